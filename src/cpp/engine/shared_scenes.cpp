#include "engine/shared_scenes.hpp"

#include <assimp/cimport.h>
#include <assimp/mesh.h>
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <dart/common/Console.hpp>
#include <dart/common/ResourceRetriever.hpp>
#include <dart/common/Uri.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <utility>

#include "base/fork.hpp"
#include "engine/import_table.hpp"

namespace pydart2 {

namespace {

using dart::common::ResourceRetriever;
using dart::common::ResourceRetrieverPtr;
using dart::common::Uri;

/// Where a file is and what is in it, as numbers that differ if it does; none if there is no such file.
using Content = std::pair<std::string, std::pair<std::size_t, std::size_t>>;

Content content_of(const Uri& uri, ResourceRetriever& retriever)
{
  const auto file = retriever.retrieve(uri);
  if (!file)
    return {};
  std::string text(file->getSize(), '\0');
  text.resize(file->read(text.data(), 1, text.size()));
  return {retriever.getFilePath(uri), {text.size(), std::hash<std::string>()(text)}};
}

/// Notes the files that an importer reads, or finds missing: a mesh, its materials.
class Noting : public ResourceRetriever
{
public:
  explicit Noting(ResourceRetrieverPtr source) : source_(std::move(source)) {}

  bool exists(const Uri& uri) override
  {
    note(uri);
    return source_->exists(uri);
  }

  dart::common::ResourcePtr retrieve(const Uri& uri) override
  {
    note(uri);
    return source_->retrieve(uri);
  }

  std::string getFilePath(const Uri& uri) override { return source_->getFilePath(uri); }

  std::map<std::string, Content> files;

private:
  void note(const Uri& uri)
  {
    if (files.count(uri.toString()) == 0)
      files[uri.toString()] = content_of(uri, *source_);
  }

  ResourceRetrieverPtr source_;
};

bool is_number(const aiVector3D& corner)
{
  return std::all_of(&corner.x, &corner.x + 3, [](double value) { return std::abs(value) <= 1e30; });
}

/// Leaves triangles whose corners are numbers: detectors end the process at points and lines, or reckon with NaN. False
/// if there are none.
bool clean(const aiScene& scene, const std::string& uri)
{
  unsigned kept = 0, dropped = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    aiMesh& mesh = *scene.mMeshes[i];
    const auto is_triangle = [&](const aiFace& face) {
      return face.mNumIndices == 3 && std::all_of(face.mIndices, face.mIndices + 3, [&](unsigned v) {
               return v < mesh.mNumVertices && is_number(mesh.mVertices[v]);
             });
    };
    const aiFace* end = std::stable_partition(mesh.mFaces, mesh.mFaces + mesh.mNumFaces, is_triangle);
    const auto triangles = static_cast<unsigned>(end - mesh.mFaces);
    dropped += std::exchange(mesh.mNumFaces, triangles) - triangles;
    kept += triangles;
    // Not in a triangle any more, but in bounding boxes.
    const aiVector3D instead = triangles == 0 ? aiVector3D() : mesh.mVertices[mesh.mFaces[0].mIndices[0]];
    std::replace_if(
        mesh.mVertices, mesh.mVertices + mesh.mNumVertices, [](const auto& corner) { return !is_number(corner); }, instead);
  }
  if (dropped > 0)
    dtwarn << "[MeshShape] '" << uri << "': " << dropped << " of " << kept + dropped
           << " faces are left out, as points, lines, or with corners that are no numbers\n";
  return kept > 0;
}

/// Mirrors corners and normals along the axes that the scheme names, and turns the triangles so that they face as before.
void mirror(const aiScene& scene, const std::string& scheme)
{
  const auto sign = [&](char axis) { return scheme.find(axis, scheme.find('-')) == std::string::npos ? 1.0F : -1.0F; };
  const aiVector3D signs(sign('x'), sign('y'), sign('z'));
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      mesh.mVertices[v] = mesh.mVertices[v].SymMul(signs);
      if (mesh.mNormals != nullptr)
        mesh.mNormals[v] = mesh.mNormals[v].SymMul(signs);
    }
    for (unsigned f = 0; f < mesh.mNumFaces && signs.x * signs.y * signs.z < 0.0F; ++f)
      std::swap(mesh.mFaces[f].mIndices[1], mesh.mFaces[f].mIndices[2]);
  }
}

/// Imported scenes and how many own each.
class Scenes
{
public:
  /// An unchanged scene for one more owner, or null.
  const aiScene* find(const std::string& uri, ResourceRetriever& retriever)
  {
    const std::lock_guard lock(mutex_);
    for (auto& shared : scenes_)
      if (shared.uri == uri && is_up_to_date(shared, retriever)) {
        ++shared.owners;
        return shared.scene;
      }
    return nullptr;
  }

  void add(const std::string& uri, const aiScene* scene, const std::map<std::string, Content>& files)
  {
    const std::lock_guard lock(mutex_);
    scenes_.push_back({uri, scene, files, 1});
  }

  bool take(const aiScene* scene)
  {
    const std::lock_guard lock(mutex_);
    const auto shared = at(scene);
    if (shared == scenes_.end())
      return false;
    ++shared->owners;
    return true;
  }

  /// Whether nobody else has it.
  bool drop(const aiScene* scene)
  {
    const std::lock_guard lock(mutex_);
    const auto shared = at(scene);
    if (shared == scenes_.end())
      return true;
    if (--shared->owners > 0)
      return false;
    scenes_.erase(shared);
    return true;
  }

private:
  struct Shared
  {
    std::string uri;
    const aiScene* scene;
    std::map<std::string, Content> files;
    int owners;
  };

  std::list<Shared>::iterator at(const aiScene* scene)
  {
    return std::find_if(scenes_.begin(), scenes_.end(), [&](const Shared& shared) { return shared.scene == scene; });
  }

  static bool is_up_to_date(const Shared& shared, ResourceRetriever& retriever)
  {
    return std::all_of(shared.files.begin(), shared.files.end(), [&](const auto& file) {
      return content_of(Uri(file.first), retriever) == file.second;
    });
  }

  HeldOverFork<std::mutex> mutex_{ForkOrder::scenes};
  std::list<Shared> scenes_;
};

auto& scenes = *new Scenes; // for ever: worlds may end after what is static

using Load = const aiScene*(const std::string&, const ResourceRetrieverPtr&);
constexpr Load* engines_load = &dart::dynamics::MeshShape::loadMesh;

const aiScene* load(const std::string& uri, const ResourceRetrieverPtr& retriever)
{
  if (!retriever)
    return engines_load(uri, retriever);
  if (const auto* scene = scenes.find(uri, *retriever))
    return scene;
  const auto noting = std::make_shared<Noting>(retriever);
  const auto* scene = engines_load(uri, noting); // without the lock: another thread may import the same meanwhile
  if (scene == nullptr)
    return nullptr;
  if (!clean(*scene, uri)) {
    aiReleaseImport(scene);
    dtwarn << "[MeshShape] '" << uri << "' has no triangle\n";
    return nullptr;
  }
  if (const auto scheme = mirror_scheme(uri); !scheme.empty())
    mirror(*scene, scheme);
  scenes.add(uri, scene, noting->files);
  return scene;
}

void release(const aiScene* scene)
{
  if (scenes.drop(scene))
    aiReleaseImport(scene);
}

} // namespace

std::string mirror_scheme(const std::string& uri)
{
  const auto end = uri.find("://");
  return uri.rfind("mirror-", 0) == 0 && end != std::string::npos ? uri.substr(0, end) : std::string();
}

bool take_scene(const aiScene* scene)
{
  return scenes.take(scene);
}

bool share_scenes()
{
  Dl_info info{};
  dladdr(reinterpret_cast<void*>(engines_load), &info); // its name, as the linker has it
  return info.dli_sname != nullptr && redirect({"libdart"}, info.dli_sname, reinterpret_cast<void*>(&load)) > 0
         && redirect({"libdart"}, "aiReleaseImport", reinterpret_cast<void*>(&release)) > 0;
}

} // namespace pydart2

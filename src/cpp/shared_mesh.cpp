#include "shared_mesh.hpp"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <dart/dynamics/BodyNode.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <typeinfo>
#include <vector>

namespace pydart2 {

using namespace dart::dynamics;

namespace {

/// Bit for bit; null only equals null.
template <class T>
bool same(const T* a, const T* b, std::size_t count)
{
  if (a == nullptr || b == nullptr)
    return a == b;
  return std::memcmp(a, b, count * sizeof(T)) == 0;
}

bool same(const aiMesh& a, const aiMesh& b)
{
  const auto count = a.mNumVertices;
  if (count != b.mNumVertices || a.mNumFaces != b.mNumFaces || a.mMaterialIndex != b.mMaterialIndex)
    return false;
  for (unsigned i = 0; i < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++i)
    if (!same(a.mTextureCoords[i], b.mTextureCoords[i], count))
      return false;
  for (unsigned i = 0; i < AI_MAX_NUMBER_OF_COLOR_SETS; ++i)
    if (!same(a.mColors[i], b.mColors[i], count))
      return false;
  return same(a.mVertices, b.mVertices, count) && same(a.mNormals, b.mNormals, count)
         && std::equal(a.mFaces, a.mFaces + a.mNumFaces, b.mFaces); // compares the indices
}

bool same(const aiMaterial& a, const aiMaterial& b)
{
  return std::equal(
      a.mProperties, a.mProperties + a.mNumProperties, b.mProperties, b.mProperties + b.mNumProperties,
      [](const aiMaterialProperty* p, const aiMaterialProperty* q) {
        return p->mKey == q->mKey && p->mSemantic == q->mSemantic && p->mIndex == q->mIndex && p->mType == q->mType
               && p->mDataLength == q->mDataLength && same(p->mData, q->mData, p->mDataLength);
      });
}

/// In all that the engine and MeshHandle read.
bool same(const aiScene& a, const aiScene& b)
{
  const auto equal = [](const auto* p, const auto* q) { return same(*p, *q); };
  return std::equal(a.mMeshes, a.mMeshes + a.mNumMeshes, b.mMeshes, b.mMeshes + b.mNumMeshes, equal)
         && std::equal(a.mMaterials, a.mMaterials + a.mNumMaterials, b.mMaterials, b.mMaterials + b.mNumMaterials, equal);
}

/// The first mesh of this process that is still there with the same content from the same file: maybe this one.
SharedMesh::Owner owner_of(const SharedMesh::Owner& mesh)
{
  static std::mutex mutex;
  static std::vector<std::weak_ptr<const MeshShape>> known;
  const std::lock_guard lock(mutex);
  known.erase(std::remove_if(known.begin(), known.end(), [](const auto& one) { return one.expired(); }), known.end());
  for (const auto& one : known)
    if (const auto other = one.lock(); // null if its last world has just gone
        other && other->getMeshPath() == mesh->getMeshPath() && same(*other->getMesh(), *mesh->getMesh()))
      return other;
  known.push_back(mesh);
  return mesh;
}

std::shared_ptr<SharedMesh> shared(const std::shared_ptr<MeshShape>& mesh)
{
  const auto& uri = mesh->getMeshUri2();
  const auto result = std::make_shared<SharedMesh>(mesh->getScale(), owner_of(mesh), uri, mesh->getResourceRetriever());
  result->setColorMode(mesh->getColorMode());
  result->setAlphaMode(mesh->getAlphaMode());
  result->setColorIndex(mesh->getColorIndex());
  return result;
}

} // namespace

SharedMesh::SharedMesh(
    const Eigen::Vector3d& scale,
    Owner owner,
    const dart::common::Uri& uri,
    dart::common::ResourceRetrieverPtr retriever)
  : MeshShape(scale, owner->getMesh(), uri, std::move(retriever)), owner_(std::move(owner))
{
}

SharedMesh::~SharedMesh()
{
  mMesh = nullptr; // the base class would free it
}

std::shared_ptr<const SharedMesh> SharedMesh::copy() const
{
  return std::make_shared<SharedMesh>(getScale(), owner_);
}

void share_meshes(Skeleton& skeleton)
{
  std::map<ShapePtr, ShapePtr> replacements; // a shape that several nodes have
  for (auto* body : skeleton.getBodyNodes())
    for (auto* node : body->getShapeNodes()) {
      const auto mesh = std::dynamic_pointer_cast<MeshShape>(node->getShape());
      if (!mesh || typeid(*mesh) != typeid(MeshShape) || mesh->getMesh() == nullptr) // an arrow makes its own mesh
        continue;
      auto& replacement = replacements[mesh];
      if (!replacement)
        replacement = shared(mesh);
      node->setShape(replacement);
    }
}

} // namespace pydart2

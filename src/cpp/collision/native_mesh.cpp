#include "collision/native_mesh.hpp"

#include <dart/dynamics/HeightmapShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <limits>
#include <map>
#include <tuple>

#include "base/fork.hpp"
#include "engine/shared_scenes.hpp"

namespace pydart2::native {

using namespace dart::dynamics;

namespace {

constexpr std::size_t most_corners = 512; // of a hull; its faces and corners are looked at one by one

using Edge = std::pair<int, int>;

/// Corners that are equal become one, triangles without area go.
std::shared_ptr<TriangleMesh> tidied(
    const std::vector<Vector>& corners, const std::vector<std::array<int, 3>>& triangles)
{
  auto mesh = std::make_shared<TriangleMesh>();
  std::map<std::tuple<double, double, double>, int> known;
  std::vector<int> index;
  for (const auto& corner : corners) {
    const auto [it, is_new] = known.emplace(std::tuple(corner.x(), corner.y(), corner.z()), static_cast<int>(known.size()));
    if (is_new)
      mesh->corners.push_back(corner);
    index.push_back(it->second);
  }
  const auto at = [&](int i) -> const Vector& { return mesh->corners[static_cast<std::size_t>(i)]; };
  for (const auto& triangle : triangles) {
    std::array<int, 3> made;
    for (std::size_t i = 0; i < 3; ++i)
      made[i] = index[static_cast<std::size_t>(triangle[i])];
    const Vector first = at(made[1]) - at(made[0]), second = at(made[2]) - at(made[0]);
    const Vector normal = first.cross(second);
    if (normal.norm() <= 1e-12 * std::max(first.squaredNorm(), second.squaredNorm()))
      continue;
    mesh->triangles.push_back(made);
    mesh->normals.push_back(normal.normalized());
  }
  return mesh;
}

/// Of edges that more than two triangles share, none has a neighbor.
void find_neighbors(TriangleMesh& mesh)
{
  std::map<Edge, std::vector<std::pair<int, int>>> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const int from = mesh.triangles[t][i], to = mesh.triangles[t][(i + 1) % 3];
      sides[std::minmax(from, to)].emplace_back(static_cast<int>(t), static_cast<int>(i));
    }
  mesh.neighbors.assign(mesh.triangles.size(), {-1, -1, -1});
  for (const auto& [edge, two] : sides) {
    if (two.size() != 2)
      continue;
    for (std::size_t k = 0; k < 2; ++k)
      mesh.neighbors[static_cast<std::size_t>(two[k].first)][static_cast<std::size_t>(two[k].second)] = two[1 - k].first;
  }
}

bool convex(const TriangleMesh& mesh, double size)
{
  if (mesh.corners.size() > most_corners)
    return false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int other = mesh.neighbors[t][i];
      if (other < 0)
        return false; // open
      const auto& its = mesh.triangles[static_cast<std::size_t>(other)];
      for (std::size_t j = 0; j < 3; ++j)
        if (its[j] == mesh.triangles[t][i] && its[(j + 1) % 3] == mesh.triangles[t][(i + 1) % 3])
          return false; // turned over
    }
    const Vector& through = mesh.corners[static_cast<std::size_t>(mesh.triangles[t][0])];
    for (const auto& corner : mesh.corners)
      if (mesh.normals[t].dot(corner - through) > 1e-6 * size)
        return false;
  }
  return !mesh.triangles.empty();
}

/// The outline of the triangles that lie in one plane.
std::vector<int> outline(const TriangleMesh& mesh, const std::vector<int>& triangles)
{
  std::map<int, int> next;
  std::map<Edge, bool> inside;
  for (const int t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& corners = mesh.triangles[static_cast<std::size_t>(t)];
      inside[{corners[i], corners[(i + 1) % 3]}] = true;
    }
  for (const auto& [edge, yes] : inside)
    if (inside.count({edge.second, edge.first}) == 0)
      next[edge.first] = edge.second;
  std::vector<int> loop;
  for (int corner = next.begin()->first; loop.size() < next.size(); corner = next[corner])
    loop.push_back(corner);
  return loop;
}

std::shared_ptr<const Hull> hull_of(const TriangleMesh& mesh)
{
  auto hull = std::make_shared<Hull>();
  hull->corners = mesh.corners;
  std::vector<bool> done(mesh.triangles.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (done[t])
      continue;
    std::vector<int> plane{static_cast<int>(t)};
    done[t] = true;
    for (std::size_t k = 0; k < plane.size(); ++k)
      for (const int other : mesh.neighbors[static_cast<std::size_t>(plane[k])])
        if (const auto o = static_cast<std::size_t>(other); !done[o] && mesh.normals[t].dot(mesh.normals[o]) > 1.0 - 1e-9) {
          done[o] = true;
          plane.push_back(other);
        }
    hull->faces.push_back(outline(mesh, plane));
    hull->normals.push_back(mesh.normals[t]);
  }
  return hull;
}

Geometry finish(const std::shared_ptr<TriangleMesh>& mesh)
{
  Geometry made;
  if (mesh->triangles.empty())
    return made;
  find_neighbors(*mesh);
  std::vector<Bounds> boxes;
  std::vector<int> leaves;
  for (const auto& triangle : mesh->triangles) {
    const auto at = [&](std::size_t i) -> const Vector& { return mesh->corners[static_cast<std::size_t>(triangle[i])]; };
    leaves.push_back(static_cast<int>(boxes.size()));
    boxes.push_back({at(0).cwiseMin(at(1)).cwiseMin(at(2)), at(0).cwiseMax(at(1)).cwiseMax(at(2))});
  }
  mesh->bounds = boxes[0];
  for (const auto& box : boxes)
    mesh->bounds.add(box);
  const Vector extent = mesh->bounds.high - mesh->bounds.low;
  made.half = extent / 2.0;
  made.center = (mesh->bounds.low + mesh->bounds.high) / 2.0;
  if (convex(*mesh, extent.maxCoeff())) {
    made.form = Form::hull;
    made.size = extent.minCoeff();
    made.hull = hull_of(*mesh);
    return made;
  }
  made.form = Form::mesh;
  made.size = extent.maxCoeff(); // one dimension may be 0: a floor
  mesh->tree.build(boxes, leaves);
  made.mesh = mesh;
  return made;
}

Geometry imported(const MeshShape& shape)
{
  std::vector<Vector> corners;
  std::vector<std::array<int, 3>> triangles;
  const auto* scene = shape.getMesh();
  for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const int first = static_cast<int>(corners.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const auto& v = part.mVertices[i];
      corners.push_back(Vector(v.x, v.y, v.z).cwiseProduct(shape.getScale()));
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i)
      if (const aiFace& face = part.mFaces[i]; face.mNumIndices == 3)
        triangles.push_back({first + static_cast<int>(face.mIndices[0]), first + static_cast<int>(face.mIndices[1]),
                             first + static_cast<int>(face.mIndices[2])});
  }
  return finish(tidied(corners, triangles));
}

/// Row 0 at the greatest y, column 0 at the least x, about the middle.
template <class Heightmap>
Geometry terrain(const Heightmap& shape)
{
  const auto& heights = shape.getHeightField();
  const Vector scale = shape.getScale().template cast<double>();
  const int rows = static_cast<int>(heights.rows()), columns = static_cast<int>(heights.cols());
  std::vector<Vector> corners;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const Vector at((j - (columns - 1) / 2.0), ((rows - 1) / 2.0 - i), static_cast<double>(heights(i, j)));
      corners.push_back(at.cwiseProduct(scale));
      if (i == 0 || j == 0)
        continue;
      const int here = i * columns + j;
      triangles.push_back({here, here - columns, here - columns - 1});
      triangles.push_back({here, here - columns - 1, here - 1});
    }
  return finish(tidied(corners, triangles));
}

/// What is made of an imported file in one scale, and a shape that keeps the file's scene.
struct Made
{
  std::shared_ptr<const MeshShape> owner;
  Geometry geometry;
};

/// The scene and its scale.
using Key = std::tuple<const aiScene*, double, double, double>;

/// Those of all worlds, each kept as long as one uses it.
std::map<Key, std::weak_ptr<Made>> all_made;
HeldOverFork<std::mutex> made_mutex(ForkOrder::meshes);

Geometry shared(const MeshShape& shape)
{
  if (!take_scene(shape.getMesh()))
    return imported(shape);
  const auto owner = std::make_shared<MeshShape>(shape.getScale(), shape.getMesh());
  const auto& scale = shape.getScale();
  const Key key(shape.getMesh(), scale.x(), scale.y(), scale.z());
  const std::lock_guard lock(made_mutex);
  auto made = all_made[key].lock();
  if (!made) {
    made = std::make_shared<Made>(Made{owner, imported(shape)});
    all_made[key] = made;
  }
  Geometry geometry = made->geometry; // whose parts keep all of it
  if (geometry.hull)
    geometry.hull = {made, made->geometry.hull.get()};
  if (geometry.mesh)
    geometry.mesh = {made, made->geometry.mesh.get()};
  return geometry;
}

} // namespace

Geometry TriangleMesh::triangle(int index) const
{
  Geometry made;
  made.form = Form::triangle;
  const auto& which = triangles[static_cast<std::size_t>(index)];
  for (std::size_t i = 0; i < 3; ++i)
    made.triangle[i] = corners[static_cast<std::size_t>(which[i])];
  made.center = (made.triangle[0] + made.triangle[1] + made.triangle[2]) / 3.0;
  made.normal = normals[static_cast<std::size_t>(index)];
  made.size = (made.triangle[1] - made.triangle[0]).norm();
  return made;
}

Geometry mesh_geometry(const Shape& shape)
{
  if (const auto* mesh = dynamic_cast<const MeshShape*>(&shape))
    return shared(*mesh);
  if (const auto* heights = dynamic_cast<const HeightmapShaped*>(&shape))
    return terrain(*heights);
  if (const auto* heights = dynamic_cast<const HeightmapShapef*>(&shape))
    return terrain(*heights);
  return {};
}

} // namespace pydart2::native

#include <algorithm>
#include <limits>

#include "collision/native_mesh.hpp"
#include "collision/native_pairs.hpp"

namespace pydart2::native {

namespace {

constexpr double same_normal = 0.99; // cosine of 8 degrees: points of one cluster

Bounds grown(const Bounds& bounds, double by)
{
  return {bounds.low.array() - by, bounds.high.array() + by};
}

/// Leaves four points of each cluster of like normals.
void keep_clusters(Points& points, std::size_t begin, double size)
{
  Points left(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end());
  points.resize(begin);
  while (!left.empty()) {
    const Vector normal = left.front().normal;
    const auto other = [&](const Point& point) { return point.normal.dot(normal) <= same_normal; };
    const auto middle = std::stable_partition(left.begin(), left.end(), [&](const Point& p) { return !other(p); });
    const auto first = points.size();
    points.insert(points.end(), left.begin(), middle);
    keep_four(points, first, size);
    left.erase(left.begin(), middle);
  }
}

/// No two points of a pair have one number.
void make_unique(Points& points, std::size_t begin)
{
  for (auto i = begin; i < points.size(); ++i)
    for (auto j = begin; j < i; ++j)
      if (points[j].feature == points[i].feature) {
        ++points[i].feature;
        j = begin - 1; // look at all again, from j = begin
      }
}

/// Whether a triangle's contact with this normal, from the triangle to the other body in the mesh's frame, is its own:
/// across its face, or over an edge no farther than to the next triangle's normal. Else a body that slides over triangles
/// in one plane would catch at the edges between them.
bool own_normal(const TriangleMesh& mesh, int index, const Vector& normal)
{
  const auto t = static_cast<std::size_t>(index);
  const double side = mesh.normals[t].dot(normal) < 0 ? -1.0 : 1.0;
  const Vector& up = mesh.normals[t];
  for (std::size_t i = 0; i < 3; ++i) {
    const int neighbor = mesh.neighbors[t][i];
    if (neighbor < 0)
      continue;
    const Vector edge = mesh.corners[static_cast<std::size_t>(mesh.triangles[t][(i + 1) % 3])]
                        - mesh.corners[static_cast<std::size_t>(mesh.triangles[t][i])];
    const Vector out = edge.cross(up).normalized();
    const Vector& next = mesh.normals[static_cast<std::size_t>(neighbor)];
    if (next.dot(up) < -0.999999)
      continue; // two sides of a sheet
    if (normal.dot(out) > std::max(0.0, side * next.dot(out)) + 1e-3)
      return false;
  }
  return true;
}

/// A convex shape and the triangles near it.
void collide_convex_mesh(const Geometry& a, const TriangleMesh& mesh, const Pose& mesh_in_a, double margin, Points& points)
{
  const Bounds near = grown(bounds_of(a, mesh_in_a.inverse(Eigen::Isometry)), margin);
  std::vector<int> triangles;
  mesh.tree.overlaps(near, [&](int index) { triangles.push_back(index); });
  std::sort(triangles.begin(), triangles.end());
  const auto begin = points.size();
  Points others;
  for (const int index : triangles) {
    const auto first = points.size();
    collide_convex(a, mesh.triangle(index), mesh_in_a, margin, points);
    for (auto i = first; i < points.size(); ++i)
      points[i].feature ^= static_cast<std::uint32_t>(index) * 0x9e3779b1U; // a triangle's points stay apart
    const auto strange = [&](const Point& point) {
      return !own_normal(mesh, index, mesh_in_a.linear().transpose() * point.normal);
    };
    std::copy_if(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(), std::back_inserter(others), strange);
    points.erase(
        std::remove_if(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(), strange), points.end());
  }
  if (points.size() == begin)
    points.insert(points.end(), others.begin(), others.end()); // better than none
  keep_clusters(points, begin, a.size);
  make_unique(points, begin);
}

void collide_plane_mesh(const Geometry& plane, const TriangleMesh& mesh, const Pose& pose, double margin, Points& points)
{
  const auto begin = points.size();
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const Vector at = pose * mesh.corners[i];
    const double depth = plane.offset - plane.normal.dot(at);
    if (depth >= -margin)
      points.push_back({at + plane.normal * (depth / 2.0), -plane.normal, depth, static_cast<std::uint32_t>(i)});
  }
  keep_four(points, begin, (mesh.bounds.high - mesh.bounds.low).norm());
}

void collide_meshes(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, double margin, Points& points)
{
  const auto begin = points.size();
  const Pose a_in_b = b_in_a.inverse(Eigen::Isometry);
  const Vector middle = a_in_b * ((a.bounds.low + a.bounds.high) / 2.0);
  const Vector half = a_in_b.linear().cwiseAbs() * ((a.bounds.high - a.bounds.low) / 2.0);
  std::vector<int> of_b;
  b.tree.overlaps(grown({middle - half, middle + half}, margin), [&](int index) { of_b.push_back(index); });
  std::sort(of_b.begin(), of_b.end());
  std::vector<int> of_a;
  for (const int i : of_b) {
    const Geometry triangle = b.triangle(i);
    of_a.clear();
    a.tree.overlaps(grown(bounds_of(triangle, b_in_a), margin), [&](int index) { of_a.push_back(index); });
    std::sort(of_a.begin(), of_a.end());
    for (const int j : of_a) {
      const auto first = points.size();
      collide_convex(a.triangle(j), triangle, b_in_a, margin, points);
      for (auto k = first; k < points.size(); ++k)
        points[k].feature ^= (static_cast<std::uint32_t>(i) * 0x9e3779b1U) ^ (static_cast<std::uint32_t>(j) * 0x85ebca6bU);
    }
  }
  keep_clusters(points, begin, std::min((a.bounds.high - a.bounds.low).norm(), (b.bounds.high - b.bounds.low).norm()));
  make_unique(points, begin);
}

} // namespace

void collide_mesh(const Geometry& a, const Geometry& mesh, const Pose& mesh_in_a, double margin, Points& points)
{
  if (a.form == Form::mesh)
    return collide_meshes(*a.mesh, *mesh.mesh, mesh_in_a, margin, points);
  if (a.form == Form::plane)
    return collide_plane_mesh(a, *mesh.mesh, mesh_in_a, margin, points);
  collide_convex_mesh(a, *mesh.mesh, mesh_in_a, margin, points);
}

} // namespace pydart2::native

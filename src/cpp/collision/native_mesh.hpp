#pragma once

#include <dart/dynamics/Shape.hpp>

#include "collision/native_manifold.hpp"
#include "collision/native_tree.hpp"

namespace pydart2::native {

/// Triangles, and which share an edge.
struct TriangleMesh
{
  std::vector<Vector> corners;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Vector> normals; ///< By the order of a triangle's corners.
  std::vector<std::array<int, 3>> neighbors; ///< Across the edges that begin at the corners; -1: none.
  BoundsTree tree;
  Bounds bounds;

  Geometry triangle(int index) const;
};

/// A hull where the triangles bound a convex body of moderate size, else the triangles; Form::none for other shapes than
/// meshes and heightmaps, and for those without a triangle. Equal meshes of imported files are shared.
Geometry mesh_geometry(const dart::dynamics::Shape& shape);

/// What collide() is for a mesh of triangles and a convex shape, a plane, or another mesh of triangles.
void collide_mesh(const Geometry& a, const Geometry& mesh, const Pose& mesh_in_a, double margin, Points& points);

} // namespace pydart2::native

#pragma once

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <string>

#include "base/arrays.hpp"
#include "handles/shape.hpp"

namespace pydart2 {

/// One mesh of the file behind a dart::dynamics::MeshShape, with one material. Not scaled; row per corner or triangle.
class MeshHandle
{
public:
  MeshHandle(const ShapeHandle::Node& node, const aiScene* scene, const aiMesh* mesh);

  void vertices(Output& out) const;
  void normals(Output& out) const;

  /// First set of texture coordinates; no rows if there is none.
  void texture_coordinates(Output& out) const;

  /// RGBA of each vertex; no rows if there is none.
  void colors(Output& out) const;

  /// Indices of the corners of each triangle, as numbers; points and lines are left out.
  void triangles(Output& out) const;

  /// Of the material: whether the file gives one; RGBA; strength and exponent of the highlights.
  bool has_material() const;
  Eigen::Vector4d diffuse() const;
  double specular() const;
  double shininess() const;

  /// Picture of the diffuse colour as the file names it, empty if there is none.
  std::string texture() const;

private:
  const aiMesh& mesh() const;
  const aiMaterial& material() const;

  ShapeHandle::Node node_; // keeps the shape, whose scene this is
  dart::dynamics::ShapePtr shape_;
  const aiScene* scene_;
  const aiMesh* mesh_;
};

} // namespace pydart2

#include "handles/mesh.hpp"

#include <assimp/material.h>

#include <algorithm>

namespace pydart2 {

namespace {

void rows_of(Output& out, const aiVector3D* vectors, unsigned count, long columns)
{
  double* to = out.matrix(vectors == nullptr ? 0 : count, columns);
  for (unsigned i = 0; vectors != nullptr && i < count; ++i)
    for (long axis = 0; axis < columns; ++axis)
      *to++ = vectors[i][static_cast<unsigned>(axis)];
}

} // namespace

MeshHandle::MeshHandle(const ShapeHandle::Node& node, const aiScene* scene, const aiMesh* mesh)
  : node_(node), shape_(node->getShape()), scene_(scene), mesh_(mesh)
{
}

const aiMesh& MeshHandle::mesh() const
{
  node_.get(); // throws if the world is gone
  return *mesh_;
}

const aiMaterial& MeshHandle::material() const
{
  return *scene_->mMaterials[mesh().mMaterialIndex];
}

void MeshHandle::vertices(Output& out) const
{
  rows_of(out, mesh().mVertices, mesh_->mNumVertices, 3);
}

void MeshHandle::normals(Output& out) const
{
  rows_of(out, mesh().mNormals, mesh_->mNumVertices, 3);
}

void MeshHandle::texture_coordinates(Output& out) const
{
  rows_of(out, mesh().mTextureCoords[0], mesh_->mNumVertices, 2);
}

void MeshHandle::colors(Output& out) const
{
  const aiColor4D* color = mesh().mColors[0];
  double* to = out.matrix(color == nullptr ? 0 : mesh_->mNumVertices, 4);
  for (unsigned i = 0; color != nullptr && i < mesh_->mNumVertices; ++i)
    for (unsigned channel = 0; channel < 4; ++channel)
      *to++ = color[i][channel];
}

void MeshHandle::triangles(Output& out) const
{
  const aiFace* first = mesh().mFaces;
  const aiFace* last = first + mesh_->mNumFaces;
  const auto is_triangle = [](const aiFace& face) { return face.mNumIndices == 3; };
  double* to = out.matrix(std::count_if(first, last, is_triangle), 3);
  for (const aiFace* face = first; face != last; ++face)
    if (is_triangle(*face))
      to = std::copy(face->mIndices, face->mIndices + 3, to);
}

bool MeshHandle::has_material() const
{
  if (mesh().mMaterialIndex >= scene_->mNumMaterials)
    return false;
  aiString name;
  material().Get(AI_MATKEY_NAME, name);
  return std::string(name.C_Str()) != AI_DEFAULT_MATERIAL_NAME;
}

Eigen::Vector4d MeshHandle::diffuse() const
{
  aiColor3D color(0.8F, 0.8F, 0.8F);
  float opacity = 1.0F;
  if (has_material()) {
    material().Get(AI_MATKEY_COLOR_DIFFUSE, color);
    material().Get(AI_MATKEY_OPACITY, opacity);
  }
  return {color.r, color.g, color.b, opacity};
}

double MeshHandle::specular() const
{
  aiColor3D color(0.0F, 0.0F, 0.0F);
  if (has_material())
    material().Get(AI_MATKEY_COLOR_SPECULAR, color);
  return (color.r + color.g + color.b) / 3.0;
}

double MeshHandle::shininess() const
{
  float exponent = 0.0F;
  if (has_material())
    material().Get(AI_MATKEY_SHININESS, exponent);
  return exponent;
}

std::string MeshHandle::texture() const
{
  aiString path;
  if (has_material())
    material().GetTexture(aiTextureType_DIFFUSE, 0, &path);
  return path.C_Str();
}

} // namespace pydart2

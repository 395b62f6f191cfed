#include "loading/built_shapes.hpp"

#include <assimp/scene.h>

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/HeightmapShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/MultiSphereConvexHullShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <iomanip>

#include "base/errors.hpp"
#include "engine/shared_scenes.hpp"
#include "loading/built.hpp"
#include "loading/model_source.hpp"

namespace pydart2::built {

using namespace dart::dynamics;

namespace {

using Numbers = std::vector<double>;

Eigen::Vector3d three(const Numbers& numbers)
{
  return {numbers[0], numbers[1], numbers[2]};
}

constexpr struct
{
  const char* type;
  std::size_t size;
  ShapePtr (*make)(const Numbers&);
} plain[] = {
    {"BoxShape", 3, [](const Numbers& n) -> ShapePtr { return std::make_shared<BoxShape>(three(n)); }},
    {"EllipsoidShape", 3, [](const Numbers& n) -> ShapePtr { return std::make_shared<EllipsoidShape>(three(n)); }},
    {"PyramidShape", 3, [](const Numbers& n) -> ShapePtr { return std::make_shared<PyramidShape>(n[0], n[1], n[2]); }},
    {"SphereShape", 1, [](const Numbers& n) -> ShapePtr { return std::make_shared<SphereShape>(n[0]); }},
    {"CylinderShape", 2, [](const Numbers& n) -> ShapePtr { return std::make_shared<CylinderShape>(n[0], n[1]); }},
    {"CapsuleShape", 2, [](const Numbers& n) -> ShapePtr { return std::make_shared<CapsuleShape>(n[0], n[1]); }},
    {"ConeShape", 2, [](const Numbers& n) -> ShapePtr { return std::make_shared<ConeShape>(n[0], n[1]); }},
    {"PlaneShape", 4, [](const Numbers& n) -> ShapePtr { return std::make_shared<PlaneShape>(three(n), n[3]); }},
};

const std::string hull_type = "MultiSphereConvexHullShape";

ShapePtr make_hull(const Numbers& numbers)
{
  MultiSphereConvexHullShape::Spheres spheres;
  for (std::size_t i = 0; i + 3 < numbers.size(); i += 4)
    spheres.push_back({numbers[i], {numbers[i + 1], numbers[i + 2], numbers[i + 3]}});
  return std::make_shared<MultiSphereConvexHullShape>(spheres);
}

void write_numbers(std::ostream& out, const Numbers& numbers)
{
  out << ' ' << numbers.size();
  for (const double number : numbers)
    out << ' ' << number;
}

Numbers read_numbers(std::istream& in)
{
  std::size_t size = 0;
  in >> size;
  Numbers numbers;
  for (std::size_t i = 0; i < size && in; ++i) {
    double number = 0.0;
    in >> number;
    numbers.push_back(number);
  }
  return numbers;
}

Numbers vertices_of(const aiMesh& mesh)
{
  Numbers vertices;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    vertices.insert(vertices.end(), {mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z});
  return vertices;
}

Numbers triangles_of(const aiMesh& mesh)
{
  Numbers corners;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i)
    for (unsigned k = 0; k < 3; ++k)
      corners.push_back(mesh.mFaces[i].mIndices[k]);
  return corners;
}

/// A mesh by its file, or if it was made of arrays by these.
void write_mesh(std::ostream& out, const MeshShape& shape)
{
  auto& mesh = const_cast<MeshShape&>(shape); // getResourceRetriever() is not const
  const auto retriever = mesh.getResourceRetriever();
  const auto& uri = shape.getMeshUri2();
  std::string path = retriever ? retriever->getFilePath(uri) : std::string();
  if (const auto scheme = mirror_scheme(uri.toString()); !path.empty() && !scheme.empty())
    path = scheme + "://" + path;
  const Eigen::Vector3d& scale = shape.getScale();
  out << ' ' << std::quoted(path);
  write_numbers(out, {scale.x(), scale.y(), scale.z()});
  out << ' ' << shape.getColorMode() << ' ' << shape.getAlphaMode() << ' ' << shape.getColorIndex();
  if (!path.empty())
    return;
  write_numbers(out, vertices_of(*shape.getMesh()->mMeshes[0]));
  write_numbers(out, triangles_of(*shape.getMesh()->mMeshes[0]));
}

ShapePtr read_mesh_file(const std::string& path, const Eigen::Vector3d& scale)
{
  const auto retriever = make_retriever(ModelSource("built", ""));
  const auto scheme = mirror_scheme(path);
  dart::common::Uri uri;
  uri.mScheme = scheme.empty() ? "file" : scheme;
  uri.mAuthority = "";
  uri.mPath = scheme.empty() ? path : path.substr(scheme.size() + 3);
  const aiScene* scene = MeshShape::loadMesh(uri, retriever);
  if (scene == nullptr)
    throw Error(Kind::load, "the mesh file '" + path + "' cannot be read");
  return std::make_shared<MeshShape>(scale, scene, uri, retriever);
}

ShapePtr read_mesh(std::istream& in)
{
  std::string path;
  in >> std::quoted(path);
  const auto scale = read_numbers(in);
  int color_mode = 0, alpha_mode = 0, color_index = 0;
  in >> color_mode >> alpha_mode >> color_index;
  if (!in || scale.size() != 3)
    return nullptr;
  ShapePtr shape;
  if (!path.empty())
    shape = read_mesh_file(path, three(scale));
  else {
    const auto vertices = read_numbers(in);
    shape = make_mesh(vertices, read_numbers(in));
  }
  auto& mesh = dynamic_cast<MeshShape&>(*shape);
  mesh.setScale(three(scale));
  mesh.setColorMode(static_cast<MeshShape::ColorMode>(color_mode));
  mesh.setAlphaMode(static_cast<MeshShape::AlphaMode>(alpha_mode));
  mesh.setColorIndex(color_index);
  return shape;
}

void write_heightfield(std::ostream& out, const HeightmapShapef& shape)
{
  const auto& field = shape.getHeightField();
  const RowMajor heights = field.cast<double>();
  out << ' ' << heights.rows() << ' ' << heights.cols();
  write_numbers(out, {heights.data(), heights.data() + heights.size()});
  const Eigen::Vector3f& scale = shape.getScale();
  write_numbers(out, {scale.x(), scale.y(), scale.z()});
}

ShapePtr read_heightfield(std::istream& in)
{
  long rows = 0, cols = 0;
  in >> rows >> cols;
  const auto heights = read_numbers(in);
  const auto scale = read_numbers(in);
  if (!in || rows < 2 || cols < 2 || static_cast<long>(heights.size()) != rows * cols || scale.size() != 3)
    return nullptr;
  return make_heightfield({heights.data(), rows, cols}, three(scale));
}

/// Sizes that make a shape of the type; their values come with visit_model().
Numbers some_sizes(const Shape& shape)
{
  for (const auto& kind : plain)
    if (shape.getType() == kind.type)
      return Numbers(kind.size, 1.0);
  if (shape.getType() == hull_type)
    return {1.0, 0.0, 0.0, 0.0};
  throw Error(Kind::value, "a skeleton with a " + shape.getType() + " cannot be changed");
}

} // namespace

ShapePtr make_shape(const std::string& type, const std::vector<double>& sizes)
{
  for (const auto& kind : plain)
    if (type == kind.type && sizes.size() == kind.size)
      return kind.make(sizes);
  if (type == hull_type && !sizes.empty() && sizes.size() % 4 == 0)
    return make_hull(sizes);
  return nullptr;
}

ShapePtr make_mesh(const std::vector<double>& vertices, const std::vector<double>& triangles)
{
  auto* mesh = new aiMesh;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(vertices.size() / 3);
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i)
    mesh->mVertices[i] = aiVector3D(
        static_cast<ai_real>(vertices[3 * i]), static_cast<ai_real>(vertices[3 * i + 1]),
        static_cast<ai_real>(vertices[3 * i + 2]));
  mesh->mNumFaces = static_cast<unsigned>(triangles.size() / 3);
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    auto& face = mesh->mFaces[i];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (unsigned k = 0; k < 3; ++k)
      face.mIndices[k] = static_cast<unsigned>(triangles[3 * i + k]);
  }
  auto* scene = new aiScene; // the engine frees it as one of the importer's, which takes either
  scene->mNumMeshes = 1;
  scene->mMeshes = new aiMesh*[1]{mesh};
  scene->mNumMaterials = 1;
  scene->mMaterials = new aiMaterial*[1]{new aiMaterial};
  scene->mRootNode = new aiNode;
  scene->mRootNode->mNumMeshes = 1;
  scene->mRootNode->mMeshes = new unsigned[1]{0};
  auto shape = std::make_shared<MeshShape>(Eigen::Vector3d::Ones(), scene);
  shape->setColorMode(MeshShape::SHAPE_COLOR);
  return shape;
}

ShapePtr make_heightfield(const MatrixIn& heights, const Eigen::Vector3d& scale)
{
  auto shape = std::make_shared<HeightmapShapef>(); // in single precision: Bullet has no other
  shape->setHeightField(Eigen::Map<const RowMajor>(heights.data, heights.rows, heights.cols).cast<float>());
  shape->setScale(scale.cast<float>());
  return shape;
}

void write_shape(std::ostream& out, const ShapeNode& node)
{
  const int purposes = (node.hasVisualAspect() ? visual : 0) | (node.hasCollisionAspect() ? collision : 0)
                       | (node.hasDynamicsAspect() ? dynamics : 0);
  const auto& shape = *node.getShape();
  out << ' ' << std::quoted(node.getName()) << ' ' << purposes << ' ' << std::quoted(shape.getType());
  if (const auto* mesh = dynamic_cast<const MeshShape*>(&shape))
    write_mesh(out, *mesh);
  else if (const auto* field = dynamic_cast<const HeightmapShapef*>(&shape))
    write_heightfield(out, *field);
  else
    write_numbers(out, some_sizes(shape));
}

void read_shape(std::istream& in, BodyNode& body)
{
  std::string name, type;
  int purposes = 0;
  in >> std::quoted(name) >> purposes >> std::quoted(type);
  ShapePtr shape;
  if (type == MeshShape::getStaticType())
    shape = read_mesh(in);
  else if (type == HeightmapShapef::getStaticType())
    shape = read_heightfield(in);
  else
    shape = make_shape(type, read_numbers(in));
  if (in && shape)
    add_shape(body, shape, name, purposes);
  else
    in.setstate(std::ios::failbit);
}

ShapeNode& add_shape(BodyNode& body, const ShapePtr& shape, const std::string& name, int purposes)
{
  auto& node = *body.createShapeNode(shape, name);
  if (purposes & visual)
    node.createVisualAspect();
  if (purposes & collision)
    node.createCollisionAspect();
  if (purposes & dynamics)
    node.createDynamicsAspect();
  return node;
}

} // namespace pydart2::built

// What a ShapeHandle tells of shapes with data of their own: meshes, heightmaps, lines, points, voxels.
#include <dart/config.hpp>
#include <dart/dynamics/HeightmapShape.hpp>
#include <dart/dynamics/LineSegmentShape.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/PointCloudShape.hpp>
#include <dart/dynamics/VoxelGridShape.hpp>

#include <algorithm>

#include "base/checks.hpp"
#include "handles/mesh.hpp"
#include "handles/shape.hpp"
#include "handles/shape_kinds.hpp"

namespace pydart2 {

using namespace dart::dynamics;

namespace {

using Meshes = OneOf<MeshShape>;
using Lines = OneOf<LineSegmentShape>;
using Points = OneOf<PointCloudShape>;

} // namespace

int ShapeHandle::num_meshes() const
{
  return with(shape(), "meshes", Meshes{}, [](auto& s) {
    return s.getMesh() == nullptr ? 0 : static_cast<int>(s.getMesh()->mNumMeshes);
  });
}

MeshHandle ShapeHandle::mesh(long index) const
{
  check::index(index, num_meshes(), "mesh");
  const aiScene* scene = dynamic_cast<MeshShape&>(shape()).getMesh();
  return MeshHandle(node_, scene, scene->mMeshes[index]);
}

bool ShapeHandle::uses_materials() const
{
  return with(shape(), "materials", Meshes{}, [](auto& s) { return s.getColorMode() == MeshShape::MATERIAL_COLOR; });
}

void ShapeHandle::heights(Output& out) const
{
  with(shape(), "heights", OneOf<HeightmapShaped, HeightmapShapef>{}, [&](auto& s) {
    const auto& field = s.getHeightField();
    matrix(out, field.rows(), field.cols()) = field.template cast<double>();
  });
}

void ShapeHandle::segments(Output& out) const
{
  with(shape(), "segments", Lines{}, [&](auto& s) {
    double* row = out.matrix(static_cast<long>(s.getConnections().size()), 6);
    for (const Eigen::Vector2i& ends : s.getConnections())
      for (const int end : {ends[0], ends[1]}) {
        const Eigen::Vector3d& point = s.getVertices()[static_cast<std::size_t>(end)];
        row = std::copy(point.data(), point.data() + 3, row);
      }
  });
}

double ShapeHandle::thickness() const
{
  return with(shape(), "thickness", Lines{}, [](auto& s) -> double { return s.getThickness(); });
}

void ShapeHandle::points(Output& out) const
{
  with(shape(), "points", Points{}, [&](auto& s) {
    double* row = out.matrix(static_cast<long>(s.getNumPoints()), 3);
    for (const Eigen::Vector3d& point : s.getPoints())
      row = std::copy(point.data(), point.data() + 3, row);
  });
}

void ShapeHandle::point_colors(Output& out) const
{
  with(shape(), "point colors", Points{}, [&](auto& s) {
    const auto& colors = s.getColors();
    const bool one_each = s.getColorMode() == PointCloudShape::BIND_PER_POINT && colors.size() == s.getNumPoints();
    double* row = out.matrix(one_each ? static_cast<long>(colors.size()) : 0, 4);
    for (std::size_t i = 0; one_each && i < colors.size(); ++i)
      row = std::copy(colors[i].data(), colors[i].data() + 4, row);
  });
}

double ShapeHandle::point_size() const
{
  return with(shape(), "point size", Points{}, [](auto& s) { return s.getVisualSize(); });
}

void ShapeHandle::voxels(Output& out) const
{
#if HAVE_OCTOMAP
  with(shape(), "voxels", OneOf<VoxelGridShape>{}, [&](auto& s) {
    std::vector<Eigen::Vector4d> cells;
    const auto tree = s.getOctree();
    for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf)
      if (tree->isNodeOccupied(*leaf))
        cells.emplace_back(leaf.getX(), leaf.getY(), leaf.getZ(), leaf.getSize());
    double* row = out.matrix(static_cast<long>(cells.size()), 4);
    for (const Eigen::Vector4d& cell : cells)
      row = std::copy(cell.data(), cell.data() + 4, row);
  });
#else
  out.matrix(0, 4); // a DART without OctoMap makes no voxel grids
#endif
}

} // namespace pydart2

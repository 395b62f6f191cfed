#include "collision/fcl_skin.hpp"

#include <array>
#include <fcl/math/bv/utility.h>

namespace pydart2 {

namespace {

using Vector = fcl::Vector3<double>;
using Box = fcl::OBB<double>;

/// The box of one triangle, there and before.
void fit_leaf(const SkinTree& tree, int triangle, Box& box)
{
  const auto& corners = tree.tri_indices[triangle];
  std::array<Vector, 6> points;
  for (const std::size_t k : {0, 1, 2}) {
    points[k] = tree.prev_vertices[corners[k]];
    points[k + 3] = tree.vertices[corners[k]];
  }
  fcl::detail::OBB_fit_functions::fitn(points.data(), 6, box);
}

void fit_boxes(SkinTree& tree)
{
  for (int i = tree.getNumBVs() - 1; i >= 0; --i) { // nodes come before their children
    auto& node = tree.getBV(i);
    if (node.isLeaf())
      fit_leaf(tree, node.primitiveId(), node.bv.obb);
    else
      node.bv.obb = tree.getBV(node.leftChild()).bv.obb + tree.getBV(node.rightChild()).bv.obb;
  }
}

} // namespace

void move_skin(SkinTree& tree, dart::dynamics::SoftMeshShape& skin)
{
  skin.update();
  const aiMesh& mesh = *skin.getAssimpMesh();
  tree.beginUpdateModel();
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const auto corner = [&](int k) {
      const auto& at = mesh.mVertices[mesh.mFaces[i].mIndices[k]];
      return Vector(at.x, at.y, at.z);
    };
    tree.updateTriangle(corner(0), corner(1), corner(2));
  }
  fit_boxes(tree);
  tree.build_state = fcl::BVH_BUILD_STATE_UPDATED; // as endUpdateModel(), which would fit all
}

} // namespace pydart2

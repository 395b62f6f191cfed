#pragma once

#include <vector>

#include "dynamics/link_tree.hpp"

namespace pydart2 {

/// The joint-space mass matrix of a skeleton by the composite rigid body algorithm (Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, section 6.2), a tenth of the time of DART's own, which runs inverse dynamics once per dof.
///
/// Each link i has a frame, a parent p(i), the transform (R, p) from its frame to its parent's, a spatial inertia
/// (mass m, first moment h, rotational inertia I about the frame's origin) and the Jacobian S_i of its joint: columns
/// [angular; linear] in the link's frame, one per dof. With the links in an order where parents come first:
///
///   1. From the last link to the first, composite inertia: C_i = own inertia + sum of the children's C in frame i, where
///        m' = m,  h' = R h + m p,  I' = R I R^T - [p][R h] - [h'][p].
///   2. F = C_i S_i, the momentum of all that link i carries per unit of its joint's velocity:
///        angular = I w + h x v,  linear = m v - h x w,  for a column [w; v] of S_i.
///   3. M_ii = S_i^T F; then, with j going up from p(i) to the root, F taken to frame j, M_ij = F^T S_j = M_ji^T:
///        linear' = R linear,  angular' = R angular + p x linear'.
///
/// Rows and columns of links on different branches stay zero. Valid until the tree changes.
class MassMatrix
{
public:
  /// The engine's matrix, up to date. That of a skeleton with soft bodies is computed by DART.
  const Eigen::MatrixXd& update(const LinkTree& tree);

private:
  void compose_inertias(const std::vector<Link>& links);
  void fill(const std::vector<Link>& links, std::size_t index, Eigen::MatrixXd& M) const;

  std::vector<SpatialInertia> inertias_;
};

} // namespace pydart2

#include <dart/dynamics/BodyNode.hpp>

#include "dynamics/each_dof.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/spatial_inline.hpp"

// A step of length h from q0 to q1 = q0 (+) r turns body i by R0' R1 = cay(w) and takes its centre of mass from x0 to x1.
// With the discrete Lagrangian h (sum of 1/2 w' I w / h^2 + 1/2 m |x1 - x0|^2 / h^2 - potential, half of it at each end) the
// momenta at the ends are
//
//   p0 = sum of J(q0)' [dcay^-1(w)' I w; m R0' (x1 - x0)] / h - h/2 F(q0),
//   p1 = sum of J(q1)' [dcay^-1(-w)' I w; m R1' (x1 - x0)] / h + h/2 F(q1),
//
// J of the centres of mass, F the forces, with damping of the mean velocity r / h. The first is solved for r, the second
// gives the velocity at the end, p1 = (M(q1) + A) dq1. Unlike the paper's, displacements turn and move apart, so that a free
// body's centre goes straight on. The Cayley map and its derivative have closed forms (Kobilarov, Marsden, "Discrete
// Geometric Optimal Control on Lie Groups", IEEE T-RO 27(4), 2011), with which momenta are kept to the last digits.

namespace pydart2 {

namespace {

using Eigen::Vector3d;
using Eigen::Vector6d;
using Eigen::VectorXd;
using Dof = dart::dynamics::DegreeOfFreedom;

constexpr int most_iterations = 40;
constexpr double most_turning = 2.0; ///< rad in a step; at pi a turn the other way would do too.

/// w of a rotation cay(w).
Vector3d inverse_cayley(const Eigen::Matrix3d& R)
{
  return 2.0 / (1.0 + R.trace()) * Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

/// dcay^-1(w)' of an angular momentum.
Vector3d transposed_cayley_rate(const Vector3d& w, const Vector3d& momentum)
{
  return momentum + 0.5 * w.cross(momentum) + 0.25 * w * w.dot(momentum);
}

} // namespace

SkeletonIntegrator::Places SkeletonIntegrator::places() const
{
  Places places;
  for (const auto& link : tree_.links) {
    places.push_back({link.body->getWorldTransform(), link.joint->getRelativeTransform(), {}});
    if (link.num_dofs > 0)
      places.back().S = link.S();
  }
  return places;
}

/// What wrenches on all links, each in its link's frame, are along the dofs.
VectorXd SkeletonIntegrator::generalised(const Places& places, std::vector<Vector6d> wrenches) const
{
  VectorXd forces(q0_.size());
  for (std::size_t i = places.size(); i-- > 0;) {
    const auto& link = tree_.links[i];
    if (link.num_dofs > 0)
      forces.segment(link.first_dof, link.num_dofs) = places[i].S.transpose() * wrenches[i];
    if (link.parent >= 0)
      wrenches[static_cast<std::size_t>(link.parent)] += spatial::to_parent(places[i].in_parent, wrenches[i]);
  }
  return forces;
}

/// Of actuators, weight, external forces and springs.
VectorXd SkeletonIntegrator::forces(const Places& places) const
{
  std::vector<Vector6d> wrenches;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& body = *tree_.links[i].body;
    Vector6d g = Vector6d::Zero();
    if (body.getGravityMode())
      g.tail<3>() = places[i].in_world.linear().transpose() * skeleton_.getGravity();
    wrenches.push_back(body.getSpatialInertia() * g + body.getExternalForceLocal());
  }
  return generalised(places, std::move(wrenches)) + actuator_forces() + each_dof(skeleton_, [](const Dof& dof) {
           return -dof.getSpringStiffness() * (dof.getPosition() - dof.getRestPosition());
         });
}

/// On each body, in its frame, h times the momentum of its displacement between two places, at the first or the second.
std::vector<Vector6d> SkeletonIntegrator::displacement_momenta(const Places& from, const Places& to, bool at_end) const
{
  std::vector<Vector6d> momenta;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto& inertia = tree_.links[i].body->getInertia();
    const auto &T0 = from[i].in_world, &T1 = to[i].in_world, &T = at_end ? T1 : T0;
    const Vector3d com = inertia.getLocalCOM(), w = inverse_cayley(T0.linear().transpose() * T1.linear());
    const Vector3d linear = inertia.getMass() * (T.linear().transpose() * (T1 * com - T0 * com));
    const Vector3d angular = transposed_cayley_rate(at_end ? Vector3d(-w) : w, inertia.getMoment() * w);
    momenta.push_back((Vector6d() << angular + com.cross(linear), linear).finished());
  }
  return momenta;
}

bool SkeletonIntegrator::step_variational(const Armature& armature, double h)
{
  const VectorXd damping = each_dof(skeleton_, [](const Dof& dof) { return dof.getDampingCoefficient(); });
  VectorXd rotors = VectorXd::Zero(q0_.size());
  for (const auto& [dof, inertia] : armature)
    rotors[static_cast<long>(dof->getIndexInSkeleton())] = inertia;
  go_back(h, dq0_);
  for (const auto& link : tree_.links)
    if (h * link.body->getAngularVelocity().norm() > most_turning) {
      go_back(h, predicted_);
      return false;
    }
  const auto start = places();
  const Eigen::LLT<Eigen::MatrixXd> M0 = mass(armature).llt();
  const VectorXd given = mass(armature) * dq0_ + 0.5 * h * forces(start);
  const auto drag = [&](const VectorXd& r) { return VectorXd(0.5 * damping.cwiseProduct(r)); };

  VectorXd r = h * dq0_;
  double last = 0.0;
  for (int i = 0;; ++i) {
    move(r);
    const VectorXd missing = given - drag(r) - rotors.cwiseProduct(r) / h
                             - generalised(start, displacement_momenta(start, places(), false)) / h;
    const VectorXd change = h * M0.solve(missing);
    const double size = change.lpNorm<Eigen::Infinity>();
    if (!(size < 1.0) || i == most_iterations) {
      go_back(h, predicted_);
      return false;
    }
    r += change;
    if (size < 1e-15 || (size < 1e-9 && i > 2 && size > 0.5 * last))
      break;
    last = size;
  }
  move(r);
  const auto end = places();
  const VectorXd momentum = generalised(end, displacement_momenta(start, end, true)) / h + 0.5 * h * forces(end) - drag(r)
                            + rotors.cwiseProduct(r) / h;
  set_velocities(mass(armature).llt().solve(momentum), h);
  return true;
}

} // namespace pydart2

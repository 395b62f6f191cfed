#include "contact/movers.hpp"

#include <dart/dynamics/SoftBodyNode.hpp>
#include <typeinfo>

#include "engine/tree_members.hpp"

namespace pydart2 {

using dart::dynamics::BodyNode;
using dart::dynamics::FreeJoint;
using Eigen::Vector3d;

namespace {

bool free_and_alone(const BodyNode& body)
{
  const auto& joint = *body.getParentJoint();
  return body.getParentBodyNode() == nullptr && body.getNumChildBodyNodes() == 0 && typeid(joint) == typeid(FreeJoint)
         && typeid(body) == typeid(BodyNode) && !joint.isKinematic();
}

} // namespace

void Movers::begin(FreeBodies* free)
{
  free_ = free;
  of_free_.assign(free == nullptr ? 0 : free->size(), none);
  read_.clear();
  movers_.clear();
  places_.clear();
  trees_.clear();
  of_tree_.clear();
}

Movers::Place Movers::add(BodyNode* body, int place_of_free)
{
  if (body == nullptr)
    return {};
  if (place_of_free != none) {
    int& mover = of_free_[static_cast<std::size_t>(place_of_free)];
    if (mover == none) {
      mover = size();
      movers_.push_back({none, 0, 6, &(*free_)[static_cast<std::size_t>(place_of_free)], true});
    }
    return {mover, none};
  }
  if (const auto* known = places_.find(body))
    return *known;
  Place place;
  if (!body->isReactive()) {
    // stays where it is
  } else if (free_and_alone(*body)) {
    place.mover = size();
    read_.push_back(FreeBodies::read(*body));
    movers_.push_back({none, 0, 6, &read_.back(), false});
  } else {
    place = add_to_trees(*body);
  }
  return places_.try_emplace(body, place).first;
}

Movers::Place Movers::add_joint(BodyNode& body)
{
  const auto* known = places_.find(&body);
  return known != nullptr ? *known : places_.try_emplace(&body, add_to_trees(body)).first;
}

Movers::Place Movers::add_to_trees(BodyNode& node)
{
  const int body = trees_.add(node);
  const auto tree = static_cast<std::size_t>(trees_.tree(body));
  of_tree_.resize(std::max(of_tree_.size(), tree + 1), none);
  if (of_tree_[tree] == none) {
    of_tree_[tree] = size();
    movers_.emplace_back();
    movers_.back().tree = static_cast<int>(tree);
  }
  return {of_tree_[tree], body};
}

void Movers::prepare()
{
  trees_.prepare();
  tree_rows_.prepare();
  for (auto& mover : movers_)
    if (mover.tree != none)
      mover.size = tree_rows_.size(mover.tree);
}

void Movers::point_row(int mover, const Vector3d& point, const Vector3d& direction, double* J, double* Y) const
{
  const auto& body = *at(mover).body;
  const Vector3d moment = (point - body.center).cross(direction);
  Eigen::Map<Vector3d>(J, 3) = moment;
  Eigen::Map<Vector3d>(J + 3, 3) = direction;
  Eigen::Map<Vector3d>(Y, 3).noalias() = body.inverse_inertia * moment;
  Eigen::Map<Vector3d>(Y + 3, 3) = body.inverse_mass * direction;
}

double Movers::speed(int mover, const double* J) const
{
  return Eigen::Map<const Vector6>(J).dot(at(mover).body->velocity);
}

void Movers::wrench_rows(
    const std::array<Place, 2>& places, const std::array<TreeRows::Lanes, 2>& wrenches, const std::array<Rows, 2>& rows)
{
  std::array<int, 2> bodies{none, none};
  for (const std::size_t side : {0, 1}) {
    const auto& place = places[side];
    if (place.mover == none)
      continue;
    if (!free(place.mover)) {
      bodies[side] = place.body;
      tree_rows_.push(place.body, wrenches[side]);
      continue;
    }
    const auto& body = *at(place.mover).body;
    for (int row = 0; row < rows[side].count; ++row) {
      const Vector3d force = body.pose.linear() * wrenches[side].row(row).tail<3>().transpose();
      const Vector3d moment = body.pose.linear() * wrenches[side].row(row).head<3>().transpose() - body.offset.cross(force);
      Eigen::Map<Vector6>(rows[side].J + 6 * row) << moment, force;
      Eigen::Map<Vector6>(rows[side].Y + 6 * row) << body.inverse_inertia * moment, body.inverse_mass * force;
    }
  }
  tree_rows_.write(bodies[0], bodies[1], rows);
}

void Movers::joint_rows(Place place, const int* dofs, const Rows& rows)
{
  if (trees_.dofs(place.body) == 0)
    return;
  for (int row = 0; row < rows.count; ++row)
    tree_rows_.push_joint(place.body, dofs[row], row);
  tree_rows_.write(place.body, none, {rows});
}

/// What the change of its velocity is for the joint of a free body.
Movers::Vector6 Movers::joint_change(const Mover& mover, const Eigen::VectorXd& velocities) const
{
  const Vector3d turning = velocities.segment<3>(mover.start);
  const auto& body = *mover.body;
  const Vector3d moving = velocities.segment<3>(mover.start + 3) - turning.cross(body.offset);
  Vector6 twist;
  twist.head<3>() = body.pose.linear().transpose() * turning;
  twist.tail<3>() = body.pose.linear().transpose() * moving;
  return dart::math::AdInvT(body.joint->getTransformFromChildBodyNode(), twist);
}

double* Movers::velocities_of(FreeJoint& joint)
{
  return (joint.*engine::GenericJointMembers<dart::math::SE3Space>::state).mVelocities.data();
}

void Movers::calm(Eigen::VectorXd& velocities, double noise, double most) const
{
  for (const auto& mover : movers_) {
    if (mover.tree != none)
      continue;
    auto change = velocities.segment<6>(mover.start);
    const Vector6 velocity = mover.body->velocity + change;
    const double speed = mover.body->speed(velocity);
    if (speed < most && !change.isZero(0.0))
      change -= velocity * (speed > noise ? noise / speed : 1.0);
  }
}

void Movers::move_free(const Eigen::VectorXd& velocities, double time_step) const
{
  for (const auto& mover : movers_) {
    if (mover.tree != none || mover.in_array)
      continue;
    const Vector6 change = joint_change(mover, velocities);
    auto& joint = *mover.body->joint;
    joint.setVelocitiesStatic(joint.getVelocitiesStatic() + change);
    joint.setAccelerationsStatic(joint.getAccelerationsStatic() + change / time_step);
  }
}

void Movers::move_free_in_array(const Eigen::VectorXd& velocities)
{
  for (auto& mover : movers_)
    if (mover.in_array)
      FreeBodies::change(*mover.body, velocities.segment<6>(mover.start));
}

void Movers::correct_free(const Eigen::VectorXd& velocities)
{
  for (auto& mover : movers_)
    if (mover.in_array)
      mover.body->correction = velocities.segment<6>(mover.start);
}

} // namespace pydart2

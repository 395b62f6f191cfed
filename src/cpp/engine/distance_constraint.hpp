#pragma once

#include <dart/constraint/DynamicJointConstraint.hpp>

#include "engine/engine_access.hpp"

/// A constraint that the engine does not have, made as its own are: all of its solvers take it. It relies on what
/// ConstraintBase asks of a class derived from it, and on the union that its solver makes of skeletons; where these
/// change, it does not compile.
namespace pydart2::engine {

/// Keeps a point of a body a length away from a point of another, or of the world: a rod; or no farther: a rope.
class DistanceConstraint final : public dart::constraint::DynamicJointConstraint
{
public:
  /// The points are in the world as the bodies stand; the second body may be null.
  DistanceConstraint(
      dart::dynamics::BodyNode* body1, dart::dynamics::BodyNode* body2, const Eigen::Vector3d& point1,
      const Eigen::Vector3d& point2, double length, bool rope);

  const std::string& getType() const override;
  BodyRows rows() const;
  void set_point2(const Eigen::Vector3d& point) { point2_ = point; }
  void scale_error(double factor) { error_ *= factor; }
  void store_impulse(double impulse) { impulse_ = impulse; }
  double impulse() const { return impulse_; }
  const Eigen::Vector6d& direction1() const { return directions_[0]; }

protected:
  void update() override;
  void getInformation(dart::constraint::ConstraintInfo* info) override;
  void applyUnitImpulse(std::size_t index) override;
  void getVelocityChange(double* change, bool with_force_mixing) override;
  void excite() override { set_impulse_applied(true); }
  void unexcite() override { set_impulse_applied(false); }
  void applyImpulse(double* impulse) override;
  bool isActive() const override;
  dart::dynamics::SkeletonPtr getRootSkeleton() const override;
  void uniteSkeletons() override;

private:
  std::array<dart::dynamics::BodyNode*, 2> bodies() const { return {mBodyNode1, mBodyNode2}; }
  bool reacts(std::size_t side) const { return bodies()[side] != nullptr && bodies()[side]->isReactive(); }
  void set_impulse_applied(bool applied);

  Eigen::Vector3d point1_, point2_; ///< In the bodies; without a second one in the world.
  double length_;
  bool rope_;
  double error_ = 0.0; ///< How much longer it is.
  double impulse_ = 0.0; ///< Of the last step; above 0 it pushes the points apart.
  std::array<Eigen::Vector6d, 2> directions_; ///< Of a unit impulse, a wrench in each body's frame.
};

} // namespace pydart2::engine

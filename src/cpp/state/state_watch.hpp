#pragma once

#include <dart/dynamics/PointMass.hpp>
#include <string>
#include <vector>

#include "state/dof_state.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// A skeleton's state, read where the engine keeps it, and a copy to go back to.
class StateWatch
{
public:
  explicit StateWatch(SkeletonRecord& record);

  int structure() const { return structure_; }

  void save();
  void restore();

  bool is_sane() const;
  /// Throws BlowUp with the dof or point whose number is none any more, at a time.
  void check_positions(double time) const;
  void check_velocities(double time) const;

private:
  using PointMass = dart::dynamics::PointMass;

  void check(const std::vector<const double*>& places, const char* what, double time) const;
  void check_points(const Eigen::Vector3d& (PointMass::*read)() const, const char* what, double time) const;

  dart::dynamics::Skeleton& skeleton_;
  int structure_;
  const DofState& dofs_;
  std::vector<PointMass*> points_;
  std::vector<double> saved_;
};

/// That of a skeleton, made anew where the skeleton's parts have changed.
StateWatch& watch(SkeletonRecord& record);

} // namespace pydart2

#pragma once

#include "base/arrays.hpp"
#include "handles/part.hpp"

namespace pydart2 {

/// The motors of a skeleton. A vector comes out as a vector "like" the one passed in, as in SkeletonHandle.
class TargetsHandle
{
public:
  TargetsHandle(WorldRef world, SkeletonRef skeleton);

  /// Compensation: 0 none, 1 gravity, 2 bias.
  void set(const VectorIn& q, const VectorIn& dq, const VectorIn& kp, const VectorIn& kd, long compensation);
  void clear();
  bool any() const;

  void q(Output& like) const;
  void dq(Output& like) const;
  void kp(Output& like) const;
  void kd(Output& like) const;
  int compensation() const;

  /// What the motors did in the last step.
  void forces(Output& like) const;

private:
  Targets targets() const;

  Part<dart::dynamics::Skeleton, dart::dynamics::Skeleton*> skeleton_; // SkeletonRecord owns it
};

} // namespace pydart2

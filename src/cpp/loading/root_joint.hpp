#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <string>

namespace pydart2 {

/// A new massless root under TranslationalJoint root_t, the old root below it under EulerJoint root_r (XYZ). At q = 0
/// the skeleton stands where it stood.
void change_root_to_trans_and_euler(dart::dynamics::Skeleton& skeleton);

/// The root is welded where it is at q = 0.
void change_root_to_weld(dart::dynamics::Skeleton& skeleton);

/// The root floats from where it is; its positions, and the initial ones, are its pose in the world.
void change_root_to_free(dart::dynamics::Skeleton& skeleton);

} // namespace pydart2

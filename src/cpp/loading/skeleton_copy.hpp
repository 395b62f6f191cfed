#pragma once

#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

/// What loading the source of a skeleton once more gives: a skeleton with shapes of its own, and scenes of meshes that
/// are shared. Null for one with a part that is not copied here: a soft body, a shape of another class.
dart::dynamics::SkeletonPtr copy_of(const dart::dynamics::Skeleton& loaded);

} // namespace pydart2

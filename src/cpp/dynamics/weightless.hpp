#pragma once

#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

/// A body that a joint moves, and that has no mass, nor has any below it: its acceleration has no answer. Null if none.
const dart::dynamics::BodyNode* weightless_body(const dart::dynamics::Skeleton& skeleton);

} // namespace pydart2

#pragma once

#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

/// A body whose joint moves nothing that has inertia along one of its dofs, as it stands now: its acceleration has no
/// answer. Null if none.
const dart::dynamics::BodyNode* weightless_body(const dart::dynamics::Skeleton& skeleton);

} // namespace pydart2

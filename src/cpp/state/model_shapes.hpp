#pragma once

#include <dart/dynamics/ShapeNode.hpp>

#include "base/archive.hpp"

namespace pydart2 {

/// What is in a shape node and its shape, for visit_model().
void visit_shape(Archive& archive, dart::dynamics::ShapeNode& node);

} // namespace pydart2

#pragma once

#include <dart/dynamics/ShapeNode.hpp>
#include <iosfwd>

namespace pydart2::built {

/// A shape node as a part of structure_of(), and back.
void write_shape(std::ostream& out, const dart::dynamics::ShapeNode& node);
void read_shape(std::istream& in, dart::dynamics::BodyNode& body);

} // namespace pydart2::built

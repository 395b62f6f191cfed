#pragma once

#include <dart/dynamics/SoftBodyNode.hpp>
#include <iosfwd>

#include "base/arrays.hpp"

namespace pydart2::built {

/// Points with masses, springs between neighbours, triangles, stiffness and damping of a soft body.
using Skin = dart::dynamics::SoftBodyNode::UniqueProperties;

/// Points and edges and faces as indices of points, one a row. ValueError or IndexError for what is no skin.
Skin make_skin(const MatrixIn& points, const VectorIn& masses, const MatrixIn& edges, const MatrixIn& faces);

/// A skin as a part of structure_of(), and back; null is a body without, as 0 points.
void write_skin(std::ostream& out, const dart::dynamics::SoftBodyNode* body);
Skin read_skin(std::istream& in);

} // namespace pydart2::built

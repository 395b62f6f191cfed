#pragma once

#include <dart/constraint/ConstrainedGroup.hpp>

#include "contact/contact_terms.hpp"

namespace pydart2 {

/// Leaves at most four contacts of each pair of faces in a group: those that span the largest area. The others get no
/// force. A face pair is what two bodies share along one normal, to 8 degrees. Changes the results: forces spread over
/// other points, and the sum that the LCP solver finds may differ where friction decides.
void keep_extremal_contacts(dart::constraint::ConstrainedGroup& group);
void keep_extremal_contacts(std::vector<ContactTerms>& contacts);

/// Two shapes part along the normal with the least depth. What a detector of triangles says of others between the same
/// bodies, as that a box which stands on another is 20 cm inside its side, is taken for at most twice that.
void doubt_depths(std::vector<ContactTerms>& contacts);

} // namespace pydart2

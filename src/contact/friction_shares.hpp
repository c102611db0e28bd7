#pragma once

#include "contact/multipliers.hpp"

namespace dotyk::contact {

/// One flag a row: its node has rows of several sides, as the tip of a wedge (TR965 (1.23)). Their normals span the jump, so that tangential
/// rows there are combinations of the normal ones: B loses rank, and forces of contact are not unique.
std::vector<char> at_corners(const std::vector<ContactRow>& rows);

/// One flag a row, in the plane: it ends a contact line.
std::vector<char> at_ends(const std::vector<ContactRow>& rows);

/// By row, the rows whose surroundings its friction stands for: itself, and shares of those `aside` (one flag each) that are nearest to it by
/// facets of the same side. Empty for those. Rows that cannot slip (`slides` false) take nothing; where nobody takes it, a row keeps its own.
std::vector<std::vector<Term>> friction_shares(const std::vector<ContactRow>& rows, const std::vector<char>& aside, const std::vector<char>& slides);

}  // namespace dotyk::contact

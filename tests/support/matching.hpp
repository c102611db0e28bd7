#pragma once

#include "base/error.hpp"
#include "contact/matching.hpp"

namespace dotyk::contact {

/// The pairs of matching nodes. Throws InputError where they do not match.
inline std::vector<NodePair> match(const Face& first, const Face& second) {
  Matching found = find_matching(first, second);
  if (!found.mismatch.empty()) throw InputError(found.mismatch);
  return std::move(found.pairs);
}

/// The rows at matching nodes.
inline std::vector<ContactRow> between(const Face& first, const Face& second, const elasticity::ScalarField& added, bool interference = false) {
  return matching_rows(match(first, second), first, second, added, interference);
}

}  // namespace dotyk::contact

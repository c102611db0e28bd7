#pragma once

#include <string>
#include <vector>

#include "contact/contact_row.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// The boundary part of one body, as contact sees it.
struct Face {
  const mesh::Mesh& mesh;
  const std::vector<mesh::Facet>& facets;
  std::string name;  ///< "'block' top", for messages
};

/// Node of `first` → node of `second`, for the nodes that have one at the same place or straight
/// across the gap along either's normal. Tolerance: 1e-6 of the parts' size.
struct NodePair {
  int first, second;
  double distance;  ///< along the first's normal; negative where the parts overlap
};

/// Throws InputError where no node of `first` has a partner whose normal is opposed, and where a node
/// of either part has none though it lies before a facet of the other, naming the first such node.
std::vector<NodePair> match(const Face& first, const Face& second);

/// Rows at the matching nodes, one a side of the first part at each; `added` (may be empty) is added
/// to the geometric gap. Throws as match(), for a gap that is not finite, and unless `interference` is
/// set for parts that overlap at rest (by more than 1e-6 of the first mesh's size; a negative `added` is no overlap).
std::vector<ContactRow> between(const Face& first, const Face& second,
                                const elasticity::ScalarField& added, bool interference = false);

}  // namespace dotyk::contact

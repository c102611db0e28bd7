#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "contact/contact_row.hpp"
#include "contact/sides.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// The boundary part of one body, as contact sees it.
struct Face {
  const mesh::Mesh& mesh;
  const std::vector<mesh::Facet>& facets;
  std::string name;  ///< "'block' top", for messages
};

/// Node of `first` → node of `second`, for the nodes that have one at the same place or straight
/// across the gap along either's normal: the nearest, and none has the partner of another, but for nodes at one place. Tolerance: 1e-6 of
/// the parts' size, but a thousandth of the way to the next node of the same facet at most, on either side (rounding of coordinates at least).
struct NodePair {
  int first, second;
};

struct Matching {
  std::vector<NodePair> pairs;
  std::string mismatch;  ///< why nodes (of order 2 also functions between them) do not match, or parts do not face each other; empty: they do
};
Matching find_matching(const Face& first, const Face& second);

/// What may be rounding of coordinates, relative to a mesh's size; where facets are so small that this is more than a thousandth of them,
/// that thousandth.
inline constexpr double kTouching = 1e-6;

class Frames;
struct Frame;

/// The row of a side whose partners are known: the gap is (Σ weight x_partner − x)·normal + added, the normal the frame's. Throws
/// InputError for a gap that is not finite.
ContactRow row_of(const NodeSide& side, std::vector<NodeWeight> partners, double added, const Frames& frames);
ContactRow row_of(const NodeSide& side, std::vector<NodeWeight> partners, double added, const Face& first, const Face& second, const Frame& frame);
/// Overlap at rest that is rounding of coordinates, where these facets of the part are; `size`: its mesh's.
double touching(const Face& face, double size, const std::vector<int>& facets);

/// Rows where it is known what lies across from nodes, `partner`. Order 1: one a side at each node that has one. Order 2: one a side at each
/// corner, the mean of its own nodes' conditions; facets that have a node without are left out.
std::vector<ContactRow> node_rows(const Face& first, const Face& second, std::unordered_map<int, std::vector<NodeWeight>> partner,
                                  const elasticity::ScalarField& added);
/// Throws InputError where rows overlap at rest by more than kTouching; a negative `added` is no overlap.
void refuse_overlap(const std::vector<ContactRow>& rows, const Face& first, const Face& second);

/// Rows at these pairs, one a side of the first part at each; `added` (may be empty) is added to the geometric gap. Throws as row_of() and,
/// unless `interference`, as refuse_overlap().
std::vector<ContactRow> matching_rows(const std::vector<NodePair>& pairs, const Face& first, const Face& second,
                                      const elasticity::ScalarField& added, bool interference);

/// The rows that matching_rows() made of `first` on the mesh `before`, whose nodes have moved (as those of `second` may have): pairs, M of
/// frame.hpp and what was added to the gaps stay, normals, weights, gaps and what normals are uncertain by are made anew. A part that rests is
/// still the mesh that it was. Throws as matching_rows() for an overlap, and as moved_sides().
std::vector<ContactRow> moved_rows(const mesh::Mesh& before, const mesh::Mesh& second_before, const std::vector<ContactRow>& rows, const Face& first, const Face& second,
                                   bool interference);

}  // namespace dotyk::contact

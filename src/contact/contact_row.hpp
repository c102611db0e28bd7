#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::contact {

/// A node of the second body's mesh, and its share of what lies across from a node of the first part.
struct Partner {
  int node;
  double weight;
  bool operator==(const Partner&) const = default;
};

/// One condition of non-penetration at a node of the first part:
///   normal·(u₁ − Σ weight u_partner) ≤ gap        (no partners against a rigid shape)
struct ContactRow {
  int node;                         ///< of the first body's mesh
  std::vector<Partner> partners{};  ///< their weights are 1 in sum; matching nodes: one. See pairing.hpp
  mesh::Point normal;   ///< unit, out of the first body
  double gap = 0;       ///< at rest, positive when open; `added` included
  double weight = 0;    ///< length or area that the node stands for
  std::vector<int> facets;  ///< of the first part, those of the row's side at the node
  double added = 0;         ///< what was added to the geometric gap
};

/// A node of the first part that moves with what lies across from it: u₁ = Σ weight u_partner.
struct Tie {
  int node;
  std::vector<Partner> partners;
};

}  // namespace dotyk::contact

#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::contact {

/// One condition of non-penetration at a node of the first part:
///   normal·u₁ − normal·u₂ ≤ gap        (u₂ absent against a rigid shape)
struct ContactRow {
  int node;             ///< of the first body's mesh
  int partner = -1;     ///< node of the second body's mesh, -1 against a rigid shape
  mesh::Point normal;   ///< unit, out of the first body
  double gap = 0;       ///< at rest, positive when open; `added` included
  double weight = 0;    ///< length or area that the node stands for
  std::vector<int> facets;  ///< of the first part, those of the row's side at the node
  double added = 0;         ///< what was added to the geometric gap
};

}  // namespace dotyk::contact

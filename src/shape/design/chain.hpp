#pragma once

#include <cmath>
#include <vector>

#include "scene/statement/body.hpp"

namespace dotyk::shape {

/// |b − a| of points in the plane.
inline double plane_distance(const double* a, const double* b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The nodes of a plane part one after the other, body on the left, and where they lie along it.
struct Chain {
  std::vector<int> nodes;       ///< of a closed one each once, from the part's first facet on
  std::vector<double> length;   ///< from the first node to each, along the part
  double total = 0;             ///< to the end; of a closed one back to the first node
  bool closed = false;
};

/// Throws InputError, naming the part, where its body is not plane or its facets are not one chain.
Chain chain_of(const scene::Part& part);

}  // namespace dotyk::shape

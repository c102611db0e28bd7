#pragma once

#include <string>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

enum class Ordering {
  automatic,          ///< the one expected to give the shorter total time
  minimum_degree,     ///< AMD (CAMD where some nodes come last)
  nested_dissection,  ///< METIS
};

/// An elimination order and what it promises.
struct Permutation {
  std::vector<int> order;  ///< position → unknown
  double flops = 0;        ///< predicted for the factorisation
  std::string method;      ///< "AMD", "METIS", …
};

/// Orders the unknowns of a symmetric matrix (lower triangle) node by node: the
/// unknowns of one node stay together, so the graph is `dimension` times
/// smaller. `node[i]`: node of unknown i, ascending. `last`: nodes (any order,
/// none twice) whose unknowns are eliminated after all others; may be empty.
Permutation order(const SparseMatrix& lower, const std::vector<int>& node,
                  const std::vector<int>& last, Ordering choice);

}  // namespace dotyk::algebra

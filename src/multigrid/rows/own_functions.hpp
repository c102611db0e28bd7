// What a rank has of the functions of coarser meshes.
#pragma once

#include <memory>
#include <vector>

#include "multigrid/processes/ranks.hpp"
#include "multigrid/rows/rows.hpp"

namespace dotyk::multigrid {

/// Own rows of P, see algebra::CoarseFunctions. Rows, and coarse nodes, are counted over all ranks.
struct OwnFunctions {
  static constexpr int kComponents = 8;  ///< of a coarse node at most, as many as bits

  std::vector<int> component;  ///< of its node, of each row; −1: the row is empty
  std::vector<int> starts{0};  ///< of the own nodes' means
  std::vector<int> means;      ///< coarse nodes times kComponents, and a bit for each component that has a column there

  /// P's rows. `dimension`: columns of a coarse node.
  Rows rows(int dimension) const;
};

using AllOwnFunctions = std::shared_ptr<const std::vector<OwnFunctions>>;  ///< of each coarser mesh, the finest of these meshes first
/// Those of the next coarser mesh.
AllOwnFunctions without_first(const AllOwnFunctions& functions);

void send(const Ranks& ranks, int to, const AllOwnFunctions& functions);
AllOwnFunctions receive_own_functions(const Ranks& ranks, int from);

}  // namespace dotyk::multigrid

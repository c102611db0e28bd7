#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "base/buckets.hpp"
#include "base/lists.hpp"

namespace dotyk::algebra {

/// Cells of some bodies that one process refines and assembles.
class Refinable {
 public:
  virtual ~Refinable() = default;
  /// Refines all cells once. Returns, for each node of the refined cells, the nodes of the cells before whose mean it is.
  virtual Buckets refine() = 0;
  /// Keeps so many layers of cells about the flagged nodes: of one layer, those that have such a node. Returns, for each node left, its number before; ascending.
  virtual std::vector<int> keep(const std::vector<char>& flagged, int layers) = 0;
  struct Assembled {
    StoredMatrix lower;        ///< triangle of the stiffness
    std::vector<double> load;  ///< of forces per volume; empty: there are none
  };
  /// Of these cells, node × dimension without the components flagged in `fixed`. The cells are gone then.
  virtual Assembled assemble(const std::vector<char>& fixed) = 0;
};

}  // namespace dotyk::algebra

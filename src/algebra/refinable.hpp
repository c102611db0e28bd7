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
  /// Keeps the cells that have a flagged node, and `layers` − 1 more layers of their neighbours. Returns, for each node left, its number before; ascending.
  virtual std::vector<int> keep(const std::vector<char>& flagged, int layers) = 0;
  struct Assembled {
    StoredMatrix lower;        ///< triangle of the stiffness
    std::vector<double> load;  ///< of forces per volume; empty: there are none
  };
  /// Assembles these cells. The unknowns are node × dimension without the components flagged in `fixed`. The cells are gone afterwards.
  virtual Assembled assemble(const std::vector<char>& fixed) = 0;
};

}  // namespace dotyk::algebra

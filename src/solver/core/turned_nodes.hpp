#pragma once

#include "solver/core/row_subset.hpp"

namespace dotyk::solver {

/// Rows that prescribe displacements of one node alone, as oblique slides do, need not be rows: in a frame of the node that is turned such a
/// displacement is an unknown, which is known. u = T y + u₀, T with orthonormal columns; energies and forces of all other rows are the same.
class TurnedNodes : public RowSubset {
 public:
  explicit TurnedNodes(const problem::Problem& problem);

  bool none() const { return all(); }
  /// The problem for y, without these rows. Rigid motions of a body that its turned nodes stop are none of its kernel, the others have no names.
  problem::Problem turned() const;
  Beginning turned(const Beginning& from) const;
  /// Makes a result of turned() one of the whole problem; the forces of the rows left out are those that equilibrium leaves to them.
  void extend(Result& result) const;

 private:
  struct Node {
    int first, unknowns;     ///< the node's unknowns
    std::vector<int> rows;   ///< the rows that prescribe them
    algebra::DenseMatrix R;  ///< those: rows × unknowns
  };
  std::vector<Node> nodes_;
  algebra::SparseMatrix T_;
  algebra::Vector u0_;
};

}  // namespace dotyk::solver

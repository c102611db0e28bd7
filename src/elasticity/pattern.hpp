#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "elasticity/numbering.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// The sparsity of a lower-triangular stiffness matrix and the place of every
/// node-pair block in it.
class Pattern {
 public:
  Pattern(const mesh::Mesh& mesh, const Numbering& numbering);

  /// The zero matrix with this pattern.
  algebra::SparseMatrix take_matrix() { return std::move(matrix_); }

  /// Position in the value array of entry (component i of node a, component j of
  /// node b), both unknown, with unknown(a,i) ≥ unknown(b,j).
  /// `block` comes from find(a, b).
  int find(int a, int b) const {
    int k = start_[b];
    while (neighbour_[k] != a) ++k;
    return k;
  }
  int position(int block, int row_rank, int column_rank, int column_start) const {
    return column_start + offset_[block] + row_rank - column_rank;
  }

 private:
  /// Fills start_ and neighbour_; the number of entries.
  std::size_t find_neighbours(const mesh::Mesh& mesh, const std::vector<int>& unknowns_of);
  /// Fills offset_ and the indices of matrix_.
  void number_entries(const Numbering& numbering, const std::vector<int>& unknowns_of);

  std::vector<int> start_, neighbour_;  ///< node → its neighbours ≥ itself, ascending, itself first
  std::vector<int> offset_;             ///< unknowns of the neighbours before, in b's first column
  algebra::SparseMatrix matrix_;
};

}  // namespace dotyk::elasticity

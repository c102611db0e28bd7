// Coarse matrices PᵀAP: their patterns, and their numbers, computed anew only in rows that change.
#pragma once

#include <vector>

#include "base/buckets.hpp"
#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/local_rows.hpp"

namespace dotyk::multigrid {

/// PETSc's own product knows neither that unknowns come in blocks nor that rows stay. Seconds of a set() on a cube of 200 000
/// unknowns: 1.2 by PETSc's, 0.6 here where all rows are new, 0.02 to 0.2 where a disc on the top is held or let go.
class Galerkin {
 public:
  /// The coarse nodes are the blocks of P's columns. Collective.
  Galerkin(const HalfMatrix& fine, Mat interpolation);

  /// The identity, with room for PᵀAP: a block of entries for each pair of coarse nodes that A couples by way of P. Collective.
  HalfMatrix pattern(const HalfMatrix& fine, Mat interpolation) const;
  /// Takes the new numbers of P, also those of rows on other ranks. Collective.
  void fetch(Mat interpolation);
  /// Computes the rows of `coarse` that depend on the given fine rows of A and P, all of this rank. Returns a flag for each coarse row of
  /// this rank: computed. Collective: each rank has the part of PᵀAP that its fine rows give, and sends what belongs to coarse nodes of others.
  std::vector<char> compute(const HalfMatrix& fine, Mat interpolation, HalfMatrix& coarse, const std::vector<char>& changed);

  double bytes() const;

 private:
  /// What belongs to coarse nodes of other ranks, by rank: of each node how many others it is coupled with, its number and theirs; and the blocks.
  struct Outgoing {
    std::vector<std::vector<int>> nodes;
    std::vector<std::vector<double>> numbers;
  };

  struct ReachedRows {
    const int *starts, *columns;
    const double* values;
  };

  // Template arguments: rows of a fine node and of a coarse one, as constants for the compiler; 0: fine_, size_ are used.
  template <int rows_of_node, int columns>
  void compute_block(int block, const HalfMatrix& A, const ReachedRows& P);
  template <int rows_of_node, int columns>
  void add_node(int node, const HalfMatrix& A);
  template <int columns>
  void add_scaled(int node, double factor, const HalfMatrix& A);
  template <int columns>
  void add_product(const ReachedRows& P);
  void fetch_rows(const Ranks& ranks, const LocalRows& P);  ///< into reached_
  void find_multiples(const ReachedRows& P);
  void put_block(int block, HalfMatrix& C);
  void append_block(int block, int rank, Outgoing& out);
  bool mine(int block) const { return block >= first_own_ && block < first_own_ + own_blocks_; }
  void add(const Outgoing& in, HalfMatrix& C) const;
  /// The rows of P of the fine nodes that are reached.
  ReachedRows reached(const RowsView& own) const;

  int size_ = 1, fine_ = 1;          // rows of a coarse node, of a fine one
  std::vector<std::vector<int>> asked_;  // by rank the own fine nodes that its rows of A reach
  Rows reached_;                     // rows of P that this rank's rows of A reach, of nodes as HalfMatrix counts them; none where there is one rank, as these are P
  int fine_nodes_ = 0;               // that are reached
  Buckets support_;                  // coarse node → the own rows of P with entries in its columns
  Buckets first_;                    // beside support_: the first of these entries
  std::vector<int> firsts_;          // by rank its first coarse node
  int first_own_ = 0, own_blocks_ = 0;  // coarse nodes of this rank
  std::vector<char> multiples_;      // of each fine node that is reached: are its blocks of P multiples of the identity, as those of meshes are?
  // Room to work for one block J. `product_`: (A P)_kJ of fine nodes k. `sum_`: (PᵀAP)_IJ of coarse nodes I, which is the transpose of the block's rows.
  SomeRows product_, sum_;
  std::vector<double> entries_;      // P_iJ of one fine node i
};

}  // namespace dotyk::multigrid

// Which process has which unknowns.
#pragma once

#include <memory>
#include <vector>

#include "base/parallel.hpp"
#include "multigrid/multigrid.hpp"
#include "multigrid/slices.hpp"

namespace dotyk::multigrid {

struct Refinement;

/// Numbers the rows of all levels. Unknowns come in blocks of one size, one block a node; a node of the finest level with fewer unknowns has idle rows
/// beside them. The rows of a rank follow one another.
/// METIS (Karypis, Kumar 1998) shares out the nodes of the coarsest mesh that has enough of them, none of which weighs much, else those of the finest. A node of
/// a finer mesh goes to the rank of the first coarse node whose function is not zero there. Even coarser meshes belong to rank 0.
class Numbering {
 public:
  Numbering(const Coupling& coupling, int ranks);
  /// Numbers the unknowns of PᵀKP, the matrix of the next coarser mesh: the functions that have entries. Each stays with the rank that it has in `finer`.
  Numbering(const Numbering& finer, const algebra::CoarseFunctions& functions);

  /// Of meshes that the ranks have refined. By level, the finest first: `first` node of each rank, and the number of all; `number` of the nodes of `functions`, and,
  /// as its last list, of the nodes of the mesh that was refined. Rows of nodes that are not among the functions' have no unknowns here.
  Numbering(const std::vector<std::vector<int>>& first, const std::vector<std::vector<int>>& number, const algebra::CoarseFunctions& functions,
            std::shared_ptr<const Refinement> refinement);

  int block() const { return block_; }                                   ///< of the finest level
  const std::vector<int>& slot() const { return slot_; }                 ///< row of each unknown
  const std::vector<int>& idle() const { return idle_; }                 ///< rows of components that are not unknown
  /// Row of each column of the functions that lead to `level` ≥ 1.
  const std::vector<int>& functions(int level) const { return functions_[level - 1]; }
  /// Of each rank the first row, and the number of all.
  const std::vector<int>& first(int level) const { return first_[level]; }
  int rank_of(int row) const;  ///< of the finest level

  int unknown(int row) const { return unknown_[row]; }  ///< of a row of the finest level; −1: it has none
  /// Are there rows that are not idle, of components whose unknowns have no number here?
  bool hides() const { return slot_.size() + idle_.size() < unknown_.size(); }

  const Refinement* refinement() const { return refinement_.get(); }  ///< null: the ranks have refined nothing

  /// What a rank has of a vector, by its rows of the finest level: of_unknown(i), and zero at idle ones.
  template <class Number>
  std::vector<double> part(int rank, const Number& of_unknown) const {
    std::vector<double> part(static_cast<std::size_t>(first_[0][rank + 1] - first_[0][rank]), 0.0);
    parallel_parts(std::ssize(part), [&](int begin, int end) {
      for (int k = begin; k < end; ++k)
        if (const int i = unknown_[first_[0][rank] + k]; i >= 0) part[k] = of_unknown(i);
    });
    return part;
  }
  /// The way back, into a vector of all unknowns.
  void put(int rank, const std::vector<double>& part, algebra::Vector& x) const;

 private:
  void take_unknowns();

  int block_ = 1;
  std::vector<int> slot_, idle_, unknown_;
  std::vector<std::vector<int>> functions_, first_;
  std::shared_ptr<const Refinement> refinement_;
};

/// How ranks have refined bodies.
struct Refinement {
  Numbering base;         ///< of the coarse bodies
  int times, dimension;
  std::vector<int> node;  ///< the number of each node that rank 0 knows
  std::vector<int> first() const;  ///< node of each rank in `base`, and the number of all
};

}  // namespace dotyk::multigrid

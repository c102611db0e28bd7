// Matrices and interpolations of all levels.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "multigrid/cycle/galerkin.hpp"
#include "multigrid/rows/own_rows.hpp"
#include "multigrid/shares/piece.hpp"

namespace dotyk::multigrid {

/// Matrices and interpolations of all levels; each rank holds its rows. All functions are collective, except the const ones.
class Hierarchy {
 public:
  Hierarchy(const Ranks& ranks, Piece piece);

  /// New numbers, and the coarse matrices for them. False where they are seen not to be positive definite.
  bool set(const Change& change);
  /// New numbers of the finest matrix as AllNumbers, and the coarse matrices for them. On one rank.
  void set(const AllNumbers& numbers);
  /// With what each rank goes on alone: all rows of the last level, and of the coarser meshes after it.
  Piece last_for_all();

  /// Of the matrix of the next coarser mesh this rank's rows, without Piece::first, where the piece asks for them; once.
  HalfRows take_coarser() { return std::move(coarser_); }
  const OwnLoad& coarser_load() const { return coarser_load_; }  ///< Pᵀ times that of the slice; null: there is none, or no coarser matrix is asked for
  const AllOwnFunctions& functions() const { return piece_.functions; }
  int levels() const { return static_cast<int>(matrices_.size()); }
  HalfMatrix& matrix(int level) { return *matrices_[level]; }             ///< from 0, the finest
  /// Flags of own rows in which numbers of the matrix or of the interpolation have changed since forget_changes(). The constructor clears some flags, so that the
  /// first caller must take all rows. The last level has no flags.
  const std::vector<char>& changed(int level) const { return changed_[level]; }
  void forget_changes();  ///< not collective
  Mat interpolation(int level) const { return interpolations_[level]; }   ///< from `level` + 1 to `level`
  int meshes() const { return static_cast<int>(piece_.own.size()) - 1; }  ///< coarser ones, those that last_for_all() has among them
  int finer() const { return std::max(0, piece_.shared_levels - 1); }     ///< levels of which this hierarchy is the rest
  double bytes() const;  ///< of this rank

 private:
  /// Takes the entries. False where a number of the diagonal is not positive.
  bool take(const Change& change);
  void make_room_for(const Change& change);  ///< in the pattern of the finest matrix
  void add_level(HalfMatrix matrix) { matrices_.push_back(std::make_shared<HalfMatrix>(std::move(matrix))); }
  OwnedMat oblong(Rows& rows, int own_columns, std::array<int, 2> blocks);
  void coarsen();
  void compute_coarser();
  void restrict_load(Mat P);
  /// Adds a level for each of the first `count` coarser meshes. S maps displacements to unknowns; null if the unknowns are displacements.
  void take_functions(Mat S, int count);
  /// Levels of aggregates below a matrix of the near kernel that Piece::modes are.
  void take_aggregates(Mat of);
  /// Interpolations from coarse displacements to the unknowns, and coarse matrices of these.
  void take_unknowns(Mat S);
  bool aggregates();         ///< do they follow the coarsest mesh?
  int shared_meshes();       ///< how many coarser meshes get a level here, where no aggregates follow; the others are left to last_for_all()
  void multiply(int level);  ///< makes the product that gives the next level
  /// The numbers of coarse matrices that are to be computed.
  void fill_coarse();
  void truncate(const std::vector<int>& held);

  const Ranks ranks_;
  Piece piece_;
  HalfRows coarser_;
  OwnLoad coarser_load_;
  std::deque<Rows> rows_, others_;              // of the first interpolations: in own columns, in those of other ranks
  std::vector<std::shared_ptr<HalfMatrix>> matrices_;  // the first may be lent by a slice
  std::vector<OwnedMat> interpolations_;
  std::vector<Galerkin> products_;              // of each interpolation
  std::vector<char> empty_;                     // own rows of the finest interpolation that are empty now
  std::map<int, std::vector<double>> emptied_;  // the numbers that they had
  std::vector<std::vector<char>> changed_;      // of each level but the last, flags of own rows, see changed()
};

}  // namespace dotyk::multigrid

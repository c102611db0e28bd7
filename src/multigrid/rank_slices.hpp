// A matrix in slices, as rank 0 has it.
#pragma once

#include <memory>
#include <vector>

#include "multigrid/rank_vectors.hpp"
#include "multigrid/rows/slice.hpp"
#include "multigrid/shares/numbering.hpp"
#include "multigrid/workers.hpp"

namespace dotyk::multigrid {

/// Each rank has a Slice. The other ranks do what rank 0 tells them.
class RankSlices final : public algebra::SlicedMatrix {
 public:
  RankSlices(Workers workers, const Shared& matrix);
  RankSlices(Workers workers, const Refined& matrix);
  /// Takes rows and functions that the ranks have already; `own`, `functions` and `load`: rank 0's. The others call receive_rest().
  RankSlices(Workers workers, Numbering numbering, HalfRows own, AllOwnFunctions functions, OwnLoad load);
  ~RankSlices() override;

  algebra::Vector times(const Eigen::Ref<const algebra::Vector>& x) const override;
  algebra::Vector gross_times(const algebra::Vector& x) const override;
  algebra::StoredMatrix near(std::vector<char>& of, int layers) const override;
  std::shared_ptr<algebra::Vectors> vectors(const std::vector<int>& watched) const override;
  bool holds(const algebra::Vectors& vectors) const override;
  void take_product(const algebra::LongField& u, bool precisely, algebra::Field& from) const override;
  void add_load(algebra::Field& to) const override;

  const Workers& workers() const { return workers_; }
  const std::shared_ptr<const Numbering>& numbering() const { return numbering_; }
  const Slice& own() const { return *slice_; }  ///< of rank 0

 private:
  RankSlices(Workers workers, Numbering numbering);
  std::unique_ptr<Slice> share_out(const Shared& matrix) const;
  std::unique_ptr<Slice> share_out(const Refined& matrix);
  std::vector<int> idle_of(int rank) const;
  void take_diagonal();
  /// Some rows of all ranks.
  struct Asked {
    std::vector<std::vector<int>> numbers;  ///< by rank, counted from its first row
    std::vector<Rows> rows;                 ///< by rank
  };
  Asked ask(const std::vector<int>& unknowns) const;
  void multiply(Slice::Product how, RankVectors& v, const Slice::Factors& of) const;
  algebra::Vector product(Slice::Product how, const algebra::Vector& x) const;

  Workers workers_;
  std::shared_ptr<const Numbering> numbering_;
  std::unique_ptr<Slice> slice_;
  double entries_ = 0;  ///< of all ranks
  bool made_ = false;  ///< to its end: the other ranks have their slices
};

/// What ranks other than 0 do when rank 0 makes slices, or asks for entries.
std::unique_ptr<Slice> receive_slice(const Ranks& ranks, const ShareMakers& makers);
std::unique_ptr<Slice> receive_refined_slice(const Ranks& ranks, const ShareMakers& makers);
std::unique_ptr<Slice> receive_rest(const Ranks& ranks, HalfRows rows, AllOwnFunctions functions, OwnLoad load);
void tell_some(const Ranks& ranks, const Slice& slice);

}  // namespace dotyk::multigrid

// Vectors in parts with the ranks, as rank 0 has them.
#pragma once

#include <memory>
#include <vector>

#include "algebra/field.hpp"
#include "multigrid/shares/numbering.hpp"
#include "multigrid/workers.hpp"

namespace dotyk::multigrid {

/// Each rank has the numbers of its rows. The other ranks do what rank 0 tells them.
class RankVectors final : public algebra::Vectors {
 public:
  /// `watched`: unknowns, ascending.
  RankVectors(const Workers& workers, std::shared_ptr<const Numbering> numbering, const std::vector<int>& watched);
  ~RankVectors() override;

  double run(const algebra::VectorOrder& order) override;
  algebra::Vector get(int v) override;
  void put(int v, const algebra::Vector& numbers) override;
  algebra::Vector some(int v, const std::vector<int>& unknowns) override;
  void set_some(int v, const std::vector<int>& unknowns, const algebra::Vector& numbers) override;

  /// As visit() in slices.hpp, where the ranks have refined bodies.
  std::vector<Lists> visit(const Visit& visit);

  int number() const { return workers_.number(); }  ///< by which the ranks know them
  const Numbering& numbering() const { return *numbering_; }
  algebra::VectorParts& own() { return own_; }  ///< of rank 0

 private:
  /// Some unknowns, by rank.
  struct ByRank {
    std::vector<std::vector<int>> places;  ///< among them
    std::vector<std::vector<int>> rows;    ///< in the rank's part, counted from its first
  };
  ByRank by_rank(const std::vector<int>& unknowns) const;

  Workers workers_;
  std::shared_ptr<const Numbering> numbering_;
  algebra::VectorParts own_;
};

/// What ranks other than 0 have, and what they do for these tasks.
algebra::VectorParts receive_vectors(const Ranks& ranks);
void run_order(const Ranks& ranks, algebra::VectorParts& vectors);
void visit_for_rank_0(const Ranks& ranks, const ShareMakers& makers, algebra::VectorParts& vectors);
void exchange_numbers(const Ranks& ranks, Task task, algebra::VectorParts& vectors);

}  // namespace dotyk::multigrid

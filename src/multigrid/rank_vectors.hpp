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
  algebra::Vector watched(int v) override;
  void set_watched(int v, const algebra::Vector& numbers) override;

  int number() const { return workers_.number(); }  ///< by which the ranks know them
  const Numbering& numbering() const { return *numbering_; }
  algebra::VectorParts& own() { return own_; }  ///< of rank 0

 private:
  /// Tells the other ranks to put numbers into v, or to send what they have of it.
  void tell(Task task, int v) const;

  Workers workers_;
  std::shared_ptr<const Numbering> numbering_;
  std::vector<std::vector<int>> watched_;  ///< by rank the places among the watched unknowns
  algebra::VectorParts own_;
};

/// What ranks other than 0 have, and what they do for these tasks.
algebra::VectorParts receive_vectors(const Ranks& ranks);
void run_order(const Ranks& ranks, algebra::VectorParts& vectors);
void exchange_numbers(const Ranks& ranks, Task task, algebra::VectorParts& vectors);

}  // namespace dotyk::multigrid

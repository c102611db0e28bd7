#include "problem/row_basis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dotyk::problem {

using algebra::SparseMatrix;
using algebra::SparseRows;

namespace {

/// Of the greatest factor in a row: that of an unknown which can be the row's own, and what elimination leaves of a row that depends on others.
constexpr double kLeastFactor = 0.2, kDependent = 1e-8;

/// Gauss–Jordan elimination of one unknown for every row, as long as that makes no row reach more than three times as far.
class Elimination {
 public:
  explicit Elimination(const Problem& problem) : problem_(problem), n_(problem.unknowns()), shared_(n_, 0), solved_(n_), most_(n_, 0), in_(n_) {
    for (int r = 0; r < problem.rows(); ++r)
      for (SparseRows::InnerIterator it(problem.B, r); it; ++it) shared_[it.col()] += it.value() != 0;
  }

  RowBasis operator()() {
    RowBasis basis;
    for (int r = 0; r < problem_.rows(); ++r) basis.unknown.push_back(eliminate(r));
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < n_; ++j) {
      if (solved_[j].empty()) entries.emplace_back(j, j, 1);
      for (const auto& [index, value] : solved_[j]) entries.emplace_back(j, index < n_ ? index : basis.unknown[index - n_], value);
    }
    basis.T.resize(n_, n_);
    basis.T.setFromTriplets(entries.begin(), entries.end());
    return basis;
  }

 private:
  using Terms = std::map<int, double>;  ///< factors of free unknowns and, after these, of what rows make

  int eliminate(int row) {
    Terms terms;
    double greatest = 0;
    std::size_t count = 0;
    for (SparseRows::InnerIterator it(problem_.B, row); it; ++it) {
      if (it.value() == 0) continue;
      add(terms, static_cast<int>(it.col()), it.value());
      greatest = std::max(greatest, std::abs(it.value()));
      ++count;
    }
    const std::size_t most = 3 * count + 3;
    if (terms.size() > most) return -1;
    const int own = pick(terms, greatest);
    if (own < 0) return -1;
    const double factor = terms[own];
    terms.erase(own);
    for (auto& [index, value] : terms) value /= -factor;
    terms[n_ + row] = 1 / factor;
    return solve_for(own, std::move(terms), most) ? own : -1;
  }

  /// Puts the terms for the unknown wherever it stands; false, and nothing done, where that makes others reach too far.
  bool solve_for(int own, Terms terms, std::size_t most) {
    std::vector<std::pair<int, Terms>> changed;
    for (const int other : in_[own]) {
      Terms now = solved_[other];
      const double factor = now[own];
      now.erase(own);
      for (const auto& [index, value] : terms) now[index] += factor * value;
      if (now.size() > most_[other]) return false;
      changed.emplace_back(other, std::move(now));
    }
    changed.emplace_back(own, std::move(terms));
    most_[own] = most;
    for (auto& [other, now] : changed) {
      for (const auto& [index, value] : now)
        if (index < n_ && std::find(in_[index].begin(), in_[index].end(), other) == in_[index].end()) in_[index].push_back(other);
      solved_[other] = std::move(now);
    }
    in_[own].clear();
    return true;
  }

  /// Adds the unknown's multiple, by what it was solved for, where it was.
  void add(Terms& terms, int unknown, double factor) const {
    if (solved_[unknown].empty()) terms[unknown] += factor;
    for (const auto& [index, value] : solved_[unknown]) terms[index] += factor * value;
  }

  int pick(const Terms& terms, double greatest) const {
    double most = 0;
    for (const auto& [index, value] : terms)
      if (index < n_) most = std::max(most, std::abs(value));
    if (!(most > kDependent * greatest)) return -1;
    int best = -1;
    for (const auto& [index, value] : terms)
      if (index < n_ && std::abs(value) >= kLeastFactor * most && (best < 0 || shared_[index] < shared_[best])) best = index;
    return best;
  }

  const Problem& problem_;
  const int n_;
  std::vector<int> shared_;           ///< rows that an unknown is in
  std::vector<Terms> solved_;         ///< by unknown; empty: free
  std::vector<std::size_t> most_;     ///< terms that it may have
  std::vector<std::vector<int>> in_;  ///< by free unknown: those in whose terms it stands
};

}  // namespace

RowBasis row_basis(const Problem& problem) { return Elimination(problem)(); }

SparseMatrix RowBasis::coordinates(const Problem& problem, const SparseMatrix& u) const {
  std::vector<int> row_of(problem.unknowns(), -1);
  for (int r = 0; r < problem.rows(); ++r)
    if (unknown[r] >= 0) row_of[unknown[r]] = r;
  std::vector<Eigen::Triplet<double>> entries;
  const SparseMatrix jumps = problem.B * u;
  for (int k = 0; k < u.cols(); ++k) {
    for (SparseMatrix::InnerIterator it(u, k); it; ++it)
      if (row_of[it.row()] < 0) entries.emplace_back(static_cast<int>(it.row()), k, it.value());
    for (SparseMatrix::InnerIterator it(jumps, k); it; ++it)
      if (const int own = unknown[it.row()]; own >= 0) entries.emplace_back(own, k, it.value());
  }
  SparseMatrix out(u.rows(), u.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace dotyk::problem

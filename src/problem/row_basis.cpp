#include "problem/row_basis.hpp"

#include <unordered_map>

namespace dotyk::problem {

using algebra::SparseMatrix;
using algebra::SparseRows;

namespace {

/// An unknown can be a row's own if its factor is at least this part of the row's greatest.
constexpr double kLeastFactor = 0.2;
/// A row nearly depends on others if elimination leaves no more than this part of its greatest factor. To solve for an unknown of it would magnify
/// the factors of the others.
constexpr double kDependent = 0.01;
/// So many unknowns may one depend on. Along an edge or a rim each row is coupled to the next, with factors that decay; factors below kNothing are
/// dropped.
constexpr std::size_t kMostTerms = 1000;
constexpr double kNothing = 1e-16;
/// Once the basis has so many terms an unknown on average, no row may come to act on more than three times as many unknowns as it does.
constexpr std::size_t kMostFill = 4;

/// Gauss–Jordan elimination of one unknown for every row, as long as that makes none reach too far.
class Elimination {
 public:
  explicit Elimination(const Problem& problem) : problem_(problem), n_(problem.unknowns()) {
    for (int r = 0; r < problem.rows(); ++r)
      for (SparseRows::InnerIterator it(problem.B, r); it; ++it) shared_[static_cast<int>(it.col())] += it.value() != 0;
  }

  RowBasis operator()() {
    RowBasis basis;
    for (int r = 0; r < problem_.rows(); ++r) basis.unknown.push_back(eliminate(r));
    const auto column = [&](int index) { return index < n_ ? index : basis.unknown[index - n_]; };
    const bool of_signs = std::ranges::all_of(solved_, [&](const auto& of) {
      const auto& [j, solved] = of;
      return solved.terms.size() == 1 && column(solved.terms.begin()->first) == j && std::abs(solved.terms.begin()->second) == 1;
    });
    if (of_signs) {  // as with one body on a rigid one whose normal is an axis
      for (const auto& [j, solved] : solved_) {
        if (solved.terms.begin()->second == 1) continue;
        if (basis.signs.size() == 0) basis.signs.setOnes(n_);
        basis.signs[j] = -1;
      }
      return basis;
    }
    algebra::Triplets entries;
    for (int j = 0; j < n_; ++j) {
      const auto solved = solved_.find(j);
      if (solved == solved_.end()) entries.emplace_back(j, j, 1);
      else
        for (const auto& [index, value] : solved->second.terms) entries.emplace_back(j, column(index), value);
    }
    basis.T = algebra::from_triplets(n_, n_, entries);
    return basis;
  }

 private:
  using Terms = std::map<int, double>;  ///< factors of free unknowns and, after these, of what rows make
  struct Solved {
    Terms terms;
    std::size_t most = 0;  ///< terms that it may have
  };

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
    const std::size_t most = terms_ < kMostFill * static_cast<std::size_t>(n_) ? std::max(3 * count + 3, kMostTerms) : 3 * count + 3;
    if (terms.size() > most) return -1;
    const int own = pick(terms, greatest);
    if (own < 0) return -1;
    const double factor = terms[own];
    terms.erase(own);
    for (auto& [index, value] : terms) value /= -factor;
    terms[n_ + row] = 1 / factor;
    drop_nothing(terms);
    return solve_for(own, std::move(terms), most) ? own : -1;
  }

  /// Puts the terms for the unknown wherever it stands; false, and nothing done, where that makes others reach too far.
  bool solve_for(int own, Terms terms, std::size_t most) {
    std::vector<std::pair<int, Terms>> changed;
    for (const int other : in_[own]) {
      Terms now = solved_[other].terms;
      const double factor = now[own];
      now.erase(own);
      for (const auto& [index, value] : terms) now[index] += factor * value;
      drop_nothing(now);
      if (now.size() > solved_[other].most) return false;
      changed.emplace_back(other, std::move(now));
    }
    changed.emplace_back(own, std::move(terms));
    solved_[own].most = most;
    for (auto& [other, now] : changed) {
      for (const auto& [index, value] : now)
        if (index < n_ && std::find(in_[index].begin(), in_[index].end(), other) == in_[index].end()) in_[index].push_back(other);
      Terms& before = solved_[other].terms;
      terms_ += now.size() - std::min(now.size(), before.size());
      before = std::move(now);
    }
    in_[own].clear();
    return true;
  }

  static void drop_nothing(Terms& terms) {
    std::erase_if(terms, [](const auto& term) { return std::abs(term.second) < kNothing; });
  }

  /// Adds the unknown's multiple, by what it was solved for, where it was.
  void add(Terms& terms, int unknown, double factor) const {
    const auto solved = solved_.find(unknown);
    if (solved == solved_.end()) return void(terms[unknown] += factor);
    for (const auto& [index, value] : solved->second.terms) terms[index] += factor * value;
  }

  int pick(const Terms& terms, double greatest) const {
    double most = 0;
    for (const auto& [index, value] : terms)
      if (index < n_) most = std::max(most, std::abs(value));
    if (!(most > kDependent * greatest)) return -1;
    int best = -1;
    double of_best = 0;
    for (const auto& [index, value] : terms) {
      if (index >= n_ || !(std::abs(value) >= kLeastFactor * most)) continue;
      const int fewer = best < 0 ? 1 : shared_.at(best) - shared_.at(index);
      if (fewer > 0 || (fewer == 0 && std::abs(value) > of_best)) best = index, of_best = std::abs(value);
    }
    return best;
  }

  const Problem& problem_;
  const int n_;
  // By unknown: few of all are in rows.
  std::unordered_map<int, int> shared_;           ///< rows that it is in
  std::map<int, Solved> solved_;                  ///< those that are not free
  std::unordered_map<int, std::vector<int>> in_;  ///< of a free one those in whose terms it stands
  std::size_t terms_ = 0;                         ///< of all together
};

}  // namespace

RowBasis row_basis(const Problem& problem) { return Elimination(problem)(); }

algebra::StoredMatrix RowBasis::with_signs(algebra::StoredMatrix lower) const {
  for (Eigen::Index j = 0; j < lower.cols() && !trivial(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) it.valueRef() *= signs[it.row()] * signs[j];
  return lower;
}

SparseRows RowBasis::times(const SparseRows& R) const {
  if (!of_signs()) return R * T;
  SparseRows product = R;
  for (int r = 0; r < product.rows() && !trivial(); ++r)
    for (SparseRows::InnerIterator it(product, r); it; ++it) it.valueRef() *= signs[it.col()];
  return product;
}

SparseMatrix RowBasis::of_displacements(const Problem& problem) const {
  const int count = problem.unknowns();
  std::vector<char> own(static_cast<std::size_t>(count), 0);
  algebra::Triplets entries;
  for (std::size_t r = 0; r < unknown.size(); ++r) {
    if (unknown[r] < 0) continue;
    own[unknown[r]] = 1;
    for (SparseRows::InnerIterator it(problem.B, static_cast<int>(r)); it; ++it) entries.emplace_back(unknown[r], static_cast<int>(it.col()), it.value());
  }
  for (int i = 0; i < count; ++i)
    if (!own[i]) entries.emplace_back(i, i, 1);
  return algebra::from_triplets(count, count, entries);
}

}  // namespace dotyk::problem

#include "solver/active/relaxed.hpp"

#include <utility>

namespace dotyk::solver {
namespace {

using algebra::SparseMatrix;
using algebra::Vector;
using problem::Problem;

constexpr int kLayers = 4;   ///< of neighbours, about the rows that bear
constexpr int kSweeps = 10;  ///< up and down

/// Rows that bear under laws with several branches.
std::vector<int> bearing(const Problem& problem, const Vector& lambda) {
  std::vector<int> rows;
  for (const auto& [law, k, r] : problem.scalar_rows())
    if (lambda[r] != 0 && !law.linear_stiffness(k)) rows.push_back(r);
  for (const problem::FrictionGroup& group : problem.friction)
    for (int r = group.first; r < group.row(group.points()); ++r)
      if (lambda[r] != 0) rows.push_back(r);
  return rows;
}

/// The unknowns of rows, and of neighbours.
std::vector<int> unknowns_near(const std::vector<int>& rows, const HeldStiffness& stiffness) {
  const SparseMatrix& lower = stiffness.lower();
  std::vector<char> layer(static_cast<std::size_t>(lower.cols()), 0);  // 1: the first; 0: beyond
  for (const int r : rows)
    if (const int own = stiffness.basis().unknown[r]; own >= 0) layer[own] = 1;
  for (char k = 1; k <= kLayers; ++k)
    for (int j = 0; j < lower.cols(); ++j)
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
        const auto i = it.row();
        if (layer[i] == k && layer[j] == 0) layer[j] = static_cast<char>(k + 1);
        if (layer[j] == k && layer[i] == 0) layer[i] = static_cast<char>(k + 1);
      }
  std::vector<int> unknowns;
  for (int i = 0; i < lower.cols(); ++i)
    if (layer[i] > 0) unknowns.push_back(i);
  return unknowns;
}

/// Sweeps over part of the unknowns, in the basis where rows are unknowns.
class NonlinearSmoothing {
 public:
  NonlinearSmoothing(const Problem& problem, const HeldStiffness& stiffness, problem::State& state)
      : problem_(problem), basis_(stiffness.basis()), lambda_(state.lambda), unknowns_(unknowns_near(bearing(problem, lambda_), stiffness)),
        rows_(unknowns_.size()), moved_(Vector::Zero(size())) {
    std::vector<int> place(static_cast<std::size_t>(problem.unknowns()), -1);
    for (int k = 0; k < size(); ++k) place[unknowns_[k]] = k;
    take_matrix(stiffness.lower(), place);
    take_rows(place);
    const Vector jump = problem.B * state.u - problem.c;
    Vector others = lambda_;  // whose force is given
    for (int k = 0; k < size(); ++k)
      if (const int r = rows_[k].row; r >= 0) others[r] = 0, rows_[k].x = jump[r];
    left_ = (basis_.T.transpose() * (problem.load() - problem::rough_stiffness_times(problem, state.u) - problem.B.transpose() * others))(unknowns_);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (int k = 0; k < size(); ++k) relax(k);
      for (int k = size(); k-- > 0;) relax(k);
    }
    Vector all = Vector::Zero(problem.unknowns());
    all(unknowns_) = moved_;
    state.u += basis_.T * all;
  }

 private:
  /// What an unknown stands for: itself, a row under a scalar law, or the first row of a friction point whose others follow.
  struct Row {
    int row = -1;
    const problem::Law* law = nullptr;
    const problem::FrictionGroup* friction = nullptr;
    int k = 0;         ///< of its group
    int others[2];     ///< places of the point's unknowns, this one first
    double x = 0;      ///< (Bu − c) of the row
  };

  int size() const { return static_cast<int>(unknowns_.size()); }

  void take_matrix(const SparseMatrix& lower, const std::vector<int>& place) {
    algebra::Triplets entries;
    for (int at = 0; at < size(); ++at)
      for (SparseMatrix::InnerIterator it(lower, unknowns_[at]); it; ++it) {
        const int i = place[it.row()];
        if (i < 0) continue;
        entries.emplace_back(i, at, it.value());
        if (i != at) entries.emplace_back(at, i, it.value());
      }
    A_ = algebra::from_triplets(size(), size(), entries);
    diagonal_ = A_.diagonal();
  }

  void take_rows(const std::vector<int>& place) {
    const auto place_of = [&](int r) { return basis_.unknown[r] < 0 ? -1 : place[basis_.unknown[r]]; };
    for (const auto& [law, k, r] : problem_.scalar_rows())
      if (const int at = place_of(r); at >= 0) rows_[at] = {r, &law, nullptr, k, {at, at}, 0};
    for (const auto& [group, k, first, n] : problem_.friction_points()) {
      const int a = place_of(first), b = place_of(first + group.components - 1);
      if (a < 0 || b < 0) continue;
      rows_[a] = {first, nullptr, &group, k, {a, b}, 0};
      if (a != b) rows_[b].row = first + 1;
    }
  }

  /// Moves an unknown, and takes what that needs off the forces left.
  void move(int at, double by) {
    moved_[at] += by, rows_[at].x += by;
    for (SparseMatrix::InnerIterator it(A_, at); it; ++it) left_[it.row()] -= by * it.value();
  }

  void relax(int at) {
    Row& row = rows_[at];
    const double stiffness = diagonal_[at];
    if (row.friction) return relax_point(row);
    if (row.row >= 0 && !row.law) return;  // with the first row of its point
    if (row.law) lambda_[row.row] = row.law->project(row.k, left_[at] + stiffness * row.x, stiffness).lambda;
    move(at, (left_[at] - (row.law ? lambda_[row.row] : 0)) / stiffness);
  }

  void relax_point(Row& row) {
    const int components = row.friction->components;
    double stiffness = 0;  // at least the greatest eigenvalue
    for (int i = 0; i < components; ++i) stiffness += diagonal_[row.others[i]];
    Vector y(components);
    for (int i = 0; i < components; ++i) y[i] = left_[row.others[i]] + stiffness * rows_[row.others[i]].x;
    const Vector force = problem::project_disc(y, row.friction->bound(row.k, lambda_)).value;
    lambda_.segment(row.row, components) = force;
    Vector by(components);
    for (int i = 0; i < components; ++i) by[i] = (left_[row.others[i]] - force[i]) / stiffness;
    for (int i = 0; i < components; ++i) move(row.others[i], by[i]);
  }

  const Problem& problem_;
  const problem::RowBasis& basis_;
  Vector& lambda_;
  std::vector<int> unknowns_;
  std::vector<Row> rows_;
  SparseMatrix A_;
  Vector diagonal_, left_, moved_;
};

}  // namespace

problem::State relaxed(const Problem& problem, const HeldStiffness& stiffness, problem::State from) {
  NonlinearSmoothing(problem, stiffness, from);
  return from;
}

}  // namespace dotyk::solver

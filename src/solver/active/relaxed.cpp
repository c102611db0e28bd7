#include "solver/active/relaxed.hpp"

#include "algebra/congruent.hpp"

namespace dotyk::solver {
namespace {

using algebra::Field;
using algebra::SparseMatrix;
using algebra::Vector;
using problem::Problem;

constexpr int kLayers = 4;   ///< of neighbours, about the rows that bear
constexpr int kSweeps = 20;  ///< up and down
/// The greatest part of the forces of rows with several branches that sweeps may change. Where they change more, contact has been made to balance the errors of
/// interpolation within a stiff body. Measured on 16³ cells and more: 0.1 to 0.6 between equal bodies, or if one is a hundred times stiffer than the
/// other; 0.85 to 1.1 if it is a thousand times stiffer.
constexpr double kMostChange = 0.7;

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

/// Flags of the unknowns of rows.
std::vector<char> own_unknowns(const std::vector<int>& rows, const HeldStiffness& stiffness, int unknowns_of_all) {
  std::vector<char> own(static_cast<std::size_t>(unknowns_of_all), 0);
  for (const int r : rows)
    if (const int unknown = stiffness.basis().unknown[r]; unknown >= 0) own[unknown] = 1;
  return own;
}

/// Sweeps over the unknowns near rows that bear, in the basis where rows are unknowns.
class NonlinearSmoothing {
 public:
  /// `bearing`: those rows.
  NonlinearSmoothing(const Problem& problem, const HeldStiffness& stiffness, const problem::State& from, const std::vector<int>& bearing)
      : problem_(problem), stiffness_(stiffness), u_(stiffness.field(from.u)), lambda_(from.lambda) {
    std::vector<char> near = own_unknowns(bearing, stiffness, problem.unknowns());
    algebra::SymmetricMatrix matrix = stiffness.near(near, kLayers);
    std::vector<int> place(near.size(), -1);
    for (std::size_t i = 0; i < near.size(); ++i)
      if (near[i]) place[i] = size(), unknowns_.push_back(static_cast<int>(i));
    rows_.resize(unknowns_.size()), moved_ = Vector::Zero(size());
    A_ = algebra::part_of(matrix.lower(), place, unknowns_).selfadjointView<Eigen::Lower>();
    matrix = {};
    diagonal_ = A_.diagonal();
    take_rows(place);
    const Vector jump = problem::jumps(problem, from.u);
    Vector given = lambda_;
    for (int k = 0; k < size(); ++k)
      if (const int r = rows_[k].row; r >= 0) given[r] = 0, rows_[k].x = jump[r];
    Field left = stiffness.load();
    problem::take_stiffness_times(problem, algebra::LongField(u_), false, left);
    left.set_watched(stiffness.near_basis().forces(left.watched() - stiffness.jumps().transpose() * given));
    left_ = left.some(unknowns_);
  }

  /// Up and down.
  void sweep() {
    for (int k = 0; k < size(); ++k) relax(k);
    for (int k = size(); k-- > 0;) relax(k);
  }

  problem::State state() const {
    Vector near = Vector::Zero(std::ssize(stiffness_.near_rows()));
    for (int k = 0; k < size(); ++k)
      if (const int place = stiffness_.place(unknowns_[k]); place >= 0) near[place] = moved_[k];
    near = u_.watched() + stiffness_.near_basis().displacements(std::move(near));
    Field u = u_;
    u.set_some(unknowns_, u.some(unknowns_) + moved_);
    u.set_watched(near);
    return {problem::Displacement(std::move(u)), lambda_};
  }

 private:
  /// What an unknown stands for: itself, a row under a scalar law, or the first row of a friction point whose others follow.
  struct Row {
    int row = -1;
    const problem::Law* law = nullptr;
    const problem::FrictionGroup* friction = nullptr;
    int k = 0;                   ///< of its group
    std::array<int, 2> places{}; ///< of the point's unknowns
    double x = 0;                ///< (Bu − c) of the row
  };

  int size() const { return static_cast<int>(unknowns_.size()); }

  void take_rows(const std::vector<int>& place) {
    const std::vector<int>& unknown = stiffness_.basis().unknown;
    const auto place_of = [&](int r) { return unknown[r] < 0 ? -1 : place[unknown[r]]; };
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
    const Row& row = rows_[at];
    const double stiffness = diagonal_[at];
    if (row.friction) return relax_point(row);
    if (row.row >= 0 && !row.law) return;  // moves with the first row of its point
    if (!(stiffness > 0)) return;
    double force = 0;
    if (row.law) force = lambda_[row.row] = row.law->project(row.k, left_[at] + stiffness * row.x, stiffness).lambda;
    move(at, (left_[at] - force) / stiffness);
  }

  void relax_point(const Row& row) {
    const int components = row.friction->components;
    double stiffness = 0, square = 0;  // at least the greatest eigenvalue
    for (int i = 0; i < components; ++i) stiffness += diagonal_[row.places[i]];
    if (!(stiffness > 0)) return;
    std::array<double, 2> y{};
    for (int i = 0; i < components; ++i) y[i] = left_[row.places[i]] + stiffness * rows_[row.places[i]].x, square += y[i] * y[i];
    const double factor = problem::disc_factor(std::sqrt(square), row.friction->bound(row.k, lambda_));
    for (int i = 0; i < components; ++i) lambda_[row.row + i] = factor * y[i], y[i] = (left_[row.places[i]] - factor * y[i]) / stiffness;
    for (int i = 0; i < components; ++i) move(row.places[i], y[i]);
  }

  const Problem& problem_;
  const HeldStiffness& stiffness_;
  const Field u_;  ///< of `from`
  Vector lambda_;
  std::vector<int> unknowns_;
  std::vector<Row> rows_;  ///< by place among unknowns_, as all that follows
  SparseMatrix A_;
  Vector diagonal_;
  Vector left_;   ///< forces that nothing balances yet, those of the rows here apart
  Vector moved_;  ///< displacements since `from`
};

}  // namespace

std::optional<problem::State> relaxed(const Problem& problem, const HeldStiffness& stiffness, const problem::State& from) {
  const std::vector<int> rows = bearing(problem, from.lambda);
  if (rows.empty()) return from;
  NonlinearSmoothing smoothing(problem, stiffness, from, rows);
  for (int k = 0; k < kSweeps; ++k) smoothing.sweep();
  problem::State state = smoothing.state();
  Vector change = state.lambda - from.lambda, before = from.lambda;
  for (const auto& [law, k, r] : problem.scalar_rows())
    if (law.linear_stiffness(k)) change[r] = before[r] = 0;
  if (!(change.norm() <= kMostChange * before.norm())) return std::nullopt;
  return state;
}

}  // namespace dotyk::solver

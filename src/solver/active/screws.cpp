#include "solver/active/screws.hpp"

#include "algebra/dense/bounded_least_squares.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "problem/uniqueness.hpp"
#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::Problem;
using problem::RowGroup;

namespace {

/// Least regularity at which screws are taken to hold: below, half of the digits are lost.
constexpr double kRegular = 1e-8;

DenseMatrix pick(const DenseMatrix& N, const std::vector<int>& rows) { return N(rows, Eigen::all); }

double regularity_of(const DenseMatrix& N) {
  if (N.rows() < N.cols() || N.cols() == 0) return N.cols() == 0 ? 1 : 0;
  const Vector s = algebra::singular_values(N);
  return s[0] > 0 ? s[s.size() - 1] / s[0] : 0;
}

std::vector<int> sorted(std::vector<int> rows) {
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace

Screws::Screws(const Problem& problem, DenseMatrix N, Vector e, std::vector<int> rows)
    : N_(std::move(N)), e_(std::move(e)), low_(Vector::Zero(problem.rows())), high_(low_), point_(problem.rows(), {0, 0}), rows_(std::move(rows)) {
  for (const auto& [law, k, r] : problem.scalar_rows())
    if (law.unilateral()) high_[r] = INFINITY;
  for (const auto& [group, k, first, n] : problem.friction_points())
    for (int r = first; r < first + group.components; ++r) point_[r] = {first, group.components}, high_[r] = group.law->bound(k, 0), low_[r] = -high_[r];
  const std::size_t count = static_cast<std::size_t>(N_.cols());
  if (rows_.empty()) {
    complete();
  } else {
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (std::count(rows_.begin(), rows_.end(), rows_[k]) > 1)
        throw InputError(text("screws: row ", rows_[k] + 1, " is named twice"));
    if (rows_.size() != count)
      throw InputError(text("screws: ", rows_.size(), " are given; this problem needs ", count,
                            ", one for each rigid motion that contacts notice"));
  }
  if (!regular(rows_))
    throw InputError(text("the screws do not hold every rigid motion (regularity ", regularity(),
                          "): place them on sides that face different ways, or not all on one line"));
}

double Screws::regularity() const { return regularity_of(pick(N_, rows_)); }

double Screws::determinant() const { return algebra::singular_values(pick(N_, rows_)).prod(); }

bool Screws::regular(const std::vector<int>& rows) const {
  return regularity_of(pick(N_, rows)) > kRegular;
}

void Screws::complete() {
  const Vector carried = algebra::bounded_least_squares(N_.transpose(), e_, low_, high_).x;
  std::vector<int> order;  // first what presses, then what is farthest from slipping
  for (int r = 0; r < N_.rows(); ++r)
    if (high_[r] > 0) order.push_back(r);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const bool presses = std::isinf(high_[a]);
    return presses != std::isinf(high_[b]) ? presses : excess(a, carried) < excess(b, carried);
  });
  add(order, 1e-3);
  add(order, kRegular);  // badly conditioned contacts: whatever is regular at all
}

void Screws::add(const std::vector<int>& order, double least) {
  for (int r : order) {
    if (static_cast<Eigen::Index>(rows_.size()) == N_.cols()) return;
    std::vector<int> more = rows_;
    more.push_back(r);
    const Vector s = algebra::singular_values(pick(N_, more));
    if (s[static_cast<Eigen::Index>(more.size()) - 1] > least * s[0]) rows_ = more;
  }
}

double Screws::excess(int row, const Vector& lambda) const {
  const auto [first, components] = point_[row];
  return components == 0 ? -lambda[row] : lambda.segment(first, components).norm() - high_[row];
}

bool Screws::pulls(const Vector& lambda, double noise) const {
  return std::any_of(rows_.begin(), rows_.end(), [&](int r) { return excess(r, lambda) > noise; });
}

bool Screws::move(const Vector& lambda, double noise) {
  tried_.insert(sorted(rows_));
  std::vector<int> pulling;
  for (int k = 0; k < static_cast<int>(rows_.size()); ++k)
    if (excess(rows_[k], lambda) > noise) pulling.push_back(k);
  std::sort(pulling.begin(), pulling.end(), [&](int a, int b) { return excess(rows_[a], lambda) > excess(rows_[b], lambda); });
  for (const int k : pulling)
    if (move(k, lambda, noise)) return true;
  return false;
}

bool Screws::move(int screw, const Vector& lambda, double noise) {
  // Neighbours on the contact see rigid motions alike: the distance of rows of N. Rows that press or stick
  // come first, others only where none does.
  std::vector<int> best;
  double nearest = INFINITY;
  for (int r = 0; r < N_.rows(); ++r) {
    if (!(high_[r] > 0) || std::find(rows_.begin(), rows_.end(), r) != rows_.end()) continue;
    const double far = excess(r, lambda) < -noise ? 0 : 1e6;
    const double distance = far + (N_.row(r) - N_.row(rows_[screw])).norm();
    if (!(distance < nearest)) continue;
    std::vector<int> moved = rows_;
    moved[screw] = r;
    if (tried_.count(sorted(moved)) || !regular(moved)) continue;
    nearest = distance;
    best = std::move(moved);
  }
  if (best.empty()) return false;
  rows_ = std::move(best);
  ++moves_;
  return true;
}

HeldByScrews::HeldByScrews(const problem::CondensedProblem& condensed, std::vector<int> screws)
    : condensed_(condensed), screws_(std::move(screws)), motions_(pick(condensed.N(), screws_)),
      Q_(DenseMatrix::Identity(condensed.rows(), condensed.rows())), balance_(Vector::Zero(condensed.rows())) {
  Q_(Eigen::all, screws_) -= motions_.solve_transposed(DenseMatrix(condensed.N().transpose())).transpose();
  Q_(screws_, Eigen::all).setZero();  // without what rounding leaves
  balance_(screws_) = motions_.solve_transposed(condensed.e());
  DenseMatrix W = Q_ * condensed.W() * Q_.transpose();
  for (const int r : screws_) W(r, r) = condensed.W()(r, r);
  problem_.emplace(std::move(W), Q_ * condensed.jump(balance_, Vector()));
}

Vector HeldByScrews::amounts(const Vector& lambda) const { return motions_.solve(-condensed_.jump(lambda, Vector())(screws_)); }

namespace {

class ScrewStep final : public Step {
 public:
  ScrewStep(const problem::CondensedProblem& condensed, const Vector& rho, const Screws& screws) : condensed_(condensed), rho_(rho), screws_(screws) {}

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    if (!held_ || held_->screws() != screws_.rows()) held_.emplace(condensed_, screws_.rows());
    Linearisation other = l;
    for (const int r : screws_.rows()) other.active[r] = 0, other.value[r] = 0;
    if (!reduced_step(held_->problem(), rho_)->solve(other, lambda, x)) return false;
    lambda_ = lambda = held_->multipliers(lambda);
    alpha_ = held_->amounts(lambda);
    x = condensed_.jump(lambda, alpha_);
    return lambda.allFinite() && x.allFinite();
  }

  problem::Displacement recover() override { return condensed_.recover(lambda_, alpha_); }

 private:
  const problem::CondensedProblem& condensed_;
  const Vector& rho_;
  const Screws& screws_;
  std::optional<HeldByScrews> held_;
  Vector lambda_, alpha_;
};

/// The rows with their laws, those of screws without: λ' = 0 there.
Problem other_rows(const Problem& problem, const std::vector<int>& screws) {
  std::vector<char> screwed(static_cast<std::size_t>(problem.rows()), 0);
  Problem rows = laws_of(problem);
  rows.groups.clear(), rows.friction.clear();
  for (const int r : screws) screwed[r] = 1, rows.groups.push_back({"screw", problem::elastic({0.0}), r, 1});
  for (const RowGroup& group : problem.groups) {
    const auto end = screwed.begin() + group.first + group.count;
    if (std::find(screwed.begin() + group.first, end, 1) == end) rows.groups.push_back(group);
    else  // unilateral: one law for all its rows
      for (int r = group.first; r < group.first + group.count; ++r)
        if (!screwed[r]) rows.groups.push_back({group.name, group.law, r, 1});
  }
  for (const auto& [group, k, first, n] : problem.friction_points()) {
    const int kept = static_cast<int>(std::count(screwed.begin() + first, screwed.begin() + first + group.components, 0));
    if (kept == 0) continue;
    const int from = kept == group.components || !screwed[first] ? first : first + 1;
    rows.friction.push_back({group.name, problem::tresca({group.law->bound(k, 0)}), from, kept, {-1}});
  }
  return rows;
}

}  // namespace

std::unique_ptr<Step> screw_step(const problem::CondensedProblem& condensed, const Vector& rho,
                                 const Screws& screws) {
  return std::make_unique<ScrewStep>(condensed, rho, screws);
}

WithScrews::WithScrews(std::shared_ptr<const RowMethod> method)
    : RowMethod(), inner(std::move(method)), name_(text(inner->name(), " with screws")) {
  static_cast<Settings&>(*this) = *inner;
}

void WithScrews::require_treatable(const Problem& problem) const {
  inner->require_treatable(problem);
  if (problem::has_coulomb(problem))
    throw InputError("kernel = \"screws\" goes with given friction: the bound of Coulomb's at a screw is not known before its force is");
}

void WithScrews::iterate(RowIteration& it) const {
  if (it.condensed.kernel_size() == 0) return inner->iterate(it);
  Screws places(it.problem, it.condensed.N(), it.condensed.e(), screws);
  Settings settings = *inner;
  settings.tol = tol / 10;
  int iterations = 0;
  bool placed = true;
  while (placed && it.next()) {
    it.note({places.rows(), places.regularity(), places.determinant()});
    const HeldByScrews held(it.condensed, places.rows());
    const Problem rows = other_rows(it.problem, places.rows());
    InnerMonitor monitor(it.monitor());
    RowIteration other(rows, held.problem(), settings, inner->map_weight(), monitor);
    inner->iterate(other);
    const Result found = other.finish();
    iterations += found.iterations;
    const Vector lambda = held.multipliers(found.state.lambda);
    it.move_to({lambda, held.amounts(lambda)});
    if (it.record()) break;
    // Where the inner method does not end, a screw may be where the solution slips.
    placed = places.moves() < max_moves && places.move(lambda, 1e-9 * lambda.lpNorm<Eigen::Infinity>());
    if (!placed) it.give_up(text(found.converged ? std::string() : "held by screws: " + found.reason + "; ", "a screw still pulls, or slips, after ", places.moves(),
                                " moves: where fewer points stick than motions are free no place is right; kernel = \"exact\" needs none"));
  }
  it.remark(text(iterations, " iterations of ", inner->name()));
}

}  // namespace dotyk::solver

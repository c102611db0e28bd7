#include "solver/active/screws.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/bounded_least_squares.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;

namespace {

/// Least regularity at which screws are taken to hold: below, half of the digits are lost.
constexpr double kRegular = 1e-8;

DenseMatrix pick(const DenseMatrix& N, const std::vector<int>& rows) { return N(rows, Eigen::all); }

double regularity_of(const DenseMatrix& N) {
  if (N.rows() < N.cols() || N.cols() == 0) return N.cols() == 0 ? 1 : 0;
  const Vector s = algebra::singular_values(N);
  return s[0] > 0 ? s[s.size() - 1] / s[0] : 0;
}

}  // namespace

Screws::Screws(const Problem& problem, DenseMatrix N, Vector e, std::vector<int> rows)
    : problem_(problem), N_(std::move(N)), e_(std::move(e)), unilateral_(problem.rows(), 0), friction_(problem.rows(), nullptr),
      rows_(std::move(rows)) {
  for (const problem::RowGroup& group : problem.groups) std::fill_n(unilateral_.begin() + group.first, group.count, group.law->unilateral());
  may_hold_ = unilateral_;
  for (const FrictionGroup& group : problem.friction)
    for (int r = group.first; r < group.row(group.points()); ++r) friction_[r] = &group, may_hold_[r] = group.bound((r - group.first) / group.components, Vector::Zero(problem.rows())) > 0;
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
  Vector low = Vector::Zero(problem_.rows()), high = low;
  for (int r = 0; r < problem_.rows(); ++r) {
    if (unilateral_[r]) high[r] = INFINITY;
    if (!may_hold_[r] || unilateral_[r]) continue;
    high[r] = friction_[r]->bound((r - friction_[r]->first) / friction_[r]->components, low);
    low[r] = -high[r];
  }
  const Vector carried = algebra::bounded_least_squares(N_.transpose(), e_, low, high).x;
  std::vector<int> order;  // first what presses, then what is farthest from slipping
  for (int r = 0; r < problem_.rows(); ++r)
    if (may_hold_[r]) order.push_back(r);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return unilateral_[a] != unilateral_[b] ? unilateral_[a] > unilateral_[b] : excess(a, carried) < excess(b, carried);
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

namespace {
std::vector<int> sorted(std::vector<int> rows) {
  std::sort(rows.begin(), rows.end());
  return rows;
}
}  // namespace

double Screws::excess(int row, const Vector& lambda) const {
  const FrictionGroup* group = friction_[row];
  if (!group) return -lambda[row];
  const int point = (row - group->first) / group->components;
  return lambda.segment(group->row(point), group->components).norm() - group->bound(point, lambda);
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
  for (int r = 0; r < problem_.rows(); ++r) {
    if (!may_hold_[r] || std::find(rows_.begin(), rows_.end(), r) != rows_.end()) continue;
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

  Vector recover() override { return condensed_.recover(lambda_, alpha_); }

 private:
  const problem::CondensedProblem& condensed_;
  const Vector& rho_;
  const Screws& screws_;
  std::optional<HeldByScrews> held_;
  Vector lambda_, alpha_;
};

}  // namespace

std::unique_ptr<Step> screw_step(const problem::CondensedProblem& condensed, const Vector& rho,
                                 const Screws& screws) {
  return std::make_unique<ScrewStep>(condensed, rho, screws);
}

}  // namespace dotyk::solver

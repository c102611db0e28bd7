#include "solver/pieces/piece_programme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "algebra/dense/dense.hpp"
#include "solver/rows/natural_map.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

constexpr int kDirections = 8;  // of the polygon around a disc
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of the right side, the greatest columns; that much more as springs of laws are softer than what a row sees. Columns without such bounds come to
/// rest anywhere, where nearly parallel ones cancel.
constexpr double kMostColumns = 1e4;

}  // namespace

PieceProgramme::PieceProgramme(const Problem& problem, const CondensedProblem& condensed)
    : problem_(problem), condensed_(condensed), root_(stiffness_of_rows(condensed).cwiseSqrt()), stated_(problem.rows(), 1) {
  if (condensed.kernel_size() > 0) {
    auto [Q, R] = algebra::orthogonal_factors(root_.asDiagonal() * condensed.N());
    Q_ = std::move(Q), R_ = std::move(R);
  } else {
    Q_ = DenseMatrix(problem.rows(), 0);
  }
  std::vector<char> rubs(problem.rows(), 0);
  for (const FrictionGroup& group : problem.friction) add(group, rubs);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (!rubs[r]) add(*group.law, r - group.first, r);
  for (Eigen::Index k = 0; k < Q_.cols(); ++k) motions_.push_back(add_column(Vector(), -Q_.col(k), -kInfinite, kInfinite));
  assemble();
}

Vector PieceProgramme::lambda(const Vector& z) const {
  Vector v = Vector::Zero(problem_.rows());
  for (std::size_t j = 0; j < forces_.size(); ++j)
    if (forces_[j].size() > 0) v += z[static_cast<Eigen::Index>(j)] / size_[static_cast<Eigen::Index>(j)] * forces_[j];
  return v.cwiseProduct(root_);
}

Vector PieceProgramme::alpha(const Vector& z) const {
  Vector a(static_cast<Eigen::Index>(motions_.size()));
  for (std::size_t k = 0; k < motions_.size(); ++k) a[static_cast<Eigen::Index>(k)] = z[motions_[k]] / size_[motions_[k]];
  return a.size() > 0 ? Vector(R_.triangularView<Eigen::Upper>().solve(a)) : a;
}

/// A column of multipliers v = λ/√ρ, which displace √ρ x by `displaces` beside what W makes of them.
int PieceProgramme::add_column(Vector v, Vector displaces, double low, double high) {
  forces_.push_back(std::move(v));
  displaces_.push_back(std::move(displaces));
  low_.push_back(low);
  high_.push_back(high);
  return static_cast<int>(forces_.size()) - 1;
}

/// In the columns' own scale.
Vector PieceProgramme::bounds(const std::vector<double>& of) const {
  return Eigen::Map<const Vector>(of.data(), static_cast<Eigen::Index>(of.size())).cwiseProduct(size_);
}

Vector PieceProgramme::unit(int row, double value) const { return value * Vector::Unit(problem_.rows(), row); }

/// The greatest column that a solution may have.
double PieceProgramme::most() const { return kMostColumns * yields_ * b_.norm(); }

void PieceProgramme::add(const problem::Law& law, int index, int r) {
  const problem::Interval bounds = law.multipliers(index);
  const problem::Springs springs = *law.springs(index);
  const double up = bounds.high / root_[r], down = -bounds.low / root_[r], rho = root_[r] * root_[r];
  const auto side = [&](double sign, double most, double k) {
    if (!(most > 0 && k > 0)) return -1;
    if (std::isfinite(k)) yields_ = std::max(yields_, rho / k);
    return add_column(unit(r, sign), std::isfinite(k) ? unit(r, sign * rho / k) : Vector(), 0, most);
  };
  if (springs.above == springs.below && !std::isfinite(up) && !std::isfinite(down)) {  // linear
    const double k = springs.above;
    if (std::isfinite(k)) yields_ = std::max(yields_, rho / k);
    add_column(unit(r), std::isfinite(k) ? unit(r, rho / k) : Vector(), -kInfinite, kInfinite);
    return;
  }
  const int above = side(1, up, springs.above), below = side(-1, down, springs.below);
  const auto beyond = [&](double sign, double most, int force, int other) {
    if (!std::isfinite(most)) return;
    const int q = add_column(Vector(), unit(r, sign), 0, kInfinite);
    if (force >= 0) pairs_.push_back({q, {force}, true});
    if (other >= 0) pairs_.push_back({q, {other}});
  };
  beyond(1, up, above, below);
  beyond(-1, down, below, above);
  if (above >= 0 && below >= 0 && springs.above != springs.below) pairs_.push_back({above, {below}});
}

void PieceProgramme::add(const FrictionGroup& group, std::vector<char>& rubs) {
  for (int k = 0; k < group.points(); ++k) {
    const double mu = group.law->bound_slope(k), bound = group.law->bound(k, 0);
    if (mu > 0) add_cone(group, k, mu, rubs);
    else if (bound > 0) add_given(group, k, bound);
    if (!(mu > 0) && (group.components > 1 || !(bound > 0)))
      for (int i = 0; i < group.components; ++i) stated_[group.row(k) + i] = 0;
  }
}

void PieceProgramme::add_cone(const FrictionGroup& group, int k, double mu, std::vector<char>& rubs) {
  const int n = group.normal[k], t = group.row(k);
  if (n < 0 || rubs[n]) {
    treatable_ = false;
    return;
  }
  rubs[n] = 1;
  std::vector<int> edges;
  const int gap = add_column(Vector(), unit(n, -1), 0, kInfinite);
  if (group.components == 1) {
    for (const double side : {mu, -mu}) edges.push_back(add_edge(n, {t}, {side}));
    slip(t, edges[1], edges[0]);
  } else {
    edges = add_polygon(n, t, mu);
  }
  pairs_.push_back({gap, edges});
}

/// A column of forces along an edge of the friction cone: λ_n = √ρ_n, and tangential forces `tangent` times λ_n on `rows`.
int PieceProgramme::add_edge(int n, const std::vector<int>& rows, const std::vector<double>& tangent) {
  Vector v = unit(n);
  for (std::size_t i = 0; i < rows.size(); ++i) v[rows[i]] = tangent[i] * root_[n] / root_[rows[i]];
  return add_column(std::move(v), Vector(), 0, kInfinite);
}

/// A polygon around the friction disc. Slip along one of its directions goes with forces of the neighbouring directions alone, in the ring between
/// the disc's inner and outer polygon.
std::vector<int> PieceProgramme::add_polygon(int n, int t, double mu) {
  std::vector<int> edges, slips;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections, c = std::cos(angle), s = std::sin(angle);
    for (const double radius : {mu / std::cos(std::numbers::pi / kDirections), mu}) edges.push_back(add_edge(n, {t, t + 1}, {radius * c, radius * s}));
    slips.push_back(add_column(Vector(), unit(t, c * root_[t] / root_[n]) + unit(t + 1, s * root_[t + 1] / root_[n]), 0, kInfinite));
  }
  for (int i = 0; i < kDirections; ++i) {
    std::vector<int> away;
    for (int j = 2; j <= kDirections - 2; ++j)
      for (const int k : {0, 1}) away.push_back(edges[2 * ((i + j) % kDirections) + k]);
    pairs_.push_back({slips[i], away});
  }
  return edges;
}

void PieceProgramme::add_given(const FrictionGroup& group, int k, double bound) {
  for (int i = 0; i < group.components; ++i) {
    const int t = group.row(k) + i;
    if (!std::isfinite(bound)) {
      add_column(unit(t), Vector(), -kInfinite, kInfinite);
      continue;
    }
    const int forward = add_column(unit(t), Vector(), 0, bound / root_[t]), backward = add_column(unit(t, -1), Vector(), 0, bound / root_[t]);
    if (group.components > 1) continue;
    const auto [ahead, back] = slip(t, backward, forward);
    pairs_.push_back({ahead, {forward}, true});
    pairs_.push_back({back, {backward}, true});
  }
}

/// x_t = q⁺ − q⁻; where q⁺ > 0 the column `against_ahead` is 0, where q⁻ > 0 `against_back`.
std::pair<int, int> PieceProgramme::slip(int t, int against_ahead, int against_back) {
  const int ahead = add_column(Vector(), unit(t), 0, kInfinite), back = add_column(Vector(), unit(t, -1), 0, kInfinite);
  pairs_.push_back({ahead, {against_ahead}});
  pairs_.push_back({back, {against_back}});
  return {ahead, back};
}

void PieceProgramme::assemble() {
  const Eigen::Index m = problem_.rows(), k = Q_.cols(), n = static_cast<Eigen::Index>(forces_.size());
  const DenseMatrix W = root_.asDiagonal() * condensed_.W() * root_.asDiagonal();
  A_ = DenseMatrix::Zero(m + k, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    if (forces_[j].size() > 0) A_.col(j).head(m) += W * forces_[j], A_.col(j).tail(k) = Q_.transpose() * forces_[j];
    if (displaces_[j].size() > 0) A_.col(j).head(m) += displaces_[j];
  }
  b_ = Vector(m + k);
  b_.head(m) = root_.cwiseProduct(condensed_.x0());
  if (k > 0) b_.tail(k) = R_.transpose().triangularView<Eigen::Lower>().solve(condensed_.e());
  for (Eigen::Index r = 0; r < m; ++r)
    if (!stated_[r]) A_.row(r).setZero(), b_[r] = 0;
  size_ = A_.colwise().norm().transpose();
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!(size_[j] > 0)) size_[j] = 1;
    A_.col(j) /= size_[j];
  }
  transposed_ = A_.transpose().sparseView();
}

}  // namespace dotyk::solver

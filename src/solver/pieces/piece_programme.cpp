#include "solver/pieces/piece_programme.hpp"

#include <numbers>

#include "algebra/dense/dense.hpp"
#include "problem/measure.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::FrictionPoint;
using problem::Problem;

constexpr int kDirections = 8;  // of the polygon around a disc
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of the right side, the greatest columns; that much more as springs of laws are softer than what a row sees. Columns without such bounds come to
/// rest anywhere, where nearly parallel ones cancel.
constexpr double kMostColumns = 1e4;

class ProgrammeBuilder : public PieceProgramme {
 public:
  ProgrammeBuilder(const Problem& problem, const CondensedProblem& condensed) : problem_(problem), condensed_(condensed), stated_(problem.rows(), 1) {
    root = problem::Measure(problem, condensed).stiffness().cwiseSqrt();
    Q_ = DenseMatrix(problem.rows(), 0);
    if (condensed.kernel_size() > 0) {
      auto factors = algebra::orthogonal_factors(root.asDiagonal() * condensed.N());
      Q_ = std::move(factors.Q), R = std::move(factors.R);
    }
    std::vector<char> rubs(problem.rows(), 0);
    for (const FrictionPoint& point : problem.friction_points()) add(point, rubs);
    for (const auto& [law, k, r] : problem.scalar_rows())
      if (!rubs[r]) add(law, k, r);
    for (Eigen::Index k = 0; k < Q_.cols(); ++k) motions.push_back(add_column(Vector(), -Q_.col(k), -kInfinite, kInfinite));
    assemble();
  }

  /// False where points of friction share a normal row.
  bool treatable() const { return treatable_; }

 private:
  /// A column of multipliers v = λ/√ρ, which displace √ρ x by `displaces` beside what W makes of them.
  int add_column(Vector v, Vector displaces, double low, double high) {
    forces.push_back(std::move(v));
    displaces_.push_back(std::move(displaces));
    low_.push_back(low);
    high_.push_back(high);
    return static_cast<int>(forces.size()) - 1;
  }

  Vector unit(int row, double value = 1) const { return value * Vector::Unit(problem_.rows(), row); }

  void add(const problem::Law& law, int index, int r) {
    const problem::Interval bounds = law.multipliers(index);
    const problem::Springs springs = *law.springs(index);
    const double up = bounds.high / root[r], down = -bounds.low / root[r], rho = root[r] * root[r];
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
      if (force >= 0) pairs.push_back({q, {force}, true});
      if (other >= 0) pairs.push_back({q, {other}});
    };
    beyond(1, up, above, below);
    beyond(-1, down, below, above);
    if (above >= 0 && below >= 0 && springs.above != springs.below) pairs.push_back({above, {below}});
  }

  void add(const FrictionPoint& point, std::vector<char>& rubs) {
    const double mu = point.group.law->bound_slope(point.k), bound = point.group.law->bound(point.k, 0);
    const int d = point.group.components;
    if (mu > 0) return add_cone(point.n, point.first, d, mu, rubs);
    if (bound > 0) add_given(point.first, d, bound);
    if (d > 1 || !(bound > 0)) std::fill_n(stated_.begin() + point.first, d, 0);
  }

  void add_cone(int n, int t, int components, double mu, std::vector<char>& rubs) {
    if (n < 0 || rubs[n]) {
      treatable_ = false;
      return;
    }
    rubs[n] = 1;
    std::vector<int> edges;
    const int gap = add_column(Vector(), unit(n, -1), 0, kInfinite);
    if (components == 1) {
      for (const double side : {mu, -mu}) edges.push_back(add_edge(n, {t}, {side}));
      slip(t, edges[1], edges[0]);
    } else {
      edges = add_polygon(n, t, mu);
    }
    pairs.push_back({gap, edges});
  }

  /// A column of forces along an edge of the friction cone: λ_n = √ρ_n, and tangential forces `tangent` times λ_n on `rows`.
  int add_edge(int n, const std::vector<int>& rows, const std::vector<double>& tangent) {
    Vector v = unit(n);
    for (std::size_t i = 0; i < rows.size(); ++i) v[rows[i]] = tangent[i] * root[n] / root[rows[i]];
    return add_column(std::move(v), Vector(), 0, kInfinite);
  }

  /// A polygon around the friction disc. Slip along one of its directions goes with forces of the neighbouring directions alone, in the ring between
  /// the disc's inner and outer polygon.
  std::vector<int> add_polygon(int n, int t, double mu) {
    std::vector<int> edges, slips;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections, c = std::cos(angle), s = std::sin(angle);
      for (const double radius : {mu / std::cos(std::numbers::pi / kDirections), mu}) edges.push_back(add_edge(n, {t, t + 1}, {radius * c, radius * s}));
      slips.push_back(add_column(Vector(), unit(t, c * root[t] / root[n]) + unit(t + 1, s * root[t + 1] / root[n]), 0, kInfinite));
    }
    for (int i = 0; i < kDirections; ++i) {
      std::vector<int> away;
      for (int j = 2; j <= kDirections - 2; ++j)
        for (const int k : {0, 1}) away.push_back(edges[2 * ((i + j) % kDirections) + k]);
      pairs.push_back({slips[i], away});
    }
    return edges;
  }

  void add_given(int first, int components, double bound) {
    for (int t = first; t < first + components; ++t) {
      if (!std::isfinite(bound)) {
        add_column(unit(t), Vector(), -kInfinite, kInfinite);
        continue;
      }
      const int forward = add_column(unit(t), Vector(), 0, bound / root[t]), backward = add_column(unit(t, -1), Vector(), 0, bound / root[t]);
      if (components > 1) continue;
      const auto [ahead, back] = slip(t, backward, forward);
      pairs.push_back({ahead, {forward}, true});
      pairs.push_back({back, {backward}, true});
    }
  }

  /// x_t = q⁺ − q⁻; where q⁺ > 0 the column `against_ahead` is 0, where q⁻ > 0 `against_back`.
  std::pair<int, int> slip(int t, int against_ahead, int against_back) {
    const int ahead = add_column(Vector(), unit(t), 0, kInfinite), back = add_column(Vector(), unit(t, -1), 0, kInfinite);
    pairs.push_back({ahead, {against_ahead}});
    pairs.push_back({back, {against_back}});
    return {ahead, back};
  }

  void assemble() {
    const Eigen::Index m = problem_.rows(), k = Q_.cols(), n = static_cast<Eigen::Index>(forces.size());
    const DenseMatrix W = root.asDiagonal() * condensed_.W() * root.asDiagonal();
    A = DenseMatrix::Zero(m + k, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      if (forces[j].size() > 0) A.col(j).head(m) += W * forces[j], A.col(j).tail(k) = Q_.transpose() * forces[j];
      if (displaces_[j].size() > 0) A.col(j).head(m) += displaces_[j];
    }
    b = Vector(m + k);
    b.head(m) = root.cwiseProduct(condensed_.x0());
    if (k > 0) b.tail(k) = R.transpose().triangularView<Eigen::Lower>().solve(condensed_.e());
    for (Eigen::Index r = 0; r < m; ++r)
      if (!stated_[r]) A.row(r).setZero(), b[r] = 0;
    size = A.colwise().norm().transpose();
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!(size[j] > 0)) size[j] = 1;
      A.col(j) /= size[j];
    }
    transposed = A.transpose().sparseView();
    const double most = kMostColumns * yields_ * b.norm();
    const auto scaled = [&](const std::vector<double>& bounds) { return Eigen::Map<const Vector>(bounds.data(), n).cwiseProduct(size); };
    low = scaled(low_).cwiseMax(-most);
    high = scaled(high_).cwiseMin(most);
  }

  const Problem& problem_;
  const CondensedProblem& condensed_;
  std::vector<char> stated_;       ///< rows whose equation is asked for
  DenseMatrix Q_;                  ///< of √ρ N = Q R
  std::vector<Vector> displaces_;  ///< by column; empty: none
  std::vector<double> low_, high_;
  double yields_ = 1;              ///< of springs against what a row sees, the greatest
  bool treatable_ = true;
};

}  // namespace

Vector PieceProgramme::lambda(const Vector& z) const {
  Vector v = Vector::Zero(root.size());
  for (std::size_t j = 0; j < forces.size(); ++j)
    if (forces[j].size() > 0) v += z[static_cast<Eigen::Index>(j)] / size[static_cast<Eigen::Index>(j)] * forces[j];
  return v.cwiseProduct(root);
}

Vector PieceProgramme::alpha(const Vector& z) const {
  const Vector a = z(motions).cwiseQuotient(size(motions));
  return a.size() > 0 ? Vector(R.triangularView<Eigen::Upper>().solve(a)) : a;
}

std::optional<PieceProgramme> piece_programme(const Problem& problem, const CondensedProblem& condensed) {
  const ProgrammeBuilder built(problem, condensed);
  return built.treatable() ? std::optional<PieceProgramme>(built) : std::nullopt;
}

}  // namespace dotyk::solver

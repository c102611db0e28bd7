#include "solver/piece_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "algebra/bounded_least_squares.hpp"
#include "algebra/cone_least_squares.hpp"
#include "algebra/dense.hpp"
#include "solver/natural_map.hpp"
#include "solver/treatable.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

constexpr int kMostRows = 80, kMostProgrammes = 8000;
constexpr int kDirections = 8;         // of the polygon around a disc
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSolved = 1e-9;       // of the right side: what is left where a programme has a point
constexpr double kAngle = 1e-12;       // of programmes
/// Of the right side, the greatest columns; that much more as springs of laws are softer than what a row sees. Columns without such bounds come to
/// rest anywhere, where nearly parallel ones cancel.
constexpr double kMostColumns = 1e4;
constexpr double kComplementary = 1e-8;

/// Column i is 0, or those of `others` are: at 0, or at their greatest values.
struct Pair {
  int column;
  std::vector<int> others;
  bool at_high = false;
};

/// A linear programme of equations A z = b, low ≤ z ≤ high, with pairs.
class Programme {
 public:
  Programme(const Problem& problem, const CondensedProblem& condensed)
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

  bool treatable() const { return treatable_; }
  const DenseMatrix& A() const { return A_; }
  const algebra::SparseRows& rows() const { return rows_; }  ///< Aᵀ
  const Vector& b() const { return b_; }
  const std::vector<Pair>& pairs() const { return pairs_; }
  Vector low() const { return bounds(low_).cwiseMax(-most()); }
  Vector high() const { return bounds(high_).cwiseMin(most()); }
  /// The greatest column that a solution may have.
  double most() const { return kMostColumns * yields_ * b_.norm(); }

  Vector lambda(const Vector& z) const {
    Vector v = Vector::Zero(problem_.rows());
    for (std::size_t j = 0; j < forces_.size(); ++j)
      if (forces_[j].size() > 0) v += z[static_cast<Eigen::Index>(j)] / size_[static_cast<Eigen::Index>(j)] * forces_[j];
    return v.cwiseProduct(root_);
  }
  Vector alpha(const Vector& z) const {
    Vector a(static_cast<Eigen::Index>(motions_.size()));
    for (std::size_t k = 0; k < motions_.size(); ++k) a[static_cast<Eigen::Index>(k)] = z[motions_[k]] / size_[motions_[k]];
    return a.size() > 0 ? Vector(R_.triangularView<Eigen::Upper>().solve(a)) : a;
  }

 private:
  /// A column of multipliers v = λ/√ρ, which displace √ρ x by `displaces` beside what W makes of them.
  int add_column(Vector v, Vector displaces, double low, double high) {
    forces_.push_back(std::move(v));
    displaces_.push_back(std::move(displaces));
    low_.push_back(low);
    high_.push_back(high);
    return static_cast<int>(forces_.size()) - 1;
  }
  Vector bounds(const std::vector<double>& of) const {
    return Eigen::Map<const Vector>(of.data(), static_cast<Eigen::Index>(of.size())).cwiseProduct(size_);
  }
  Vector unit(int row, double value = 1) const { return value * Vector::Unit(problem_.rows(), row); }

  void add(const problem::Law& law, int index, int r) {
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

  void add(const FrictionGroup& group, std::vector<char>& rubs) {
    for (int k = 0; k < group.points(); ++k) {
      const double mu = group.law->bound_slope(k), bound = group.law->bound(k, 0);
      if (mu > 0) add_cone(group, k, mu, rubs);
      else if (bound > 0) add_given(group, k, bound);
      if (!(mu > 0) && (group.components > 1 || !(bound > 0)))
        for (int i = 0; i < group.components; ++i) stated_[group.row(k) + i] = 0;
    }
  }

  void add_cone(const FrictionGroup& group, int k, double mu, std::vector<char>& rubs) {
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

  /// λ_n = √ρ_n, λ_t = `tangent` λ_n.
  int add_edge(int n, const std::vector<int>& rows, const std::vector<double>& tangent) {
    Vector v = unit(n);
    for (std::size_t i = 0; i < rows.size(); ++i) v[rows[i]] = tangent[i] * root_[n] / root_[rows[i]];
    return add_column(std::move(v), Vector(), 0, kInfinite);
  }

  /// Forces in a polygon around the disc, and slip along a direction only with forces near it, of the polygon's ring from within to around the disc.
  std::vector<int> add_polygon(int n, int t, double mu) {
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

  void add_given(const FrictionGroup& group, int k, double bound) {
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
  std::pair<int, int> slip(int t, int against_ahead, int against_back) {
    const int ahead = add_column(Vector(), unit(t), 0, kInfinite), back = add_column(Vector(), unit(t, -1), 0, kInfinite);
    pairs_.push_back({ahead, {against_ahead}});
    pairs_.push_back({back, {against_back}});
    return {ahead, back};
  }

  void assemble() {
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
    rows_ = A_.transpose().sparseView();
  }

  const Problem& problem_;
  const CondensedProblem& condensed_;
  const Vector root_;          ///< √ρ: v = λ/√ρ and √ρ x are in one unit
  std::vector<char> stated_;   ///< rows whose equation is asked for
  DenseMatrix Q_, R_;          ///< of √ρ N
  std::vector<Vector> forces_, displaces_;  ///< by column; empty: none
  std::vector<double> low_, high_;
  std::vector<int> motions_;
  std::vector<Pair> pairs_;
  double yields_ = 1;  ///< of springs against what a row sees, the greatest
  bool treatable_ = true;
  DenseMatrix A_;
  algebra::SparseRows rows_;
  Vector b_, size_;
};

/// Depth first; a node is a choice of bounds of the columns, its programme begun at its parent's point.
class DepthFirstSearch {
 public:
  DepthFirstSearch(const Programme& programme, const Attempt& attempt, Monitor& monitor) : on_(programme), attempt_(attempt), monitor_(monitor) {}

  PieceSearch run() {
    const bool all = visit(on_.low(), on_.high(), Vector());
    if (all) out_.verdict = PieceSearch::Verdict::none;
    else if (out_.verdict == PieceSearch::Verdict::undecided && out_.lambda.size() > 0) out_.verdict = PieceSearch::Verdict::near;
    return std::move(out_);
  }

 private:
  enum class End { point, excluded, unknown };
  End programme(const Vector& low, const Vector& high, const Vector& start, algebra::BoundedLeastSquares& point) const {
    try {
      point = algebra::bounded_least_squares(on_.A(), on_.b(), low, high, kAngle, start);
    } catch (const std::runtime_error&) {  // its active sets repeat
      auto fitted = algebra::cone_least_squares(on_.rows(), on_.b(), {{low.begin(), low.end()}, {high.begin(), high.end()}, {}}, 0.1 * kSolved);
      point.x = std::move(fitted.x);
      point.residual = on_.b() - on_.A() * point.x;
    }
    if (excluded(point, low, high)) return End::excluded;
    return point.residual.norm() <= kSolved * on_.b().norm() ? End::point : End::unknown;
  }

  /// True where these bounds are excluded; false where a solution is found, or nothing can be said of some of them: others may hold one.
  bool visit(const Vector& low, const Vector& high, const Vector& start) {
    if (out_.programmes >= kMostProgrammes || monitor_.stop()) return false;
    ++out_.programmes;
    algebra::BoundedLeastSquares point;
    End end = programme(low, high, start, point);
    if (end == End::unknown && start.size() > 0) end = programme(low, high, Vector(), point);
    if (end == End::excluded) return true;
    const Pair* worst = broken(point.x, high);
    Vector lambda = on_.lambda(point.x), alpha = on_.alpha(point.x);
    if (!worst && end == End::point && out_.lambda.size() == 0) out_.lambda = lambda, out_.alpha = alpha;  // near a solution
    const bool found = attempt_(lambda, alpha);
    if (found) out_.verdict = PieceSearch::Verdict::found, out_.lambda = std::move(lambda), out_.alpha = std::move(alpha);
    if (found || !worst) return false;
    Vector closed = high, low_of_others = low, high_of_others = high;
    closed[worst->column] = 0;
    for (const int j : worst->others) (worst->at_high ? low_of_others[j] : high_of_others[j]) = worst->at_high ? high[j] : 0;
    const bool none = visit(low, closed, point.x);
    if (out_.verdict != PieceSearch::Verdict::undecided) return false;
    return visit(low_of_others, high_of_others, point.x) && none;
  }

  /// Does what is left prove that the programme has no point? Farkas: rᵀ(b − A z) is above zero at all z within the bounds.
  bool excluded(const algebra::BoundedLeastSquares& point, const Vector& low, const Vector& high) const {
    const double left = point.residual.norm();
    if (!(left > kSolved * on_.b().norm())) return false;
    const Vector along = on_.A().transpose() * point.residual / left;
    double reach = 0;
    for (Eigen::Index j = 0; j < along.size(); ++j) reach += along[j] * ((along[j] > 0 ? high[j] : low[j]) - point.x[j]);
    return reach < 0.5 * left;
  }

  const Pair* broken(const Vector& z, const Vector& high) const {
    const Pair* worst = nullptr;
    double most = kComplementary * z.norm();
    for (const Pair& pair : on_.pairs()) {
      double off = 0;
      for (const int j : pair.others) off += pair.at_high ? high[j] - z[j] : z[j];
      if (const double both = std::min(z[pair.column], off); both > most) most = both, worst = &pair;
    }
    return worst;
  }

  const Programme& on_;
  const Attempt& attempt_;
  Monitor& monitor_;
  PieceSearch out_;
};

}  // namespace

PieceSearch search_pieces(const Problem& problem, const CondensedProblem& condensed, const Attempt& attempt, Monitor& monitor) {
  if (problem.rows() == 0 || problem.rows() > kMostRows || !tells_springs(problem)) return {};
  const Programme programme(problem, condensed);
  return programme.treatable() ? DepthFirstSearch(programme, attempt, monitor).run() : PieceSearch{};
}

}  // namespace dotyk::solver

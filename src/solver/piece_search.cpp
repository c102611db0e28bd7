#include "solver/piece_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
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

constexpr int kMostRows = 80, kMostProgrammes = 4000;
constexpr std::size_t kProbed = 3;     // pairs of a point
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

/// Depth first; a node is a choice of bounds of the columns, its programme begun at its parent's point. Where bounds are excluded, the pairs
/// whose choices the proof needs are known: a choice that it does not need is not tried the other way (conflict-directed backjumping, Prosser 1993).
class DepthFirstSearch {
 public:
  DepthFirstSearch(const Programme& programme, const Attempt& attempt, Monitor& monitor)
      : on_(programme), attempt_(attempt), monitor_(monitor), low_(on_.low()), high_(on_.high()) {}

  PieceSearch run() {
    const std::optional<Pairs> conflict = visit(solved({low_, high_, std::vector<int>(low_.size(), -1)}, Vector()));
    if (conflict) out_.verdict = PieceSearch::Verdict::none;
    else if (out_.verdict == PieceSearch::Verdict::undecided && out_.lambda.size() > 0) out_.verdict = PieceSearch::Verdict::near;
    return std::move(out_);
  }

 private:
  using Pairs = std::set<int>;
  enum class End { point, excluded, unknown };

  /// Bounds, and the point of their programme.
  struct Node {
    Vector low, high;
    std::vector<int> chosen;  ///< by column: the pair whose choice made its bounds; -1: none
    algebra::BoundedLeastSquares point{};
    End end = End::unknown;
    Pairs conflict{};         ///< the pairs whose choices exclude it
  };

  bool over() const { return out_.verdict != PieceSearch::Verdict::undecided || out_.programmes >= kMostProgrammes || monitor_.stop(); }

  Node solved(Node node, const Vector& start) {
    ++out_.programmes;
    solve(node, start);
    if (node.end == End::unknown && start.size() > 0) solve(node, Vector());
    return node;
  }

  void solve(Node& node, const Vector& start) const {
    try {
      node.point = algebra::bounded_least_squares(on_.A(), on_.b(), node.low, node.high, kAngle, start);
    } catch (const std::runtime_error&) {  // its active sets repeat
      auto fitted = algebra::cone_least_squares(on_.rows(), on_.b(), {{node.low.begin(), node.low.end()}, {node.high.begin(), node.high.end()}, {}}, 0.1 * kSolved);
      node.point.x = std::move(fitted.x);
      node.point.residual = on_.b() - on_.A() * node.point.x;
    }
    node.end = excluded(node) ? End::excluded : node.point.residual.norm() <= kSolved * on_.b().norm() ? End::point : End::unknown;
  }

  Node with_column_zero(const Node& of, int pair) {
    Node node{of.low, of.high, of.chosen};
    bind(node, on_.pairs()[pair].column, pair, false);
    return solved(std::move(node), of.point.x);
  }

  Node with_others_at_bounds(const Node& of, int pair) {
    Node node{of.low, of.high, of.chosen};
    for (const int j : on_.pairs()[pair].others) bind(node, j, pair, on_.pairs()[pair].at_high);
    return solved(std::move(node), of.point.x);
  }

  /// The column is 0, or at its greatest value.
  static void bind(Node& node, int column, int pair, bool at_high) {
    if (at_high) node.low[column] = node.high[column];
    else node.high[column] = 0;
    if (node.chosen[column] < 0) node.chosen[column] = pair;
  }

  /// The pairs whose choices exclude the node; nothing where a solution is found, or nothing can be said of some of its choices: they may hold one.
  /// Of the pairs that are broken most one is looked for that leaves one choice only.
  std::optional<Pairs> visit(Node node) {
    std::vector<std::pair<int, Pairs>> forced;  // pairs, and why they have one choice
    while (node.end != End::excluded) {
      const std::vector<int> worst = broken(node);
      if (over() || taken(node, worst.empty()) || worst.empty()) return std::nullopt;
      std::optional<Node> only, first, second;
      for (const int pair : worst) {
        Node closed = with_column_zero(node, pair), open = with_others_at_bounds(node, pair);
        if (closed.end == End::excluded || open.end == End::excluded) {
          const bool first_out = closed.end == End::excluded;
          forced.push_back({pair, first_out ? std::move(closed.conflict) : std::move(open.conflict)});
          only = first_out ? std::move(open) : std::move(closed);
          break;
        }
        if (!first) first = std::move(closed), second = std::move(open);
      }
      if (!only) {
        const int pair = worst.front();
        std::optional<Pairs> one = visit(std::move(*first));
        if (one && one->count(pair) == 0) {
          node.conflict = std::move(*one);
          break;
        }
        if (over()) return std::nullopt;
        const std::optional<Pairs> other = visit(std::move(*second));
        if (!one || !other) return std::nullopt;
        node.conflict = *other;
        if (other->count(pair)) resolve(node.conflict, pair, *one);
        break;
      }
      node = std::move(*only);
    }
    for (auto it = forced.rbegin(); it != forced.rend(); ++it)
      if (node.conflict.count(it->first)) resolve(node.conflict, it->first, it->second);
    return std::move(node.conflict);
  }

  /// One choice of the pair is excluded by `conflict`, the other one by `other`: neither is possible.
  static void resolve(Pairs& conflict, int pair, const Pairs& other) {
    conflict.insert(other.begin(), other.end());
    conflict.erase(pair);
  }

  /// Is a solution found from the node's point? At an `end` of the search it is near one at least.
  bool taken(const Node& node, bool end) {
    Vector lambda = on_.lambda(node.point.x), alpha = on_.alpha(node.point.x);
    if (end && node.end == End::point && out_.lambda.size() == 0) out_.lambda = lambda, out_.alpha = alpha;
    if (!attempt_(lambda, alpha)) return false;
    out_.verdict = PieceSearch::Verdict::found, out_.lambda = std::move(lambda), out_.alpha = std::move(alpha);
    return true;
  }

  /// Does what is left prove that the programme has no point? Farkas: rᵀ(b − A z) is above zero at all z within the bounds.
  bool excluded(Node& node) const {
    const double left = node.point.residual.norm();
    if (!(left > kSolved * on_.b().norm())) return false;
    const Vector along = on_.A().transpose() * node.point.residual / left;
    double reach = 0;
    std::map<int, double> wider;  // what the proof would lose without the choice of a pair
    for (Eigen::Index j = 0; j < along.size(); ++j) {
      const double bound = along[j] > 0 ? node.high[j] : node.low[j];
      reach += along[j] * (bound - node.point.x[j]);
      if (node.chosen[j] >= 0) wider[node.chosen[j]] += along[j] * ((along[j] > 0 ? high_[j] : low_[j]) - bound);
    }
    if (!(reach < 0.5 * left)) return false;
    for (const auto& [pair, more] : wider) {
      if (reach + more < 0.5 * left) reach += more;
      else node.conflict.insert(pair);
    }
    return true;
  }

  /// The pairs of whose columns neither is at its bound, those with the greatest products.
  std::vector<int> broken(const Node& node) const {
    const Vector& z = node.point.x;
    std::vector<std::pair<double, int>> all;
    for (std::size_t i = 0; i < on_.pairs().size(); ++i) {
      const Pair& pair = on_.pairs()[i];
      double off = 0;
      for (const int j : pair.others) off += pair.at_high ? node.high[j] - z[j] : z[j];
      if (std::min(z[pair.column], off) > kComplementary * z.norm()) all.push_back({-z[pair.column] * off, static_cast<int>(i)});
    }
    std::sort(all.begin(), all.end());
    if (all.size() > kProbed) all.resize(kProbed);
    std::vector<int> worst;
    for (const auto& one : all) worst.push_back(one.second);
    return worst;
  }

  const Programme& on_;
  const Attempt& attempt_;
  Monitor& monitor_;
  const Vector low_, high_;
  PieceSearch out_;
};

}  // namespace

PieceSearch search_pieces(const Problem& problem, const CondensedProblem& condensed, const Attempt& attempt, Monitor& monitor) {
  if (problem.rows() == 0 || problem.rows() > kMostRows || !tells_springs(problem)) return {};
  const Programme programme(problem, condensed);
  return programme.treatable() ? DepthFirstSearch(programme, attempt, monitor).run() : PieceSearch{};
}

}  // namespace dotyk::solver

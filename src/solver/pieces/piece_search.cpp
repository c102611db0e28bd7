#include "solver/pieces/piece_search.hpp"

#include <set>

#include "algebra/dense/bounded_least_squares.hpp"
#include "algebra/dense/cone_least_squares.hpp"
#include "solver/pieces/piece_programme.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;
using Pair = PieceProgramme::Pair;

constexpr int kMostRows = 80;
/// Of all programmes, in numbers of their matrix that least-squares steps look at: some seconds.
constexpr double kMostWork = 6e9;
constexpr std::size_t kProbed = 3;     // broken pairs of a node that are tried for one with a single choice
constexpr double kSolved = 1e-9;       // residual of a feasible point, relative to the right side
constexpr double kAngle = 1e-12;       // tolerance of bounded_least_squares()
constexpr double kComplementary = 1e-8;  // a column this small, relative to the point, is 0

/// Depth-first branch and bound over the pairs. A node is a set of column bounds; its programme starts from its parent's point. If the programme
/// has no feasible point, the proof tells which choices it needs. A choice that it does not need is not tried the other way (conflict-directed
/// backjumping, Prosser 1993).
class DepthFirstSearch {
 public:
  DepthFirstSearch(const PieceProgramme& programme, const Attempt& attempt, Monitor& monitor)
      : on_(programme), attempt_(attempt), monitor_(monitor) {}

  PieceSearch run() {
    const std::optional<Pairs> conflict = visit(solved({on_.low, on_.high, std::vector<int>(on_.low.size(), -1)}, Vector()));
    if (conflict) out_.verdict = PieceSearch::Verdict::none;
    else if (out_.verdict == PieceSearch::Verdict::undecided && out_.lambda.size() > 0) out_.verdict = PieceSearch::Verdict::near;
    out_.given_up = !conflict && work_ >= kMostWork;
    return std::move(out_);
  }

 private:
  using Pairs = std::set<int>;
  enum class End { point, excluded, unknown };

  /// Column bounds, and the point of their programme.
  struct Node {
    Vector low, high;
    std::vector<int> chosen;  ///< by column: the pair whose choice made its bounds; -1: none
    algebra::BoundedLeastSquares point{};
    End end = End::unknown;
    Pairs conflict{};         ///< the pairs whose choices exclude it
  };

  bool over() const { return out_.verdict != PieceSearch::Verdict::undecided || work_ >= kMostWork || monitor_.stop(); }

  Node solved(Node node, const Vector& start) {
    ++out_.programmes;
    solve(node, start);
    if (node.end == End::unknown && start.size() > 0) solve(node, Vector());
    return node;
  }

  void solve(Node& node, const Vector& start) {
    double steps = 20.0 * static_cast<double>(on_.A.cols());
    try {
      node.point = algebra::bounded_least_squares(on_.A, on_.b, node.low, node.high, kAngle, start);
      steps = node.point.steps;
    } catch (const std::runtime_error&) {  // its active sets repeat
      auto fitted = algebra::cone_least_squares(on_.transposed, on_.b, {{node.low.begin(), node.low.end()}, {node.high.begin(), node.high.end()}, {}}, 0.1 * kSolved);
      node.point.x = std::move(fitted.x);
      node.point.residual = on_.b - on_.A * node.point.x;
    }
    work_ += (steps + static_cast<double>(on_.A.rows())) * static_cast<double>(on_.A.size());
    node.end = excluded(node) ? End::excluded : node.point.residual.norm() <= kSolved * on_.b.norm() ? End::point : End::unknown;
  }

  /// One choice of the pair: its column or its others fixed at 0 or, with `at_high`, at their upper bounds.
  Node with(const Node& of, int pair, const std::vector<int>& columns, bool at_high) {
    Node node{of.low, of.high, of.chosen};
    for (const int j : columns) {
      if (at_high) node.low[j] = node.high[j];
      else node.high[j] = 0;
      if (node.chosen[j] < 0) node.chosen[j] = pair;
    }
    return solved(std::move(node), of.point.x);
  }

  /// Explores a node. Returns the pairs whose choices exclude it; nothing if a solution is found, or if parts of it stay undecided. Among the
  /// pairs that are broken most, one with a single possible choice is preferred.
  std::optional<Pairs> visit(Node node) {
    std::vector<std::pair<int, Pairs>> forced;  // pairs, and why they have one choice
    while (node.end != End::excluded) {
      const std::vector<int> worst = broken(node);
      if (over() || taken(node, worst.empty()) || worst.empty()) return std::nullopt;
      std::optional<Node> only, first, second;
      for (const int pair : worst) {
        const auto& [column, others, at_high] = on_.pairs[pair];
        Node closed = with(node, pair, {column}, false), open = with(node, pair, others, at_high);
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

  /// Does the residual r prove that the programme has no feasible point? By Farkas' lemma it does if rᵀ(b − A z) > 0 for all z within the bounds.
  bool excluded(Node& node) const {
    const double left = node.point.residual.norm();
    if (!(left > kSolved * on_.b.norm())) return false;
    const Vector along = on_.A.transpose() * node.point.residual / left;
    double reach = 0;
    std::map<int, double> wider;  // by pair: how much `reach` would grow without its choice
    for (Eigen::Index j = 0; j < along.size(); ++j) {
      const double bound = along[j] > 0 ? node.high[j] : node.low[j];
      reach += along[j] * (bound - node.point.x[j]);
      if (node.chosen[j] >= 0) wider[node.chosen[j]] += along[j] * ((along[j] > 0 ? on_.high[j] : on_.low[j]) - bound);
    }
    if (!(reach < 0.5 * left)) return false;
    for (const auto& [pair, more] : wider) {
      if (reach + more < 0.5 * left) reach += more;
      else node.conflict.insert(pair);
    }
    return true;
  }

  /// The broken pairs with the greatest products: neither `column` nor `others` are at their bounds.
  std::vector<int> broken(const Node& node) const {
    const Vector& z = node.point.x;
    std::vector<std::pair<double, int>> all;
    for (std::size_t i = 0; i < on_.pairs.size(); ++i) {
      const Pair& pair = on_.pairs[i];
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

  const PieceProgramme& on_;
  const Attempt& attempt_;
  Monitor& monitor_;
  double work_ = 0;
  PieceSearch out_;
};

}  // namespace

PieceSearch search_pieces(const Problem& problem, const CondensedProblem& condensed, const Attempt& attempt, Monitor& monitor) {
  if (problem.rows() == 0 || problem.rows() > kMostRows || !tells_springs(problem)) return {};
  const auto programme = piece_programme(problem, condensed);
  return programme ? DepthFirstSearch(*programme, attempt, monitor).run() : PieceSearch{};
}

}  // namespace dotyk::solver

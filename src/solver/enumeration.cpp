#include "solver/enumeration.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "solver/natural_map.hpp"
#include "solver/require_solvable.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

constexpr long kMostCombinations = 1L << 20;
constexpr double kRelative = 1e-9;  ///< what counts as rounding in multipliers and jumps

/// A row or two whose pieces are chosen together.
struct Choice {
  int row = -1;            ///< of contact
  int tangent = -1;        ///< of friction
  int pieces = 2;          ///< open, closed; stick, forward, backward; open, stick, forward, backward
  double bound = 0;        ///< of given friction
  double coefficient = 0;  ///< ∂b/∂λ_n
};

void add_friction(const FrictionGroup& group, std::vector<Choice>& choices, const std::vector<int>& choice_of) {
  const auto refuse = [&](const char* why) {
    throw InputError(text("enumeration cannot treat ", group.name, ": ", why,
                          "; newton from several starts can (seed = 1, 2, …)"));
  };
  if (group.components != 1) refuse("in space slip has not finitely many pieces");
  for (int k = 0; k < group.points(); ++k) {
    const double slope = group.law->bound_slope(k), bound = group.law->bound(k, 0);
    if (slope == 0) {
      if (bound > 0) choices.push_back({.tangent = group.row(k), .pieces = 3, .bound = bound});
      continue;
    }
    const int at = choice_of[group.normal[k]];
    if (at < 0 || choices[at].tangent >= 0) refuse("its normal rows are not contact rows of one point each");
    choices[at].tangent = group.row(k);
    choices[at].coefficient = slope;
    choices[at].pieces = 4;
  }
}

std::vector<Choice> choices_of(const Problem& problem) {
  std::vector<Choice> choices;
  std::vector<int> choice_of(problem.rows(), -1);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r) {
      choice_of[r] = static_cast<int>(choices.size());
      choices.push_back({.row = r});
    }
  for (const RowGroup& group : problem.groups)
    if (group.count > 0 && !group.law->unilateral() && !group.law->linear_stiffness(0))
      throw InputError(text("enumeration cannot treat the ", group.law->name(), " law of the ", group.name, "; pdas can"));
  for (const FrictionGroup& group : problem.friction) add_friction(group, choices, choice_of);
  double combinations = 1;
  for (const Choice& choice : choices) combinations *= choice.pieces;
  if (combinations > kMostCombinations)
    throw InputError(text("enumeration would try ", combinations, " combinations of the pieces of ", choices.size(),
                          " contact and friction points; it takes up to ", kMostCombinations));
  return choices;
}

class Search {
 public:
  Search(const Problem& problem, const CondensedProblem& condensed, Monitor& monitor)
      : problem_(problem), condensed_(condensed), monitor_(monitor), choices_(choices_of(problem)),
        map_(problem, condensed, stiffness_of_rows(condensed)), pieces_(problem.rows(), Piece::closed) {
    for (const FrictionGroup& group : problem.friction)
      for (int k = 0; k < group.points(); ++k) pieces_[group.row(k)] = Piece::open;  // without friction
    // Rows of one piece are linear: what the map is anywhere.
    base_ = map_.sticking(std::vector<char>(problem.rows(), 0));
  }

  Enumeration run() {
    std::vector<int> digit(choices_.size(), 0);
    do {
      if (++out_.tried % 1024 == 0 && monitor_.stop()) {
        out_.complete = false;
        break;
      }
      try_pieces(digit);
    } while (advance(digit));
    finish();
    return std::move(out_);
  }

 private:
  bool advance(std::vector<int>& digit) const {
    for (std::size_t k = digit.size(); k-- > 0;) {
      if (++digit[k] < choices_[k].pieces) return true;
      digit[k] = 0;
    }
    return false;
  }

  /// The map on these pieces, as it is linearised.
  NaturalMap::Value value(const std::vector<int>& digit) {
    NaturalMap::Value v = base_;
    const auto close = [&](int row) { v.slope.emplace_back(row, row, 1.0); };
    for (std::size_t k = 0; k < choices_.size(); ++k) {
      const Choice& c = choices_[k];
      const Piece piece = static_cast<Piece>(c.pieces == 3 ? digit[k] + 1 : digit[k]);
      if (c.row >= 0) {
        pieces_[c.row] = piece == Piece::open ? Piece::open : Piece::closed;
        if (piece != Piece::open) close(c.row);
      }
      if (c.tangent < 0) continue;
      pieces_[c.tangent] = piece;
      const double side = piece == Piece::forward ? 1 : -1;
      if (piece == Piece::closed)
        close(c.tangent);
      else if (piece != Piece::open && c.row >= 0)
        v.slope.emplace_back(c.tangent, c.row, side * c.coefficient);
      else if (piece != Piece::open)
        v.projected[c.tangent] = side * c.bound;
    }
    return v;
  }

  void try_pieces(const std::vector<int>& digit) {
    const NaturalMap::System system = map_.linearise(value(digit));
    Vector solved(0);
    bool singular = false;
    if (system.matrix.size() > 0) {
      Eigen::FullPivLU<DenseMatrix> lu(system.matrix);
      lu.setThreshold(1e-12);
      solved = lu.solve(system.right_side);
      singular = !lu.isInvertible();
      const double size = system.right_side.norm() + system.matrix.norm() * solved.norm();
      if (singular && (system.matrix * solved - system.right_side).norm() > kRelative * size) return;
    }
    out_.undecided += singular;
    Vector lambda, alpha;
    map_.take(system, solved, lambda, alpha);
    if (lambda.allFinite()) add(lambda, alpha);
  }

  void add(const Vector& lambda, const Vector& alpha) {
    const NaturalMap::Value v = map_.at(lambda, alpha);
    const double size = lambda.norm() + v.y.norm();
    if (!(v.norm <= kRelative * size)) return;
    // Without force friction may point to either side, but a piece is slip to its own side.
    for (std::size_t r = 0; r < pieces_.size(); ++r) {
      const double side = pieces_[r] == Piece::forward ? 1 : pieces_[r] == Piece::backward ? -1 : 0;
      if (side * (v.y[r] - lambda[r]) < -kRelative * size) return;
    }
    for (std::size_t k = 0; k < found_.size(); ++k)
      if ((found_[k].lambda - lambda).norm() + (found_[k].y - v.y).norm() <= 1e-6 * size) {
        out_.solutions[k].pieces.push_back(pieces_);
        return;
      }
    Enumeration::Solution solution;
    Result& result = solution.result;
    result.state = {condensed_.recover(lambda, alpha), lambda};
    result.converged = true;
    result.method = "enumeration";
    result.active_sets = {v.closed};
    result.slipping = v.slipping;
    solution.pieces = {pieces_};
    out_.solutions.push_back(std::move(solution));
    found_.push_back({lambda, v.y});
  }

  void finish() {
    const std::string summary = out_.summary();
    for (std::size_t k = 0; k < out_.solutions.size(); ++k)
      out_.solutions[k].result.reason = text("number ", k + 1, " of ", summary);
  }

  struct Found {
    Vector lambda, y;
  };
  const Problem& problem_;
  const CondensedProblem& condensed_;
  Monitor& monitor_;
  const std::vector<Choice> choices_;
  const NaturalMap map_;
  NaturalMap::Value base_;
  std::vector<Piece> pieces_;
  std::vector<Found> found_;
  Enumeration out_;
};

}  // namespace

std::string Enumeration::summary() const {
  std::string out = text(solutions.size(), solutions.size() == 1 ? " solution; " : " solutions; ",
                         complete ? "all " : "interrupted after ", tried, " combinations of pieces tried");
  if (undecided > 0)
    out += text("; ", undecided, " of them singular: solutions there are not isolated, and some may be missing");
  return out;
}

Enumeration enumerate(const Problem& problem, Monitor& monitor) {
  const problem::RigidMotions rigid = problem::rigid_motions(problem);
  require_solvable(problem, rigid);
  problem::Clock clock;
  const CondensedProblem condensed(problem, rigid, algebra::Ordering::automatic, clock, monitor);
  Enumeration all = Search(problem, condensed, monitor).run();
  for (Enumeration::Solution& solution : all.solutions) {
    solution.result.clock = clock;
    solution.result.ordering = condensed.ordering();
    solution.result.factor_bytes = condensed.factor_bytes();
  }
  return all;
}

}  // namespace dotyk::solver

#include "solver/pieces/enumeration.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "algebra/dense/polyhedron.hpp"
#include "problem/measure.hpp"
#include "solver/rows/natural_map.hpp"
#include "solver/core/require_solvable.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;

constexpr double kRelative = 1e-9;  ///< what counts as rounding in multipliers and jumps
constexpr double kSingularPivot = 1e-11; ///< pivots below this part of the greatest are rounding
constexpr double kNothing = 1e-13;  ///< of a family's size: rounding in its ends
constexpr long kMostCombinations = 1L << 20;

/// A row or two whose pieces are chosen together.
struct Choice {
  int row = -1;            ///< of contact
  int tangent = -1;        ///< of friction
  int pieces = 2;          ///< open, closed; stick, forward, backward; open, stick, forward, backward
  double bound = 0;        ///< of given friction
  double coefficient = 0;  ///< ∂b/∂λ_n
};

/// Of unilateral rows, alone or with the friction of the same point, and of given friction in the plane.
std::vector<Choice> choices_of(const Problem& problem) {
  std::vector<Choice> choices;
  std::vector<int> choice_of(problem.rows(), -1);
  for (const auto& [law, k, r] : problem.scalar_rows()) {
    if (!law.unilateral()) continue;
    choice_of[r] = static_cast<int>(choices.size());
    choices.push_back({.row = r});
  }
  for (const problem::RowGroup& group : problem.groups)
    if (group.count > 0 && !group.law->unilateral() && !group.law->linear_stiffness(0))
      throw InputError(text("enumeration cannot treat the ", group.law->name(), " law of the ", group.name, group.law->springs(0) ? "; pdas can" : "; newton can"));
  for (const auto& [group, k, first, n] : problem.friction_points()) {
    const auto refuse = [&, &name = group.name](const char* why) {
      throw InputError(text("enumeration cannot treat ", name, ": ", why, "; newton from several starts can (seed = 1, 2, …)"));
    };
    if (group.components != 1) refuse("in space slip has not finitely many pieces");
    const double slope = group.law->bound_slope(k), bound = group.law->bound(k, 0);
    if (slope > 0) {
      const int at = choice_of[n];
      if (at < 0 || choices[at].tangent >= 0) refuse("its normal rows are not contact rows of one point each");
      choices[at].tangent = first, choices[at].coefficient = slope, choices[at].pieces = 4;
    } else if (bound > 0) {
      choices.push_back({.tangent = first, .pieces = 3, .bound = bound});
    }
  }
  double combinations = 1;
  for (const Choice& choice : choices) combinations *= choice.pieces;
  if (combinations > kMostCombinations)
    throw InputError(text("enumeration would try ", combinations, " combinations of the pieces of ", choices.size(),
                          " contact and friction points; it takes up to ", kMostCombinations));
  return choices;
}

class BranchSearch {
 public:
  BranchSearch(const Problem& problem, const CondensedProblem& condensed, const problem::Clock& clock, Monitor& monitor)
      : problem_(problem), condensed_(condensed), clock_(clock), monitor_(monitor), choices_(choices_of(problem)),
        map_(problem, condensed, problem::Measure(problem, condensed).stiffness()), pieces_(problem.rows(), RowPiece::closed) {
    for (const auto& point : problem.friction_points()) pieces_[point.first] = RowPiece::open;  // without friction
    // Rows of one piece are linear: what the map is anywhere.
    base_ = map_.sticking(std::vector<char>(problem.rows(), 0));
    scale_ = size(join({Vector::Zero(problem.rows()), Vector::Zero(condensed.kernel_size())}));
  }

  Enumeration run() {
    long combinations = 1;
    for (const Choice& c : choices_) combinations *= c.pieces;
    for (long i = 0; i < combinations && out_.complete; ++i) {
      if (++out_.tried % 1024 == 0 && monitor_.stop()) out_.complete = false;
      else try_pieces(i);
    }
    finish();
    return std::move(out_);
  }

 private:
  /// The map on one combination of pieces, as it is linearised. The last choice's pieces change first.
  NaturalMap::Value value(long combination) {
    NaturalMap::Value v = base_;
    const auto close = [&](int row) { v.slope.emplace_back(row, row, 1.0); };
    for (std::size_t k = choices_.size(); k-- > 0;) {
      const Choice& c = choices_[k];
      const RowPiece piece = static_cast<RowPiece>(combination % c.pieces + (c.pieces == 3));
      combination /= c.pieces;
      if (c.row >= 0) {
        pieces_[c.row] = piece == RowPiece::open ? RowPiece::open : RowPiece::closed;
        if (piece != RowPiece::open) close(c.row);
      }
      if (c.tangent < 0) continue;
      pieces_[c.tangent] = piece;
      const double side = piece == RowPiece::forward ? 1 : -1;
      if (piece == RowPiece::closed)
        close(c.tangent);
      else if (piece != RowPiece::open && c.row >= 0)
        v.slope.emplace_back(c.tangent, c.row, side * c.coefficient);
      else if (piece != RowPiece::open)
        v.projected[c.tangent] = side * c.bound;
    }
    return v;
  }

  void try_pieces(long combination) {
    const NaturalMap::System system = map_.linearise(value(combination));
    Vector solved(0);
    if (system.matrix.size() > 0) {
      const algebra::PivotedLu lu(system.matrix, kSingularPivot);
      solved = lu.solve(system.right_side);
      if (!lu.regular()) {
        ++out_.singular;
        const double size = system.right_side.norm() + system.matrix.norm() * solved.norm() + scale_;
        if ((system.matrix * solved - system.right_side).norm() <= kRelative * size) add_family(system, solved, lu.kernel());
        return;
      }
    }
    const Iterate at = map_.take(system, solved);
    if (at.lambda.allFinite()) add(at);
  }

  /// Of all that the singular system allows, what the signs and bounds of the pieces leave.
  void add_family(const NaturalMap::System& system, const Vector& solved, const DenseMatrix& kernel) {
    const DenseMatrix Z = algebra::orthonormal(kernel);
    const Vector least = solved - Z * (Z.transpose() * solved);
    Members members;
    members.pieces = pieces_;
    const Vector origin = members.origin = join(map_.take(system, least));
    if (const double greatest = std::max(size(origin), scale_); greatest > 0) members.size = greatest;
    members.directions = DenseMatrix(origin.size(), Z.cols());
    for (Eigen::Index k = 0; k < Z.cols(); ++k)  // steps of the origin's size, so that their difference keeps its digits
      members.directions.col(k) = (join(map_.take(system, least + members.size * Z.col(k))) - origin) / members.size;
    members.inequalities(*this);
    members.set = algebra::polyhedron(members.A, members.b, kRelative);
    const int dimension = members.set.dimension(kRelative);
    if (dimension == 0) add(split(members.at(members.set.vertices.col(0))));
    if (dimension > 0) found_families_.push_back(std::move(members));
  }

  /// (v, x̃, a) in one unit, the root of an energy: scaled multipliers, jumps and motions.
  Vector join(const Iterate& at) const {
    const Vector x = condensed_.jump(at.lambda, at.alpha).cwiseProduct(map_.rho().cwiseSqrt());
    Vector all(2 * x.size() + at.alpha.size());
    all << map_.scaled_lambda(at.lambda), x, map_.scaled_alpha(at.alpha);
    return all;
  }
  Iterate split(const Vector& all) const {
    const Eigen::Index m = problem_.rows();
    return {map_.lambda(all.head(m)), map_.alpha(all.tail(all.size() - 2 * m))};
  }
  /// Of multipliers and displacements: gaps, which may say "never", are no measure.
  double size(const Vector& all) const {
    const Eigen::Index m = problem_.rows();
    return all.head(m).norm() + (all.segment(m, m) + problem_.c.cwiseProduct(map_.rho().cwiseSqrt())).norm();
  }

  /// A polyhedron of solutions: origin + size · directions · t, A t ≤ b.
  struct Members {
    std::vector<RowPiece> pieces;
    Vector origin;
    DenseMatrix directions;
    double size = 1;
    DenseMatrix A;
    Vector b;
    algebra::Polyhedron set;

    Vector at(const Vector& t) const { return origin + size * directions * t; }

    /// What the pieces ask for, each a functional of the coordinates that is not negative.
    void inequalities(const BranchSearch& search) {
      const Eigen::Index m = search.problem_.rows();
      std::vector<std::pair<Vector, double>> wanted;  // the constants of the functionals beside
      const auto want = [&](Eigen::Index i, double factor) -> auto& { return wanted.emplace_back(factor * Vector::Unit(origin.size(), i), 0); };
      for (const Choice& c : search.choices_) {
        if (c.row >= 0) pieces[c.row] == RowPiece::open ? want(m + c.row, -1) : want(c.row, 1);
        if (c.tangent < 0) continue;
        const RowPiece piece = pieces[c.tangent];
        if (piece == RowPiece::forward) want(m + c.tangent, 1);
        if (piece == RowPiece::backward) want(m + c.tangent, -1);
        if (piece != RowPiece::closed) continue;
        for (const double side : {1.0, -1.0}) {  // a point has one ρ
          auto& [functional, constant] = want(c.tangent, side);
          if (c.row >= 0) functional[c.row] += c.coefficient;
          constant = c.bound / std::sqrt(search.map_.rho()[c.tangent]);
        }
      }
      A = DenseMatrix(static_cast<Eigen::Index>(wanted.size()), directions.cols());
      b = Vector(A.rows());
      for (Eigen::Index k = 0; k < A.rows(); ++k) {
        const auto& [functional, constant] = wanted[k];
        A.row(k) = -functional.transpose() * directions;
        b[k] = (constant + functional.dot(origin)) / size;
        if (A.row(k).norm() <= kRelative) A.row(k).setZero();
      }
    }

    bool contains(const Vector& point) const {
      const Vector t = algebra::least_squares(directions, Vector(point - origin)) / size;
      const double near = 1e3 * kRelative * (1 + t.norm());
      return (at(t) - point).norm() <= near * size && (A.rows() == 0 || (A * t - b).maxCoeff() <= near);
    }
    bool contains(const Members& other) const {
      for (const Vector& point : other.ends())
        if (!contains(point)) return false;
      for (const DenseMatrix* far : {&other.set.rays, &other.set.lines})
        for (Eigen::Index k = 0; k < far->cols(); ++k)
          if (!contains(other.at(other.set.vertices.col(0) + far->col(k)))) return false;
      return true;
    }
    std::vector<Vector> ends() const {
      std::vector<Vector> all;
      for (Eigen::Index k = 0; k < set.vertices.cols(); ++k)
        all.push_back(at(set.vertices.col(k)).unaryExpr([&](double v) { return std::abs(v) > kNothing * size ? v : 0.0; }));
      return all;
    }
    bool has_end_of(const Members& other) const {
      const std::vector<Vector> points = other.ends();
      return std::any_of(points.begin(), points.end(), [&](const Vector& point) { return contains(point); });
    }
  };

  void add(const Iterate& at) {
    const NaturalMap::Value v = map_.at(at);
    const double size = at.lambda.norm() + v.y.norm();
    if (!(v.norm <= kRelative * size)) return;
    // Without force friction may point to either side, but a piece is slip to its own side.
    for (std::size_t r = 0; r < pieces_.size(); ++r) {
      const double side = pieces_[r] == RowPiece::forward ? 1 : pieces_[r] == RowPiece::backward ? -1 : 0;
      if (side * (v.y[r] - at.lambda[r]) < -kRelative * size) return;
    }
    for (std::size_t k = 0; k < found_.size(); ++k)
      if ((found_[k].lambda - at.lambda).norm() + (found_[k].y - v.y).norm() <= 1e-6 * size) {
        out_.solutions[k].pieces.push_back(pieces_);
        return;
      }
    out_.solutions.push_back(solution(at, pieces_));
    found_.push_back({at.lambda, v.y, join(at)});
  }

  Enumeration::Solution solution(const Iterate& at, const std::vector<RowPiece>& pieces) const {
    const NaturalMap::Value v = map_.at(at);
    Enumeration::Solution out;
    out.result.state = {condensed_.recover(at.lambda, at.alpha), at.lambda};
    out.result.converged = true;
    out.result.method = "enumeration";
    out.result.active_sets = {v.closed};
    out.result.slipping = v.slipping;
    out.result.clock = clock_;
    out.result.ordering = condensed_.ordering();
    out.result.factor_bytes = condensed_.factor_bytes();
    out.pieces = {pieces};
    return out;
  }

  /// Families that are no part of another, and which of them meet; solutions that are in none of them.
  void finish() {
    std::vector<Members> all;
    for (std::size_t k = 0; k < found_families_.size(); ++k) {
      bool part = false;
      for (std::size_t j = 0; j < found_families_.size() && !part; ++j)
        part = j != k && found_families_[j].contains(found_families_[k]) && (j < k || !found_families_[k].contains(found_families_[j]));
      if (!part) all.push_back(found_families_[k]);
    }
    for (std::size_t k = found_.size(); k-- > 0;)
      if (std::any_of(all.begin(), all.end(), [&](const Members& family) { return family.contains(found_[k].coordinates); }))
        out_.solutions.erase(out_.solutions.begin() + static_cast<std::ptrdiff_t>(k));
    for (const Members& family : all) out_.families.push_back(report(family));
    int sets = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (out_.families[k].connected < 0) connect(all, k, sets++);
    const std::string summary = out_.summary();
    for (std::size_t k = 0; k < out_.solutions.size(); ++k)
      out_.solutions[k].result.reason = text("number ", k + 1, " of ", summary);
    for (std::size_t f = 0; f < all.size(); ++f)
      for (auto& ends = out_.families[f].ends; Enumeration::Solution& end : ends)
        end.result.reason = text("end ", &end - ends.data() + 1, " of ", ends.size(), " of family ", f + 1, " of ", summary);
  }

  Enumeration::Family report(const Members& members) const {
    Enumeration::Family family;
    family.connected = -1;
    family.dimension = members.set.dimension(kRelative);
    for (const Vector& end : members.ends()) family.ends.push_back(solution(split(end), members.pieces));
    family.unbounded = static_cast<int>(members.set.rays.cols() + 2 * members.set.lines.cols());
    const Eigen::Index m = problem_.rows();
    family.forces_only = members.directions.bottomRows(members.directions.rows() - m).norm() <= 1e3 * kRelative * members.directions.norm();
    return family;
  }

  /// Numbers a family, those that it meets, and so on.
  void connect(const std::vector<Members>& all, std::size_t k, int set) {
    out_.families[k].connected = set;
    for (std::size_t j = 0; j < all.size(); ++j)
      if (out_.families[j].connected < 0 && (all[k].has_end_of(all[j]) || all[j].has_end_of(all[k]))) connect(all, j, set);
  }

  struct Found { Vector lambda, y, coordinates; };
  const Problem& problem_;
  const CondensedProblem& condensed_;
  const problem::Clock& clock_;
  Monitor& monitor_;
  const std::vector<Choice> choices_;
  const NaturalMap map_;
  NaturalMap::Value base_;
  double scale_ = 0;  ///< of what loads displace without any multipliers
  std::vector<RowPiece> pieces_;
  std::vector<Found> found_;
  std::vector<Members> found_families_;
  Enumeration out_;
};

}  // namespace

std::string Enumeration::summary() const {
  std::string out = families.empty() ? text(solutions.size(), solutions.size() == 1 ? " solution" : " solutions")
                    : solutions.empty() ? "no isolated solution"
                                        : text(solutions.size(), " isolated ", solutions.size() == 1 ? "solution" : "solutions");
  int sets = 0;
  for (const Family& family : families) sets = std::max(sets, family.connected + 1);
  if (sets > 0) out += sets == 1 ? " and a continuum of solutions" : text(" and ", sets, " continua of solutions");
  for (std::size_t k = 0; k < families.size(); ++k) {
    const Family& family = families[k];
    out += text(k == 0 ? ": " : ", ", "a family of dimension ", family.dimension, " with ", family.ends.size(),
                family.ends.size() == 1 ? " end" : " ends", family.unbounded > 0 ? ", unbounded" : "",
                family.forces_only ? ", of forces alone" : "", sets > 1 ? text(" (continuum ", family.connected + 1, ")") : "");
  }
  return out + text("; ", complete ? "all " : "interrupted after ", tried, " combinations of pieces tried");
}

Enumeration enumerate(const Problem& problem, Monitor& monitor) {
  problem::Clock clock;
  const problem::RigidMotions rigid = require_solvable(problem, clock, monitor).rigid;
  const CondensedProblem condensed(problem, rigid, algebra::Ordering::automatic, clock, monitor);
  return BranchSearch(problem, condensed, clock, monitor).run();
}

}  // namespace dotyk::solver

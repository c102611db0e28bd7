#include "solver/pieces/enumeration.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "algebra/dense/polyhedron.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "solver/pieces/choices.hpp"
#include "solver/rows/natural_map.hpp"
#include "solver/core/require_solvable.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

constexpr double kRelative = 1e-9;  ///< what counts as rounding in multipliers and jumps
constexpr double kSingularPivot = 1e-11; ///< pivots below this part of the greatest are rounding
constexpr double kNothing = 1e-13;  ///< of a family's size: rounding in its ends

class BranchSearch {
 public:
  BranchSearch(const Problem& problem, const CondensedProblem& condensed, Monitor& monitor)
      : problem_(problem), condensed_(condensed), monitor_(monitor), choices_(choices_of(problem)),
        map_(problem, condensed, stiffness_of_rows(condensed)), pieces_(problem.rows(), RowPiece::closed) {
    for (const FrictionGroup& group : problem.friction)
      for (int k = 0; k < group.points(); ++k) pieces_[group.row(k)] = RowPiece::open;  // without friction
    // Rows of one piece are linear: what the map is anywhere.
    base_ = map_.sticking(std::vector<char>(problem.rows(), 0));
    scale_ = size(join({Vector::Zero(problem.rows()), Vector::Zero(condensed.kernel_size())}));
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
      const RowPiece piece = static_cast<RowPiece>(c.pieces == 3 ? digit[k] + 1 : digit[k]);
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

  void try_pieces(const std::vector<int>& digit) {
    const NaturalMap::System system = map_.linearise(value(digit));
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
    Point at;
    map_.take(system, solved, at.lambda, at.alpha);
    if (at.lambda.allFinite()) add(at);
  }

  struct Point { Vector lambda, alpha; };

  /// Of all that the singular system allows, what the signs and bounds of the pieces leave.
  void add_family(const NaturalMap::System& system, const Vector& solved, const DenseMatrix& kernel) {
    const DenseMatrix Z = algebra::orthonormal(kernel);
    const Vector least = solved - Z * (Z.transpose() * solved);
    Members members;
    members.pieces = pieces_;
    const Vector origin = members.origin = coordinates(system, least);
    if (const double greatest = std::max(size(origin), scale_); greatest > 0) members.size = greatest;
    members.directions = DenseMatrix(origin.size(), Z.cols());
    for (Eigen::Index k = 0; k < Z.cols(); ++k)  // steps of the origin's size, so that their difference keeps its digits
      members.directions.col(k) = (coordinates(system, least + members.size * Z.col(k)) - origin) / members.size;
    members.inequalities(*this);
    members.set = algebra::polyhedron(members.A, members.b, kRelative);
    const int dimension = members.set.dimension(kRelative);
    if (dimension == 0) add(split(members.at(members.set.vertices.col(0))));
    if (dimension > 0) found_families_.push_back(std::move(members));
  }

  /// (v, x̃, a) in one unit, the root of an energy: scaled multipliers, jumps and motions.
  Vector coordinates(const NaturalMap::System& system, const Vector& solved) const {
    Point at;
    map_.take(system, solved, at.lambda, at.alpha);
    return join(at);
  }
  Vector join(const Point& at) const {
    const Vector x = condensed_.jump(at.lambda, at.alpha).cwiseProduct(map_.rho().cwiseSqrt());
    Vector all(2 * x.size() + at.alpha.size());
    all << map_.scaled_lambda(at.lambda), x, map_.scaled_alpha(at.alpha);
    return all;
  }
  Point split(const Vector& all) const {
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
      std::vector<Vector> wanted;
      const auto want = [&](Eigen::Index i, double factor, Eigen::Index j = 0, double other = 0) {
        Vector w = Vector::Zero(origin.size());
        w[i] += factor;
        w[j] += other;
        wanted.push_back(std::move(w));
      };
      std::vector<double> constant;
      for (const Choice& c : search.choices_) {
        if (c.row >= 0) pieces[c.row] == RowPiece::open ? want(m + c.row, -1) : want(c.row, 1);
        if (c.row >= 0) constant.push_back(0);
        if (c.tangent < 0) continue;
        const RowPiece piece = pieces[c.tangent];
        if (piece == RowPiece::forward) want(m + c.tangent, 1), constant.push_back(0);
        if (piece == RowPiece::backward) want(m + c.tangent, -1), constant.push_back(0);
        if (piece != RowPiece::closed) continue;
        for (const double side : {1.0, -1.0}) {  // a point has one ρ
          want(c.tangent, side, std::max(c.row, 0), c.row >= 0 ? c.coefficient : 0);
          constant.push_back(c.bound / std::sqrt(search.map_.rho()[c.tangent]));
        }
      }
      A = DenseMatrix(static_cast<Eigen::Index>(wanted.size()), directions.cols());
      b = Vector(A.rows());
      for (Eigen::Index k = 0; k < A.rows(); ++k) {
        A.row(k) = -wanted[k].transpose() * directions;
        b[k] = (constant[k] + wanted[k].dot(origin)) / size;
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
    bool meets(const Members& other) const {
      for (const Vector& point : other.ends())
        if (contains(point)) return true;
      for (const Vector& point : ends())
        if (other.contains(point)) return true;
      return false;
    }
  };

  void add(const Point& at) {
    const NaturalMap::Value v = map_.at(at.lambda, at.alpha);
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

  Enumeration::Solution solution(const Point& at, const std::vector<RowPiece>& pieces) const {
    const NaturalMap::Value v = map_.at(at.lambda, at.alpha);
    Enumeration::Solution out;
    out.result.state = {condensed_.recover(at.lambda, at.alpha), at.lambda};
    out.result.converged = true;
    out.result.method = "enumeration";
    out.result.active_sets = {v.closed};
    out.result.slipping = v.slipping;
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
    connect(all);
    const std::string summary = out_.summary();
    for (std::size_t k = 0; k < out_.solutions.size(); ++k)
      out_.solutions[k].result.reason = text("number ", k + 1, " of ", summary);
    for (std::size_t f = 0; f < out_.families.size(); ++f)
      for (std::size_t k = 0; k < out_.families[f].ends.size(); ++k)
        out_.families[f].ends[k].result.reason = text("end ", k + 1, " of ", out_.families[f].ends.size(), " of family ", f + 1, " of ", summary);
  }

  Enumeration::Family report(const Members& members) const {
    Enumeration::Family family;
    family.dimension = members.set.dimension(kRelative);
    for (const Vector& end : members.ends()) family.ends.push_back(solution(split(end), members.pieces));
    family.unbounded = static_cast<int>(members.set.rays.cols() + 2 * members.set.lines.cols());
    const Eigen::Index m = problem_.rows();
    family.forces_only = members.directions.bottomRows(members.directions.rows() - m).norm() <= 1e3 * kRelative * members.directions.norm();
    return family;
  }

  void connect(const std::vector<Members>& all) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      out_.families[k].connected = static_cast<int>(k);
      for (std::size_t j = 0; j < k; ++j) {
        const int mine = out_.families[k].connected, its = out_.families[j].connected;
        if (mine == its || !all[k].meets(all[j])) continue;
        for (Enumeration::Family& family : out_.families)
          if (family.connected == mine) family.connected = its;
      }
    }
    std::vector<int> sets;  // numbered as they come
    for (Enumeration::Family& family : out_.families) {
      if (std::find(sets.begin(), sets.end(), family.connected) == sets.end()) sets.push_back(family.connected);
      family.connected = static_cast<int>(std::find(sets.begin(), sets.end(), family.connected) - sets.begin());
    }
  }

  struct Found { Vector lambda, y, coordinates; };
  const Problem& problem_;
  const CondensedProblem& condensed_;
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
  Enumeration all = BranchSearch(problem, condensed, monitor).run();
  const auto complete = [&](std::vector<Enumeration::Solution>& solutions) {
    for (Enumeration::Solution& solution : solutions) {
      solution.result.clock = clock;
      solution.result.ordering = condensed.ordering();
      solution.result.factor_bytes = condensed.factor_bytes();
    }
  };
  complete(all.solutions);
  for (Enumeration::Family& family : all.families) complete(family.ends);
  return all;
}

}  // namespace dotyk::solver

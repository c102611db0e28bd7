#pragma once

#include <string>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::program {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

/// minimise ½xᵀPx + qᵀx + r subject to low ≤ Ax ≤ high: n unknowns, m rows. A row with low == high is
/// an equality, one with a single entry a bound; ±∞ where there is no limit.
struct QuadraticProgram {
  std::string name;
  SparseMatrix P;   ///< n × n, positive semidefinite, lower triangle
  Vector q;         ///< n
  double r = 0;
  SparseRows A;     ///< m × n
  Vector low, high; ///< m

  int unknowns() const { return static_cast<int>(q.size()); }
  int rows() const { return static_cast<int>(low.size()); }
  bool equality(int row) const { return low[row] == high[row]; }
};

/// Throws InputError where sizes do not fit, a number is not finite (nan in the limits), or low > high
/// in a row; the message names the row (from 1).
void check(const QuadraticProgram& program);

/// Px, from the lower triangle.
Vector times(const SparseMatrix& lower, const Vector& x);

/// ½xᵀPx + qᵀx + r.
double objective(const QuadraticProgram& program, const Vector& x);

/// The greatest size of an entry; 0 where there is none.
inline double peak(const Vector& v) { return v.lpNorm<Eigen::Infinity>(); }
inline double peak(const SparseMatrix& a) { return a.coeffs().matrix().lpNorm<Eigen::Infinity>(); }
inline double peak(const SparseRows& a) { return a.coeffs().matrix().lpNorm<Eigen::Infinity>(); }

/// How far x (n) and the multipliers y (m; positive at high, negative at low) are from optimal.
struct Residuals {
  double stationarity = 0;     ///< max |Px + q + Aᵀy| over max(|P||x|, |q|, |A|ᵀ|y|)
  double feasibility = 0;      ///< max violation of a row over max(|A||x|, |limits exceeded|) and a millionth of what the
                               ///< multipliers move the rows they pull at by, |y_r| Σ A_rj²/P_jj: x may be nothing but rounding
  double complementarity = 0;  ///< |xᵀPx + qᵀx + highᵀy⁺ − lowᵀy⁻| over 1 + |objective|
  double stationarity_scale = 1, feasibility_scale = 1, complementarity_scale = 1;  ///< those divisors
};
Residuals residuals(const QuadraticProgram& program, const Vector& x, const Vector& y);

enum class Status { solved, infeasible, unbounded, not_convex, stopped };
const char* text_of(Status status);

/// Where a row stands.
enum class Side : signed char { free = 0, low = -1, high = 1, equal = 2, above = 3, below = 4 };

struct Result {
  Status status = Status::stopped;
  std::string reason;         ///< one sentence
  Vector x, y;                ///< n; m multipliers: Px + q + Aᵀy = 0, y ≥ 0 at high, ≤ 0 at low
  std::vector<Side> working;  ///< active set: the working set at the end, m; else empty
  /// unbounded: n, along it the objective falls for ever; infeasible: m, weights of the rows whose sum
  /// contradicts itself; not convex: n, xᵀPx < 0.
  Vector direction;
  double objective = 0;
  Residuals residual;
  int iterations = 0;
  int predictor_iterations = 0;  ///< interior-point iterations that chose the first working set
  int added = 0, dropped = 0;    ///< rows that entered and left the working set
  int singular = 0;              ///< singular KKT systems met
  int survived = 0;              ///< of these, the ones that still gave a step or the solution
  int factorisations = 0;
  int repeats = 0;               ///< times zigzagging was noticed, and the rule changed
  int cg = 0;                    ///< CG iterations of the augmented Lagrangian
  double penalty = 0;            ///< its last penalty
  double seconds = 0;

  void end(Status how, std::string why) { status = how, reason = std::move(why); }
  void end(Status how, std::string why, Vector along) { end(how, std::move(why)), direction = std::move(along); }
};

/// Fills objective and residual of a result from its x and y. Nothing is solved of which one of these numbers is not finite: status is then
/// stopped.
void measure(const QuadraticProgram& program, Result& result);

/// A vector v with vᵀPv < −tolerance·max|P| vᵀv, empty where P is positive semidefinite up to that.
Vector negative_curvature(const SparseMatrix& lower, double tolerance = 1e-9);

}  // namespace dotyk::program

#pragma once

#include <cmath>
#include <vector>

#include "program/program.hpp"

namespace dotyk::program {

/// Where every row of a program stands at a point: in the working set at one of its limits, free between
/// them, or elastic: violated, and charged for.
class Elastic {
 public:
  Elastic(const QuadraticProgram& program, double tolerance);

  std::vector<Side> side;  ///< m

  bool working(int row) const { return side[row] == Side::low || side[row] == Side::high || side[row] == Side::equal; }
  bool violated(int row) const { return side[row] == Side::above || side[row] == Side::below; }
  int violations() const;
  std::vector<char> taken() const;
  /// The limit at which a row stands or towards which an elastic one comes back.
  double limit(int row) const;
  /// limit − activity of the rows at work, zero for others; activity = Ax (m).
  Vector missing(const Vector& activity) const;
  /// Σ ± a_r over elastic rows: the gradient of the summed violation, as weights (m) of the rows of A.
  Vector charge() const;
  /// Rows at work that have left their limit become elastic or free; others are looked at anew; an equality
  /// that holds goes to work.
  void classify(const Vector& activity);
  /// Do all elastic rows stand at their limit, up to the tolerance?
  bool arrived(const Vector& activity) const;
  /// A number that tells this set from others.
  std::size_t hash() const;
  double slack_tolerance(double limit) const;

  struct Meeting {
    double step = INFINITY;
    std::vector<int> rows;  ///< the row met first, or several met at once
  };
  /// The first limits met along `speed` = Ap (m) from `activity`; elastic rows meet theirs coming back.
  /// Harris's test (1973): of the rows within the tolerance the one met most squarely; `least_index`: of the
  /// rows met first, within rounding, the first (Bland); `all`: all within the tolerance.
  /// A speed that is rounding beside its terms, `terms` = |A||p| (m), is none.
  Meeting meeting(const Vector& activity, const Vector& speed, const Vector& terms, bool least_index, bool all) const;
  /// Puts a row to work at the limit it met at this speed.
  void engage(int row, double speed);

 private:
  double room(int row, double activity, double speed) const;

  const QuadraticProgram& p_;
  double tolerance_;
};

}  // namespace dotyk::program

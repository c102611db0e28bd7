#pragma once

#include "problem/parts.hpp"

namespace dotyk::problem {

class CondensedProblem;

/// A force and a gap, row by row, up to which they are nothing.
struct Nothing {
  algebra::Vector force, gap;
};

/// What counts as a force and as a displacement in a problem, by its loads, gaps, laws and stiffness: results are judged by it, and no result
/// by its own size. It is a measure of each of the problem's Parts.
///
/// Force: F = ‖f‖₂, or ‖λ⁰‖₂ if that is more. λ⁰_r = P(−k_r c_r) is the force on row r at rest, were the bodies that it joins springs of
/// stiffness k_r. It is not zero where bodies overlap, where a displacement is prescribed, where slip is locked in from the step before, and where a law
/// has a force of its own. Because k_r is local, λ⁰ may be far above all forces of the solution: bodies may get out of each other's way. Of a
/// state, ‖λ⁰‖ therefore counts as no more than the state's forces, and as no less than √ε of itself or of ‖|K||w|‖, w a motion by the greatest such gap.
///
/// Displacement: X = F/k of the part's stiffest row, or the greatest |u| of a state without its rigid motions if that is more: a slender body
/// yields far more than k says. How far bodies move as a whole does not count, nor do great multipliers. A row with a gap beyond X is measured by its gap.
///
/// A part that nothing loads has at least a small part of the forces of the others. Where nothing drives anything, the solution is without forces; those of a
/// state, or √ε ‖|K||u|‖, are then all that it can be measured by.
class Measure {
 public:
  /// `stiffness`: k by row, in force per displacement; without it that of Problem::row_stiffness().
  explicit Measure(const Problem& problem, algebra::Vector stiffness = {});
  /// k is what bodies yield as well as the row's own cells: 1/W_rr.
  Measure(const Problem& problem, const CondensedProblem& condensed);
  Measure(const Problem& problem, const State& state, const Forces& forces);
  Measure(const Problem& problem, const State& state) : Measure(problem, state, external_forces(problem, state)) {}

  const Parts& parts() const { return parts_; }
  /// k by row; the greatest of all where no unknown moves a row, 1 where none moves any.
  const algebra::Vector& stiffness() const { return stiffness_; }
  double load(std::size_t part) const { return load_[part] > 0 ? load_[part] : 1; }  ///< ‖f‖, 1 where there is none
  double force(std::size_t part) const { return force_[part]; }    ///< F, 1 where nothing gives a measure
  /// F of a state whose multipliers have that norm on the part's rows.
  double force(std::size_t part, double borne) const { return std::max({load_[part], least_[part], std::min(borne, at_rest_[part])}); }
  double length(std::size_t part) const { return length_[part]; }  ///< X, likewise
  /// A method's forces are measured by their own norm where that is more than this: √ε of what drives the part, or a small part of the others'.
  double least_force(std::size_t part) const;
  double force_of_row(int row) const { return force_[static_cast<std::size_t>(parts_.of_row[row])]; }
  double load_of_row(int row) const { return load(static_cast<std::size_t>(parts_.of_row[row])); }
  double length_of_row(int row) const;
  /// `relative` of the terms that make forces and gaps at multipliers λ and gaps x: of the greatest |λ| of the row's part, and of |c_r| and the greatest
  /// |x + c| of the part, each turned into the other by k_r. A few ε is what rounding leaves. A gap that says "never" does not count.
  Nothing nothing(double relative, const algebra::Vector& lambda, const algebra::Vector& x) const;
  /// ‖|K||u|‖ of a part.
  double gross_forces(const Problem& problem, std::size_t part, const Displacement& u) const;

 private:
  void take_loads(const Problem& problem);
  void take_rows(const Problem& problem);
  void count_others();
  double driving(std::size_t part) const { return std::max(load_[part], at_rest_[part]); }

  Parts parts_;
  algebra::Vector stiffness_, c_;              ///< by row
  std::vector<double> stiffest_;               ///< by part
  std::vector<double> load_, at_rest_;         ///< by part: ‖f‖, ‖λ⁰‖
  std::vector<double> moved_;                  ///< by part that nothing loads: ‖|K||w|‖, w a motion by its greatest driving gap
  std::vector<double> least_;                  ///< by part, what counts at least where bodies get out of each other's way
  std::vector<double> force_, length_;         ///< by part
};

}  // namespace dotyk::problem

#pragma once

#include <optional>

#include "program/program.hpp"

namespace dotyk::program {

/// A program in other units: x = column ∘ x̂, rows multiplied by `row`, the objective by `cost`.
struct Scaled {
  QuadraticProgram program;
  Vector column, row;  ///< n and m, positive
  double cost = 1;

  Vector x(const Vector& scaled) const { return column.cwiseProduct(scaled); }
  Vector y(const Vector& scaled) const { return row.cwiseProduct(scaled) / cost; }
  /// Turns a result of the program into one of the program that it was made of.
  void take_back(Result& result) const;
};

/// The greatest entry of P and q where that is beyond 1e±6, else 1: divided by it, an objective is of numbers like 1.
double objective_unit(const QuadraticProgram& program);

/// Ruiz's equilibration (2001) of the KKT matrix [P Aᵀ; A 0]: ten times every row and column is
/// divided by the root of its largest entry, P besides by the root of its own. A row of one unknown takes whatever unit that has, and has
/// no say in it. Then x is measured by what drives it: q where P resists, by the root of the energy that comes of it, and limits that 0
/// violates; the objective by its gradient's size.
Scaled scale(const QuadraticProgram& program);

/// In units of which programs that differ in the units of their unknowns, rows and objective are the same: P has the diagonal 1, q the greatest entry 1, and
/// so have rows. Where P_jj > 0 for all j and q is not zero; else nothing.
std::optional<Scaled> scale_by_curvature(const QuadraticProgram& program);

/// How far (x, y) is from optimal for single unknowns and rows, not beside others. In units of scale_by_curvature() the greatest of: what is left of an
/// unknown's gradient, multipliers counted by how far their row is from its limit, against the gradient's terms; violations of rows against what their unknowns'
/// terms move them by. 0 where there are no such units. What is left of an unknown that its own q_j drives counts beyond rounding of its terms. The solution of
/// other unknowns may be 0: by `of_greatest` what is left of them counts beyond 1e-9 of the greatest terms, by `own` beyond rounding of their own terms.
enum class Rounding { of_greatest, own };
double imbalance(const QuadraticProgram& program, const Vector& x, const Vector& y, Rounding nothing = Rounding::of_greatest);
/// Where the imbalance is more, other units are tried; and where the result is no solution.
constexpr double kImbalanced = 1e-7, kHidden = 1e-5;
constexpr const char* kHiddenReason = "unknowns are of so different size that the great ones hide the others: these are not found";

}  // namespace dotyk::program

#pragma once

#include "program/program.hpp"

namespace dotyk::program {

/// A program in other units: x = column ∘ x̂, rows multiplied by `row`, the objective by `cost`.
struct Scaled {
  QuadraticProgram program;
  Vector column, row;  ///< n and m, positive
  double cost = 1;

  Vector x(const Vector& scaled) const { return column.cwiseProduct(scaled); }
  Vector y(const Vector& scaled) const { return row.cwiseProduct(scaled) / cost; }
};

/// The greatest entry of P and q where that is beyond 1e±6, else 1: divided by it, an objective is of numbers like 1.
double objective_unit(const QuadraticProgram& program);

/// Ruiz's equilibration (2001) of the KKT matrix [P Aᵀ; A 0]: ten times every row and column is
/// divided by the root of its largest entry; then the objective is divided by its gradient's size. Before that, by its unit: what
/// is beyond all rows' size would make them nothing.
Scaled scale(const QuadraticProgram& program);

}  // namespace dotyk::program

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

/// Ruiz's equilibration (2001) of the KKT matrix [P Aᵀ; A 0]: ten times every row and column is
/// divided by the root of its largest entry; then the objective is divided by its gradient's size.
Scaled scale(const QuadraticProgram& program);

}  // namespace dotyk::program

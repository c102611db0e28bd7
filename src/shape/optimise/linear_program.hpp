#pragma once

#include <string>

#include "algebra/types.hpp"

namespace dotyk::shape {

/// min gᵀd over the d (n) with A d ≤ b (m rows) and lower ≤ d ≤ upper; infinite bounds and infinite b bound nothing.
struct LinearProgram {
  algebra::Vector g;
  algebra::DenseMatrix A;
  algebra::Vector b, lower, upper;
};

enum class LinearStatus { solved, infeasible, unbounded, failed };

/// A vertex d, with y (m) ≥ 0 and z = g + Aᵀy (n): z ≥ 0 where d is at its lower bound, ≤ 0 at its upper, 0 between;
/// y is 0 where A d < b. Where nothing was found, all three are empty.
struct LinearSolution {
  LinearStatus status = LinearStatus::failed;
  std::string reason;  ///< empty where solved
  algebra::Vector d, y, z;
  double value = 0;  ///< gᵀd
};

/// By GLPK's primal simplex method; in silence, whatever happens inside. Throws InputError for sizes that do not fit,
/// numbers that are not finite (bounds may be infinite), and lower > upper.
LinearSolution minimise(const LinearProgram& program);

}  // namespace dotyk::shape

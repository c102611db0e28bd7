#pragma once

#include <functional>

#include "algebra/types.hpp"

namespace dotyk::program {

struct Refined {
  algebra::Vector z;         ///< the best found
  algebra::Vector residual;  ///< b − K z
  bool reached = false;      ///< largest entry of the residual ≤ target
  int steps = 0;             ///< solves with the regularised matrix
};

using Apply = std::function<algebra::Vector(const algebra::Vector&)>;

/// Iterative refinement of K z = b with solves of a regularised, nearby matrix, accelerated by GMRES
/// (Saad and Schultz 1986; for refinement with a regularised factor Arioli, Duff, Gratton and Pralet
/// 2007). A consistent singular system is solved; for an inconsistent symmetric one the residual tends
/// to the part of b in K's kernel.
Refined refine(const Apply& K, const Apply& regularised, const algebra::Vector& b, double target,
               int most_steps = 12);

}  // namespace dotyk::program

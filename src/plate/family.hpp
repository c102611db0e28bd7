#pragma once

#include "plate/model.hpp"

namespace dotyk::plate {

/// All solutions where there are many: u + t·motion for from ≤ t ≤ to, u the one that is given (P5, lemma 10: w + c for every c with γ₀w + c ≥ 0).
struct Family {
  algebra::Vector motion;   ///< of all freedoms, greatest 1
  double from, to;          ///< may be infinite
};

/// The motion by these amounts of the modes of the problem's kernel: of all freedoms, greatest 1.
algebra::Vector of_freedoms(const Model& model, const algebra::Vector& amounts);

/// B·moved, zero where it is no more than rounding, 1e-9 of Σⱼ|Bᵢⱼ| max|moved|: the row does not notice the motion.
algebra::Vector by_motion(const algebra::SparseRows& B, const algebra::Vector& moved);

/// For how much of the motion the multipliers still obey the laws, x − t B·motion ∈ ∂φ*(λ) in every row.
Family family(const Model& model, const problem::State& state, const algebra::Vector& motion);

}  // namespace dotyk::plate

#pragma once

#include <optional>
#include <string>

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

/// What is known before solving: whether reactions that the supports can give balance the load.
struct Verdict {
  std::string note;   ///< that the solution is unique up to a motion, a limit case, and by which condition; empty where it is unique
  std::optional<algebra::Vector> motion;  ///< of all freedoms, greatest 1: the solution is known but for this
};

/// Throws InputError where there is no solution: with the motion that nothing stops, the work of the load on it, and the condition of P5.
Verdict require_solvable(const Model& model);

/// The conditions of P5 that are about these supports: (33) of the free plate, (44) to (46) of Signorini's edge, (62) to (64) of
/// friction, (73) and (74) of the one-sided elastic edge.
std::string conditions(const Model& model);

}  // namespace dotyk::plate

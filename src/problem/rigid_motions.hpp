#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// Modes have greatest displacement 1: 1e-9 of that is "not at all".
constexpr double kNotAtAll = 1e-9;

/// A motion of one block.
struct BodyMotion {
  std::string body;
  Motion motion;
  std::function<Motion(const algebra::Vector&)> sum = {};  ///< as Motions::sum, the same for all modes of the block
  /// "'lid': translation along x".
  std::string text() const { return "'" + body + "': " + motion.text(); }
};

/// The rigid motions of all blocks against the rows: with α the amounts of the kernel's modes,
/// N α is the jump that a motion makes on the rows, and eᵀα the work of the load on it.
struct RigidMotions {
  algebra::SparseMatrix N;         ///< B R, rows × modes: a row joins the modes of the bodies that it touches
  algebra::Vector e;               ///< Rᵀ f; of a block where it is rounding, zero
  /// Bases of the motions that some row notices (N α ≠ 0) and that none does, modes × count; see algebra::range_and_null().
  algebra::SparseMatrix noticed, unnoticed;
  algebra::SparseMatrix noticed_N;  ///< N on the noticed motions, rows × their count
  algebra::Vector noticed_e;       ///< e on them
  std::vector<BodyMotion> motions;  ///< what the modes are
  int count() const { return static_cast<int>(e.size()); }
};
/// Asks whether to stop, see algebra::ask_to_stop().
RigidMotions rigid_motions(const Problem& problem);
/// B R, rows × modes.
algebra::SparseMatrix jumps_of_modes(const Problem& problem);
/// The same motions under another f: sets e and noticed_e.
void take_load(const Problem& problem, RigidMotions& rigid);

/// What the modes of all blocks' kernels are, block after block.
std::vector<BodyMotion> body_motions(const Problem& problem);

/// What each block does under so much of each mode: one motion, where Motions::sum is known, else its modes one by one; blocks that rest are
/// left out. Their amounts are such that the greatest mode's is 1.
std::vector<BodyMotion> told(const std::vector<BodyMotion>& modes, const algebra::Vector& amounts);
/// "'lid': translation along x", "'lid': clockwise rotation about (0, 0)"; of several blocks each with its amount (a length, or an angle in
/// radians) beside the others'.
std::string describe(const std::vector<BodyMotion>& motions, const algebra::Vector& amounts);

/// R α, the displacement of all unknowns under motions α (modes × any number of columns).
algebra::SparseMatrix displacement(const Problem& problem, const algebra::SparseMatrix& motions);

/// The part of a block's displacement in its kernel, R R⁺u.
algebra::Vector rigid_part(const Block& block, const algebra::Vector& u);

/// The motions that no row notices as displacements, orthonormal: unknowns × count.
algebra::SparseMatrix unnoticed_displacements(const Problem& problem, const RigidMotions& rigid);

/// u less its part in them: the least of all displacements that differ by such motions.
algebra::Vector least(const algebra::SparseMatrix& unnoticed, algebra::Vector u);

}  // namespace dotyk::problem

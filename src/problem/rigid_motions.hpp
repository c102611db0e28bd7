#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// A motion of one block.
struct BodyMotion {
  std::string body;
  Motion motion;
  /// "'lid': translation along x".
  std::string text() const { return "'" + body + "': " + motion.text(); }
};

/// The rigid motions of all blocks against the rows: with α the amounts of the kernel's modes,
/// N α is the jump that a motion makes on the rows, and eᵀα the work of the load on it.
struct RigidMotions {
  algebra::DenseMatrix N;          ///< B R, rows × modes
  algebra::Vector e;               ///< Rᵀ f; of a block where it is rounding, zero
  /// Orthonormal bases of the motions that some row notices (N α ≠ 0) and that none does.
  algebra::DenseMatrix noticed, unnoticed;  ///< modes × count
  algebra::DenseMatrix noticed_N;  ///< N on the noticed motions, rows × their count
  algebra::Vector noticed_e;       ///< e on them
  std::vector<BodyMotion> motions;  ///< what the modes are
  int count() const { return static_cast<int>(e.size()); }
};
RigidMotions rigid_motions(const Problem& problem);
/// The same motions under another f: sets e and noticed_e.
void take_load(const Problem& problem, RigidMotions& rigid);

/// What the modes of all blocks' kernels are, block after block.
std::vector<BodyMotion> body_motions(const Problem& problem);

/// "'lid': translation along x", or a combination with its amounts: one for each of the motions.
std::string describe(const std::vector<BodyMotion>& motions, const algebra::Vector& amounts);

/// R α, the displacement of all unknowns under motions α (modes × any number of columns).
algebra::DenseMatrix displacement(const Problem& problem, const algebra::DenseMatrix& motions);

/// The motions that no row notices as displacements, orthonormal: unknowns × count.
algebra::DenseMatrix unnoticed_displacements(const Problem& problem, const RigidMotions& rigid);

/// u less its part in them: the least of all displacements that differ by such motions.
algebra::Vector least(const algebra::DenseMatrix& unnoticed, algebra::Vector u);

}  // namespace dotyk::problem

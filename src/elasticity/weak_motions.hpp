#pragma once

#include <functional>
#include <vector>

#include "algebra/symmetric_matrix.hpp"
#include "base/motion.hpp"
#include "elasticity/assembly.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Rigid motions that a body's supports hold, but hardly.
struct WeakMotions {
  /// Of the softest, relative to the body's own: see weak_motions(). 0 where the stiffness matrix
  /// cannot be told from that of the free body.
  double stiffness = 1;
  std::vector<Motion> motions;  ///< empty: all is well held
};

/// A body's springs, on its mesh or, where that is not refined as yet, on the cells near the boundary of the refined one.
struct Springs {
  const mesh::Mesh& mesh;
  const Numbering& numbering;
  const std::vector<FacetSpring>& facets;
};

/// A body is nearly free in a motion where its supports are far softer than the body itself. With Q an
/// M-orthonormal basis of the rigid motions without the kernel (M: lumped volumes) and μ an eigenvalue of
/// the compliance QᵀM K⁺ M Q, 1/μ is the stiffness of what holds the motion, supports and the body around
/// them in series; the body's own is the least Rayleigh quotient of deformations (M-orthogonal to rigid
/// motions), by a step of inverse iteration from those that come with the responses;
///   stiffness = (1/μ) / the body's own.
/// Motions below 1e-6 are named: there a load that strains the body by a millionth turns or moves it by its
/// own size, so that the statement of small displacements has lost its meaning, and six digits of the
/// deformation are lost beside the rigid part.
///
/// Cost: two passes over the cells compare the least Rayleigh quotient of rigid motions, an upper bound of the supports' stiffness, with that of a dilatation.
/// Only where their ratio is below 1e-3 there follow one factorisation of K and twice as many solutions as motions are held.
/// `stiffness`: makes K, on the unknowns, where it is needed; `kernel`: its exact rigid modes, unknowns × modes.
WeakMotions weak_motions(const mesh::Mesh& mesh, const MaterialField& material, const Springs& springs, const Numbering& numbering,
                         const std::function<algebra::SymmetricMatrix()>& stiffness, const algebra::DenseMatrix& kernel);

}  // namespace dotyk::elasticity

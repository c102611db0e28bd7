#pragma once

#include <array>
#include <memory>
#include <vector>

#include "algebra/symmetric_matrix.hpp"

namespace dotyk::problem {

/// How bodies are to be cut into subdomains, for methods that work on such.
struct Decomposition {
  /// Subdomains in all, shared out among the bodies by their cells, at least one a body; 0: as `boxes` say.
  int count = 0;
  /// Each body's bounding box cut into so many equal boxes along each axis; a cell belongs where its centre is.
  std::array<int, 3> boxes = {1, 1, 1};
  /// Supports, springs among them, as rows of the dual problem (total FETI: every subdomain then has all its rigid motions
  /// as kernel, and equal subdomains have equal matrices); false: supports stay in the matrices.
  bool support_rows = true;
};

/// ½vᵀKv: shared by pieces that are translates of each other.
struct Stiffness {
  algebra::SymmetricMatrix K;   ///< positive semidefinite
  algebra::DenseMatrix kernel;  ///< ker K: unknowns × modes
};

/// A piece of a block: the energy ½vᵀKv − fᵀv + ½ Σ k_q (Sv)_q² of some of its cells, on copies of its own of the block's
/// unknowns. Where all copies of an unknown agree and the held ones have their values, the pieces' energies
/// sum up to the block's (but for its offset).
struct Subdomain {
  int block = 0;
  std::shared_ptr<const Stiffness> stiffness;  ///< on the own unknowns
  algebra::Vector f;            ///< a load on a node that several pieces share is split among them
  std::vector<int> node;        ///< of the block's mesh, for each own unknown, ascending
  std::vector<int> unknown;     ///< which of all blocks' unknowns each own unknown is a copy of; -1: one held by a support
  algebra::Vector value;        ///< the displacement that the support prescribes where `unknown` is -1; else 0
  algebra::SparseRows S;        ///< springs that are to be rows of the dual problem: those × own unknowns
  algebra::Vector spring;       ///< k_q > 0 of each; none where supports are in the matrices
  int size() const { return static_cast<int>(f.size()); }
  const algebra::SparseMatrix& K() const { return stiffness->K.lower(); }
  const algebra::DenseMatrix& kernel() const { return stiffness->kernel; }
};

}  // namespace dotyk::problem

#pragma once

#include <array>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::problem {

/// How bodies are to be cut into subdomains, for methods that work on such.
struct Decomposition {
  /// Subdomains in all, shared out among the bodies by their cells, at least one a body; 0: as `boxes` say.
  int count = 0;
  /// Each body's bounding box cut into so many equal boxes along each axis; a cell belongs where its centre is.
  std::array<int, 3> boxes = {1, 1, 1};
  /// Supports as rows of the dual problem (total FETI: every subdomain without springs then has all its rigid
  /// motions as kernel, and equal subdomains have equal matrices); false: supports stay in the matrices.
  bool support_rows = true;
};

/// A piece of a block: the energy ½vᵀKv − fᵀv of some of its cells, on copies of its own of the block's
/// unknowns. Where all copies of an unknown agree and the held ones have their values, the pieces' energies
/// sum up to the block's (but for its offset).
struct Subdomain {
  int block = 0;
  algebra::SparseMatrix K;      ///< lower triangle, own numbering; positive semidefinite
  algebra::Vector f;            ///< a load on a node that several pieces share is split among them
  std::vector<int> node;        ///< of the block's mesh, for each own unknown, ascending
  algebra::DenseMatrix kernel;  ///< ker K: own unknowns × modes
  std::vector<int> unknown;     ///< which of all blocks' unknowns each own unknown is a copy of; -1: one held by a support
  algebra::Vector value;        ///< the displacement that the support prescribes where `unknown` is -1; else 0
  int size() const { return static_cast<int>(f.size()); }
};

/// Sizes to report of subdomains.
struct SubdomainCounts {
  int subdomains = 0;
  int least = 0, greatest = 0;  ///< own unknowns of one
  int gluing = 0;               ///< equations between copies: one less than an unknown has, summed
  int held = 0;                 ///< own unknowns with `unknown` -1: equations of supports
};
SubdomainCounts counts(const std::vector<Subdomain>& subdomains);

}  // namespace dotyk::problem

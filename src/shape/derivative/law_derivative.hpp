#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::shape {

/// A point of friction that slips along d = x_t/‖x_t‖.
struct Slip {
  int row;                   ///< the first of its rows
  algebra::Vector direction; ///< d, one component a row
};

/// How the multipliers of all rows follow the rows at a state: with one unknown y for each direction of multipliers that
/// is not settled by its law alone, and x' the derivative of Bu − c,
///   λ' = E y + Σ_p b'_p d_p,     Fᵀx' = C y   (weak contact: y ≥ 0, Fᵀx' ≤ C y, one of them an equality).
/// Strong contact, stick and other rows that are held: C = 0; springs: C = 1/k; slip in space: across d, C = ‖x_t‖/b;
/// Coulomb's slip: b' = F λ'_n, in E beside the normal row's unknown, so that E ≠ F. Open rows: no unknown.
struct LawDerivative {
  algebra::SparseMatrix E, F;  ///< rows × unknowns y
  algebra::Vector C;           ///< compliances, displacement per force
  std::vector<int> weak;       ///< unknowns y in weak contact
  std::vector<int> weak_row;   ///< their rows
  std::vector<Slip> slips;     ///< of points whose bound b' is given
  bool symmetric = true;       ///< E = F
  int size() const { return static_cast<int>(C.size()); }
};

/// `touching`: what counts as nothing, relative: of a multiplier of row r, touching (max|λ| + k_r max(|c_r|, moved)), k_r its
/// stiffness and `moved` the greatest |Bu|; of a gap or slip that over k_r; but at
/// least force_error, by which multipliers may be wrong. A row that touches with no force is in weak
/// contact. So are rows of other laws at the end of what they can bear.
/// Throws InputError, naming the node, where force_error alone makes nothing of a force, gap or slip, where friction is about to slip or stick (‖λ_t‖ is the bound, the slip nothing; of
/// Coulomb's also weak contact), and where a spring with two stiffnesses bears nothing: the derivative is then not one of
/// a quadratic program.
LawDerivative law_derivative(const problem::Problem& problem, const problem::State& state, double touching, double force_error);

}  // namespace dotyk::shape

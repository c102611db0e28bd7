#pragma once

#include <string>

#include "algebra/types.hpp"
#include "base/monitor.hpp"
#include "solver/core/method.hpp"

namespace dotyk::fclib {

/// A frictional contact problem in the form of the FCLIB collection. Contact k has d = dimension components
/// (N, T or N, T1, T2) in rows d·k …; u is the relative velocity, r the impulse or force, and
///   u = W r + q,   0 ≤ r_N ⊥ u_N ≥ 0,   ‖r_T‖ ≤ μ r_N, with r_T = −μ r_N u_T/‖u_T‖ where u_T ≠ 0.
/// With û = u + μ‖u_T‖ e_N (De Saxcé) that is: r ∈ K, û ∈ K*, r·û = 0, K = {‖r_T‖ ≤ μ r_N}.
struct ContactProblem {
  std::string name;         ///< the file's, without folder
  std::string title, description;
  /// local: W and q are the file's own. global: M v = H r + f, u = Hᵀ v + w, so that W = Hᵀ M⁻¹ H and
  /// q = Hᵀ M⁻¹ f + w.
  enum class Kind { local, global } kind = Kind::local;
  int dimension = 3;        ///< of space, and components a contact: 2 or 3
  algebra::DenseMatrix W;   ///< rows × rows, as stored: not symmetric where the file's is not
  algebra::Vector q;        ///< rows
  algebra::Vector mu;       ///< contacts
  algebra::SparseMatrix M;  ///< global: unknowns × unknowns, both triangles, as stored; else 0 × 0
  algebra::SparseMatrix H;  ///< global: unknowns × rows
  algebra::Vector f, w;     ///< global: unknowns; rows

  /// W is made of the symmetric part of M: the file's own is unsymmetric by less than 1e-6, its rounding.
  bool symmetrised = false;

  int contacts() const { return static_cast<int>(mu.size()); }
  int rows() const { return dimension * contacts(); }
  int unknowns() const { return kind == Kind::global ? static_cast<int>(f.size()) : rows(); }
};

/// The frictional contact problem in a file: HDF5 as FCLIB writes it (groups fclib_local and fclib_global), or the
/// plain text that siconos prints (FC2D, FC3D, GFC2D, GFC3D). Which it is, is seen from its content. A global
/// problem comes condensed. Throws InputError naming the file and what is wrong with it, or why its problem is
/// not treated (rolling friction; equations beside the contacts); std::runtime_error for HDF5 where dotyk was built
/// without it.
ContactProblem read(const std::string& file, Monitor& monitor);

constexpr int kMost = 10'000'000;  ///< rows, columns, entries: beyond it a count is a mistake

/// One format each, neither checked nor condensed.
ContactProblem read_hdf5(const std::string& file, Monitor& monitor);
ContactProblem read_text(const std::string& file);

/// Throws InputError naming the problem where sizes do not fit together, a number is not finite, or a μ is
/// negative.
void check(const ContactProblem& problem);

/// Fills W and q of a global problem, by sparse Cholesky, or by LU where M is not symmetric positive definite.
/// An M that is unsymmetric by less than 1e-6 is taken for a symmetric one stored with seven digits: in soft
/// directions of a stiff body that rounding would be many per cent of W. Throws InputError where M is singular, Interrupted where the monitor asks to stop.
void condense(ContactProblem& problem, Monitor& monitor);

/// max |A − Aᵀ| / max |A| of the matrix stored, W or M; 0 where it is empty.
double unsymmetry(const ContactProblem& problem);

/// How many singular values of W exceed 1e-10 of the greatest.
int rank_of_W(const ContactProblem& problem);

/// The point of the cone {‖r_T‖ ≤ μ r_N} nearest to y = (y_N, y_T), 2 or 3 components.
Eigen::VectorXd project_cone(const Eigen::Ref<const Eigen::VectorXd>& y, double mu);

/// What a contact force r says of the problem.
struct Measure {
  algebra::Vector u;      ///< W r + q
  /// ‖r − P_K(r − ρ û)‖ / ‖r‖ (the numerator alone where r = 0), ρ = 1/max W_ii: the natural map with û = u + μ‖u_T‖ e_N.
  double residual = 0;
  /// Where r − ρ û lies: with u and r exact, open is r = 0; stick is u = 0; slip the rest.
  int open = 0, stick = 0, slip = 0;
};
Measure measure(const ContactProblem& problem, const algebra::Vector& r);

struct Result {
  /// As the method ended, its own residual, reason and history; first the normal rows of all contacts, then their
  /// tangential ones.
  solver::Result iteration;
  algebra::Vector r;  ///< rows of the contact problem
  Measure measure;    ///< of r
};
/// As rows under laws, unilateral and Coulomb's: λ = r, x = −u = x₀ − Wλ, x₀ = −q.
Result solve(const ContactProblem& problem, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::fclib

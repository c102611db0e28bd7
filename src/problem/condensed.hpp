#pragma once

#include <optional>
#include <vector>

#include "algebra/direct/condensation.hpp"
#include "base/monitor.hpp"
#include "problem/rigid_motions.hpp"

namespace dotyk::problem {

/// Seconds of the steps of a solve; `motions`: rigid motions, whether the load is carried, and which of them the solution leaves free.
/// `total` is set by the caller that owns the whole.
struct Clock {
  double assembly = 0, motions = 0, ordering = 0, factor = 0, iterate = 0, recover = 0, total = 0;
  /// Adds what another solve took, from motions to recover.
  void add_solve(const Clock& other) {
    motions += other.motions, ordering += other.ordering, factor += other.factor, iterate += other.iterate, recover += other.recover;
  }
};

/// Bytes of the dense matrices of so many rows that are held at a time: W, a block's share, its factor.
inline double dense_bytes(double rows) { return 3 * 8 * rows * rows; }

/// One block condensed onto the unknowns Γ that rows act on.
struct CondensedBlock {
  algebra::Condensation condensation;
  algebra::SparseRows rows;  ///< B on Γ, rows × |Γ|
  algebra::Vector load;      ///< condensed, once taken
  int first_unknown, size;
  void take_load(const algebra::Vector& f) { load = condensation.condense(f); }
};

/// Orders all blocks, factors them by factor_in_threads() and condenses them, without their loads. Adds its times to `clock`. Throws InputError if a block
/// is not held, SingularStiffness as said there.
std::vector<CondensedBlock> condense(const Problem& problem, algebra::Ordering ordering, Clock& clock, Monitor& monitor);

/// What condensing takes, as the orderings predict; `bytes` with those of dense_bytes().
struct CondensingWork {
  double flops = 0, bytes = 0;
};
CondensingWork work_of_condensing(const Problem& problem);

/// The problem on its rows alone. With the unknowns off the contact boundary eliminated (TR965 (1.52)–(1.69)),
///   x = Bu − c = x₀ − W λ + N α,     Nᵀ λ = e,
/// W = Σ_b B M⁻¹ Bᵀ dense, N = B R (R: rigid modes of every block, α their amounts), e = Rᵀ f. Without a kernel W is the Delassus operator
/// B K⁻¹ Bᵀ and x₀ the jump of the unconstrained solution. Motions that no row notices are left out of N, α and e: recover() gives the
/// displacement of least norm among those that differ by them.
class CondensedProblem {
 public:
  /// Orders, factors and condenses every block once; adds its times to `clock`. Throws InputError where a block is not held.
  CondensedProblem(const Problem& problem, const RigidMotions& rigid, algebra::Ordering ordering,
                   Clock& clock, Monitor& monitor);
  /// Takes another f and c, of a problem with the same K and B; `rigid` are its motions. What was factored stays.
  void set_load(const Problem& problem, const RigidMotions& rigid);
  /// Adds rows by forward sweeps with the present factors. `grown` has the same K; its row place[k] is row k of this problem; `rigid` are its rigid motions.
  /// Each call sweeps all rows but those of the constructor. Returns false, and changes nothing, if factoring again is less work, if memory is short, or if
  /// digits would be lost (Condensation::are_far()).
  bool extend(const Problem& grown, const RigidMotions& rigid, const std::vector<int>& place, Clock& clock, Monitor& monitor);
  /// Given as it is: W (rows × rows, positive semidefinite; symmetric, but that methods which need it say so) and
  /// x₀, no rigid motions, and no displacements to recover.
  CondensedProblem(algebra::DenseMatrix W, algebra::Vector x0);
  /// The same with a spring in each row, pressed by λ − centre: x = x₀ − Wλ − compliance (λ − centre) + Nα.
  /// Without displacements to recover.
  CondensedProblem softened(const algebra::Vector& compliance, const algebra::Vector& centre) const;

  /// The same about a state of multipliers λ_c, amounts α_c and displacements u: x = (Bu − c) − W(λ − λ_c) + N(α − α_c). Near it there are no great terms that
  /// cancel, as there are in x₀ − Wλ where bodies are soft without contact. Without displacements to recover.
  CondensedProblem centred(const Problem& problem, const algebra::Vector& lambda, const algebra::Vector& alpha, const algebra::Vector& u) const;

  int rows() const { return static_cast<int>(x0_.size()); }
  int unknowns() const { return unknowns_; }
  int kernel_size() const { return static_cast<int>(e_.size()); }
  const algebra::DenseMatrix& W() const { return W_; }
  const algebra::Vector& x0() const { return x0_; }  ///< of one that is centred its jump there
  const algebra::DenseMatrix& N() const { return N_; }  ///< rows × kernel_size
  const algebra::Vector& e() const { return e_; }

  algebra::Vector jump(const algebra::Vector& lambda, const algebra::Vector& alpha) const;
  /// By row, how far rounding may put that off.
  algebra::Vector rounding(const algebra::Vector& lambda, const algebra::Vector& alpha) const;
  /// All unknowns, from the multipliers and the amounts of rigid motion: one backward sweep a block; after extend() a forward sweep as well.
  algebra::Vector recover(const algebra::Vector& lambda, const algebra::Vector& alpha) const;

  /// The displacement K⁻¹f + Rα under other forces f (unknowns), by a generalised inverse for free blocks, with amounts α of rigid motions.
  algebra::Vector response(const algebra::Vector& f, const algebra::Vector& alpha) const;

  double factor_bytes() const;
  std::string ordering() const;

 private:
  struct Part : CondensedBlock {
    int first_mode;
    algebra::SparseRows all_rows = {};  ///< B on all unknowns of the block, set by extend(): added rows may act off Γ
    algebra::Vector f = {};             ///< the load, set with all_rows
  };
  void add(CondensedBlock block);
  void set_motions(const Problem& problem, const RigidMotions& rigid);
  /// Puts together what `of` makes of each part and its rigid motion on Γ.
  template <class Of>
  algebra::Vector together(const algebra::Vector& alpha, const Of& of) const;

  std::vector<Part> parts_;
  std::vector<int> first_rows_;  ///< those of the constructor, which Γ was made for
  algebra::DenseMatrix W_, N_;
  algebra::Vector x0_, e_;
  algebra::Vector centre_, centre_motion_, rounding_;  ///< λ_c, α_c and rounding() there; empty: none
  algebra::SparseMatrix noticed_;    ///< basis of the motions that rows notice: modes × kernel_size
  algebra::SparseMatrix unnoticed_;  ///< orthonormal displacements that no row notices: unknowns × count
  int unknowns_ = 0, modes_ = 0;
};

/// Condenses problems that differ only in f and c, or that have more rows than the one before. The first is ordered, factored and condensed; the
/// following take over its factors and W.
class Condenser {
 public:
  /// The result is valid until the next call. Throws InputError if the number of rows or unknowns has changed without a call of grow().
  const CondensedProblem& condense(const Problem& problem, const RigidMotions& rigid, algebra::Ordering ordering,
                                   Clock& clock, Monitor& monitor);
  /// Announces a problem with more rows: its row place[k] is row k of the one before.
  void grow(std::vector<int> place) { place_ = std::move(place); }
  bool holds() const { return condensed_.has_value(); }  ///< a factor

 private:
  std::optional<CondensedProblem> condensed_;
  std::optional<std::vector<int>> place_;
};

}  // namespace dotyk::problem

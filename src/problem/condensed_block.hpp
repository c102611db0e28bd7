#pragma once

#include "algebra/direct/condensation.hpp"
#include "base/monitor.hpp"
#include "problem/problem.hpp"

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

/// Orders, factors and condenses a block, without its load; adds its times to `clock`. Throws InputError where the block
/// is not held (its name, a node).
CondensedBlock condense(const Problem& problem, const Block& block, algebra::Ordering ordering, Clock& clock,
                        Monitor& monitor);

/// What condensing takes, as the orderings predict; `bytes` with those of dense_bytes().
struct CondensingWork {
  double flops = 0, bytes = 0;
};
CondensingWork work_of_condensing(const Problem& problem);

}  // namespace dotyk::problem

#pragma once

#include <functional>

#include "base/monitor.hpp"

namespace dotyk::algebra {

/// While it lives, a Cholesky::factor on this thread, and what dense.hpp has for large matrices, ends early by throwing
/// Interrupted once the monitor asks to stop: within a second or so. CHOLMOD and LAPACK cannot be asked; but each of their steps
/// calls BLAS, whose names dgemm_, dtrsm_, dsyrk_ and dpotrf_ this program takes: they pass on to OpenBLAS, large ones in pieces,
/// unless the monitor asks to stop, when dpotrf_ reports a pivot that is not positive, which ends CHOLMOD's loop.
/// The monitor is asked on this thread, often.
class StopFactoring {
 public:
  explicit StopFactoring(Monitor& monitor);
  ~StopFactoring();
  StopFactoring(const StopFactoring&) = delete;
  StopFactoring& operator=(const StopFactoring&) = delete;

 private:
  Monitor* before_;
};

/// Throws Interrupted where the monitor of the StopFactoring that lives on this thread asks to stop: for loops of this program's own.
void ask_to_stop();

/// For those functions: such a library is at work in `work`, which throws nothing. Throws Interrupted where it was ended early.
void stoppable(const std::function<void()>& work);

}  // namespace dotyk::algebra

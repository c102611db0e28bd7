#pragma once

#include "base/monitor.hpp"

namespace dotyk::algebra {

/// While it lives, a Cholesky::factor on this thread ends early, by throwing Interrupted, once the monitor asks to stop:
/// within one product of matrices, a second at most for some 1e5 unknowns in space. CHOLMOD itself cannot be asked; but
/// each of its steps calls BLAS, whose names dgemm_, dsyrk_ and dpotrf_ this program takes: they pass on to OpenBLAS
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

/// For Cholesky::factor: lives while CHOLMOD factors.
class StoppableFactoring {
 public:
  StoppableFactoring();
  ~StoppableFactoring();
  StoppableFactoring(const StoppableFactoring&) = delete;
  StoppableFactoring& operator=(const StoppableFactoring&) = delete;

  /// Was it ended early? Its numbers mean nothing then.
  bool stopped() const;
};

}  // namespace dotyk::algebra

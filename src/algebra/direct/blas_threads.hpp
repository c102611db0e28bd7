#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace dotyk::algebra {

/// OpenBLAS takes 128 MiB for itself at its first product, and asks for them for ever where it does not get them
/// (ulimit -v): they are taken here, once, or InputError is thrown. The classes below call it.
void reserve_blas_buffer();

/// Would a BlasThreads of so many flops use more than one thread?
bool blas_shares_out(double flops);

/// While it lives, BLAS calls use all threads it started with (OPENBLAS_NUM_THREADS, else the cores) if the work ahead is worth it, else
/// one; afterwards one again. In many small products threads wait for each other (measured: 1.3 s on two against 0.85 s on one, a plane mesh of
/// 262 656 unknowns). CHOLMOD's own loops run on one thread from here on: threads would take half more time (0.52 s against 0.30 s, 100 000 unknowns
/// of a plate), and end the program where a limit of the address space leaves no room for their stacks.
class BlasThreads {
 public:
  explicit BlasThreads(double flops);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;
};

/// While it lives BLAS uses one thread whatever BlasThreads asks for: for work that is itself shared out to threads.
/// Made and ended outside that work.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  /// How many threads can do that work: one a core; fewer where a limit of the address space leaves no room for OpenBLAS's
  /// buffer of each, which is taken here.
  int workers() const;
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// OpenBLAS has kernels for each kind of processor, and takes those of 2004 (SSE) for one that it does not know: that of Debian 12 (0.3.21) for all of Intel's
/// since 2023. There this chooses the kernels for AVX2 or AVX-512: a factor of a cube of 24³ cells takes 1.8 s in place of 5.0. Where the user has
/// set OPENBLAS_CORETYPE, or OpenBLAS knows the processor, it does nothing. Before the first product; not from several threads.
void choose_blas_kernels();

/// Calls factor(k) once for every k; the calls with most work begin first. `flops[k]`: the work of a call. The calls run in several threads, and BLAS
/// uses one thread in each. They run one after another, and BLAS may use several threads, if there is only one call, if all of them together are small,
/// or if one call has most of the work and is large enough for several threads.
///
/// Before each call the monitor is asked whether to stop, and is told phase(k, n): this is the n-th call, from 1. StopFactoring holds during the call.
/// A call must not touch what another one writes.
void factor_in_threads(const std::vector<double>& flops, const std::function<std::string(int k, int n)>& phase, Monitor& monitor,
                       const std::function<void(int)>& factor);

}  // namespace dotyk::algebra

#pragma once

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

}  // namespace dotyk::algebra

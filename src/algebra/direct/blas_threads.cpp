#include "algebra/direct/blas_threads.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <vector>

#include "algebra/direct/blas_kernels.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int count);
void omp_set_max_active_levels(int levels);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace dotyk::algebra {
namespace {

/// Above this many flops in one piece of work its products are large enough to share out.
constexpr double kWorthSharing = 1e11;

std::atomic<int> held_to_one{0};  ///< how many OneBlasThread live

int all_threads() {
  static const int count = openblas_get_num_threads();  // as the program was started
  return count;
}

}  // namespace

void reserve_blas_buffer() {
  static const bool taken = [] {
    choose_blas_kernels();
    require_memory(160e6, "the first product of matrices");  // 128 MiB, and what the allocator takes beside them
    double a = 1;
    const int n = 1;
    int info = 0;
    dpotrf_("L", &n, &a, &n, &info);
    return info == 0;
  }();
  static_cast<void>(taken);
}

bool blas_shares_out(double flops) { return all_threads() > 1 && held_to_one == 0 && flops > kWorthSharing; }  // counted before the first change

BlasThreads::BlasThreads(double flops) {
  reserve_blas_buffer();
  omp_set_max_active_levels(0);  // of this thread: its loops stay on it
  if (held_to_one > 0) return;
  openblas_set_num_threads(blas_shares_out(flops) ? all_threads() : 1);
}

BlasThreads::~BlasThreads() {
  if (held_to_one == 0) openblas_set_num_threads(1);
}

OneBlasThread::OneBlasThread() {
  reserve_blas_buffer();
  all_threads();  // counted before the first change
  openblas_set_num_threads(1);
  ++held_to_one;
}

OneBlasThread::~OneBlasThread() { --held_to_one; }

int OneBlasThread::workers() const {
  constexpr double kBuffer = 140e6, kOther = 64e6;  // of the work itself
  static std::mutex taking;
  static int taken = 1;
  if (std::isinf(address_space_left())) return cores();
  const std::lock_guard lock(taking);
  static const auto take = reinterpret_cast<void* (*)(int)>(dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  static const auto give = reinterpret_cast<void (*)(void*)>(dlsym(RTLD_DEFAULT, "blas_memory_free"));
  std::vector<void*> held;
  while (take && give && static_cast<int>(held.size()) < cores() &&
         (static_cast<int>(held.size()) < taken || address_space_left() > kBuffer + kOther))
    held.push_back(take(0));
  for (void* one : held) give(one);
  return taken = std::max<int>(taken, held.size());
}

}  // namespace dotyk::algebra

#include "algebra/direct/blas_threads.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <numeric>
#include <string_view>

#include "algebra/direct/stop_factoring.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int count);
void omp_set_max_active_levels(int levels);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}
extern "C" char* openblas_get_corename();

namespace dotyk::algebra {
namespace {

/// Above this many flops in one piece of work its products are large enough to share out.
constexpr double kWorthSharing = 1e11;

std::atomic<int> held_to_one{0};  ///< how many OneBlasThread live

int all_threads() {
  static const int count = openblas_get_num_threads();  // as the program was started
  return count;
}

/// OpenBLAS's name of the best kernels for this processor; null where it has no AVX2.
const char* kernels_by_features() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

/// Below so many flops together threads are not worth their beginning.
constexpr double kWorthThreads = 1e8;
/// If one call has more than this share of the work, it is faster to let BLAS use several threads, one call after another.
constexpr double kMost = 2.0 / 3;

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

void choose_blas_kernels() {
  constexpr const char* kVariable = "OPENBLAS_CORETYPE";
  const char* better = kernels_by_features();
  if (!better || std::getenv(kVariable) || std::string_view(openblas_get_corename()) != "Prescott") return;
  // What OpenBLAS does when it is loaded and unloaded: not in its header.
  const auto leave = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"));
  const auto choose = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init"));
  if (!leave || !choose) return;
  setenv(kVariable, better, 1);
  leave(), choose();
  unsetenv(kVariable);
}

void factor_in_threads(const std::vector<double>& flops, const std::function<std::string(int k, int n)>& phase, Monitor& monitor,
                       const std::function<void(int)>& factor) {
  if (flops.empty()) return;
  std::vector<int> order(flops.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return flops[a] > flops[b]; });
  std::mutex watching;
  int begun = 0;
  const auto one = [&](int k) {
    {
      const std::lock_guard lock(watching);
      monitor.check();
      monitor.phase(phase(order[k], ++begun));
    }
    const StopFactoring stop(monitor);
    factor(order[k]);
  };
  const double total = std::accumulate(flops.begin(), flops.end(), 0.0), greatest = flops[order.front()];
  if (order.size() == 1 || total < kWorthThreads || (greatest > kMost * total && blas_shares_out(greatest))) {
    for (std::size_t k = 0; k < order.size(); ++k) one(static_cast<int>(k));
    return;
  }
  const OneBlasThread single;
  parallel_for(static_cast<int>(order.size()), one, single.workers());
}

}  // namespace dotyk::algebra

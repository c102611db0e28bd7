#include "algebra/blas_threads.hpp"

#include <atomic>

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int count);
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

BlasThreads::BlasThreads(double flops) {
  if (held_to_one > 0) return;
  const int all = all_threads();
  openblas_set_num_threads(flops > kWorthSharing ? all : 1);
}

BlasThreads::~BlasThreads() {
  if (held_to_one == 0) openblas_set_num_threads(1);
}

OneBlasThread::OneBlasThread() {
  all_threads();  // counted before the first change
  openblas_set_num_threads(1);
  ++held_to_one;
}

OneBlasThread::~OneBlasThread() { --held_to_one; }

}  // namespace dotyk::algebra

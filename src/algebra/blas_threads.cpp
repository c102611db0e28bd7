#include "algebra/blas_threads.hpp"

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int count);
}

namespace dotyk::algebra {
namespace {

/// Above this many flops in one piece of work its products are large enough to share out.
constexpr double kWorthSharing = 1e11;

int all_threads() {
  static const int count = openblas_get_num_threads();  // as the program was started
  return count;
}

}  // namespace

BlasThreads::BlasThreads(double flops) {
  const int all = all_threads();
  openblas_set_num_threads(flops > kWorthSharing ? all : 1);
}

BlasThreads::~BlasThreads() { openblas_set_num_threads(1); }

}  // namespace dotyk::algebra

#include "algebra/stop_factoring.hpp"

#include <dlfcn.h>

namespace dotyk::algebra {
namespace {

thread_local Monitor* watcher = nullptr;
thread_local bool factoring = false, ended = false;

/// Once true it stays so until the factorisation is over: what was left out is missing.
bool ends() {
  if (factoring && !ended && watcher && watcher->stop()) ended = true;
  return factoring && ended;
}

/// OpenBLAS's own function of the name that is taken here.
template <class Function>
Function* passed_on(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

StopFactoring::StopFactoring(Monitor& monitor) : before_(watcher) { watcher = &monitor; }
StopFactoring::~StopFactoring() { watcher = before_; }

StoppableFactoring::StoppableFactoring() {
  ended = false;
  factoring = true;
}
StoppableFactoring::~StoppableFactoring() { factoring = ended = false; }
bool StoppableFactoring::stopped() const { return ended; }

}  // namespace dotyk::algebra

using dotyk::algebra::ends;
using dotyk::algebra::passed_on;

extern "C" {

__attribute__((visibility("default"))) void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k,
                                                   const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                                                   const double* beta, double* c, const int* ldc) {
  static const auto product = passed_on<decltype(dgemm_)>("dgemm_");
  if (!ends()) product(trans_a, trans_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc);
}

__attribute__((visibility("default"))) void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha,
                                                   const double* a, const int* lda, const double* beta, double* c, const int* ldc) {
  static const auto product = passed_on<decltype(dsyrk_)>("dsyrk_");
  if (!ends()) product(uplo, trans, n, k, alpha, a, lda, beta, c, ldc);
}

__attribute__((visibility("default"))) void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info) {
  static const auto factor = passed_on<decltype(dpotrf_)>("dpotrf_");
  if (ends()) *info = 1;
  else factor(uplo, n, a, lda, info);
}
}

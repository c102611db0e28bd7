#include "algebra/direct/stop_factoring.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dotyk::algebra {
namespace {

thread_local Monitor* watcher = nullptr;
thread_local bool factoring = false, ended = false;

/// Once true it stays so until the factorisation is over: what was left out is missing.
bool ends() {
  if (factoring && !ended && watcher && watcher->stop()) ended = true;
  return factoring && ended;
}

/// Multiplications between two questions: a second at most.
constexpr double kMostMultiplications = 1e10;
/// Columns of a triangular factor made at a time.
constexpr int kPanel = 1024;

/// How many of n columns, each of so many multiplications, to take at a time: all, unless somebody may ask to stop.
int panel(int n, double each) {
  if (!factoring || !watcher || n * each <= 2 * kMostMultiplications) return n;
  return std::max(16, static_cast<int>(kMostMultiplications / each));
}

/// OpenBLAS's own function of the name that is taken here.
template <class Function>
Function* passed_on(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

StopFactoring::StopFactoring(Monitor& monitor) : before_(watcher) { watcher = &monitor; }
StopFactoring::~StopFactoring() { watcher = before_; }

void ask_to_stop() {
  if (watcher) watcher->check();
}

void stoppable(const std::function<void()>& work) {
  factoring = true;
  work();
  factoring = false;
  if (std::exchange(ended, false)) throw Interrupted();
}

}  // namespace dotyk::algebra

using dotyk::algebra::ends;
using dotyk::algebra::kPanel;
using dotyk::algebra::panel;
using dotyk::algebra::passed_on;

extern "C" {

__attribute__((visibility("default"))) void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k,
                                                   const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                                                   const double* beta, double* c, const int* ldc) {
  static const auto product = passed_on<decltype(dgemm_)>("dgemm_");
  const int wide = std::max(1, panel(*n, 1.0 * *m * *k));
  for (int j = 0; (j == 0 || j < *n) && !ends(); j += wide) {
    const int columns = std::min(wide, *n - j);
    product(trans_a, trans_b, m, &columns, k, alpha, a, lda, b + (*trans_b == 'N' ? std::ptrdiff_t(j) * *ldb : j), ldb, beta,
            c + std::ptrdiff_t(j) * *ldc, ldc);
  }
}

__attribute__((visibility("default"))) void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
                                                   const double* alpha, const double* a, const int* lda, double* b, const int* ldb) {
  static const auto sweep = passed_on<decltype(dtrsm_)>("dtrsm_");
  const int wide = std::max(1, *side == 'L' ? panel(*n, 0.5 * *m * *m) : *n);
  for (int j = 0; (j == 0 || j < *n) && !ends(); j += wide) {
    const int columns = std::min(wide, *n - j);
    sweep(side, uplo, trans, diag, m, &columns, alpha, a, lda, b + std::ptrdiff_t(j) * *ldb, ldb);
  }
}

__attribute__((visibility("default"))) void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha,
                                                   const double* a, const int* lda, const double* beta, double* c, const int* ldc) {
  static const auto product = passed_on<decltype(dsyrk_)>("dsyrk_");
  const int wide = std::max(1, *uplo == 'L' ? panel(*n, 1.0 * *n * *k) : *n);
  const auto rows = [&](int j) { return a + (*trans == 'N' ? j : std::ptrdiff_t(j) * *lda); };
  for (int j = 0; (j == 0 || j < *n) && !ends(); j += wide) {
    const int columns = std::min(wide, *n - j), below = *n - j - columns;
    double* corner = c + j + std::ptrdiff_t(j) * *ldc;
    product(uplo, trans, &columns, k, alpha, rows(j), lda, beta, corner, ldc);
    if (below > 0)
      dgemm_(*trans == 'N' ? "N" : "T", *trans == 'N' ? "T" : "N", &below, &columns, k, alpha, rows(j + columns), lda, rows(j), lda, beta,
             corner + columns, ldc);
  }
}

__attribute__((visibility("default"))) void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info) {
  static const auto factor = passed_on<decltype(dpotrf_)>("dpotrf_");
  const int wide = *uplo == 'L' && panel(*n, 1.0 / 3 * *n * *n) < *n ? kPanel : *n;
  if (wide == *n) {
    if (ends()) *info = 1;
    else factor(uplo, n, a, lda, info);
    return;
  }
  const double one = 1, minus_one = -1;
  for (int j = 0; j < *n; j += wide) {  // columns by columns, each less what those before it make
    const int columns = std::min(wide, *n - j), below = *n - j - columns;
    double *left = a + j, *corner = left + std::ptrdiff_t(j) * *lda;
    if (j > 0) dsyrk_("L", "N", &columns, &j, &minus_one, left, lda, &one, corner, lda);
    if (j > 0 && below > 0) dgemm_("N", "T", &below, &columns, &j, &minus_one, left + columns, lda, left, lda, &one, corner + columns, lda);
    dpotrf_("L", &columns, corner, lda, info);
    if (*info != 0) {
      *info += j;
      return;
    }
    if (below > 0) dtrsm_("R", "L", "T", "N", &below, &columns, &one, corner, lda, corner + columns, lda);
  }
}
}

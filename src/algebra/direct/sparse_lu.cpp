#include "algebra/direct/sparse_lu.hpp"

#include <umfpack.h>

#include <new>
#include <stdexcept>
#include <string>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"

namespace dotyk::algebra {

namespace {

void check(int status, const char* step) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status < 0)
    throw std::runtime_error(std::string(step) + " failed inside UMFPACK (status " +
                             std::to_string(status) + ")");
}

}  // namespace

SparseLu::SparseLu(const SparseMatrix& a) : a_(a) {
  const int n = static_cast<int>(a.rows());
  if (n == 0) return;
  reserve_blas_buffer();
  void *symbolic = nullptr, *numeric = nullptr;
  int status = umfpack_di_symbolic(n, n, a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), &symbolic, nullptr, nullptr);
  check(status, "LU analysis");
  double info[UMFPACK_INFO];
  stoppable([&] {
    status = umfpack_di_numeric(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), symbolic, &numeric, nullptr, info);
    umfpack_di_free_symbolic(&symbolic);
    numeric_ = std::shared_ptr<void>(numeric, [](void* factors) { umfpack_di_free_numeric(&factors); });
  });
  check(status, "LU factorisation");
  // The ratio of least to greatest pivot: rounding leaves a dependent row some 1e-16.
  singular_ = status == UMFPACK_WARNING_singular_matrix || info[UMFPACK_RCOND] < 1e-14;
}

Vector SparseLu::solve(const Vector& b) const {
  Vector x(b.size());
  if (x.size() == 0) return x;
  const int status = umfpack_di_solve(UMFPACK_A, a_.outerIndexPtr(), a_.innerIndexPtr(), a_.valuePtr(), x.data(), b.data(), numeric_.get(),
                                      nullptr, nullptr);
  check(status, "LU solve");
  return x;
}

}  // namespace dotyk::algebra

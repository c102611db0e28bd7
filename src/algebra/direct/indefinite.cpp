#include "algebra/direct/indefinite.hpp"

#include <umfpack.h>

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/cholmod_handle.hpp"
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

struct QuasiDefinite::Implementation {
  CholmodCommon common;
  cholmod_factor* factor = nullptr;  ///< null for a matrix without unknowns
  ~Implementation() { cholmod_free_factor(&factor, common.get()); }

  double pivot(std::size_t k) const {
    return static_cast<double*>(factor->x)[static_cast<int*>(factor->p)[k]];
  }

  Vector sweep(int system, const Vector& b) { return solution(system, factor, b, common); }
};

QuasiDefinite::QuasiDefinite(const SparseMatrix& lower) : it_(std::make_unique<Implementation>()) {
  if (lower.rows() == 0) return;
  cholmod_common* c = it_->common.get();
  c->supernodal = CHOLMOD_SIMPLICIAL;
  c->final_ll = false;
  c->quick_return_if_not_posdef = false;
  c->nmethods = 1;
  c->method[0].ordering = CHOLMOD_AMD;
  c->postorder = true;
  cholmod_sparse a = view(lower);
  it_->factor = cholmod_analyze(&a, c);
  it_->common.check("symbolic factorisation");
}

QuasiDefinite::~QuasiDefinite() = default;
QuasiDefinite::QuasiDefinite(QuasiDefinite&&) noexcept = default;
QuasiDefinite& QuasiDefinite::operator=(QuasiDefinite&&) noexcept = default;

bool QuasiDefinite::factor(const SparseMatrix& lower) {
  if (!it_->factor) return true;
  cholmod_sparse a = view(lower);
  cholmod_factorize(&a, it_->factor, it_->common.get());
  if (it_->common.get()->status == CHOLMOD_NOT_POSDEF) return false;
  it_->common.check("factorisation");
  for (std::size_t k = 0; k < it_->factor->n; ++k)
    if (!std::isfinite(it_->pivot(k)) || it_->pivot(k) == 0) return false;
  return true;
}

Vector QuasiDefinite::solve(const Vector& b) const { return it_->factor ? it_->sweep(CHOLMOD_A, b) : b; }

int QuasiDefinite::negative_pivots() const {
  int count = 0;
  for (std::size_t k = 0; it_->factor && k < it_->factor->n; ++k) count += it_->pivot(k) < 0;
  return count;
}

Vector QuasiDefinite::negative_direction() const {
  for (std::size_t k = 0; it_->factor && k < it_->factor->n; ++k)
    if (it_->pivot(k) < 0) {
      Vector e = Vector::Zero(static_cast<Eigen::Index>(it_->factor->n));
      e[static_cast<Eigen::Index>(k)] = 1;
      return it_->sweep(CHOLMOD_Pt, it_->sweep(CHOLMOD_Lt, e));
    }
  return {};
}

}  // namespace dotyk::algebra

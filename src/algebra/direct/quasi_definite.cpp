#include "algebra/direct/quasi_definite.hpp"

#include <cmath>

#include "algebra/direct/cholmod_handle.hpp"

namespace dotyk::algebra {

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

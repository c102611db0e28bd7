#pragma once

// CHOLMOD types with owners. Included by this room's source files only.

#include <cholmod.h>

#include <new>
#include <stdexcept>
#include <string>

#include "algebra/types.hpp"
#include "base/error.hpp"

namespace dotyk::algebra {

/// cholmod_common with this project's settings: supernodal LLᵀ, no messages.
class CholmodCommon {
 public:
  CholmodCommon() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = true;
    common_.quick_return_if_not_posdef = true;
    common_.error_handler = nullptr;
    // Merge small supernodes more eagerly than CHOLMOD's 4/16/48, 0.8/0.1/0.05: the factor
    // grows by a fifth in the plane and a tenth in space, its time falls by 5 to 10 %.
    common_.nrelax[0] = 8, common_.nrelax[1] = 32, common_.nrelax[2] = 96;
    common_.zrelax[0] = 0.8, common_.zrelax[1] = 0.2, common_.zrelax[2] = 0.1;
  }
  ~CholmodCommon() { cholmod_finish(&common_); }
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;

  cholmod_common* get() { return &common_; }

  /// Throws what the last call reported: out of memory as std::bad_alloc.
  void check(const char* step) const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status == CHOLMOD_TOO_LARGE)
      throw InputError(std::string(step) + ": the factor has more than 2147483647 numbers, the most that CHOLMOD's indices of 32 bits reach: "
                       "dotyk.solver.multigrid{} needs no factor, or take fewer cells");
    if (common_.status < CHOLMOD_OK)
      throw std::runtime_error(std::string(step) + " failed inside CHOLMOD (status " +
                               std::to_string(common_.status) + ")");
  }

 private:
  cholmod_common common_;
};

/// Columns first … first + width − 1 of a supernodal L: in each the same `height` rows, the columns' own ones first.
struct Supernode {
  int first, width, height;
  const int* rows;
  const double* values;  ///< height × width

  Supernode(const cholmod_factor& f, std::size_t s) {
    if (!f.is_super) throw std::runtime_error("the factor is not supernodal");
    const int *super = static_cast<int*>(f.super), *pi = static_cast<int*>(f.pi);
    first = super[s], width = super[s + 1] - first, height = pi[s + 1] - pi[s];
    rows = static_cast<int*>(f.s) + pi[s];
    values = static_cast<double*>(f.x) + static_cast<int*>(f.px)[s];
  }
};

/// A view of a lower-triangular Eigen matrix as CHOLMOD sees it; no copy.
inline cholmod_sparse view(const SparseMatrix& lower) {
  cholmod_sparse a{};
  a.nrow = lower.rows();
  a.ncol = lower.cols();
  a.nzmax = lower.nonZeros();
  a.p = const_cast<int*>(lower.outerIndexPtr());
  a.i = const_cast<int*>(lower.innerIndexPtr());
  a.x = const_cast<double*>(lower.valuePtr());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = true;
  a.packed = true;
  return a;
}

/// What CHOLMOD's system (CHOLMOD_A: A x = b; CHOLMOD_L, …: a sweep) with a factor has for every column of b.
inline DenseMatrix solution(int system, cholmod_factor* factor, const DenseMatrix& b, CholmodCommon& common) {
  cholmod_dense in{};
  in.nrow = in.d = b.rows();
  in.ncol = b.cols();
  in.nzmax = b.size();
  in.x = const_cast<double*>(b.data());
  in.xtype = CHOLMOD_REAL;
  in.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* out = cholmod_solve(system, factor, &in, common.get());
  common.check("back substitution");
  DenseMatrix x = Eigen::Map<DenseMatrix>(static_cast<double*>(out->x), b.rows(), b.cols());
  cholmod_free_dense(&out, common.get());
  return x;
}

}  // namespace dotyk::algebra

#include "algebra/direct/reached_sweep.hpp"

#include <cstddef>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/cholmod_handle.hpp"
#include "algebra/direct/stop_factoring.hpp"

extern "C" {
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n, const double* alpha,
            const double* a, const int* lda, double* b, const int* ldb);
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha, const double* a, const int* lda,
            const double* b, const int* ldb, const double* beta, double* c, const int* ldc);
}

namespace dotyk::algebra {
namespace {

/// Columns first … first + width − 1 of L: dense below the diagonal in `height` rows.
struct Supernode {
  int first, width, height;
  const int* rows;
  const double* values;

  Supernode(const cholmod_factor& f, int s) {
    const int *super = static_cast<int*>(f.super), *pi = static_cast<int*>(f.pi);
    first = super[s], width = super[s + 1] - first, height = pi[s + 1] - pi[s];
    rows = static_cast<int*>(f.s) + pi[s];
    values = static_cast<double*>(f.x) + static_cast<int*>(f.px)[s];
  }
};

}  // namespace

ReachedSweep::ReachedSweep(const cholmod_factor& factor, const SparseRows& rows, const std::vector<int>& also)
    : factor_(factor), rows_(rows), place_(factor.n, -1) {
  const int count = static_cast<int>(factor.nsuper);
  std::vector<int> supernode(factor.n), position(factor.n);  // of a position; of an unknown
  for (int s = 0; s < count; ++s)
    for (int p = static_cast<int*>(factor.super)[s]; p < static_cast<int*>(factor.super)[s + 1]; ++p) supernode[p] = s;
  for (std::size_t p = 0; p < factor.n; ++p) position[static_cast<int*>(factor.Perm)[p]] = static_cast<int>(p);
  std::vector<char> reached(count, 0);
  const auto climb = [&](int p) {
    for (int s = supernode[p]; !reached[s];) {
      reached[s] = 1;
      const Supernode node(factor, s);
      if (node.height > node.width) s = supernode[node.rows[node.width]];
    }
  };
  for (const int p : also) climb(p);
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it) climb(position[it.col()]);
  for (int s = 0; s < count; ++s) {
    if (!reached[s]) continue;
    const Supernode node(factor, s);
    supernodes_.push_back(s);
    entries_ += static_cast<double>(node.width) * node.height;
    for (int p = node.first; p < node.first + node.width; ++p) {
      place_[p] = static_cast<int>(positions_.size());
      positions_.push_back(p);
    }
  }
}

DenseMatrix ReachedSweep::values() const {
  const int n = static_cast<int>(positions_.size()), k = static_cast<int>(rows_.rows());
  DenseMatrix Y = DenseMatrix::Zero(n, k), update;
  if (k == 0) return Y;
  std::vector<int> place_of_unknown(factor_.n);
  for (std::size_t p = 0; p < factor_.n; ++p) place_of_unknown[static_cast<int*>(factor_.Perm)[p]] = place_[p];
  for (int r = 0; r < k; ++r)
    for (SparseRows::InnerIterator it(rows_, r); it; ++it) Y(place_of_unknown[it.col()], r) += it.value();
  const BlasThreads threads(flops());
  const double one = 1, zero = 0;
  for (const int s : supernodes_) {
    ask_to_stop();
    const Supernode node(factor_, s);
    double* own = Y.data() + place_[node.first];
    dtrsm_("L", "L", "N", "N", &node.width, &k, &one, node.values, &node.height, own, &n);
    const int below = node.height - node.width;
    if (below == 0) continue;
    update.resize(below, k);
    dgemm_("N", "N", &below, &k, &node.width, &one, node.values + node.width, &node.height, own, &n, &zero, update.data(), &below);
    for (int j = 0; j < k; ++j)
      for (int i = 0; i < below; ++i) Y(place_[node.rows[node.width + i]], j) -= update(i, j);
  }
  return Y;
}

}  // namespace dotyk::algebra

#include "algebra/dense/tridiagonal.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>
#include <vector>

extern "C" void dstevr_(const char* jobz, const char* range, const int* n, double* d, double* e, const double* vl,
                        const double* vu, const int* il, const int* iu, const double* abstol, int* m, double* w,
                        double* z, const int* ldz, int* isuppz, double* work, const int* lwork, int* iwork,
                        const int* liwork, int* info);

namespace dotyk::algebra {

Eigenpairs all_eigenpairs(const Vector& diagonal, const Vector& off_diagonal) {
  Eigen::SelfAdjointEigenSolver<DenseMatrix> e;
  e.computeFromTridiagonal(diagonal, off_diagonal);
  return {e.eigenvalues(), e.eigenvectors()};
}

Eigenpairs lowest_eigenpairs(Vector diagonal, Vector off_diagonal, int count) {
  const int n = static_cast<int>(diagonal.size());
  count = std::min(count, n);
  if (count <= 0) return {};
  if (!diagonal.allFinite() || !off_diagonal.allFinite()) throw std::runtime_error("tridiagonal eigenvalues: not finite");
  off_diagonal.conservativeResize(n);  // dstevr uses one more for itself
  off_diagonal[n - 1] = 0;
  Vector values(n), work(20 * n);
  DenseMatrix vectors(n, count);
  std::vector<int> support(2 * static_cast<std::size_t>(count)), integers(10 * static_cast<std::size_t>(n));
  const int first = 1, lwork = 20 * n, liwork = 10 * n;
  const double unused = 0;
  int found = 0, info = 0;
  dstevr_("V", "I", &n, diagonal.data(), off_diagonal.data(), &unused, &unused, &first, &count, &unused, &found,
          values.data(), vectors.data(), &n, support.data(), work.data(), &lwork, integers.data(), &liwork, &info);
  if (info != 0 || found < count) throw std::runtime_error("tridiagonal eigenvalues: dstevr failed");
  return {values.head(count), vectors};
}

}  // namespace dotyk::algebra

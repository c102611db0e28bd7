#include "program/mat_file.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "base/error.hpp"
#include "base/text.hpp"

#ifdef DOTYK_MATIO
#include <matio.h>
#endif

namespace dotyk::program {

#ifdef DOTYK_MATIO
namespace {

constexpr std::size_t kMost = 1 << 30;

/// Do columns and rows of the entries lie within the matrix, and the entries within the lists? The file alone says so.
bool sound(const mat_sparse_t& s, std::size_t rows, std::size_t columns) {
  if (s.njc != columns + 1 || !s.jc) return false;
  for (std::size_t j = 0; j < columns; ++j)
    if (s.jc[j] > s.jc[j + 1]) return false;
  const std::size_t count = s.jc[columns];
  if (count > s.nir || count > s.ndata || (count > 0 && (!s.ir || !s.data))) return false;
  for (std::size_t k = 0; k < count; ++k)
    if (s.ir[k] >= rows) return false;
  return true;
}

/// 1e20 less the rounding of a scaling.
constexpr double kInfinite = 0.99e20;

using Entries = std::vector<Eigen::Triplet<double>>;

class MatFile {
 public:
  explicit MatFile(const std::string& name) : name_(name), file_(Mat_Open(name.c_str(), MAT_ACC_RDONLY), &Mat_Close) {
    if (!file_) throw InputError("cannot read '" + name + "' as a MATLAB file");
  }

  /// The variable's size and its entries that are not zero. Absent: 0 × 0 where `optional`.
  Entries entries(const char* variable, int& rows, int& columns, bool optional = false) const {
    const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> v(Mat_VarRead(file_.get(), variable), &Mat_VarFree);
    rows = columns = 0;
    if (!v && optional) return {};
    if (!v) throw InputError("'" + name_ + "' has no variable '" + variable + "'; it must have P, q, A, l and u");
    if (v->rank != 2 || v->isComplex) fail(variable, "is not a real matrix");
    if (v->dims[0] > kMost || v->dims[1] > kMost) fail(variable, "is too large");
    rows = static_cast<int>(v->dims[0]), columns = static_cast<int>(v->dims[1]);
    Entries out;
    if (!v->data && rows > 0 && columns > 0) fail(variable, "has no entries in the file");
    if (rows == 0 || columns == 0) return out;
    if (v->class_type == MAT_C_SPARSE) {
      const auto* s = static_cast<const mat_sparse_t*>(v->data);
      if (!sound(*s, v->dims[0], v->dims[1])) fail(variable, "is damaged: its sparse entries do not fit its size");
      const auto* x = static_cast<const double*>(s->data);
      for (int j = 0; j < columns; ++j)
        for (auto k = s->jc[j]; k < s->jc[j + 1]; ++k)
          out.emplace_back(static_cast<int>(s->ir[k]), j, x[k]);
    } else if (v->class_type == MAT_C_DOUBLE) {
      if (v->data_type != MAT_T_DOUBLE) fail(variable, "is not stored as doubles");
      const auto* x = static_cast<const double*>(v->data);
      for (int j = 0; j < columns; ++j)
        for (int i = 0; i < rows; ++i)
          if (const double value = x[static_cast<std::size_t>(j) * rows + i]; value != 0) out.emplace_back(i, j, value);
    } else if (rows > 0 && columns > 0) {
      fail(variable, "is not a matrix of numbers");
    }
    return out;
  }

  Vector vector(const char* variable) const {
    int rows, columns;
    const Entries found = entries(variable, rows, columns);
    if (rows > 1 && columns > 1) fail(variable, "is not a vector");
    Vector v = Vector::Zero(static_cast<Eigen::Index>(rows) * columns);
    for (const auto& e : found) v[e.row() + e.col()] = e.value();
    return v;
  }

  [[noreturn]] void fail(const char* variable, const char* what) const {
    throw InputError("variable '" + std::string(variable) + "' of '" + name_ + "' " + what);
  }

 private:
  std::string name_;
  std::unique_ptr<mat_t, decltype(&Mat_Close)> file_;
};

}  // namespace

QuadraticProgram read_mat(const std::string& name) {
  const MatFile file(name);
  QuadraticProgram p;
  int rows, columns;
  const Entries P = file.entries("P", rows, columns);
  if (rows != columns) file.fail("P", "is not square");
  SparseMatrix full(rows, columns);
  full.setFromTriplets(P.begin(), P.end());
  const SparseMatrix transposed = full.transpose();
  if ((full - transposed).norm() > 1e-12 * full.norm()) file.fail("P", "is not symmetric");
  p.P = full.triangularView<Eigen::Lower>();
  p.q = file.vector("q");
  const Entries r = file.entries("r", rows, columns, true);
  p.r = r.empty() ? 0 : r.front().value();
  const Entries A = file.entries("A", rows, columns);
  p.A = SparseRows(rows, columns);
  p.A.setFromTriplets(A.begin(), A.end());
  p.low = file.vector("l");
  p.high = file.vector("u");
  for (double& x : p.low) x = x <= -kInfinite ? -INFINITY : x;
  for (double& x : p.high) x = x >= kInfinite ? INFINITY : x;
  const auto slash = name.find_last_of('/'), dot = name.find_last_of('.');
  p.name = name.substr(slash == std::string::npos ? 0 : slash + 1, dot - (slash == std::string::npos ? 0 : slash + 1));
  check(p);
  return p;
}

#else

QuadraticProgram read_mat(const std::string& name) {
  throw std::runtime_error("'" + name + "' cannot be read: this dotyk was built without libmatio "
                           "(apt-get install libmatio-dev, then build again)");
}

#endif

}  // namespace dotyk::program

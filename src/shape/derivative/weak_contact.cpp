#include "shape/derivative/weak_contact.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "program/active_set.hpp"

namespace dotyk::shape {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;

constexpr double kWrong = 1e-8;  ///< relative, of signs in weak contact
constexpr double kNone = std::numeric_limits<double>::infinity();

/// The program in ŷ = y/(σ d): H gets a unit diagonal, the right side is of size 1.
program::QuadraticProgram program_of(const Bordered& bordered, const std::vector<int>& weak, const Vector& b) {
  const Eigen::Index n = bordered.unknowns, modes = bordered.A.rows() - n;
  const DenseMatrix H = bordered.A.topLeftCorner(n, n);
  const double greatest = H.diagonal().maxCoeff();
  Vector d(n);
  for (Eigen::Index j = 0; j < n; ++j) d[j] = 1 / std::sqrt(H(j, j) > 1e-14 * greatest ? H(j, j) : greatest);
  DenseMatrix A = DenseMatrix::Zero(modes + n, n);
  A.topRows(modes) = bordered.A.bottomLeftCorner(modes, n) * d.asDiagonal();
  Vector e = b.tail(modes), g = d.cwiseProduct(b.head(n));
  for (Eigen::Index k = 0; k < modes; ++k) {
    const double size = A.row(k).cwiseAbs().maxCoeff();
    if (size > 0) A.row(k) /= size, e[k] /= size;
  }
  double sigma = g.lpNorm<Eigen::Infinity>();
  if (modes > 0) sigma = std::max(sigma, e.lpNorm<Eigen::Infinity>());
  if (!(sigma > 0)) sigma = 1;
  A.bottomRows(n).setIdentity();
  program::QuadraticProgram p;
  p.P = DenseMatrix(DenseMatrix(d.asDiagonal() * H * d.asDiagonal()).triangularView<Eigen::Lower>()).sparseView();
  p.q = -g / sigma;
  p.A = A.sparseView();
  p.low = Vector::Constant(modes + n, -kNone);
  p.high = Vector::Constant(modes + n, kNone);
  p.low.head(modes) = p.high.head(modes) = e / sigma;
  for (const int j : weak) p.low[modes + j] = 0;
  return p;
}

}  // namespace

std::vector<int> closing(const Bordered& bordered, const std::vector<int>& weak, const Vector& b, Monitor& monitor) {
  const program::QuadraticProgram program = program_of(bordered, weak, b);
  const program::Result result = program::solve(program, program::ActiveSet{}, monitor);
  if (result.status == program::Status::infeasible || result.status == program::Status::unbounded)
    throw InputError("in weak contact (touching without force) along this motion of the nodes the solution has no derivative: " + result.reason);
  std::vector<char> kept(static_cast<std::size_t>(bordered.unknowns), 1);
  const Eigen::Index modes = bordered.A.rows() - bordered.unknowns;
  for (const int j : weak)
    if (result.working[static_cast<std::size_t>(modes + j)] == program::Side::low) kept[static_cast<std::size_t>(j)] = 0;
  std::vector<int> all;
  for (std::size_t j = 0; j < kept.size(); ++j)
    if (kept[j]) all.push_back(static_cast<int>(j));
  return all;
}

void require_complementary(const Bordered& bordered, const std::vector<int>& weak, const Vector& b, const Vector& solved) {
  const Eigen::Index n = bordered.unknowns;
  const Vector open = (bordered.A * solved - b).head(n);  // Cy − Fᵀx'
  Vector d = bordered.A.diagonal().head(n).cwiseSqrt();
  for (double& v : d) v = std::max(v, 1e-7 * d.maxCoeff());
  const double size = std::max(d.cwiseProduct(solved.head(n)).lpNorm<Eigen::Infinity>(), b.head(n).cwiseQuotient(d).lpNorm<Eigen::Infinity>());
  for (const int j : weak)
    if (std::min(solved[j] * d[j], open[j] / d[j]) < -kWrong * size)
      throw std::runtime_error("the quadratic program of weak contact did not settle");
}

}  // namespace dotyk::shape

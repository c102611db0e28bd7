#include "fclib/contact_problem.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "algebra/dense/dense.hpp"
#include "algebra/direct/cholesky.hpp"
#include "algebra/direct/indefinite.hpp"
#include "base/memory.hpp"
#include "base/place.hpp"

namespace dotyk::fclib {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

/// Greater unsymmetry is meant, lesser is rounding.
constexpr double kRounding = 1e-6;

template <class Matrix>
double greatest(const Matrix& a) {
  return a.size() ? a.cwiseAbs().maxCoeff() : 0;
}
double greatest(const SparseMatrix& a) { return a.nonZeros() ? a.coeffs().abs().maxCoeff() : 0; }

template <class Matrix>
double unsymmetry_of(const Matrix& a) {
  const double size = greatest(a);
  return size > 0 ? greatest(Matrix(a - Matrix(a.transpose()))) / size : 0;
}

/// M⁻¹ times every column of b; empty where M is singular.
DenseMatrix solve(const SparseMatrix& M, const DenseMatrix& b) {
  if (unsymmetry_of(M) == 0) {
    std::vector<int> node(M.rows());
    std::iota(node.begin(), node.end(), 0);
    const SparseMatrix lower = M.triangularView<Eigen::Lower>();
    algebra::Cholesky factor(lower, node, {});
    if (factor.factor(lower)) return factor.solve(b);
  }
  const algebra::SparseLu factor(M);
  if (factor.singular()) return {};
  DenseMatrix x(b.rows(), b.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j) x.col(j) = factor.solve(b.col(j));
  return x;
}

}  // namespace

ContactProblem read(const std::string& file, Monitor& monitor) {
  char start[8] = {};
  require_readable(file);
  std::ifstream(file, std::ios::binary).read(start, sizeof start);
  const bool hdf5 = std::memcmp(start, "\x89HDF\r\n\x1a\n", sizeof start) == 0;
  ContactProblem problem = hdf5 ? read_hdf5(file, monitor) : read_text(file);
  problem.name = std::filesystem::path(file).filename();
  check(problem);
  if (problem.kind == ContactProblem::Kind::global) condense(problem, monitor);
  return problem;
}

void check(const ContactProblem& p) {
  const auto fail = [&](const std::string& what) { throw InputError(text("'", p.name, "': ", what)); };
  const auto finite = [&](const char* name, const auto& numbers) {
    if (numbers.size() && !numbers.allFinite()) fail(text(name, " holds a number that is not finite"));
  };
  const auto vector = [&](const char* name, const Vector& v, Eigen::Index expected) {
    if (v.size() != expected) fail(text(name, " has ", v.size(), " entries; ", expected, " are expected"));
    finite(name, v);
  };
  const auto shape = [&](const char* name, const auto& A, Eigen::Index r, Eigen::Index c) {
    if (A.rows() != r || A.cols() != c) fail(text(name, " is ", A.rows(), " x ", A.cols(), "; ", r, " x ", c, " is expected"));
  };
  if (p.dimension != 2 && p.dimension != 3) fail(text("the dimension is ", p.dimension, "; it must be 2 or 3"));
  for (Eigen::Index k = 0; k < p.mu.size(); ++k)
    if (!(p.mu[k] >= 0) || !std::isfinite(p.mu[k]))
      fail(text("the friction coefficient of contact ", k + 1, " is ", p.mu[k], "; it must be zero or positive"));
  if (p.kind == ContactProblem::Kind::local) {
    shape("W", p.W, p.rows(), p.rows());
    finite("W", p.W);
    vector("q", p.q, p.rows());
  } else {
    shape("M", p.M, p.f.size(), p.f.size());
    shape("H", p.H, p.f.size(), p.rows());
    finite("M", p.M.coeffs());
    finite("H", p.H.coeffs());
    vector("f", p.f, p.f.size());
    vector("w", p.w, p.rows());
  }
}

void condense(ContactProblem& p, Monitor& monitor) {
  const int m = p.rows();
  require_memory(8.0 * (2.0 * p.f.size() * (m + 1) + 1.0 * m * m), text("the dense matrix of ", m, " rows"));
  monitor.phase(text("condensing ", p.f.size(), " unknowns onto ", p.contacts(), " contacts"));
  monitor.check();
  DenseMatrix right(p.f.size(), m + 1);
  right << DenseMatrix(p.H), p.f;
  if (p.f.size() > 0) {
    const double unsymmetric = unsymmetry_of(p.M);
    p.symmetrised = unsymmetric > 0 && unsymmetric < kRounding;
    right = solve(p.symmetrised ? SparseMatrix(0.5 * (p.M + SparseMatrix(p.M.transpose()))) : p.M, right);
    if (right.size() == 0 || !right.allFinite()) throw InputError(text("'", p.name, "': M is singular"));
  }
  p.W = p.H.transpose() * right.leftCols(m);
  p.q = p.H.transpose() * right.col(m) + p.w;
}

double unsymmetry(const ContactProblem& p) {
  return p.kind == ContactProblem::Kind::global ? unsymmetry_of(p.M) : unsymmetry_of(p.W);
}

int rank_of_W(const ContactProblem& p) {
  if (p.W.size() == 0) return 0;
  const Vector values = algebra::singular_values(p.W);
  return static_cast<int>((values.array() > 1e-10 * values[0]).count());
}

Eigen::VectorXd project_cone(const Eigen::Ref<const Eigen::VectorXd>& y, double mu) {
  const double normal = y[0], tangential = y.tail(y.size() - 1).norm();
  if (tangential <= mu * normal) return y;
  if (mu * tangential <= -normal) return Eigen::VectorXd::Zero(y.size());
  Eigen::VectorXd p(y.size());
  p[0] = (normal + mu * tangential) / (1 + mu * mu);
  if (tangential > 0)
    p.tail(y.size() - 1) = mu * p[0] / tangential * y.tail(y.size() - 1);
  else
    p.tail(y.size() - 1).setZero();
  return p;
}

Measure measure(const ContactProblem& problem, const Vector& r) {
  const int d = problem.dimension;
  Measure m;
  m.u = problem.W * r + problem.q;
  const double compliance = problem.rows() ? problem.W.diagonal().maxCoeff() : 0;
  const double rho = compliance > 0 ? 1 / compliance : 1;
  double square = 0;
  for (int k = 0; k < problem.contacts(); ++k) {
    const double mu = problem.mu[k];
    Eigen::VectorXd y = r.segment(k * d, d) - rho * m.u.segment(k * d, d);
    y[0] -= rho * mu * m.u.segment(k * d + 1, d - 1).norm();
    square += (r.segment(k * d, d) - project_cone(y, mu)).squaredNorm();
    const double tangential = y.tail(d - 1).norm();
    ++(mu * tangential <= -y[0] ? m.open : tangential < mu * y[0] ? m.stick : m.slip);
  }
  const double size = r.norm();
  m.residual = std::sqrt(square) / (size > 0 ? size : 1);
  return m;
}

Result solve(const ContactProblem& p, const solver::Method& method, Monitor& monitor) {
  const int d = p.dimension, contacts = p.contacts();
  problem::FrictionGroup friction{p.name, problem::coulomb({p.mu.begin(), p.mu.end()}), contacts, d - 1, {}};
  std::vector<int> order;  // of the contact problem's rows among those under laws
  for (int k = 0; k < contacts; ++k) order.push_back(k * d), friction.normal.push_back(k);
  for (int k = 0; k < contacts; ++k)
    for (int i = 1; i < d; ++i) order.push_back(k * d + i);
  problem::Problem rows;
  rows.B = algebra::SparseRows(p.rows(), 0);
  rows.c = Vector::Zero(p.rows());
  rows.groups.push_back({p.name, problem::unilateral(), 0, contacts});
  rows.friction.push_back(std::move(friction));
  Result result;
  result.iteration = method.run(rows, problem::CondensedProblem(p.W(order, order), -p.q(order)), monitor);
  result.r.resize(p.rows());
  result.r(order) = result.iteration.state.lambda;
  result.measure = measure(p, result.r);
  return result;
}

}  // namespace dotyk::fclib

#include "fclib/contact_problem.hpp"

#include <cmath>

#include "program/active_set.hpp"
#include "reference.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"

using namespace dotyk;
using fclib::ContactProblem;
using algebra::Vector;

namespace {

Vector of(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

solver::Newton newton() {
  solver::Newton n;
  n.tol = 1e-12;
  return n;
}

solver::Proximal proximal() {
  solver::Proximal p;
  p.tol = 1e-12;
  p.max_iterations = 200;
  return p;
}

/// W singular or not, the residual of the file's own problem; what is left is the tolerance of the
/// method's map, whose scaling of rows differs.
void check_solved(const std::string& name) {
  CAPTURE(name);
  ContactProblem p;
  if (!reference::read(name, p)) return;
  Monitor quiet;
  const fclib::Result r = fclib::solve(p, proximal(), quiet);
  CHECK_MESSAGE(r.iteration.converged, r.iteration.reason);
  CHECK(r.measure.residual < 1e-11);
  CHECK(r.measure.open + r.measure.stick + r.measure.slip == p.contacts());
}

}  // namespace

TEST_CASE("projection onto the cone: in it, in its polar, between them, in the plane and in space") {
  const Vector inside = of({2, 0.6, -0.8});
  CHECK(fclib::project_cone(inside, 0.5) == inside);
  CHECK(fclib::project_cone(of({-1, 0.6, 0.8}), 0.9).norm() == 0);
  const Vector y = of({0.3, 1.2, -1.6});
  const Vector p = fclib::project_cone(y, 0.5);
  CHECK(p.tail(2).norm() == doctest::Approx(0.5 * p[0]).epsilon(1e-14));
  CHECK(std::abs(p.dot(y - p)) < 1e-15);          // orthogonal …
  CHECK(p[1] * y[2] == doctest::Approx(p[2] * y[1]));  // … and in the plane of y and the axis
  CHECK(fclib::project_cone(of({1, 3}), 0) == of({1, 0}));
}

TEST_CASE("FC3D_Example1: W = I, every contact slips") {
  if (!reference::present()) return;
  ContactProblem p;
  REQUIRE(reference::read("dat/FC3D_Example1.dat", p));
  Monitor quiet;
  const fclib::Result r = fclib::solve(p, newton(), quiet);
  CHECK(r.iteration.converged);
  CHECK(r.measure.residual < 1e-15);
  CHECK(r.measure.slip == 3);
  for (int k = 0; k < 3; ++k) {  // u = r + q, q = (−1, 1, 3): r_N = 1, r_T against (1, 3)
    CHECK(r.r[3 * k] == doctest::Approx(1).epsilon(1e-14));
    CHECK(r.r[3 * k + 1] == doctest::Approx(-0.1 / std::sqrt(10)).epsilon(1e-14));
    CHECK(r.r[3 * k + 2] == doctest::Approx(-0.3 / std::sqrt(10)).epsilon(1e-14));
  }
}

TEST_CASE("GFC3D_Example00: M = H = I, and its badly scaled twin") {
  if (!reference::present()) return;
  ContactProblem p;
  Monitor quiet;
  REQUIRE(reference::read("dat/GFC3D_Example00.dat", p));
  const fclib::Result r = fclib::solve(p, newton(), quiet);
  CHECK(r.measure.residual < 1e-15);
  CHECK(r.r[0] == doctest::Approx(1).epsilon(1e-14));
  CHECK(r.r[1] == doctest::Approx(0.1 / std::sqrt(2)).epsilon(1e-14));
  CHECK(r.r[2] == doctest::Approx(0.1 / std::sqrt(2)).epsilon(1e-14));
  // M = diag(1e-4, 1, 1e4): r_N = 1 again, and u_T = M⁻¹r_T + q_T against r_T. W varies by 1e8, hence the tolerance.
  REQUIRE(reference::read("dat/GFC3D_Example00_badly_scaled.dat", p));
  const fclib::Result bad = fclib::solve(p, newton(), quiet);
  CHECK(bad.iteration.converged);
  CHECK(bad.measure.residual < 1e-10);
  CHECK(bad.r[0] == doctest::Approx(1).epsilon(1e-10));
  CHECK(bad.r.tail(2).norm() == doctest::Approx(0.1).epsilon(1e-10));
  CHECK(bad.r.tail(2).dot(bad.measure.u.tail(2)) == doctest::Approx(-0.1 * bad.measure.u.tail(2).norm()).epsilon(1e-10));
}

TEST_CASE("elastic blocks: Newton's method") {
  if (!reference::present()) return;
  Monitor quiet;
  for (const std::string name : {"CubeH8.hdf5", "LMGC_GlobalFrictionContactProblem00046.hdf5"}) {
    CAPTURE(name);
    ContactProblem p;
    if (!reference::read(name, p)) return;
    const fclib::Result r = fclib::solve(p, newton(), quiet);
    CHECK(r.iteration.converged);
    CHECK(r.measure.residual < 1e-14);
    CHECK(r.measure.stick == p.contacts());
  }
}

TEST_CASE("no contacts at all; a method that works on bodies") {
  if (!reference::present()) return;
  ContactProblem p;
  REQUIRE(reference::read("dat/gfc2d_granularflowonwall_00000_00117.dat", p));
  CHECK(p.contacts() == 0);
  Monitor quiet;
  const fclib::Result r = fclib::solve(p, newton(), quiet);
  CHECK(r.iteration.converged);
  CHECK(r.r.size() == 0);
  CHECK(r.measure.residual == 0);
  CHECK_THROWS_AS(fclib::solve(p, solver::Pdas(), quiet), InputError);
}

TEST_CASE("every HDF5 file is solved, though W is singular") {
  if (!reference::present()) return;
  for (const std::string& name : reference::files(""))
    if (name.rfind("Chute", 0) != 0) check_solved(name);
}

TEST_CASE("every text file is solved") {
  if (!reference::present()) return;
  for (const std::string& name : reference::files("dat/"))
    if (name != "dat/ACinputs.dat") check_solved(name);
}

TEST_CASE("PerioBox: u is that of an independent computation, whatever the forces, which are not unique") {
  if (!reference::present()) return;
  ContactProblem p;
  if (!reference::read("LMGC_100_PR_PerioBox-i00361-60-03000.hdf5", p)) return;
  Monitor quiet;
  solver::Psor psor;
  psor.tol = 1e-12;
  psor.max_iterations = 10000;
  const fclib::Result one = fclib::solve(p, proximal(), quiet), other = fclib::solve(p, psor, quiet);
  REQUIRE(one.iteration.converged);
  REQUIRE(other.iteration.converged);
  for (const auto* r : {&one, &other}) CHECK(r->measure.u.norm() == doctest::Approx(0.3119524231).epsilon(3e-10));
  CHECK((one.measure.u - other.measure.u).norm() < 1e-10 * one.measure.u.norm());
  // Both solve the problem, with forces that differ in the kernel of W.
  const Vector difference = one.r - other.r;
  CHECK(difference.norm() > 1e-3 * one.r.norm());
  CHECK((p.W * difference).norm() < 1e-10 * one.measure.u.norm());
}

TEST_CASE("friction ignored: the values of the bound-constrained program, by two methods") {
  if (!reference::present()) return;
  for (const auto& [name, value] : {std::pair{"local_problem_test.hdf5", -1.443542005e-06},
                                    std::pair{"LMGC_100_PR_PerioBox-i00361-60-03000.hdf5", -1.110126663e+05}}) {
    CAPTURE(name);
    ContactProblem p;
    if (!reference::read(name, p)) return;
    const int n = p.contacts();
    algebra::DenseMatrix W(n, n);
    Vector q(n);
    for (int i = 0; i < n; ++i) {
      q[i] = p.q[3 * i];
      for (int j = 0; j < n; ++j) W(i, j) = 0.5 * (p.W(3 * i, 3 * j) + p.W(3 * j, 3 * i));
    }
    const auto objective = [&](const Vector& r) { return 0.5 * r.dot(W * r) + q.dot(r); };
    Monitor quiet;

    program::QuadraticProgram bounded;
    bounded.P = algebra::SparseMatrix(algebra::DenseMatrix(W.triangularView<Eigen::Lower>()).sparseView());
    bounded.q = q;
    bounded.A = algebra::SparseRows(algebra::DenseMatrix::Identity(n, n).sparseView());
    bounded.low = Vector::Zero(n);
    bounded.high = Vector::Constant(n, INFINITY);
    const program::Result exact = program::solve(bounded, program::ActiveSet(), quiet);
    REQUIRE_MESSAGE(exact.status == program::Status::solved, exact.reason);
    CHECK(exact.objective == doctest::Approx(value).epsilon(2e-10));  // ten digits are given

    problem::Problem rows;
    rows.B = algebra::SparseRows(n, 0);
    rows.c = Vector::Zero(n);
    rows.groups = {{name, problem::unilateral(), 0, n}};
    const auto r = solver::solve(rows, problem::CondensedProblem(W, -q), proximal(), quiet);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK(objective(r.state.lambda) == doctest::Approx(value).epsilon(2e-10));
  }
}

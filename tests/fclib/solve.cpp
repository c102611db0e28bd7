#include "fclib/solve.hpp"

#include "reference.hpp"
#include "solver/newton.hpp"
#include "solver/pdas.hpp"

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

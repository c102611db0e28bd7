#include <doctest/doctest.h>

#include "../support/chain.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using namespace dotyk::problem;
using algebra::DenseMatrix;
using algebra::Field;
using algebra::Vector;

namespace {

/// Springs of stiffness 2 and 3, each with two unknowns that a coupling of 1 joins, each over an obstacle. `joined`: a third row ties them.
Problem two_springs(bool joined) {
  Problem p;
  for (const double k : {2.0, 3.0}) {
    Block b;
    b.name = k == 2 ? "a" : "b";
    b.K = test::lower(DenseMatrix{{k, -1}, {-1, k}});
    b.f = Vector{{1, k}};
    b.node = {0, 1};
    b.kernel.resize(2, 0);
    b.offset = k;
    add(p, b);
  }
  DenseMatrix B = DenseMatrix::Zero(joined ? 3 : 2, 4);
  B(0, 0) = B(1, 3) = 1;
  if (joined) B(2, 1) = 1, B(2, 2) = -1;
  p.B = test::rows(B);
  p.c = Vector::Constant(B.rows(), 0.1);
  p.groups = {test::group(unilateral(), 0, 2)};
  if (joined) p.groups.push_back(test::group(bilateral(), 2, 1));
  return p;
}

Displacement elsewhere(const Vector& u) {
  Field field(algebra::vectors_here(static_cast<int>(u.size()), {}));
  field.put(u);
  return Displacement(std::move(field));
}

}  // namespace

TEST_CASE("a displacement that lies with the stiffness is told when it is asked for, and lies here once it is changed") {
  const Vector u{{1, 2, 3}};
  Displacement there = elsewhere(u);
  const Displacement copy = there;
  CHECK(there.there() == copy.there());
  CHECK(there.size() == 3);
  CHECK(there.here() == u);
  there.change()[1] = 7;
  CHECK_FALSE(there.there());
  CHECK(there.here() == Vector{{1, 7, 3}});
  CHECK(copy.here() == u);
}

TEST_CASE("residuals of states that lie elsewhere, of one part and of several, are those of states here") {
  for (const bool joined : {false, true}) {
    const Problem p = two_springs(joined);
    const State here{Vector{{0.3, 0.5, 0.2, 0.4}}, Vector::LinSpaced(p.rows(), 0.5, 1)}, there{elsewhere(here.u.here()), here.lambda};
    CHECK((jumps(p, there.u) - (p.B * here.u.here() - p.c)).norm() < 1e-16);
    const Residual a = residual(p, here), b = residual(p, there);
    CHECK(a.equilibrium == b.equilibrium);
    CHECK(a.law == b.law);
    CHECK(a.complementarity == b.complementarity);
    const Vector& u = here.u.here();
    const DenseMatrix lower = lower_stiffness(p), K = lower.selfadjointView<Eigen::Lower>();
    const double expected = 0.5 * u.dot(K * u) - u.dot(p.load()) + 5;
    CHECK(a.energy == doctest::Approx(expected));
    CHECK(a.energy == b.energy);
    // Each part has its own scale: ‖Ku + Bᵀλ − f‖ / ‖f‖, the greater of two.
    const auto of = [&](int first, int size) {
      const Vector internal = (K * u).segment(first, size), contact = (p.B.transpose() * here.lambda).segment(first, size), load = p.load().segment(first, size);
      return (internal + contact - load).norm() / load.norm();
    };
    CHECK(a.equilibrium == doctest::Approx(joined ? of(0, 4) : std::max(of(0, 2), of(2, 2))));
  }
}

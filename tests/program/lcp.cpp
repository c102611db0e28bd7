#include <doctest/doctest.h>

#include "base/error.hpp"
#include "program/lcp.hpp"
#include "programs.hpp"

using namespace dotyk;
using program::FreeSet;
using program::Lcp;
using program::LcpStatus;
using test::DenseMatrix;
using test::Random;
using test::Vector;

namespace {

FreeSet set_of(unsigned bits, int n) {
  FreeSet free(n);
  for (int i = 0; i < n; ++i) free[i] = bits >> i & 1;
  return free;
}

Lcp lcp_of(const DenseMatrix& M, const Vector& q) { return {M.sparseView(0, 0), q}; }

DenseMatrix circulant(double a) {
  DenseMatrix M(3, 3);
  M << 1, 0, a, a, 1, 0, 0, a, 1;
  return M;
}

}  // namespace

TEST_CASE("the P-matrix of Ben Gharbia and Gilbert: cycles are noticed and solved all the same") {
  Monitor quiet;
  for (const double a : {2.0, 1.1, 0.9})
    for (unsigned bits = 0; bits < 8; ++bits) {
      const Lcp lcp = lcp_of(circulant(a), Vector::Ones(3));
      const auto plain = program::newton_min(lcp, set_of(bits, 3), quiet);
      const bool trivial = bits == 0 || bits == 7 || a < 1;
      CHECK(plain.end == (trivial ? program::NewtonMin::End::solved : program::NewtonMin::End::cycle));
      CHECK(plain.cycle.size() == (trivial ? 0 : 3));
      const auto r = program::solve(lcp, {.method = program::LcpSettings::Method::automatic, .start = set_of(bits, 3), .unique = true}, quiet);
      CHECK(r.status == LcpStatus::solved);
      CHECK(r.z.norm() == 0);
      CHECK(r.cycle.size() == plain.cycle.size());
      CHECK(r.method == (trivial ? "newton_min" : "lemke"));
    }
}

TEST_CASE("random problems: Newton, Lemke and enumeration agree on P-matrices") {
  Random random(351);
  Monitor quiet;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 8;
    DenseMatrix K = random.matrix(n, n) * 3;
    const Lcp lcp = lcp_of(random.positive_definite(n, 0.1) + K - K.transpose(), random.vector(n));
    const auto all = program::enumerate(lcp, 3, quiet);
    REQUIRE(all.solutions.size() == 1);
    const auto lemke = program::lemke(lcp, quiet);
    REQUIRE(lemke.solved);
    CHECK((lemke.z - all.solutions[0]).norm() < 1e-9 * (1 + lemke.z.norm()));
    const auto r = program::solve(lcp, {}, quiet);
    CHECK(r.status == LcpStatus::solved);
    CHECK(r.counted);
    CHECK(r.residual < 1e-12);
    CHECK((r.z - all.solutions[0]).norm() < 1e-9 * (1 + r.z.norm()));
  }
}

TEST_CASE("no solution, one, two, and a segment are told apart") {
  Monitor quiet;
  const auto status = [&](const DenseMatrix& M, const Vector& q) { return program::solve(lcp_of(M, q), {}, quiet).status; };
  CHECK(status(DenseMatrix{{1, -1}, {-1, 1}}, Vector{{1, -2}}) == LcpStatus::none);     // load outside the cone
  CHECK(status(DenseMatrix{{1, -1}, {-1, 1}}, Vector{{1, -1}}) == LcpStatus::several);  // a ray
  CHECK(status(DenseMatrix{{1, 1}, {1, 1}}, Vector{{-1, -1}}) == LcpStatus::several);   // a segment
  CHECK(status(DenseMatrix{{1, 2}, {2, 1}}, Vector{{-1, -1}}) == LcpStatus::several);   // three points
  CHECK(status(DenseMatrix{{-1}}, Vector{{-1}}) == LcpStatus::none);
  CHECK(status(DenseMatrix{{-1}}, Vector{{1}}) == LcpStatus::several);
  CHECK(status(DenseMatrix{{0, 1}, {-1, 0}}, Vector{{-1, 1}}) == LcpStatus::solved);
  // Too large to enumerate: a ray of Lemke's method decides for a semidefinite matrix.
  const int n = 20;
  Vector q = -Vector::Ones(n);
  CHECK(status(DenseMatrix::Zero(n, n), q) == LcpStatus::none);
  CHECK(status(-DenseMatrix::Identity(n, n), q) == LcpStatus::stopped);
}

TEST_CASE("Murty's matrix, exponential for least-index pivoting, takes n + 1 solves") {
  Monitor quiet;
  for (int n : {6, 12}) {
    DenseMatrix M = DenseMatrix::Constant(n, n, 2).triangularView<Eigen::StrictlyLower>();
    M.diagonal().setOnes();
    const auto r = program::newton_min(lcp_of(M, -Vector::Ones(n)), FreeSet(n, 0), quiet);
    CHECK(r.end == program::NewtonMin::End::solved);
    CHECK(r.solves == n + 1);
    CHECK((r.z - Vector::Unit(n, 0)).norm() == 0);
  }
}

TEST_CASE("Murty's matrix again, with the right-hand side that takes Lemke's method 2ⁿ − 1 pivots: its limit is told, and what to try") {
  Monitor quiet;
  for (const int n : {10, 20}) {
    DenseMatrix M = DenseMatrix::Constant(n, n, 2).triangularView<Eigen::StrictlyLower>();
    M.diagonal().setOnes();
    Vector q(n);
    for (int i = 0; i < n; ++i) q[i] = std::ldexp(1, n - 1 - i) - std::ldexp(1, n);
    program::LcpSettings by_lemke;
    by_lemke.method = program::LcpSettings::Method::lemke;
    by_lemke.unique = false;
    const auto r = program::solve(lcp_of(M, q), by_lemke, quiet), other = program::solve(lcp_of(M, q), {}, quiet);
    CHECK(other.status == program::LcpStatus::solved);
    if (n == 10) {
      CHECK(r.status == program::LcpStatus::solved);
      CHECK(r.pivots == 1023);
    } else {
      CHECK(r.status == program::LcpStatus::stopped);
      CHECK(r.reason == "Lemke's method stops at its limit of 100000 pivots: try newton_min");
    }
  }
}

TEST_CASE("symmetric problems are bound-constrained programs") {
  Random random(352);
  Monitor quiet;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 2 + trial % 12;
    const DenseMatrix M = random.positive_definite(n, 0.2);
    const Vector q = random.vector(n);
    const auto lcp = program::solve(lcp_of(M, q), {}, quiet);
    const auto p = program::solve(test::quadratic(M, q, DenseMatrix::Identity(n, n), Vector::Zero(n), Vector::Constant(n, INFINITY)),
                                  test::one(), quiet);
    CHECK((lcp.z - p.x).norm() < 1e-9 * (1 + p.x.norm()));
    CHECK((lcp.w + p.y).norm() < 1e-9 * (1 + lcp.w.norm()));
  }
}

TEST_CASE("scales: a problem in other units has the same answer") {
  Random random(353);
  Monitor quiet;
  for (int trial = 0; trial < 50; ++trial) {
    const int n = 5;
    const DenseMatrix K = random.matrix(n, n);
    const Lcp lcp = lcp_of(random.positive_definite(n, 0.5) + K - K.transpose(), random.vector(n));
    Vector s(n);
    for (double& x : s) x = std::pow(10.0, random.below(9) - 4);
    const Lcp other = lcp_of(s.asDiagonal() * DenseMatrix(lcp.M) * s.asDiagonal(), s.cwiseProduct(lcp.q));
    const auto a = program::solve(lcp, {}, quiet), b = program::solve(other, {}, quiet);
    CHECK(b.status == LcpStatus::solved);
    CHECK((s.cwiseProduct(b.z) - a.z).norm() < 1e-8 * (1 + a.z.norm()));
  }
}

TEST_CASE("what does not fit is refused") {
  Monitor quiet;
  CHECK_THROWS_AS(program::check(lcp_of(DenseMatrix::Identity(2, 2), Vector::Ones(3))), InputError);
  CHECK_THROWS_AS(program::solve(lcp_of(DenseMatrix::Identity(2, 2), Vector::Ones(2)), {.method = program::LcpSettings::Method::automatic, .start = FreeSet(3), .unique = true}, quiet), InputError);
  CHECK_THROWS_AS(program::solve(lcp_of(DenseMatrix::Identity(20, 20), Vector::Ones(20)),
                                 {.method = program::LcpSettings::Method::enumeration, .start = {}, .unique = true}, quiet), InputError);
}

namespace {

/// A chain of n springs, its ends held, over a floor that its own weight presses it on: M is tridiagonal.
Lcp chain(int n) {
  algebra::Triplets entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2);
    if (i > 0) entries.emplace_back(i, i - 1, -1), entries.emplace_back(i - 1, i, -1);
  }
  Vector q(n);
  for (int i = 0; i < n; ++i) q[i] = std::sin(0.7 * i) - 0.1;
  return {algebra::from_triplets(n, n, entries), q};
}

/// Asks to stop when it is asked for the time `after` + 1.
struct Impatient : Monitor {
  int after, asked = 0;
  explicit Impatient(int after) : after(after) {}
  bool stop() override { return ++asked > after; }
};

}  // namespace

TEST_CASE("large sparse problems: Lemke's method and Newton's find the same") {
  Monitor quiet;
  program::LcpSettings by_lemke, by_newton;
  by_lemke.method = program::LcpSettings::Method::lemke, by_newton.method = program::LcpSettings::Method::newton_min;
  const Lcp lcp = chain(1500);
  const auto lemke = program::solve(lcp, by_lemke, quiet), newton = program::solve(lcp, by_newton, quiet);
  REQUIRE_MESSAGE(lemke.status == LcpStatus::solved, lemke.reason);
  REQUIRE_MESSAGE(newton.status == LcpStatus::solved, newton.reason);
  CHECK((lemke.z - newton.z).norm() < 1e-9 * newton.z.norm());
  CHECK(lemke.pivots > 100);
  CHECK(lemke.seconds > 0);
}

TEST_CASE("each method ends where the monitor asks to, and says so") {
  using Method = program::LcpSettings::Method;
  for (const auto method : {Method::automatic, Method::newton_min, Method::lemke, Method::enumeration}) {
    program::LcpSettings settings;
    settings.method = method;
    Impatient monitor(1);
    const auto r = program::solve(method == Method::enumeration ? chain(16) : chain(300), settings, monitor);
    CHECK(r.status == LcpStatus::stopped);
    CHECK(r.reason == "stopped on request");
    CHECK(r.pivots <= 1);
    CHECK(r.solves <= 1);
    CHECK(monitor.asked <= 8);
  }
}

// SMALBE on random programs with equality constraints whose solution and multipliers are known.
#include "solver/bounded/smalbe.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "../support/known_equality.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::Smalbe;
using solver::SmalbeResult;
using Known = test::KnownEquality;
using test::kShapes;
using test::Shape;
using test::until;

namespace {

using End = SmalbeResult::End;

SmalbeResult solve(const Known& known, bool complementary, const Smalbe& method, const solver::SmalbeCaller& caller) {
  const Vector zero = Vector::Zero(known.x.size());
  return minimise(known.program(complementary), method, caller, zero, zero);
}

}  // namespace

TEST_CASE("both updates find the known solution, also at tight tolerance") {
  for (const bool complementary : {false, true})
    for (const Shape shape : kShapes)
      for (const double least : {0.1, 1e-3})
        for (const double tol : {1e-6, 1e-11}) {
          CAPTURE(complementary);
          CAPTURE(int(shape));
          CAPTURE(least);
          CAPTURE(tol);
          const Known known(3, 90, 8, shape, least, complementary);
          const double small = tol * known.b.norm();
          Vector found[2];
          for (const auto update : {Smalbe::Update::precision, Smalbe::Update::penalty}) {
            CAPTURE(int(update));
            Smalbe method;
            method.update = update;
            const SmalbeResult r = solve(known, complementary, method, until(small));
            CHECK(r.end == End::done);
            CHECK(known.set->contains(r.x));
            CHECK((known.Q * r.x).norm() <= 1.001 * small);
            CHECK((known.Q * r.nu - r.nu).norm() <= 1e-12 * (1 + r.nu.norm()));
            const auto left = known.set->gradients(r.x, known.H * r.x - known.b + r.nu);
            CHECK(std::hypot(left.free.norm(), left.chopped.norm()) <= 1.01 * small);
            CHECK((r.x - known.x).norm() <= 3 * small / least);  // ‖g^P‖/λ_min and what ‖Qx‖ adds
            found[int(update)] = r.x;
          }
          if (tol == 1e-11) CHECK((found[0] - found[1]).norm() <= (least == 0.1 ? 1e-9 : 1e-8));  // 2 · 1e-11 ‖b‖/λ_min
        }
}

TEST_CASE("without bounds it is the method of conjugate gradients on H") {
  for (const double least : {1e-1, 1e-2, 1e-3})
    for (const auto update : {Smalbe::Update::precision, Smalbe::Update::penalty}) {
      const Known known(5, 150, 10, Shape::none, least, true);
      const double small = 1e-9 * known.b.norm();
      Smalbe method;
      method.update = update;
      const SmalbeResult r = solve(known, true, method, until(small));
      CHECK(r.end == End::done);
      // Conjugate gradients as in the books.
      Vector x = Vector::Zero(150), g = -known.b, p = g;
      int steps = 0;
      while (g.norm() > small) {
        const Vector Hp = known.H * p;
        const double alpha = g.squaredNorm() / p.dot(Hp), before = g.squaredNorm();
        x -= alpha * p;
        g -= alpha * Hp;
        p = g + g.squaredNorm() / before * p;
        ++steps;
      }
      CHECK(r.outer == 0);
      CHECK(std::abs(r.inner - steps) <= 1 + steps / 20);
      CHECK(r.products <= 1.05 * steps + 4);
      CHECK((r.x - x).norm() <= 2 * small / least);
    }
}

TEST_CASE("precision: L grows by ½ρ‖Qx‖² at each outer step, and M keeps above its bound") {
  for (const Shape shape : kShapes)
    for (const double least : {0.1, 1e-2})
      for (const double rho : {0.5, 1.0, 10.0}) {
        CAPTURE(int(shape));
        CAPTURE(least);
        CAPTURE(rho);
        const Known known(8, 80, 6, shape, least, false);
        const double bound = std::sqrt(least * rho);
        struct Outer {
          double L, growth;
        };
        for (const double M : {bound, 1e3}) {
          std::vector<Outer> outer;
          auto caller = until(1e-9 * known.b.norm());
          caller.outer = [&](const solver::SmalbeState& s) { outer.push_back({s.lagrangian, 0.5 * s.rho * s.equality * s.equality}); };
          Smalbe method;
          method.rho = rho;
          method.M = M;
          const SmalbeResult r = solve(known, false, method, caller);
          CHECK(r.end == End::done);
          CHECK(r.rho == rho);
          if (M > bound) {
            CHECK(r.M > 0.999 * bound / method.beta);
            continue;
          }
          CHECK(r.M == M);
          REQUIRE(outer.size() > 2);
          for (std::size_t k = 1; k < outer.size(); ++k)
            CHECK(outer[k].L >= outer[k - 1].L + outer[k].growth - 1e-13 * std::abs(outer[k].L));
        }
      }
}

TEST_CASE("the paper's finding: inner steps depend little on M and ρ₀") {
  // H = PFP with spectrum in [0.02, 1]: A_ρ has that and ρ.
  const Known known(9, 200, 6, Shape::low, 0.02, true);
  for (const double rho : {1.0, 10.0, 100.0, 1000.0}) {
    int fewest = 1 << 30, most = 0;
    for (const double M : {0.01, 0.1, 1.0}) {
      Smalbe method;
      method.update = Smalbe::Update::penalty;
      method.rho = rho;
      method.M = M;
      const SmalbeResult r = solve(known, true, method, until(1e-4 * known.b.norm()));
      CHECK(r.end == End::done);
      fewest = std::min(fewest, r.inner);
      most = std::max(most, r.inner);
    }
    CHECK(most <= 2 * fewest);
  }
}

// SMALBE on random programs with equality constraints whose solution and multipliers are known.
#include "solver/smalbe.hpp"

#include <doctest/doctest.h>

#include <optional>

#include "../support/known_minimum.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::EqualityProgram;
using solver::Smalbe;
using solver::SmalbeResult;
using test::Random;
using test::Shape;

namespace {

using End = SmalbeResult::End;

/// minimise ½xᵀHx − bᵀx over Ω with Qx = 0 and its solution: H = PFP with spectrum [least, 1] on the kernel of Q =
/// GᵀG, G of k orthonormal rows; or H positive definite on the whole space.
struct Known {
  Known(unsigned seed, int n, int k, Shape shape, double least, bool complementary, double degenerate = 0)
      : random(seed), known(test::known_minimum(random, n, shape, degenerate)) {
    const DenseMatrix V = test::orthonormal(random, n, n), G = V.leftCols(k).transpose();
    Q = G.transpose() * G;
    H = test::random_matrix(random, n, least);
    if (complementary) {
      const DenseMatrix N = V.rightCols(n - k);
      H = N * test::random_matrix(random, n - k, least) * N.transpose();
    }
    // Moves Ω along so that the solution has Qx = 0.
    shift = -Q * known.x;
    x = known.x + shift;
    std::vector<solver::SeparableSet::Disc> discs = known.set.discs();
    for (auto& disc : discs) disc.centre += Eigen::Vector2d(shift[disc.first], shift[disc.second]);
    set.emplace(known.set.low() + shift, known.set.high() + shift, discs);
    // b in the kernel of Q where H is, as P d is: the multiplier ν takes the rest.
    const Vector rest = H * x - known.g;
    b = complementary ? Vector(rest - Q * rest) : rest;
    if (!complementary) b += Q * random.vector(n);
  }
  EqualityProgram program(bool complementary) const {
    return {[this](const Vector& v) -> Vector { return H * v; }, 1, [this](const Vector& v) -> Vector { return Q * v; },
            complementary, b, &*set};
  }

  Random random;
  test::KnownMinimum known;
  DenseMatrix H, Q;
  Vector shift, x, b;
  std::optional<solver::SeparableSet> set;
};

}  // namespace

TEST_CASE("both updates find the known solution") {
  for (const bool complementary : {false, true})
    for (const Shape shape : {Shape::none, Shape::low, Shape::box, Shape::discs, Shape::mixed})
      for (const double least : {0.1, 1e-3})
        for (const double tol : {1e-6, 1e-11})
          for (const auto update : {Smalbe::Update::precision, Smalbe::Update::penalty}) {
            CAPTURE(complementary);
            CAPTURE(int(shape));
            CAPTURE(least);
            CAPTURE(tol);
            CAPTURE(int(update));
            const Known known(3, 90, 8, shape, least, complementary);
            Smalbe method;
            method.update = update;
            const double small = tol * known.b.norm();
            const solver::SmalbeCaller caller{[&](double g, double e) { return g <= small && e <= small; }, {}, {}};
            const SmalbeResult r = minimise(known.program(complementary), method, caller, Vector::Zero(90), Vector::Zero(90));
            CHECK(r.end == End::done);
            CHECK(known.set->contains(r.x));
            CHECK((known.Q * r.x).norm() <= 1.001 * small);
            const auto left = known.set->gradients(r.x, known.H * r.x - known.b + r.nu);
            CHECK(std::hypot(left.free.norm(), left.chopped.norm()) <= 1.01 * small);
            CHECK((r.x - known.x).norm() <= 3 * small / least);  // ‖g^P‖/λ_min and what ‖Qx‖ adds
          }
}

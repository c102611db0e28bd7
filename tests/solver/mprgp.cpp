// Mprgp on random dense programs whose solution is known, with what theory promises asserted at every step.
#include "solver/mprgp.hpp"

#include <doctest/doctest.h>

#include "../support/known_minimum.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::Mprgp;
using solver::MprgpSettings;
using solver::SeparableSet;
using test::KnownMinimum;
using test::Random;
using test::Shape;

namespace {

using Step = Mprgp::Step;

solver::LinearMap map(const DenseMatrix& A) {
  return [&A](const Vector& v) -> Vector { return A * v; };
}

struct Counts {
  int steps = 0, products = 0, faces = 0;
};

/// Steps to ‖g^P‖ ≤ tol ‖b‖, each one asserted to keep x in Ω, to lower q (up to 1e-14 of the greatest
/// |q| met, what rounding of the sum leaves) and to be of the kind that proportionality asks for.
Counts follow(Mprgp& method, const SeparableSet& set, double tol, int limit) {
  Counts counts;
  double scale = std::abs(method.q());
  while (method.projected_gradient_norm() > tol && counts.steps < limit) {
    const bool proportional = method.proportional();
    const double q = method.q();
    const auto face = method.face();
    const Step step = method.step();
    REQUIRE(step != Step::none);
    ++counts.steps;
    if (face != method.face()) ++counts.faces;
    scale = std::max(scale, std::abs(method.q()));
    REQUIRE(method.q() <= q + 1e-14 * scale);
    REQUIRE(set.contains(method.x()));
    REQUIRE((step == Step::proportioning) == !proportional);
    if (step == Step::conjugate || step == Step::proportioning) CHECK(method.x().allFinite());
  }
  counts.products = method.products();
  return counts;
}

}  // namespace

TEST_CASE("known minima of every shape are found, each step as theory has it") {
  for (const Shape shape : {Shape::none, Shape::low, Shape::box, Shape::discs, Shape::mixed})
    for (const double least : {0.1, 1e-2, 1e-4})
      for (const auto expansion : {MprgpSettings::Expansion::fixed_step, MprgpSettings::Expansion::projected_cg_step}) {
        CAPTURE(int(shape));
        CAPTURE(least);
        CAPTURE(int(expansion));
        Random random(7);
        const int n = 120;
        const DenseMatrix A = test::random_matrix(random, n, least);
        const KnownMinimum known = test::known_minimum(random, n, shape);
        const Vector b = A * known.x - known.g;
        Mprgp method(map(A), 1, b, known.set, Vector::Zero(n), {.expansion = expansion});
        follow(method, known.set, 1e-10 * b.norm(), 20000);
        // ‖x − x*‖ ≤ ‖g^P‖/λ_min.
        CHECK((method.x() - known.x).norm() <= 2e-10 * b.norm() / least);
      }
}

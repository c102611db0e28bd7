// Springs that push with one stiffness and pull with another (P4, remark 6, figure 15).
#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"
#include "solver/rows/uzawa.hpp"

using namespace dotyk;
using beam::Beam;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::kEJ;
using test::kFree;
using test::kHeld;
using test::kLength;
using test::only;

namespace {

constexpr double kPush = 10, kPull = 0.4;

LawChoice unequal(double push, double pull) { return {&laws::unequal_elastic, push, pull}; }

/// Every support that the law can be of, between others: at the ends and within.
Beam on(const LawChoice& law, double q) {
  Beam b = test::beam_between(kLength, kEJ, q, law, law, law, law);
  b.supports.insert(b.supports.begin() + 1, {"middle", 1, law, law});
  b.loads = {{0.5, 0.7, 0}, {1.5, -0.4, 0.3}};
  return b;
}

double difference(const beam::Solution& a, const beam::Solution& b) {
  CHECK(a.result().converged);
  CHECK(b.result().converged);
  return (a.result().state.u.here() - b.result().state.u.here()).norm() / b.result().state.u.here().norm();
}

template <class Chosen>
solver::Method patient(Chosen method) {
  method.max_iterations = 100000;
  method.tol = 1e-12;
  return method;
}

}  // namespace

TEST_CASE("a cantilever's tip on a spring of two stiffnesses, in closed form") {
  // Its own stiffness against a force at the tip is c = 3EJ/L³, against a moment EJ/L; each shares the load with the spring.
  const double c = 3 * kEJ / std::pow(kLength, 3), turning = kEJ / kLength;
  for (const double load : {1.0, -1.0, 0.3}) {
    CAPTURE(load);
    Beam b = test::beam_between(kLength, kEJ, 0, kHeld, kHeld, unequal(kPush, kPull), kFree);
    b.loads = {{kLength, load, 0}};
    double k = load < 0 ? kPush : kPull;  // down it is pushed
    auto s = only(b);
    CHECK(s->deflection(kLength) == doctest::Approx(load / (k + c)).epsilon(1e-10));
    CHECK(s->reaction(1).force == doctest::Approx(-load * k / (k + c)).epsilon(1e-10));
    CHECK(s->energy() == doctest::Approx(-0.5 * load * load / (k + c)).epsilon(1e-10));
    b = test::beam_between(kLength, kEJ, 0, kHeld, kHeld, kFree, unequal(kPush, kPull));
    b.loads = {{kLength, 0, load}};
    k = load > 0 ? kPush : kPull;  // slopes above zero are pushed, as one-sided laws do
    s = only(b);
    CHECK(s->rotation(kLength) == doctest::Approx(load / (k + turning)).epsilon(1e-10));
    CHECK(s->reaction(1).moment == doctest::Approx(-load * k / (k + turning)).epsilon(1e-10));
  }
}

TEST_CASE("with equal stiffnesses it is elastic, with one of 0 one-sided elastic") {
  for (const double q : {-1.0, 0.8}) {
    CAPTURE(q);
    CHECK(difference(*only(on(unequal(5, 5), q)), *only(on({&laws::elastic, 5}, q))) < 1e-12);
    const beam::Support held{"held", 0.25, {&laws::elastic, 0.5}, {&laws::elastic, 0.5}};
    // What pulls alone pushes on the mirrored beam.
    Beam pulls = on(unequal(0, 5), -q), pushes = on({&laws::one_sided_elastic, 5}, q);
    for (beam::PointLoad& load : pulls.loads) load.force *= -1, load.moment *= -1;
    for (Beam* b : {&pulls, &pushes}) b->supports.insert(b->supports.begin() + 1, held);
    Beam one = on(unequal(5, 0), q);
    one.supports.insert(one.supports.begin() + 1, held);
    const auto mirrored = only(pulls), exact = only(pushes);
    CHECK(difference(*only(one), *exact) < 1e-12);
    CHECK((mirrored->result().state.u.here() + exact->result().state.u.here()).norm() < 1e-12 * exact->result().state.u.here().norm());
  }
}

TEST_CASE("every method finds the sides, of springs that differ much or little or bear on one side alone") {
  for (const auto& law : {unequal(kPush, kPull), unequal(kPull, kPush), unequal(1e6, 1e-3), unequal(3, 2.999)})
    for (const double q : {-1.0, 0.8, 0.0}) {
      CAPTURE(law.numbers[0]);
      CAPTURE(q);
      const Beam b = on(law, q);
      const auto exact = only(b);
      for (int i = 0; i < 3; ++i) {
        const beam::Reaction r = exact->reaction(i);
        CHECK(r.force == doctest::Approx(-(r.deflection < 0 ? law.numbers[0] : law.numbers[1]) * r.deflection).epsilon(1e-9));
        CHECK(r.moment == doctest::Approx(-(r.rotation > 0 ? law.numbers[0] : law.numbers[1]) * r.rotation).epsilon(1e-9));
      }
      solver::Pdas full;
      full.reduced = false;
      CHECK(difference(*only(b, full), *exact) < (law.numbers[0] > 1e3 ? 1e-7 : 1e-9));  // rounding by the ratio of 1e9
      CHECK(difference(*only(b, solver::Newton{}), *exact) < 1e-9);
      CHECK(difference(*only(b, patient(solver::Proximal{})), *exact) < 1e-8);
      CHECK(difference(*only(b, patient(solver::ProjectedCg{})), *exact) < 1e-8);
      if (law.numbers[0] > 1e3) continue;  // those below converge with the springs' ratio
      CHECK(difference(*only(b, patient(solver::Psor{})), *exact) < 1e-7);
      CHECK(difference(*only(b, patient(solver::Uzawa{})), *exact) < 1e-7);
    }
}

TEST_CASE("a spring of two stiffnesses that neither pushes nor pulls keeps its side") {
  // Symmetry holds the middle's slope at 0, and without a load nothing moves at all.
  Beam b = test::beam_between(kLength, kEJ, -1, kHeld, kFree, kHeld, kFree);
  b.supports.insert(b.supports.begin() + 1, {"middle", 1, kFree, unequal(kPush, kPull)});
  const auto s = only(b);
  CHECK(s->result().converged);
  CHECK(s->result().reason == "active set confirmed");
  CHECK(std::abs(s->rotation(1)) < 1e-12);
  CHECK(s->deflection(1) == doctest::Approx(-5 * std::pow(kLength, 4) / (384 * kEJ)).epsilon(1e-10));
  Beam idle = on(unequal(kPush, kPull), 0);
  idle.loads.clear();
  CHECK(only(idle)->result().converged);
  CHECK(only(idle)->result().state.u.here().isZero(0));
}

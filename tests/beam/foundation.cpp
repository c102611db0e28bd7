// Laws per length along the beam.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"
#include "base/error.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"
#include "solver/rows/proximal.hpp"

using namespace dotyk;
using beam::Beam;
using beam::Foundation;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::kEJ;
using test::kFree;
using test::kHeld;
using test::only;

namespace {

constexpr double kLambda = 1.5, kStiffness = 4 * kEJ * kLambda * kLambda * kLambda * kLambda, kForce = 0.8;

void found(Beam& b, const LawChoice& law, double at = 0) { b.foundation.assign(beam::nodes(b).size(), Foundation{law, at}); }

Beam loose(double length, int cells, const LawChoice& law) {
  Beam b = test::beam_between(length, kEJ, 0, kFree, kFree, kFree, kFree);
  b.cells = cells;
  b.loads = {{length / 2, -kForce, 0}};
  found(b, law);
  return b;
}

/// The greatest difference of the nodes' forces from those under a rigid beam, k share (a + b x)⁺ down, by Newton's method on a and b; relative to P.
double off_rigid(const beam::Solution& s, double stiffness, double force, double at) {
  const auto& x = s.model().nodes;
  const int n = static_cast<int>(x.size());
  const auto spring = [&](int i) { return stiffness * s.model().share(i); };
  Eigen::Vector2d ab(force / (stiffness * s.beam().length), 0);
  for (int k = 0; k < 50; ++k) {
    Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
    for (int i = 0; i < n; ++i)
      if (const Eigen::Vector2d one(1, x[i]); ab.dot(one) > 0) H += spring(i) * one * one.transpose();
    ab = H.fullPivLu().solve(force * Eigen::Vector2d(1, at));
  }
  double worst = 0;
  for (int i = 0; i < n; ++i) worst = std::max(worst, std::abs(s.foundation_force(i) - spring(i) * std::max(0.0, ab.dot(Eigen::Vector2d(1, x[i])))));
  return worst / force;
}

/// Hetényi's beam of half length c on springs under a force P down in the middle: with t = c − x from the free end
/// w = A cosh λt cos λt + B (cosh λt sin λt + sinh λt cos λt), w' = 0 in the middle, ∫k w = P/2. Downwards.
struct Hetenyi {
  explicit Hetenyi(double half) : c(half) {
    const double l = kLambda * c, cc = std::cosh(l) * std::cos(l), cs = std::cosh(l) * std::sin(l), sc = std::sinh(l) * std::cos(l),
                 ss = std::sinh(l) * std::sin(l);
    const double a = 2 * cc, b = cs - sc, size = kForce * kLambda / kStiffness / (a * (sc + cs) + 2 * b * ss);
    A = size * a, B = size * b;
  }
  double w(double x) const {  // from the middle
    const double t = kLambda * (c - x);
    return A * std::cosh(t) * std::cos(t) + B * (std::cosh(t) * std::sin(t) + std::sinh(t) * std::cos(t));
  }
  double moment(double x) const {  // EJ w'': −EJ u''
    const double t = kLambda * (c - x);
    return kEJ * kLambda * kLambda * (-2 * A * std::sinh(t) * std::sin(t) + 2 * B * (std::sinh(t) * std::cos(t) - std::cosh(t) * std::sin(t)));
  }
  double c, A, B;
};

double error(const beam::Solution& s, const Hetenyi& exact) {
  double worst = 0;
  const double middle = s.beam().length / 2;
  for (int i = 0; i <= 60; ++i) worst = std::max(worst, std::abs(s.deflection(middle + exact.c * i / 60) + exact.w(exact.c * i / 60)));
  return worst / exact.w(0);
}

double apart(const beam::Solution& a, const beam::Solution& b) {
  CHECK(a.result().converged);
  CHECK(b.result().converged);
  return (a.result().state.u.here() - b.result().state.u.here()).lpNorm<Eigen::Infinity>() / b.result().state.u.here().lpNorm<Eigen::Infinity>();
}

double total(const beam::Solution& s) {
  double sum = 0;
  for (std::size_t i = 0; i < s.model().nodes.size(); ++i) sum += s.foundation_force(static_cast<int>(i));
  return sum;
}

template <class Chosen>
solver::Method to_the_end(Chosen method) {
  method.max_iterations = 100000;
  method.tol = 1e-12;
  return method;
}

}  // namespace

TEST_CASE("Winkler's foundation under a finite beam, of order 2; under a long one λP/2k and P/4λ") {
  const Hetenyi exact(1);
  double before = 0;
  for (const int cells : {16, 32, 64, 128}) {
    const auto s = only(loose(2, cells, {&laws::elastic, kStiffness}));
    const double now = error(*s, exact);
    CAPTURE(now);
    if (before > 0) CHECK(before / now == doctest::Approx(4).epsilon(0.05));
    before = now;
    CHECK(total(*s) == doctest::Approx(kForce).epsilon(1e-10));
    CHECK(s->pressure(1.25) == doctest::Approx(-kStiffness * s->deflection(1.25)).epsilon(cells > 64 ? 1e-3 : 5e-2));
    if (cells == 128) CHECK(s->moment(1.25) == doctest::Approx(exact.moment(0.25)).epsilon(1e-2));
  }
  CHECK(before < 1e-4);
  const auto s = only(loose(16, 400, {&laws::elastic, kStiffness}));  // λL/2 = 12
  CHECK(s->deflection(8) == doctest::Approx(-kForce * kLambda / (2 * kStiffness)).epsilon(1e-4));
  CHECK(s->moment(8) == doctest::Approx(-kForce / (4 * kLambda)).epsilon(1e-3));
}

TEST_CASE("without tension the ends lift off: the beam touches over π/λ whatever the force, in closed form") {
  const double half = M_PI / (2 * kLambda);
  const Hetenyi exact(half);
  for (const double factor : {1.0, 50.0}) {
    Beam b = loose(6, 240, {&laws::one_sided_elastic, kStiffness});
    b.loads[0].force *= factor;
    const auto s = only(b);
    CHECK(s->result().converged);
    for (const double x : {0.0, 0.3, 0.9}) CHECK(s->deflection(3 + x) == doctest::Approx(-factor * exact.w(x)).scale(factor * exact.w(0)).epsilon(1e-3));
    double last = 0;
    for (std::size_t i = 0; i < s->model().nodes.size(); ++i)
      if (s->foundation_force(static_cast<int>(i)) > 0) last = s->model().nodes[i] - 3;
    CHECK(std::abs(last - half) < 6.0 / 240);
    // Beyond it the beam is straight.
    CHECK(s->rotation(6) == doctest::Approx(s->rotation(5)).epsilon(1e-9));
    CHECK(s->deflection(6) > 0);
    CHECK(total(*s) == doctest::Approx(factor * kForce).epsilon(1e-10));
  }
}

TEST_CASE("a clamped beam that meets a rigid floor at depth d: it hangs free over (72 EJ d/q)^(1/4)") {
  // u = −d + q a⁴/72EJ (4σ³ − 3σ⁴), σ = (a − x)/a: no moment where it meets the floor, but a force qa/3; −qa²/6 in the wall.
  const double d = 0.01, q = 4, L = 3, a = std::pow(72 * kEJ * d / q, 0.25);
  REQUIRE(a < L / 2);
  double before = 0;
  for (const int cells : {60, 240}) {
    Beam b = test::beam_between(L, kEJ, -q, kHeld, kHeld, kHeld, kHeld);
    b.cells = cells;
    found(b, {&laws::signorini}, -d);
    const auto s = only(b);
    CHECK(s->result().converged);
    CHECK(s->deflection(1.5) == doctest::Approx(-d).epsilon(1e-4));
    double worst = 0;
    for (int i = 0; i <= 20; ++i) {
      const double sigma = 1 - i / 20.0;
      worst = std::max(worst, std::abs(s->deflection(a * i / 20) + d - q * std::pow(a, 4) / (72 * kEJ) * (4 * std::pow(sigma, 3) - 3 * std::pow(sigma, 4))) / d);
    }
    if (before > 0) CHECK(worst < before / 8);
    before = worst;
    if (cells < 240) continue;
    CHECK(worst < 2e-3);
    CHECK(s->reaction(0).moment == doctest::Approx(q * a * a / 6).epsilon(2e-3));
    CHECK(total(*s) == doctest::Approx(q * (L - 2 * a) + 2 * q * a / 3).epsilon(2e-3));
  }
}

TEST_CASE("friction holds a beam where it is, a capped foundation bears the load it can, and no more") {
  Beam b = test::beam_between(2, kEJ, -0.6, kFree, kFree, kFree, kFree);
  found(b, {&laws::friction, 0.7});
  CHECK(only(b)->pressure(0.3) == doctest::Approx(0.6).epsilon(0.2));  // with nodes at rest: the fixed-end moments of the cells stay
  CHECK(std::abs(only(b)->deflection(1)) < 1e-5);
  found(b, {&laws::capped_elastic, kStiffness, 0.7});
  CHECK(only(b)->deflection(0.4) == doctest::Approx(-0.6 / kStiffness).epsilon(1e-2));
  found(b, {&laws::capped_elastic, kStiffness, 0.5});
  CHECK_THROWS_AS(only(b), InputError);
  found(b, {&laws::one_sided_elastic, kStiffness});
  b.q = 0.6;
  CHECK_THROWS_AS(only(b), InputError);
}

TEST_CASE("every method finds what the foundation bears") {
  const auto compare = [](const Beam& b) {
    const auto exact = only(b);
    solver::Pdas full;
    full.reduced = false;
    CHECK(apart(*only(b, full), *exact) < 1e-8);
    CHECK(apart(*only(b, solver::Newton{}), *exact) < 1e-8);
    CHECK(apart(*only(b, to_the_end(solver::Proximal{})), *exact) < 1e-7);
    return exact;
  };
  compare(loose(6, 48, {&laws::elastic, kStiffness}));
  compare(loose(6, 48, {&laws::one_sided_elastic, kStiffness}));
  compare(loose(6, 48, {&laws::unequal_elastic, kStiffness, kStiffness / 10}));
  compare(loose(6, 48, {&laws::capped_elastic, kStiffness, 0.4}));
  Beam floor = test::beam_between(3, kEJ, -4, kHeld, kHeld, kHeld, kHeld);
  found(floor, {&laws::signorini}, -0.01);
  const auto exact = compare(floor);
  CHECK(apart(*only(floor, solver::InteriorPoint{}), *exact) < 1e-5);
}

TEST_CASE("a foundation that changes along the beam; nodes moved by supports bear for their cells") {
  Beam b = loose(2, 20, {&laws::elastic, kStiffness});
  b.supports.insert(b.supports.begin() + 1, {"inner", 0.63, {&laws::elastic, 1}, kFree});
  const auto x = beam::nodes(b);
  b.foundation.clear();
  for (const double at : x) b.foundation.push_back({at < 1 ? LawChoice{&laws::elastic, kStiffness} : LawChoice{&laws::one_sided_elastic, 2 * kStiffness}, 0.01 * at});
  const auto s = only(b);
  double length = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const int node = static_cast<int>(i);
    const double v = s->deflection(x[i]) - 0.01 * x[i], k = x[i] < 1 ? kStiffness : 2 * kStiffness;
    length += s->model().share(node);
    CHECK(s->foundation_force(node) == doctest::Approx((x[i] < 1 || v < 0 ? -k * v : 0) * s->model().share(node)).scale(1e-3).epsilon(1e-9));
  }
  CHECK(length == doctest::Approx(2).epsilon(1e-14));
  CHECK(total(*s) + s->reaction(1).force == doctest::Approx(kForce).epsilon(1e-10));
}

TEST_CASE("foundations that cannot be are refused, with what they contradict") {
  const auto why = [](Beam b, const LawChoice& law, double at = 0) {
    found(b, law, at);
    try {
      only(b);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("nothing");
  };
  const Beam held = test::beam_between(2, kEJ, -1, kHeld, kFree, kHeld, kFree);
  CHECK(why(held, {&laws::signorini}, -1) == "nothing");
  CHECK(why(held, {&laws::signorini}, 0.1).find("contradict each other: deflections 0 and 0.1") != std::string::npos);
  CHECK(why(held, {&laws::load, 1}).find("loads along the beam are its load") != std::string::npos);
  CHECK(why(held, {&laws::breaking, 1, 1}).find("capped_elastic") != std::string::npos);
  CHECK(why(held, {&laws::elastic, -1}).find("zero or positive") != std::string::npos);
  const Beam stopped = test::beam_between(2, kEJ, -1, {&laws::signorini}, kFree, kHeld, kFree);
  CHECK(why(stopped, {&laws::signorini}).find("both hold the deflection rigidly") != std::string::npos);
  CHECK(why(stopped, {&laws::elastic, 3}) == "nothing");
  Beam few = held;
  few.foundation.resize(3);
  CHECK_THROWS_WITH_AS(only(few), "its foundation has 3 laws for 33 nodes", InputError);
}

TEST_CASE("a beam far stiffer than its one-sided foundation stands on it as a rigid one does, 1.6e6 to 1.6e10 times as stiff as a node's spring") {
  constexpr double length = 6, force = 300, stiffness = 1000;
  for (const int cells : {60, 120})
    for (const double EJ : {1e7, 1e8, 1e9, 1e10})
      for (const double e : {0.4, 1.5, 2.5}) {
        Beam b = test::beam_between(length, EJ, 0, kFree, kFree, kFree, kFree);
        b.cells = cells, b.loads = {{length / 2 + e, -force, 0}};
        found(b, {&laws::one_sided_elastic, stiffness});
        const auto s = only(b);
        INFO(EJ << ", " << cells << " cells, " << e << ": " << s->result().reason);
        CHECK(s->result().converged);
        CHECK(off_rigid(*s, stiffness, force, length / 2 + e) < 1e-7 + 1e3 / EJ);
      }
}

#include "scene/study/inf_sup.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "../support/scenes.hpp"
#include "base/error.hpp"

using namespace dotyk;
using contact::Multipliers;
using mesh::Point;
using scene::MultiplierPart;
using test::given;
using test::quiet;

namespace {

struct JoinedBlocks {
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// Two blocks of n cells each way on top of each other, held below; with `clamped` at their sides as well.
JoinedBlocks stack(int dim, mesh::Family family, int n, const scene::Discretisation& d, bool clamped = false, double g = 1) {
  const auto low = test::block("low", dim, family, n, 0), high = test::block("high", dim, family, n, 1);
  test::fix(low, "bottom");
  if (clamped)
    for (const auto& b : {low, high})
      for (const char* side : {"left", "right"}) test::fix(b, side);
  JoinedBlocks s;
  s.scene = scene::make_scene({low, high});
  s.contact = scene::add_contact(*s.scene, test::part(high, "bottom"), test::part(low, "top"), {}, given(g), false, d);
  return s;
}

double constant(const JoinedBlocks& s, MultiplierPart part = MultiplierPart::tangential) {
  return scene::inf_sup(*s.contact, {part, true}, quiet).constant;
}

}  // namespace

TEST_CASE("the Sobolev norm of a linear displacement") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto m = test::unit(dim, family, 3);
      const auto numbering = elasticity::number(m, std::vector<char>(m.coordinates.size(), 0), std::vector<double>(m.coordinates.size(), 0.0));
      const auto gram = elasticity::h1_gram(m, numbering, 0.5);
      algebra::Vector u = algebra::Vector::Zero(numbering.count());
      for (int n = 0; n < m.node_count(); ++n) u[numbering.unknown[static_cast<std::size_t>(n) * dim]] = 1 + 2 * m.point(n)[1];
      // ∫ 4 + (1 + 2y)²/ℓ² = 4 + 4 (1 + 2 + 4/3)
      CHECK(u.dot(gram.selfadjointView<Eigen::Lower>() * u) == doctest::Approx(4 + 4 * (1 + 2 + 4.0 / 3)).epsilon(1e-12));
    }
}

TEST_CASE("one constant multiplier against a rigid floor: √coth, with the far side held √tanh") {
  // The best displacement solves v″ = v/ℓ² up the block, v′ = 1 at the contact: ∫v = ℓ coth(1/ℓ); ‖1‖² = ℓ.
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const bool held : {false, true}) {
        const auto block = test::block("block", dim, family, 8);
        if (held) test::fix(block, "top");
        auto scene = scene::make_scene({block});
        Point up{0, 0, 0};
        up[dim - 1] = 1;
        const auto contact = scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, up}, {}, false,
                                                given(1), {Multipliers::p1_p0, 10});
        const auto s = scene::inf_sup(*contact, {MultiplierPart::tangential, true}, quiet);
        CHECK(s.multipliers == dim - 1);
        const double length = dim == 2 ? 1 : std::sqrt(2.0), t = std::tanh(1 / length);
        CHECK(s.constant == doctest::Approx(std::sqrt(held ? t : 1 / t)).epsilon(0.002));  // h²/24ℓ² of the discrete v
      }
}

TEST_CASE("dual cells, and cells in space of two facets' width, are stable; cells of one facet are not" * doctest::test_suite("large")) {
  // As the mesh is refined the constant tends to a limit, or to 0 as h does.
  for (const auto family : test::kFamilies) {
    const scene::Discretisation cells{Multipliers::p1_p0, 0};
    CHECK(constant(stack(2, family, 16, cells)) > 0.8);
    CHECK(constant(stack(2, family, 16, cells)) == doctest::Approx(constant(stack(2, family, 8, cells))).epsilon(0.01));
    CHECK(constant(stack(2, family, 16, cells), MultiplierPart::both) > 0.8);
    CHECK(constant(stack(3, family, 8, cells)) > 0.8);
    CHECK(constant(stack(3, family, 8, cells), MultiplierPart::both) > 0.7);
    // H = h: squares of two triangles, or a quadrilateral.
    const double at4 = constant(stack(3, family, 4, {Multipliers::p1_p0, 0.25})),
                 at8 = constant(stack(3, family, 8, {Multipliers::p1_p0, 0.125}));
    CHECK(at4 > 1.8 * at8);
    // Nodal multipliers, and normal ones in the plane: √2, the value between two half-spaces.
    for (int dim : {2, 3})
      CHECK(constant(stack(dim, family, 8, {}), MultiplierPart::both) == doctest::Approx(std::sqrt(2.0)).epsilon(0.03));
  }
  const auto triangles = scene::inf_sup(*stack(3, mesh::Family::p1, 4, {Multipliers::p1_p0, 1e-3}).contact, {MultiplierPart::tangential, true}, quiet);
  CHECK(triangles.multipliers == 64);
  CHECK(triangles.kernel > 0);
  CHECK(triangles.constant == 0);
  CHECK(triangles.above_kernel > 0.1);
}

TEST_CASE("nodes held on both sides: a kernel of two where their multipliers are kept, none where they are shared out") {
  for (const auto family : test::kFamilies)
    for (int n : {4, 8}) {
      const auto s = stack(2, family, n, {Multipliers::p1_p0, 0}, true);
      const auto kept = scene::inf_sup(*s.contact, {MultiplierPart::tangential, false}, quiet);
      CHECK(kept.multipliers == n + 1);
      CHECK(kept.kernel == 2);
      CHECK(kept.constant == 0);
      const auto shared = scene::inf_sup(*s.contact, {MultiplierPart::tangential, true}, quiet);
      CHECK(shared.multipliers == n - 1);
      CHECK(shared.kernel == 0);
      CHECK(shared.constant > 0.8);
    }
  const auto space = stack(3, mesh::Family::p1, 4, {Multipliers::p1_p0, 0}, true);
  CHECK(scene::inf_sup(*space.contact, {MultiplierPart::normal, false}, quiet).kernel > 0);
  CHECK(scene::inf_sup(*space.contact, {MultiplierPart::normal, true}, quiet).kernel == 0);
  CHECK(scene::inf_sup(*space.contact, {MultiplierPart::normal, true}, quiet).constant > 0.6);
}

TEST_CASE("a constant bound, finite or not, does not change the constant") {
  const auto reference = constant(stack(2, mesh::Family::p1, 4, {Multipliers::p1_p0, 0}));
  CHECK(constant(stack(2, mesh::Family::p1, 4, {Multipliers::p1_p0, 0}, false, 1e4)) == doctest::Approx(reference).epsilon(1e-10));
  CHECK(constant(stack(2, mesh::Family::p1, 4, {Multipliers::p1_p0, 0}, false, std::numeric_limits<double>::infinity())) ==
        doctest::Approx(reference).epsilon(1e-10));
}

TEST_CASE("no friction, no tangential multipliers") {
  const auto block = test::block("block", 2, mesh::Family::p1, 2);
  auto scene = scene::make_scene({block});
  const auto contact = scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, 0, 0}, {0, 1, 0}}, {}, false);
  CHECK_THROWS_WITH_AS(scene::inf_sup(*contact, {MultiplierPart::tangential, true}, quiet), doctest::Contains("has no friction"), InputError);
  CHECK(scene::inf_sup(*contact, {MultiplierPart::normal, true}, quiet).constant > 0.5);
}

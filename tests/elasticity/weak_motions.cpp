#include "elasticity/weak_motions.hpp"

#include <doctest/doctest.h>

#include "../support/elastic.hpp"

using namespace dotyk;
using elasticity::FacetSpring;
using elasticity::WeakMotions;
using mesh::Point;
using Given = std::function<bool(const Point&, int)>;

namespace {

WeakMotions weak(const mesh::Mesh& m, const Given& held, const std::vector<FacetSpring>& springs = {}, double E = 1,
                 double nu = 0.3) {
  const auto numbering = test::prescribe(m, held, [](const Point&) { return Point{0, 0, 0}; });
  const auto material = test::steel(m.dimension(), E, nu);
  return elasticity::weak_motions(m, material, {m, numbering, springs}, numbering, [&] { return elasticity::assemble(m, material, springs, numbering); }, elasticity::rigid_modes(m, numbering, springs).modes);
}

bool nothing(const Point&, int) { return false; }

/// The unit square or cube with cells that shrink towards the origin as s^power.
mesh::Mesh graded(int dim, mesh::Family family, int n, double power) {
  mesh::Mesh m = test::unit(dim, family, n);
  mesh::transform(m, [=](Point x) {
    for (int i = 0; i < dim; ++i) x[i] = std::pow(x[i], power);
    return x;
  });
  return m;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a column on soft springs: the stiffness is that of the closed form, k/(π² E)") {
  // Of length 1: it moves on k, and its first vibration with free ends has stiffness π² E.
  for (const auto family : test::kFamilies)
    for (const double k : {1e-6, 1e-8, 1e-10})
      for (const double scale : {1e-20, 1.0, 1e20}) {
        const auto m = test::rectangle(family, 4, 32);
        const auto w = weak(m, [](const Point& x, int i) { return i == 0 && (x[0] == 0 || x[0] == 1); },
                            test::even_springs(m, "bottom", {0, k * scale, 0}), scale, 0);
        CHECK(w.stiffness == doctest::Approx(k / std::pow(std::numbers::pi, 2)).epsilon(0.01));  // of the mesh and one step
        CHECK(texts(w.motions) == Names{"translation along y"});
      }
}

TEST_CASE("springs all around: every motion is named, pure; stiffer springs are no news") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto m = test::unit(dim, family, 4);
      const auto on = [&](double k) { return weak(m, nothing, test::even_springs(m, "bottom", {k, k, k})); };
      CHECK(on(1e-3).motions.empty());
      CHECK(on(1e-3).stiffness == 1);
      CHECK(on(1e-7).motions.size() == (dim == 2 ? 3 : 6));
      CHECK(on(1e-7).motions[0].text() == "translation along x");
      CHECK(on(1e-9).stiffness == doctest::Approx(on(1e-8).stiffness / 10).epsilon(0.01));
      const WeakMotions lost = on(1e-17);
      CHECK(lost.stiffness == 0);
      CHECK(lost.motions.size() == (dim == 2 ? 3 : 6));
    }
}

TEST_CASE("one tiny patch in the plane holds the rotation as the square of its size") {
  for (const auto family : test::kFamilies) {
    std::vector<double> constant;
    for (const double power : {3.2, 3.5, 3.8}) {
      const double a = std::pow(1.0 / 20, power);
      const auto w = weak(graded(2, family, 20, power), [=](const Point& x, int) { return x[1] == 0 && x[0] < 1.1 * a; });
      REQUIRE(texts(w.motions) == Names{"rotation about (0, 0)"});
      constant.push_back(w.stiffness / (a * a));
    }
    // The cells around the patch coarsen with the power, which changes the constant by some ten percent.
    CHECK(constant[1] == doctest::Approx(constant[0]).epsilon(0.3));
    CHECK(constant[2] == doctest::Approx(constant[0]).epsilon(0.3));
    // The same patch where it need not hold the rotation.
    CHECK(weak(graded(2, family, 20, 3), [](const Point& x, int i) { return i == 0 ? x[0] == 0 : x[1] == 0 && x[0] < 1e-3; })
              .motions.empty());
  }
}

TEST_CASE("one tiny patch in space: the rotations; and two nodes close together in the plane") {
  for (const auto family : test::kFamilies) {
    const auto m = graded(3, family, 5, 4);
    const auto w = weak(m, [](const Point& x, int) { return x[2] == 0 && x[0] < 2e-3 && x[1] < 2e-3; });
    REQUIRE(w.motions.size() == 3);
    for (const std::string& name : texts(w.motions)) CHECK(name.find("rotation about the axis along") == 0);
    const auto two = graded(2, family, 12, 4);
    const double d = std::pow(1.0 / 12, 4);  // (0, 0) and (d, d)
    CHECK(texts(weak(two, [=](const Point& x, int) { return x[0] < 1.1 * d && x[0] == x[1]; }).motions) == Names{"rotation about (0, 0)"});
  }
}

TEST_CASE("nodes on one axis leave an exact kernel; nodes almost on one axis a weak motion of that name") {
  for (const auto family : test::kFamilies)
    for (const double bend : {0.0, 1e-4, 0.3}) {
      auto m = test::unit(3, family, 4);
      mesh::transform(m, [=](const Point& x) { return Point{x[0] + bend * x[2] * (1 - x[2]) * (1 - x[1]), x[1], x[2]}; });
      const Given edge = [=](const Point& x, int) {
        return x[1] == 0 && std::abs(x[0] - bend * x[2] * (1 - x[2])) < 1e-12;
      };
      const auto numbering = test::prescribe(m, edge, [](const Point&) { return Point{0, 0, 0}; });
      const auto modes = elasticity::rigid_modes(m, numbering, {});
      CHECK(modes.motions.size() == (bend == 0 ? 1 : 0));
      const WeakMotions w = weak(m, edge);
      REQUIRE(w.motions.size() == (bend == 1e-4 ? 1 : 0));
      const std::string name = bend == 0 ? modes.motions[0].text() : bend == 1e-4 ? w.motions[0].text() : "";
      if (!name.empty()) CHECK(name.find("rotation about the axis along z through (0, 0, 0.5") == 0);
    }
}

TEST_CASE("a motion that is free, exactly, beside one that is held weakly") {
  for (const auto family : test::kFamilies) {
    // The bottom may slide; one soft spring at the side holds against that, or none does.
    const auto m = test::unit(2, family, 6);
    const Given roller = [](const Point& x, int i) { return i == 1 && x[1] == 0; };
    CHECK(weak(m, roller).motions.empty());
    CHECK(texts(weak(m, roller, test::even_springs(m, "left", {1e-8, 0, 0})).motions) == Names{"translation along x"});
    // Springs along y on a body free along x: the rest is weak, the kernel is not named.
    const auto w = weak(m, nothing, test::even_springs(m, "bottom", {0, 1e-8, 0}));
    CHECK(texts(w.motions) == Names{"translation along y", "rotation about (0.5, 0.5)"});
  }
}

TEST_CASE("ordinary supports are not called weak, slender bodies included") {
  for (const auto family : test::kFamilies) {
    const auto square = test::unit(2, family, 32);
    CHECK(weak(square, [](const Point& x, int) { return x[0] == 0; }).motions.empty());
    CHECK(weak(square, [](const Point& x, int) { return x[1] == 0 && x[0] < 0.04; }).motions.empty());  // one facet
    CHECK(weak(square, [](const Point& x, int i) { return x[1] == 0 && (x[0] == 0 || (i == 1 && x[0] == 1)); }).motions.empty());
    const auto cube = test::unit(3, family, 6);
    // Six components at three corners, and one facet.
    CHECK(weak(cube, [](const Point& x, int i) {
            return x[2] == 0 && ((x[0] == 0 && x[1] == 0) || (i >= 1 && x[0] == 1 && x[1] == 0) || (i == 2 && x[0] == 0 && x[1] == 1));
          }).motions.empty());
    CHECK(weak(cube, [](const Point& x, int) { return x[2] == 0 && x[0] < 0.2 && x[1] < 0.2; }).motions.empty());
    const auto beam = test::rectangle(family, 400, 4, 0, 0, 400, 1);
    CHECK(weak(beam, [](const Point& x, int) { return x[0] == 0; }).motions.empty());
    CHECK(weak(beam, [](const Point& x, int i) { return x[1] == 0 && (x[0] == 0 || (i == 1 && x[0] == 400)); }).motions.empty());
    for (const double nu : {-0.9, 0.4999}) CHECK(weak(square, [](const Point& x, int) { return x[0] == 0; }, {}, 1, nu).motions.empty());
  }
}

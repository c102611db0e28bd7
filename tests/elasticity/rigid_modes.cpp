#include "elasticity/rigid_modes.hpp"

#include <doctest/doctest.h>

#include "../support/elastic.hpp"
#include "algebra/dense/decompositions.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using mesh::Point;

namespace {

/// Checks modes against the assembled K: exactly null, independent, and as many as its kernel has.
elasticity::RigidModes checked(const mesh::Mesh& m, const test::Numbering& numbering,
                               const std::vector<elasticity::FacetSpring>& springs = {}) {
  const auto modes = elasticity::rigid_modes(m, numbering, springs);
  const DenseMatrix K = test::full(elasticity::assemble(m, test::steel(m.dimension()), springs, numbering));
  CHECK(modes.modes.cols() == static_cast<int>(modes.motions.size()));
  if (modes.modes.cols() > 0) {
    CHECK((K * modes.modes).norm() <= 1e-12 * K.norm());
    for (int k = 0; k < modes.modes.cols(); ++k)
      CHECK(modes.modes.col(k).lpNorm<Eigen::Infinity>() == doctest::Approx(1));
    CHECK(algebra::PivotedLu(modes.modes).rank() == modes.modes.cols());
  }
  const Eigen::VectorXd e = algebra::eigenvalues(K);
  int kernel = 0;
  // Elastic eigenvalues of these meshes and springs are above 1e-6 of the greatest, null ones below 1e-14.
  while (kernel < e.size() && e[kernel] < 1e-9 * e.maxCoeff()) ++kernel;
  CHECK(kernel == modes.modes.cols());
  return modes;
}

using Given = std::function<bool(const Point&, int)>;

elasticity::RigidModes supported(const mesh::Mesh& m, const Given& given) {
  return checked(m, test::prescribe(m, given, [](const Point&) { return Point{0, 0, 0}; }));
}

std::vector<elasticity::FacetSpring> springs(const mesh::Mesh& m, const std::string& part,
                                             const elasticity::VectorField& k) {
  std::vector<elasticity::FacetSpring> result;
  for (const auto f : m.parts.at(part)) {
    result.push_back({f, {}});
    elasticity::for_each_facet_point(
        m, f, [&](const elasticity::FacetPoint& p) { result.back().stiffness.push_back(k(p.x)); });
  }
  return result;
}

}  // namespace

TEST_CASE("plane bodies: every combination of components held on the four sides") {
  for (const auto family : test::kFamilies) {
    auto m = test::rectangle(family, 3, 2, 4, -1, 6, 0);
    test::Random random(241);
    for (unsigned set = 0; set < 256; set += 1 + random.below(4)) {
      // Bits: x and y on left, right, bottom, top.
      supported(m, [&](const Point& x, int i) {
        const bool side[4] = {x[0] == 4, x[0] == 6, x[1] == -1, x[1] == 0};
        for (int s = 0; s < 4; ++s)
          if (side[s] && (set >> (2 * s + i) & 1)) return true;
        return false;
      });
    }
  }
}

TEST_CASE("solid bodies: random components held at random nodes") {
  for (const auto family : test::kFamilies) {
    auto m = test::box(family, 2, 1, 2, {3, -1, 0}, {5, 1, 1});
    for (int trial = 0; trial < 60; ++trial) {
      test::Random random(300 + trial);
      std::vector<std::pair<int, int>> held;
      for (int k = random.below(8); k > 0; --k) held.emplace_back(random.below(m.node_count()), random.below(3));
      supported(m, [&](const Point& x, int i) {
        for (const auto& [n, c] : held)
          if (c == i && m.point(n) == x) return true;
        return false;
      });
    }
    // Whole sides: sliding on one, two and three faces.
    for (unsigned faces = 0; faces < 8; ++faces) {
      const auto modes = supported(m, [&](const Point& x, int i) {
        const double low[3] = {3, -1, 0};
        return x[i] == low[i] && (faces >> i & 1);
      });
      const int count = static_cast<int>(modes.motions.size());
      CHECK(count == std::vector<int>{6, 3, 3, 1, 3, 1, 1, 0}[faces]);
    }
  }
}

TEST_CASE("names of the motions") {
  const auto m = test::rectangle(mesh::Family::p1, 2, 2, 0, 0, 2, 1);
  using Names = std::vector<std::string>;
  CHECK(texts(supported(m, [](const Point&, int) { return false; }).motions) ==
        Names{"translation along x", "translation along y", "rotation about (1, 0.5)"});
  CHECK(texts(supported(m, [](const Point& x, int i) { return i == 0 && x[0] == 0; }).motions) == Names{"translation along y"});
  CHECK(texts(supported(m, [](const Point& x, int) { return x[0] == 2 && x[1] == 1; }).motions) ==
        Names{"rotation about (2, 1)"});
  const auto box = test::box(mesh::Family::q1, 2, 2, 2, {0, 0, 0}, {2, 2, 2});
  CHECK(texts(supported(box, [](const Point& x, int i) { return i == 2 && x[2] == 0; }).motions) ==
        Names{"translation along x", "translation along y", "rotation about the axis along z through (1, 1, 1)"});
  CHECK(texts(supported(box, [](const Point& x, int) { return x[0] == 0 && x[1] == 0; }).motions) ==
        Names{"rotation about the axis along z through (0, 0, 1)"});
}

TEST_CASE("springs hold what they act on") {
  for (const auto family : test::kFamilies) {
    const auto m = test::rectangle(family, 3, 3);
    const auto free = test::all_free(m);
    CHECK(checked(m, free, springs(m, "bottom", [](const Point&) { return Point{1, 0, 0}; })).motions.size() == 2);
    CHECK(checked(m, free,
                  springs(m, "bottom",
                          [](const Point&) {
                            return Point{0, 1, 0};
                          }))
              .motions[0].text() == "translation along x");
    CHECK(checked(m, free, springs(m, "bottom", [](const Point&) { return Point{1, 2, 0}; })).motions.empty());
    CHECK(checked(m, free, springs(m, "bottom", [](const Point&) { return Point{0, 0, 0}; })).motions.size() == 3);
    const auto box = test::box(family, 2, 2, 2);
    CHECK(checked(box, test::all_free(box),
                  springs(box, "bottom",
                          [](const Point&) {
                            return Point{0, 0, 1};
                          }))
              .motions.size() == 3);
  }
}

TEST_CASE("a spring at a single quadrature point leaves the rotation about it free") {
  for (const auto family : test::kFamilies) {
    const auto m = test::rectangle(family, 1, 1);
    const auto at_one = springs(m, "bottom", [](const Point& x) {
      return x[0] < 0.5 ? Point{1, 1, 0} : Point{0, 0, 0};
    });
    const auto modes = checked(m, test::all_free(m), at_one);
    REQUIRE(modes.motions.size() == 1);
    CHECK(modes.motions[0].text() == "rotation about (0.211325, 0)");
  }
}

TEST_CASE("modes do not depend on the place and the unit of length") {
  for (double size : {1e-6, 1.0, 1e5}) {
    const auto m = test::rectangle(mesh::Family::p1, 4, 2, 100 * size, 7 * size, 102 * size, 8 * size);
    const auto modes = checked(m, test::prescribe(
                                      m, [&](const Point& x, int i) { return i == 1 && x[1] == 7 * size; },
                                      [](const Point&) {
                                        return Point{0, 0, 0};
                                      }));
    CHECK(texts(modes.motions) == std::vector<std::string>{"translation along x"});
  }
}

TEST_CASE("prescribed values do not matter for what is held") {
  const auto m = test::rectangle(mesh::Family::p1, 2, 2);
  const auto numbering = test::prescribe(
      m, [](const Point& x, int i) { return x[0] == 0 && i == 0; },
      [](const Point& x) {
        return Point{x[1], 0, 0};
      });
  CHECK(texts(elasticity::rigid_modes(m, numbering, {}).motions) == std::vector<std::string>{"translation along y"});
}

TEST_CASE("any rigid motion is named by what it is, with its sense and amount") {
  const auto told = [](const mesh::Mesh& m, std::vector<double> c) { return elasticity::RigidFrame(m).motion(Eigen::Map<const algebra::Vector>(c.data(), std::ssize(c)), 1e-6, true); };
  const mesh::Mesh plane = test::rectangle(mesh::Family::p1, 2, 2, 0, 0, 2, 1);  // about (1, 0.5), of size 2
  const auto turned = told(plane, {0.25, -0.5, -1});  // about the origin: t = ω × (1, 0.5), ω = -1/2
  CHECK(turned.text() == "clockwise rotation about (0, 0)");
  CHECK(turned.amount == doctest::Approx(-0.5));
  CHECK(told(plane, {3, 4, 1e-9}).text() == "translation along (0.6, 0.8)");
  CHECK(told(plane, {3, 4, 0}).amount == doctest::Approx(5));
  const mesh::Mesh box = test::box(mesh::Family::p1, 2, 2, 2);
  CHECK(told(box, {0, 0, 0, 0, 0, -1}).text() == "rotation about the axis along -z through (0.5, 0.5, 0.5)");
  CHECK(times(-2, told(box, {0, 0, 0, 0, 0, 1})).text() == "rotation about the axis along -z through (0.5, 0.5, 0.5)");
}

// One normal for both parts: by closed forms, and the same whichever part is named first.
#include "contact/frame.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <tuple>

#include "../support/meshes.hpp"
#include "contact/pairing.hpp"

using namespace dotyk;
using contact::ContactRow;
using contact::Face;
using contact::Pairing;
using mesh::Family;
using mesh::Mesh;
using mesh::Point;

namespace {

/// Heights of the lower and the upper part above the common tangent plane.
using Height = std::function<double(const Point&)>;

/// A block of about n cells along [-1, 1], its side next to the plane bent; `up`: the one above it.
Mesh bent(int dimension, Family family, int n, bool up, const Height& height) {
  const double low = up ? 0 : -1, high = up ? 1 : 0;
  Mesh m = dimension == 2 ? test::rectangle(family, n, 2, -1, low, 1, high) : test::box(family, n, n, 2, {-1, -1, low}, {1, 1, high});
  mesh::transform(m, [&](Point x) {
    double& z = x[dimension - 1];
    const double share = 1 - std::abs(z);
    z += share * height(x);
    return x;
  });
  return m;
}

struct Pair {
  Mesh lower, upper;
  Face low() const { return {lower, lower.parts.at("top"), "lower"}; }
  Face high() const { return {upper, upper.parts.at("bottom"), "upper"}; }
};

Pair pair(int dimension, Family family, int n, int m, const Height& lower, const Height& upper) {
  return {bent(dimension, family, n, false, lower), bent(dimension, family, m, true, upper)};
}

/// Greatest distance of normals from what is known, what sees the parts' edges left out: there a normal is the outermost facet's.
double worst(const Face& first, const Face& second, Pairing pairing, const std::function<Point(const Point&)>& known) {
  const contact::PairedRows paired = contact::pair_rows(first, second, pairing, {}, true);
  const Mesh& mesh = paired.turned ? second.mesh : first.mesh;
  double most = 0;
  for (const ContactRow& row : paired.rows) {
    const Point x = mesh.point(row.node);
    bool inside = true;
    for (int i = 0; i < mesh.dimension() - 1; ++i) inside = inside && std::abs(x[i]) < 0.6;
    const Point n = paired.turned ? mesh::times(-1, row.normal) : row.normal;
    if (inside) most = std::max(most, mesh::length(mesh::minus(n, known(x))));
  }
  return most;
}

Height sphere(double k) {
  return [k](const Point& x) { return k / 2 * (x[0] * x[0] + x[1] * x[1]); };
}
Height arc(int axis, double k) {
  return [=](const Point& x) { return k / 2 * x[axis] * x[axis]; };
}
double flat(const Point&) { return 0; }

Point upwards(int dimension, double sign) {
  Point n{0, 0, 0};
  n[dimension - 1] = sign;
  return n;
}

}  // namespace

TEST_CASE("a curved part on a flat one has the flat one's normal, exactly, whichever comes first") {
  for (const int dimension : {2, 3})
    for (const Family family : test::kAllFamilies)
      for (const auto& [n, m, pairing] : {std::tuple(8, 8, Pairing::matching), {6, 8, Pairing::mortar}, {8, 6, Pairing::mortar}, {6, 8, Pairing::node_to_segment}}) {
        CAPTURE(dimension);
        CAPTURE(test::name(family));
        const Height curved = dimension == 2 ? arc(0, 0.2) : sphere(0.2);
        const Pair p = pair(dimension, family, n, m, flat, curved);
        CHECK(worst(p.low(), p.high(), pairing, [&](const Point&) { return upwards(dimension, 1); }) < 1e-5);
        CHECK(worst(p.high(), p.low(), pairing, [&](const Point&) { return upwards(dimension, -1); }) < 1e-5);
      }
}

TEST_CASE("equal arcs, opposed or crossed, have the common tangent plane's normal; parts that conform the flatter one's") {
  for (const Family family : {Family::p1, Family::q1}) {
    CAPTURE(test::name(family));
    const double k = 0.2;
    struct Case {
      int dimension;
      Height lower, upper;
      std::function<Point(const Point&)> known;
    };
    const auto up = [](int dimension) { return [=](const Point&) { return upwards(dimension, 1); }; };
    const Case cases[] = {
        {2, arc(0, -k), arc(0, k), up(2)},                // discs
        {2, arc(0, -k), arc(0, 2 * k), up(2)},            // of unlike radii
        {3, sphere(-k), sphere(k), up(3)},                // balls
        {3, arc(0, -k), arc(1, k), up(3)},                // crossed cylinders
        {3, arc(0, -k), sphere(k), up(3)},                // a ball on a cylinder
        {2, arc(0, k), arc(0, 1.25 * k), [=](const Point& x) {  // a disc in a hollow: slopes k x and 1.25 k x by 5/9 and 4/9
           return mesh::unit({-k * x[0] * (5 + 4 * 1.25) / 9, 1, 0});
         }}};
    for (const Case& c : cases) {
      CAPTURE(&c - cases);
      double before = 0;
      for (const int n : {12, 24}) {
        if (c.dimension == 3 && n > 12) continue;
        const Pair p = pair(c.dimension, family, n, n * 3 / 4, c.lower, c.upper);
        const double one = worst(p.low(), p.high(), Pairing::mortar, c.known);
        const double two = worst(p.high(), p.low(), Pairing::mortar, [&](const Point& x) { return mesh::times(-1, c.known(x)); });
        CHECK(one < 0.03 * k);  // of slopes up to 0.6 k; one part's normal alone is off by that
        CHECK(two < 0.03 * k);
        if (before > 0) CHECK(std::max(one, two) < before);
        before = std::max(one, two);
      }
    }
  }
}

TEST_CASE("flat parts keep their normal to the last bit, turned or not, and an edge of the second part leaves the first one's") {
  for (const double angle : {0.0, 0.3, 1.1}) {
    Pair p = pair(2, Family::q1, 6, 8, flat, flat);
    for (Mesh* m : {&p.lower, &p.upper})
      mesh::transform(*m, [&](const Point& x) {
        return Point{x[0] * std::cos(angle) - x[1] * std::sin(angle), x[0] * std::sin(angle) + x[1] * std::cos(angle), 0};
      });
    const auto sides = contact::sides(p.lower, p.low().facets);
    const auto rows = contact::pair_rows(p.low(), p.high(), Pairing::mortar, {}, true).rows;
    REQUIRE(rows.size() == sides.size());
    for (std::size_t k = 0; k < rows.size(); ++k) CHECK(mesh::length(mesh::minus(rows[k].normal, sides[k].normal)) < (angle == 0 ? 1e-300 : 1e-15));
  }
  // A roof upside down, its ridge on a plane: both sides of the ridge look at it, neither is its normal.
  const Pair roof = pair(2, Family::q1, 8, 8, flat, [](const Point& x) { return std::abs(x[0]) / 2; });
  for (const ContactRow& row : contact::pair_rows(roof.low(), roof.high(), Pairing::node_to_segment, {}, true).rows)
    if (std::abs(roof.lower.point(row.node)[0]) < 1e-12) CHECK(row.normal == Point{0, 1, 0});
}

TEST_CASE("the part that is coarser where the parts are nearest has the rows, whichever comes first, also where a part curves away") {
  for (const int dimension : {2, 3})
    for (const Family family : test::kAllFamilies)
      for (const auto& [low, high] : {std::pair{9, 14}, {14, 9}}) {
        CAPTURE(dimension);
        CAPTURE(test::name(family));
        // Slopes up to 0.8: the upper part is longer than the lower one, and sees less of it along its normals.
        const Pair p = pair(dimension, family, low, high, flat, dimension == 2 ? arc(0, 0.8) : sphere(0.5));
        for (const Pairing pairing : {Pairing::mortar, Pairing::node_to_segment}) {
          const auto one = contact::pair_rows(p.low(), p.high(), pairing, {}, true), two = contact::pair_rows(p.high(), p.low(), pairing, {}, true);
          CHECK(one.turned == (pairing == Pairing::mortar ? high < low : low < high));
          CHECK(two.turned != one.turned);
          REQUIRE(one.rows.size() == two.rows.size());
          for (std::size_t k = 0; k < one.rows.size(); ++k) CHECK(one.rows[k].node == two.rows[k].node);
        }
      }
}

TEST_CASE("two cylinders almost along each other: the normal is no farther from the mean than theirs") {
  // Axes along y, the second turned by φ and tilted by t: the normals of both at the line of contact differ by t along y.
  for (const double angle : {1e-4, 3e-3, 1e-2, 0.1, 0.5, 1.5})
    for (const double tilt : {1e-3, 1e-2}) {
      CAPTURE(angle);
      CAPTURE(tilt);
      const Eigen::Vector3d one{1, 0, 0}, two{std::cos(angle), std::sin(angle), 0};
      const Eigen::Matrix3d K1 = one * one.transpose() / 10, K2 = two * two.transpose() / 20;
      const Point n1{0, 0, 1}, n2 = mesh::unit({0, -tilt, 1}), mean = mesh::unit(mesh::plus(n1, n2));
      const contact::Frame frame = contact::frame_between(n1, K1, n2, K2, 1e-9, 3);
      const double half = mesh::length(mesh::minus(mesh::times(1 / mesh::dot(n1, mean), n1), mean));
      CHECK(mesh::length(mesh::minus(frame.normal, mean)) <= half * (1 + 1e-12));
      CHECK(mesh::length(mesh::minus(contact::frame_between(n2, K2, n1, K1, 1e-9, 3).normal, frame.normal)) < 1e-15);
    }
}

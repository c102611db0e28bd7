#include "contact/matching.hpp"

#include <doctest/doctest.h>

#include "../support/block_pair.hpp"
#include "../support/facets.hpp"
#include "base/error.hpp"

using namespace dotyk;
using contact::Face;
using mesh::Family;
using mesh::Point;

TEST_CASE("nodes at the same place are partners, whatever their numbers") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto low = test::unit(dim, family, 4);
      auto high = test::reversed(low);
      mesh::transform(high, [&](Point x) { return x[dim - 1] += 1, x; });
      const auto pairs = contact::match(test::face(low, "top"), test::face(high, "bottom"));
      CHECK(pairs.size() == (dim == 2 ? 5u : 25u));
      for (const auto& p : pairs) CHECK(low.point(p.first) == high.point(p.second));
      const auto rows = contact::between(test::face(low, "top"), test::face(high, "bottom"), {});
      double weight = 0;
      for (const auto& r : rows) {
        CHECK(r.gap == 0);
        CHECK(r.normal[dim - 1] == doctest::Approx(1));
        weight += r.weight;
      }
      CHECK(weight == doctest::Approx(1).epsilon(1e-14));
    }
}

TEST_CASE("matching tolerates rounding of coordinates") {
  const auto low = test::rectangle(Family::p1, 10, 2);
  auto high = test::rectangle(Family::p1, 10, 3, 0, 1, 1, 2);
  for (int n = 0; n < high.node_count(); ++n) high.coordinates[2 * n] += (n % 3 - 1) * 1e-13;
  CHECK(contact::match(test::face(low, "top"), test::face(high, "bottom")).size() == 11);
}

TEST_CASE("across a gap partners lie along the normal, and the gap is the distance") {
  for (int dim : {2, 3})
    for (const double distance : {0.3, -0.05}) {
      const auto low = test::unit(dim, Family::p1, 3);
      auto high = test::unit(dim, Family::q1, 3);
      mesh::transform(high, [&](Point x) { return x[dim - 1] += 1 + distance, x; });
      const auto rows =
          contact::between(test::face(low, "top"), test::face(high, "bottom"), [](const Point& x) { return 10 * x[0]; }, true);
      CHECK(rows.size() == (dim == 2 ? 4u : 16u));
      for (const auto& r : rows) CHECK(r.gap == doctest::Approx(distance + 10 * low.node(r.node)[0]));
    }
}

TEST_CASE("parts that overlap at rest are refused with depth and place, unless that is meant or made up for") {
  for (int dim : {2, 3}) {
    const auto low = test::unit(dim, Family::p1, 3);
    auto high = test::unit(dim, Family::q1, 3);
    mesh::transform(high, [&](Point x) { return x[dim - 1] += 0.95, x; });
    const auto meet = [&](double added, bool interference = false) {
      return contact::between(test::face(low, "top"), test::face(high, "bottom"), [=](const Point&) { return added; }, interference);
    };
    CHECK_THROWS_WITH_AS(meet(0), doctest::Contains("overlap by 0.05 at "), InputError);
    CHECK_THROWS_WITH_AS(meet(-0.01), doctest::Contains("overlap by 0.05 at "), InputError);
    CHECK_NOTHROW(meet(0.05));
    CHECK(meet(0, true).front().gap == doctest::Approx(-0.05));
    mesh::transform(high, [&](Point x) { return x[dim - 1] += 0.05 + 1e-9, x; });
    CHECK(meet(-0.01).front().gap == doctest::Approx(-0.01));  // a press fit that is said
  }
}

TEST_CASE("parts may overhang each other") {
  const auto low = test::rectangle(Family::p1, 8, 2, 0, 0, 2, 1);
  const auto high = test::rectangle(Family::q1, 4, 2, 1, 1, 2, 2),
             beside = test::rectangle(Family::p1, 8, 2, 1.5, 1, 3.5, 2);
  CHECK(contact::match(test::face(low, "top"), test::face(high, "bottom")).size() == 5);
  CHECK(contact::match(test::face(high, "bottom"), test::face(low, "top")).size() == 5);
  CHECK(contact::match(test::face(low, "top"), test::face(beside, "bottom")).size() == 3);
}

TEST_CASE("meshes that do not match are refused with a node, also where some nodes coincide") {
  const auto low = test::rectangle(Family::p1, 8, 2);
  for (int n : {3, 5, 7, 9, 12, 16, 4}) {
    const auto high = test::rectangle(Family::p1, n, 2, 0, 1, 1, 2);
    CHECK_THROWS_WITH_AS(contact::match(test::face(low, "top"), test::face(high, "bottom")), doctest::Contains("do not match"),
                         InputError);
  }
  const auto box = test::box(Family::p1, 4, 4, 1);
  for (int n : {3, 6, 8, 2}) {
    const auto high = test::box(Family::q1, n, 4, 1, {0, 0, 1}, {1, 1, 2});
    CHECK_THROWS_AS(contact::match(test::face(box, "top"), test::face(high, "bottom")), InputError);
  }
}

TEST_CASE("parts that do not face each other are refused") {
  const auto low = test::rectangle(Family::p1, 4, 2), high = test::rectangle(Family::p1, 4, 2, 0, 1, 1, 2);
  CHECK_THROWS_AS(contact::match(test::face(low, "top"), test::face(high, "top")), InputError);
  const auto far = test::rectangle(Family::p1, 4, 2, 10, 1, 11, 2);
  CHECK_THROWS_AS(contact::match(test::face(low, "top"), test::face(far, "bottom")), InputError);
}

TEST_CASE("a broken line in contact has two rows at its corner, each along its own normal") {
  const auto notch =
      test::without(test::rectangle(Family::p1, 8, 8), [](const Point& x) { return x[0] > 0.5 && x[1] > 0.5; });
  const auto legs = mesh::select(
      notch, [](const Point& x, const Point&) { return (x[0] == 0.5 && x[1] > 0.5) || (x[1] == 0.5 && x[0] > 0.5); });
  const auto block = test::rectangle(Family::p1, 4, 4, 0.5, 0.5, 1, 1);
  std::vector<mesh::Facet> faces = block.parts.at("left");
  faces.insert(faces.end(), block.parts.at("bottom").begin(), block.parts.at("bottom").end());
  const auto rows = contact::between({block, faces, "block"}, {notch, legs, "notch"}, {});
  CHECK(rows.size() == 10);
  int corner = 0;
  for (const auto& r : rows) {
    CHECK(r.gap == 0);
    CHECK(r.normal[0] * r.normal[1] == 0);
    corner += block.point(r.node) == Point{0.5, 0.5, 0};
  }
  CHECK(corner == 2);
}

TEST_CASE("an added gap that is no number is refused with its place") {
  const auto low = test::rectangle(Family::p1, 2, 1), high = test::rectangle(Family::p1, 2, 1, 0, 1, 1, 2);
  CHECK_THROWS_WITH_AS(
      contact::between(test::face(low, "top"), test::face(high, "bottom"), [](const Point& x) { return x[0] == 0.5 ? NAN : 0; }),
      "the gap is nan at (0.5, 1); it must be a finite number", InputError);
}

#include "contact/matching.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "../support/block_pair.hpp"
#include "../support/facets.hpp"
#include "../support/matching.hpp"
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

namespace {

/// Cells that grow by one factor along every axis but the last: of twelve the first is 1e-8 of the whole, 2000 long.
Point graded(Point x, int dim) {
  for (int i = 0; i + 1 < dim; ++i) x[i] = 2000 * std::expm1(20 * x[i]) / std::expm1(20);
  return x;
}

int node_at(const mesh::Mesh& m, const Point& x) {
  for (int n = 0; n < m.node_count(); ++n)
    if (m.point(n) == x) return n;
  return -1;
}

}  // namespace

TEST_CASE("on graded meshes nodes have the partners that they have on even ones, however small facets are beside the part") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const double distance : {0.0, 0.3, -0.05}) {
        auto low = test::unit(dim, family, dim == 2 ? 12 : 6);
        auto high = test::reversed(low);
        mesh::transform(high, [&](Point x) { return x[dim - 1] += 1 + distance, x; });
        const auto even = contact::match(test::face(low, "top"), test::face(high, "bottom"));
        for (mesh::Mesh* m : {&low, &high}) mesh::transform(*m, [&](const Point& x) { return graded(x, dim); });
        const auto pairs = contact::match(test::face(low, "top"), test::face(high, "bottom"));
        CHECK(std::equal(pairs.begin(), pairs.end(), even.begin(), even.end(),
                         [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; }));
        for (const auto& row : contact::between(test::face(low, "top"), test::face(high, "bottom"), {}, true))
          CHECK(row.gap == doctest::Approx(distance).epsilon(1e-12));
        if (distance != 0) continue;
        const auto glued = contact::pair_ties(test::face(low, "top"), test::face(high, "bottom"), contact::Pairing::matching);
        CHECK(glued.ties.size() == even.size());
      }
}

TEST_CASE("an overlap that is much beside small facets is no rounding of coordinates") {
  for (int dim : {2, 3}) {
    auto low = test::unit(dim, Family::p1, 6);
    auto high = low;
    mesh::transform(high, [&](Point x) { return x[dim - 1] += 1, x; });
    for (mesh::Mesh* m : {&low, &high}) mesh::transform(*m, [&](const Point& x) { return graded(x, dim); });
    CHECK_NOTHROW(contact::between(test::face(low, "top"), test::face(high, "bottom"), {}));
    mesh::transform(high, [&](Point x) { return x[dim - 1] -= 1e-5, x; });
    CHECK_THROWS_WITH_AS(contact::between(test::face(low, "top"), test::face(high, "bottom"), {}), doctest::Contains("overlap by 1e-05"), InputError);
  }
}

TEST_CASE("a node has one partner, the nearest; nodes at one place share it") {
  // A slit from the top: its lips' ends lie above one node of the other body.
  auto low = test::rectangle(Family::q1, 4, 4);
  const int end = node_at(low, {0.5, 1, 0}), copy = low.node_count();
  low.coordinates.insert(low.coordinates.end(), {0.5, 1});
  for (int c = 0; c < low.cell_count(); ++c)
    if (low.cell_centre(c)[0] > 0.5)
      for (int a = 0; a < 4; ++a)
        if (int& node = low.cells[static_cast<std::size_t>(c) * 4 + a]; node == end) node = copy;
  const auto high = test::rectangle(Family::q1, 4, 4, 0, 1, 1, 2);
  std::map<int, int> times;
  for (const auto& pair : contact::match(test::face(low, "top"), test::face(high, "bottom"))) {
    CHECK(low.point(pair.first) == high.point(pair.second));
    ++times[pair.second];
  }
  CHECK(times.size() == 5);
  CHECK(times.at(node_at(high, {0.5, 1, 0})) == 2);
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

#include "contact/pairing.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "../support/block_pair.hpp"
#include "../support/facets.hpp"
#include "../support/matching.hpp"
#include "base/error.hpp"
#include "contact/projection.hpp"

using namespace dotyk;
using contact::Across;
using contact::Face;
using contact::Pairing;
using mesh::Family;
using mesh::Point;

namespace {

/// Σ weight x_partner.
Point across(const mesh::Mesh& mesh, const std::vector<contact::NodeWeight>& partners) {
  Point sum{0, 0, 0};
  for (const auto& p : partners)
    for (int i = 0; i < 3; ++i) sum[i] += p.weight * mesh.point(p.node)[i];
  return sum;
}

double apart(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

TEST_CASE("mortar reproduces linear functions, and its integrals are those of either part's hats") {
  for (int dim : {2, 3})
    for (const Family one : test::kFamilies)
      for (const Family other : test::kFamilies)
        for (const auto& [n, m] : {std::pair{2, 3}, {5, 7}, {7, 5}, {4, 4}, {1, 6}})
          for (const double angle : {0.0, 0.4}) {
            const int cells = 100 * n + m;
            const bool p1[2] = {one == Family::p1, other == Family::p1};
            CAPTURE(dim);
            CAPTURE(p1[0]);
            CAPTURE(p1[1]);
            CAPTURE(cells);
            CAPTURE(angle);
            const test::BlockPair p = test::block_pair(dim, one, other, n, m, angle);
            const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
            const auto sides = contact::sides(first.mesh, first.facets);
            const auto all = contact::mortar(first, second, sides);
            std::vector<double> reached(p.low.node_count(), 0);
            for (std::size_t k = 0; k < sides.size(); ++k) {
              CHECK(all[k].weight == doctest::Approx(sides[k].weight).epsilon(1e-12));  // ∫φ of the first part
              CHECK(apart(across(p.low, all[k].partners), p.high.point(sides[k].node)) < 1e-12);
              double sum = 0;
              for (const auto& partner : all[k].partners) sum += partner.weight, reached[partner.node] += partner.weight * all[k].weight;
              CHECK(std::abs(sum - 1) < 1e-14);
            }
            for (const auto& node : contact::nodes(second.mesh, second.facets))
              CHECK(std::abs(reached[node.node] - node.weight) < 1e-13);  // Σ_k M_kj = ∫φ_j of the second: the patch test
          }
}

TEST_CASE("on matching nodes mortar and feet are the matching nodes") {
  for (int dim : {2, 3})
    for (const Family family : test::kFamilies) {
      const test::BlockPair p = test::block_pair(dim, family, family, 4, 4, 0.3);
      const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
      const auto rows = contact::between(first, second, {});
      for (const Pairing pairing : {Pairing::mortar, Pairing::node_to_segment}) {
        const auto same = contact::pair_rows(first, second, pairing, {}, false);
        CHECK(same.pairing == pairing);
        REQUIRE(same.rows.size() == rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
          CHECK(same.rows[k].node == rows[k].node);
          double other = 0;
          for (const auto& partner : same.rows[k].partners)
            if (partner.node == rows[k].partners.front().node)
              CHECK(partner.weight == doctest::Approx(1).epsilon(1e-9));  // the foot is one by coordinates' rounding
            else
              other += std::abs(partner.weight);
          CHECK(other < 1e-9);
          CHECK(std::abs(same.rows[k].gap - rows[k].gap) < 1e-12);
          CHECK(same.rows[k].weight == doctest::Approx(rows[k].weight).epsilon(1e-12));
        }
      }
      CHECK(contact::pair_rows(first, second, {}, {}, false).pairing == Pairing::matching);
    }
}

TEST_CASE("feet reproduce linear functions, but not the second part's integrals") {
  for (int dim : {2, 3})
    for (const Family other : test::kFamilies) {
      const test::BlockPair p = test::block_pair(dim, Family::p1, other, 5, 7);
      const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
      const auto sides = contact::sides(first.mesh, first.facets);
      const auto all = contact::node_to_segment(first, second, sides);
      std::vector<double> reached(p.low.node_count(), 0);
      for (std::size_t k = 0; k < sides.size(); ++k) {
        CHECK(apart(across(p.low, all[k].partners), p.high.point(sides[k].node)) < 1e-12);
        for (const auto& partner : all[k].partners) reached[partner.node] += partner.weight * sides[k].weight;
      }
      double worst = 0;
      for (const auto& node : contact::nodes(second.mesh, second.facets)) worst = std::max(worst, std::abs(reached[node.node] / node.weight - 1));
      CHECK(worst > 0.1);
    }
}

TEST_CASE("parts that overhang: what is covered counts, however little of a facet it is") {
  for (int dim : {2, 3})
    for (const Family family : test::kFamilies)
      for (const double shift : {0.25, 0.37, 0.5 + 1e-3, 0.5 + 1e-5}) {
        test::BlockPair p = test::block_pair(dim, family, family, 3, 2);
        mesh::transform(p.high, [&](Point x) { return x[0] += shift, x; });
        const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
        const auto rows = contact::pair_rows(first, second, Pairing::mortar, {}, false).rows;
        double weight = 0, moment = 0, reached = 0;
        for (const auto& row : rows) {
          weight += row.weight;
          moment += row.weight * across(p.high, row.own)[0];
          reached += row.weight * across(p.low, row.partners)[0];
          CHECK(std::abs(row.gap) < 1e-12);
        }
        CHECK(weight == doctest::Approx(1 - shift).epsilon(1e-12));
        CHECK(moment == doctest::Approx((1 - shift * shift) / 2).epsilon(1e-12));  // ∫x over what is covered
        CHECK(reached == doctest::Approx(moment).epsilon(1e-10));
      }
}

TEST_CASE("a gap is its mean: constant and linear ones are exact") {
  for (int dim : {2, 3}) {
    test::BlockPair p = test::block_pair(dim, Family::p1, Family::q1, 3, 5);
    mesh::transform(p.high, [&](Point x) { return x[dim - 1] += 0.1 + 0.05 * x[0], x; });
    // The lower part first: what lies across is looked for along its facets' normal, the axis, where the gap is 0.1 + 0.05 x; it is
    // measured along the normal of both, which leans half as far as the upper part does.
    const double leaning = std::cos(std::atan(0.05) / 2);
    const auto rows = contact::pair_rows(test::face(p.low, "top"), test::face(p.high, "bottom"), {}, [](const Point& x) { return x[0]; }, false);
    CHECK(rows.pairing == Pairing::mortar);
    for (const auto& row : rows.rows) CHECK(row.gap == doctest::Approx((0.1 + 0.05 * p.low.node(row.node)[0]) * leaning + p.low.node(row.node)[0]).epsilon(1e-12));
  }
}

TEST_CASE("distorted quadrilaterals: forces balance to rounding, integrals are those of the rule") {
  test::BlockPair p = test::block_pair(3, Family::q1, Family::q1, 3, 4);
  const auto move = [](mesh::Mesh& m) {
    mesh::transform(m, [](Point x) {
      const double bump = 16 * x[0] * (1 - x[0]) * x[1] * (1 - x[1]);
      x[0] += 0.04 * bump * std::sin(5 * x[1] + 1), x[1] += 0.04 * bump * std::cos(7 * x[0]);
      return x;
    });
  };
  move(p.low), move(p.high);
  const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
  const auto sides = contact::sides(first.mesh, first.facets);
  const auto all = contact::mortar(first, second, sides);
  std::vector<double> reached(p.low.node_count(), 0);
  for (std::size_t k = 0; k < sides.size(); ++k)
    for (const auto& partner : all[k].partners) reached[partner.node] += partner.weight * all[k].weight;
  for (const auto& node : contact::nodes(second.mesh, second.facets))
    CHECK(std::abs(reached[node.node] / node.weight - 1) < 1e-9);  // degree 11 on rational functions
  for (std::size_t k = 0; k < sides.size(); ++k)
    CHECK(apart(across(p.low, all[k].partners), p.high.point(sides[k].node)) < 1e-8);
}

TEST_CASE("chords of a curve that overlap by their height touch; a ring in a ring") {
  const auto arc = [](double inner, double outer, int cells) {
    mesh::Mesh m = test::rectangle(Family::q1, cells, 2);
    mesh::transform(m, [&](const Point& x) {
      const double r = inner + (outer - inner) * x[1], a = std::numbers::pi / 2 * (1 - x[0]);
      return Point{r * std::cos(a), r * std::sin(a), 0};
    });
    return m;
  };
  const mesh::Mesh shaft = arc(0.5, 1, 11), bush = arc(1, 1.5, 16);
  const auto rows = contact::pair_rows(test::face(shaft, "top"), test::face(bush, "bottom"), {}, {}, false);
  CHECK(rows.pairing == Pairing::mortar);
  CHECK(rows.rows.size() == 12);
  const double height = 1 - std::cos(std::numbers::pi / 44);  // of the shaft's chords
  for (const auto& row : rows.rows) {
    CHECK(row.gap >= 0);
    CHECK(row.gap < 2 * height);
  }
  CHECK_THROWS_WITH_AS(contact::pair_rows(test::face(shaft, "top"), test::face(arc(0.98, 1.5, 16), "bottom"), {}, {}, false),
                       doctest::Contains("overlap by"), InputError);
}

TEST_CASE("of two sheets above each other the nearer one counts") {
  // A part of two plates' lower sides, one 0.5 and one 1.5 above.
  mesh::Mesh low = test::rectangle(Family::p1, 4, 2), near = test::rectangle(Family::p1, 3, 1, 0, 1.5, 1, 1.7);
  const mesh::Mesh far = test::rectangle(Family::p1, 5, 1, 0, 2.5, 1, 2.7);
  std::vector<mesh::Facet> facets = near.parts.at("bottom");
  const int nodes = near.node_count(), cells = near.cell_count();
  near.coordinates.insert(near.coordinates.end(), far.coordinates.begin(), far.coordinates.end());
  for (const int node : far.cells) near.cells.push_back(node + nodes);
  for (const mesh::Facet f : far.parts.at("bottom")) facets.push_back({f.cell + cells, f.local});
  const Face second{near, facets, "plates"};
  for (const Pairing pairing : {Pairing::mortar, Pairing::node_to_segment})
    for (const auto& row : contact::pair_rows(test::face(low, "top"), second, pairing, {}, false).rows)
      CHECK(row.gap == doctest::Approx(0.5));
}

TEST_CASE("parts that do not face each other have no pairing at all") {
  const auto low = test::rectangle(Family::p1, 4, 2), high = test::rectangle(Family::p1, 3, 2, 0, 1, 1, 2),
             beside = test::rectangle(Family::p1, 3, 2, 1, 1, 2, 2);
  for (const std::optional<Pairing> pairing : {std::optional<Pairing>{}, std::optional{Pairing::mortar}, std::optional{Pairing::node_to_segment}}) {
    CHECK_THROWS_WITH_AS(contact::pair_rows(test::face(low, "top"), test::face(high, "top"), pairing, {}, false),
                         doctest::Contains("do not face each other"), InputError);
    if (pairing != Pairing::node_to_segment)  // two corners are one another's feet
      CHECK_THROWS_AS(contact::pair_rows(test::face(low, "top"), test::face(beside, "bottom"), Pairing::mortar, {}, false), InputError);
  }
  CHECK_THROWS_WITH_AS(contact::pair_rows(test::face(low, "top"), test::face(high, "bottom"), Pairing::matching, {}, false),
                       doctest::Contains("do not match"), InputError);
}

TEST_CASE("quadrature on polygons: monomials") {
  const std::vector<contact::Flat> polygon{{0, 0}, {2, 0}, {3, 1}, {1, 2}, {0, 1}};
  const auto moment = [&](int count, int a, int b) {
    const contact::FlatQuadrature rule(count);
    double sum = 0;
    for (const auto& q : rule.points(polygon)) sum += q.measure * std::pow(q.x[0], a) * std::pow(q.x[1], b);
    return sum;
  };
  CHECK(moment(2, 0, 0) == doctest::Approx(contact::size(polygon)).epsilon(1e-14));
  for (int a = 0; a < 6; ++a)
    for (int b = 0; a + b < 6; ++b) CHECK(moment(3, a, b) == doctest::Approx(moment(6, a, b)).epsilon(1e-13));
}

// Parts of bodies with cells of order 2: rows in the mean with the corners' hats.
#include <doctest/doctest.h>

#include <map>
#include <tuple>

#include "../support/block_pair.hpp"
#include "../support/elastic.hpp"
#include "contact/pairing.hpp"
#include "contact/rigid.hpp"
#include "contact/sides.hpp"

using namespace dotyk;
using contact::Face;
using contact::NodeSide;
using contact::NodeWeight;
using contact::Pairing;
using mesh::Facet;
using mesh::Family;
using mesh::Mesh;
using mesh::Point;

namespace {

double mean(const Mesh& m, const std::vector<NodeWeight>& nodes, const std::function<double(const Point&)>& f) {
  double sum = 0;
  for (const NodeWeight& n : nodes) sum += n.weight * f(m.point(n.node));
  return sum;
}

double total(const std::vector<NodeSide>& sides) {
  double sum = 0;
  for (const NodeSide& s : sides) sum += s.weight;
  return sum;
}

double length_of(const Mesh& m, const std::vector<Facet>& facets) {
  double sum = 0;
  for (const Facet f : facets) elasticity::for_each_facet_point(m, f, [&](const auto& p) { sum += p.measure; });
  return sum;
}

}  // namespace

TEST_CASE("in the plane a corner stands for 2/3 of itself, 2/3 of the middles and -1/3 of its neighbours, ∫ψφ_k/∫ψ by hand") {
  for (const Family family : test::kSecondOrder) {
    const Mesh m = test::rectangle(family, 4, 2);
    const auto sides = contact::corner_sides(m, m.parts.at("top"));
    CHECK(sides.size() == 5);
    for (const NodeSide& s : sides) {
      const double x = m.node(s.node)[0];
      const bool end = x == 0 || x == 1;
      CHECK(s.weight == doctest::Approx(end ? 0.125 : 0.25).epsilon(1e-14));
      CHECK(s.own.front().node == s.node);
      // On [0, h] with ψ = 2 − 3s, dual to 1 − s: ∫ψφ is h/3 of its own corner, h/3 of the middle, −h/6 of the other corner; ∫ψ = h/2.
      REQUIRE(s.own.size() == (end ? 3 : 5));
      CHECK(s.own.front().weight == doctest::Approx(2.0 / 3).epsilon(1e-14));
      for (std::size_t k = 1; k < s.own.size(); ++k) {
        const bool middle = std::abs(std::abs(m.node(s.own[k].node)[0] - x) - 0.125) < 1e-14;
        CHECK(s.own[k].weight == doctest::Approx((middle ? 2.0 : -1.0) / (end ? 3 : 6)).epsilon(1e-13));
      }
    }
  }
}

TEST_CASE("own weights are 1 in sum, weights the part's measure, means those of the hat: T6, Q9 and edges") {
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder) {
      CAPTURE(dim);
      CAPTURE(test::name(family));
      const Mesh m = dim == 2 ? test::rectangle(family, 5, 2) : test::box(family, 3, 2, 2);
      for (const char* part : {"top", "left"})
        for (const bool whole : {true, false}) {
          const auto& facets = m.parts.at(part);
          const auto sides = whole ? contact::corner_nodes(m, facets) : contact::corner_sides(m, facets);
          CHECK(total(sides) == doctest::Approx(1).epsilon(1e-14));
          // Σ_k weight_k·mean_k(v) = ∫v, since Σψ = 1: exact for quadratic v.
          double integral = 0;
          const auto v = [](const Point& x) { return 1 + x[0] * x[0] - 3 * x[1] * x[1] + 2 * x[2] + x[0] * x[1]; };
          for (const NodeSide& s : sides) {
            double sum = 0;
            for (const NodeWeight& n : s.own) sum += n.weight;
            CHECK(sum == doctest::Approx(1).epsilon(1e-14));
            CHECK(s.own.front().node == s.node);
            integral += s.weight * mean(m, s.own, v);
          }
          double exact = 0;
          for (const Facet f : facets) elasticity::for_each_facet_point(m, f, [&](const auto& p) { exact += p.measure * v(p.x); });
          CHECK(integral == doctest::Approx(exact).epsilon(1e-13));
        }
    }
}

TEST_CASE("a uniform pressure on the corners' rows is the traction's nodal forces: λ_k = p·weight, spread by own weights") {
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder) {
      std::vector<std::pair<Mesh, std::string>> parts{{test::unit(dim, family, 3), "top"}};
      if (dim == 2) parts.emplace_back(test::disc(family, 4), "boundary");
      for (const auto& [m, part] : parts) {
        const auto& facets = m.parts.at(part);
        std::vector<double> traction(m.coordinates.size(), 0), rows(m.node_count(), 0);
        test::add_traction(m, facets, [](const Point&) { return Point{1, 0, 0}; }, traction);
        for (const NodeSide& s : contact::corner_sides(m, facets))
          for (const NodeWeight& n : s.own) rows[n.node] += n.weight * s.weight;
        for (int n = 0; n < m.node_count(); ++n) CHECK(std::abs(rows[n] - traction[n * dim]) < 1e-14);
      }
    }
}

TEST_CASE("corners of a circle's curved sides: as many rows as edges, radial normals, the arc's length; no edge of 60 degrees is a corner") {
  for (const Family family : test::kSecondOrder)
    for (int cells : {1, 2, 4}) {
      const Mesh m = test::disc(family, cells, 2, 1);
      const auto& circle = m.parts.at("boundary");
      const auto sides = contact::corner_sides(m, circle);
      CHECK(total(sides) == doctest::Approx(length_of(m, circle)).epsilon(1e-14));
      if (cells > 1) CHECK(sides.size() == circle.size());
      for (const NodeSide& s : sides)
        if (cells > 1)
          for (int i : {0, 1}) CHECK(s.normal[i] == doctest::Approx(m.node(s.node)[i] - (i == 0 ? 2 : 1)).epsilon(1e-10));
    }
}

TEST_CASE("an edge of a cube of order 2 has two sides at its corners, its own normals and halves") {
  for (const Family family : test::kSecondOrder) {
    const Mesh m = test::box(family, 2, 2, 2);
    const auto sides = contact::corner_sides(m, mesh::boundary(m));
    CHECK(total(sides) == doctest::Approx(6).epsilon(1e-14));
    std::map<int, int> count;
    for (const NodeSide& s : sides) ++count[s.node];
    CHECK(count.size() == 26);  // of the 27 corners of cells all but the inner one
    for (const auto& [node, here] : count) {
      int faces = 0;
      for (const double v : m.point(node)) faces += v == 0 || v == 1;
      CHECK(here == faces);
    }
    for (const NodeSide& s : sides) {
      CHECK(std::abs(s.normal[0]) + std::abs(s.normal[1]) + std::abs(s.normal[2]) == doctest::Approx(1).epsilon(1e-14));
      for (const NodeWeight& n : s.own)  // the mean does not reach over the edge
        CHECK(std::abs(mesh::dot(mesh::minus(m.point(n.node), m.point(s.node)), s.normal)) < 1e-14);
    }
  }
}

TEST_CASE("mortar with order 2 on either side: means of linear functions are the first part's, moments either part's") {
  for (int dim : {2, 3})
    for (const Family one : test::kAllFamilies)
      for (const Family other : test::kAllFamilies)
        for (const auto& [n, m] : {std::pair{2, 3}, {3, 2}, {2, 2}, {1, 4}})
          for (const double angle : {0.0, 0.4}) {
            if (one != Family::p2 && one != Family::q2 && other != Family::p2 && other != Family::q2) continue;
            CAPTURE(dim);
            CAPTURE(test::name(one));
            CAPTURE(test::name(other));
            CAPTURE(n);
            CAPTURE(m);
            const test::BlockPair p = test::block_pair(dim, one, other, n, m, angle);
            const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
            const auto paired = contact::pair_rows(first, second, Pairing::mortar, {}, false);
            // The rows are at the corners of the part that has fewer, of the first where as many.
            const Mesh &here = paired.turned ? p.low : p.high, &there = paired.turned ? p.high : p.low;
            const auto corners = [&](const Mesh& mesh) { return contact::corner_nodes(mesh, mesh.parts.at(&mesh == &p.low ? "top" : "bottom")).size(); };
            CHECK(corners(here) <= corners(there));
            if (paired.turned) CHECK(corners(here) < corners(there));
            const auto sides = contact::corner_sides(here, here.parts.at(paired.turned ? "top" : "bottom"));
            REQUIRE(paired.rows.size() == sides.size());
            const auto quadratic = [](const Point& x) { return 1 + 2 * x[0] - x[1] + 0.5 * x[2] + x[0] * x[0] - 2 * x[1] * x[0]; };
            std::vector<double> reached(there.node_count(), 0), pushed(here.node_count(), 0);
            double mine = 0, theirs = 0;
            for (std::size_t k = 0; k < sides.size(); ++k) {
              const contact::ContactRow& row = paired.rows[k];
              CHECK(row.node == sides[k].node);
              CHECK(row.own.front().node == row.node);
              CHECK(row.weight == doctest::Approx(sides[k].weight).epsilon(1e-12));
              CHECK(std::abs(mean(there, row.partners, [](const Point&) { return 1.0; }) - 1) < 1e-13);
              CHECK(std::abs(mean(here, row.own, [](const Point&) { return 1.0; }) - 1) < 1e-13);
              for (int i = 0; i < dim; ++i) {
                const auto x = [i](const Point& at) { return at[i]; };
                CHECK(std::abs(mean(there, row.partners, x) - mean(here, row.own, x)) < 1e-12);
              }
              CHECK(std::abs(row.gap) < 1e-12);
              // ∫ψv of a quadratic v by either part's shape functions, where they contain it.
              if (there.topology().order == 2) {
                theirs += row.weight * mean(there, row.partners, quadratic);
                if (here.topology().order == 2)
                  CHECK(std::abs(mean(there, row.partners, quadratic) - mean(here, row.own, quadratic)) < 1e-11);
              }
              mine += row.weight * mean(here, row.own, quadratic);
              for (const NodeWeight& w : row.partners) reached[w.node] += w.weight * row.weight;
              for (const NodeWeight& w : row.own) pushed[w.node] += w.weight * row.weight;
            }
            // The patch test: a uniform pressure pushes both bodies as their own tractions do.
            for (const auto& [mesh, part, forces] : {std::tuple{&there, paired.turned ? "bottom" : "top", &reached}, {&here, paired.turned ? "top" : "bottom", &pushed}}) {
              std::vector<double> traction(mesh->coordinates.size(), 0);
              test::add_traction(*mesh, mesh->parts.at(part), [](const Point&) { return Point{1, 0, 0}; }, traction);
              for (int k = 0; k < mesh->node_count(); ++k) CHECK(std::abs((*forces)[k] - traction[k * dim]) < 1e-13);
            }
          }
}

TEST_CASE("matching nodes of order 2: mortar gives the rows of the matching pairing") {
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder) {
      const test::BlockPair p = test::block_pair(dim, family, family, 3, 3, 0.3);
      const Face first = test::face(p.high, "bottom"), second = test::face(p.low, "top");
      const auto own = contact::pair_rows(first, second, {}, {}, false);
      CHECK(own.pairing == Pairing::matching);
      const auto mortar = contact::pair_rows(first, second, Pairing::mortar, {}, false);
      REQUIRE(own.rows.size() == mortar.rows.size());
      for (std::size_t k = 0; k < own.rows.size(); ++k) {
        CHECK(own.rows[k].node == mortar.rows[k].node);
        CHECK(own.rows[k].weight == doctest::Approx(mortar.rows[k].weight).epsilon(1e-12));
        const auto same = [&](const Mesh& m, const std::vector<NodeWeight>& a, const std::vector<NodeWeight>& b) {
          std::vector<double> difference(m.node_count(), 0);
          for (const NodeWeight& n : a) difference[n.node] += n.weight;
          for (const NodeWeight& n : b) difference[n.node] -= n.weight;
          for (const double d : difference) CHECK(std::abs(d) < 1e-11);
        };
        same(p.high, own.rows[k].own, mortar.rows[k].own);
        same(p.low, own.rows[k].partners, mortar.rows[k].partners);
      }
    }
}

TEST_CASE("parts of order 2 that overhang: what is covered counts") {
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder)
      for (const double shift : {0.25, 0.37, 0.5 + 1e-4}) {
        test::BlockPair p = test::block_pair(dim, family, family, 3, 2);
        mesh::transform(p.high, [&](Point x) { return x[0] += shift, x; });
        double weight = 0, moment = 0, across = 0, second = 0;
        for (const auto& row : contact::pair_rows(test::face(p.high, "bottom"), test::face(p.low, "top"), Pairing::mortar, {}, false).rows) {
          const auto x = [](const Point& at) { return at[0]; };
          weight += row.weight;
          moment += row.weight * mean(p.high, row.own, x);
          across += row.weight * mean(p.low, row.partners, x);
          second += row.weight * mean(p.high, row.own, [](const Point& at) { return at[0] * at[0]; });
        }
        CHECK(weight == doctest::Approx(1 - shift).epsilon(1e-11));
        CHECK(moment == doctest::Approx((1 - shift * shift) / 2).epsilon(1e-11));
        CHECK(across == doctest::Approx(moment).epsilon(1e-11));
        CHECK(second == doctest::Approx((1 - shift * shift * shift) / 3).epsilon(1e-11));
      }
}

TEST_CASE("a rigid shape: the gap is the mean of the nodes' gaps, exact for quadratic ones") {
  for (int dim : {2, 3})
    for (const Family family : test::kSecondOrder) {
      const Mesh m = test::unit(dim, family, 3);
      Point up{0, 0, 0};
      up[dim - 1] = 1;
      const auto gap = [](const Point& x) { return 0.2 + x[0] * x[0] / 2; };
      const auto rows = contact::against(m, m.parts.at("top"), contact::RigidGap{up, gap}, [](const Point& x) { return x[0]; }, false);
      CHECK(rows.size() == (dim == 2 ? 4 : 16));
      double whole = 0;
      for (const auto& row : rows) {
        CHECK(row.gap == doctest::Approx(mean(m, row.own, [&](const Point& x) { return gap(x) + x[0]; })).epsilon(1e-13));
        CHECK(row.added == doctest::Approx(mean(m, row.own, [](const Point& x) { return x[0]; })).epsilon(1e-13));
        whole += row.weight * row.gap;
      }
      CHECK(whole == doctest::Approx(0.2 + 1.0 / 6 + 0.5).epsilon(1e-13));
    }
}

TEST_CASE("curved parts of order 2 that fit but do not match touch, by either pairing") {
  const auto arc = [](Family family, double inner, double outer, int n) {
    Mesh m = test::rectangle(family, n, 2);
    mesh::transform(m, [&](const Point& x) {
      const double r = inner + (outer - inner) * x[1], angle = 1.5 * (1 - x[0]);
      return Point{r * std::cos(angle), r * std::sin(angle), 0};
    });
    return m;
  };
  for (const Family family : test::kSecondOrder)
    for (const auto& [n, m] : {std::pair{6, 9}, std::pair{9, 6}, std::pair{7, 20}}) {
      const Mesh shaft = arc(family, 1, 2, n), bush = arc(family, 2, 3, m);
      for (const Pairing pairing : {Pairing::mortar, Pairing::node_to_segment})
        for (const auto& row : contact::pair_rows(test::face(shaft, "top"), test::face(bush, "bottom"), pairing, {}, false).rows) {
          CHECK(row.gap >= 0);
          CHECK(row.gap < 1e-4);  // the parabola through three points of a circle
        }
    }
}

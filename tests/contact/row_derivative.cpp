// Derivatives of contact rows by the places of nodes, against central differences over steps from 1e-2 to 1e-10 on moved
// meshes: the error falls as h² until rounding, 1e-16/h, takes over; about h = 1e-5 some 1e-11 are left, 1e-9 is asked for.
#include "contact/row_derivative.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../support/matching.hpp"
#include "base/error.hpp"
#include "contact/frame.hpp"
#include "contact/matching.hpp"
#include "contact/sides.hpp"
#include "contact/contact_row.hpp"
#include "mesh/generators.hpp"

using namespace dotyk;
using contact::ContactRow;
using contact::RowDerivative;
using mesh::Facet;
using mesh::Mesh;
using mesh::Point;

namespace {

const mesh::Family kFamilies[] = {mesh::Family::p1, mesh::Family::q1};

/// A block with curved sides, whose top is that of the last axis.
Mesh sample(int dimension, mesh::Family family, double lift) {
  const double from[3] = {0, 0, 0}, to[3] = {1, dimension == 2 ? 0.8 : 1.2, 0.8};
  const int cells[3] = {4, 3, 2};
  const mesh::Grading even[3];
  Mesh m = dimension == 2 ? mesh::rectangle(from, to, cells, family, even) : mesh::box(from, to, cells, family, even);
  mesh::transform(m, [&](Point x) {
    const double bulge = 0.08 * std::sin(3 * x[0] + x[dimension == 2 ? 2 : 1]);
    return x[dimension - 1] += bulge + lift, x;
  });
  return m;
}

std::vector<double> random_field(const Mesh& m, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<double> out(m.coordinates.size());
  for (double& v : out) v = number(engine);
  return out;
}

Mesh moved(Mesh m, const std::vector<double>& V, double t) {
  for (std::size_t k = 0; k < V.size(); ++k) m.coordinates[k] += t * V[k];
  return m;
}

std::vector<double> numbers(const std::vector<ContactRow>& rows) {
  std::vector<double> out;
  for (const ContactRow& r : rows) out.insert(out.end(), {r.normal[0], r.normal[1], r.normal[2], r.gap, r.weight});
  return out;
}

std::vector<double> numbers(const std::vector<RowDerivative>& rows) {
  std::vector<double> out;
  for (const RowDerivative& r : rows) out.insert(out.end(), {r.normal[0], r.normal[1], r.normal[2], r.gap, r.weight});
  return out;
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// Central differences of at(t) make a V whose bottom is at the derivative.
template <class At>
void check_derivative(const std::vector<double>& exact, const At& at) {
  std::vector<double> errors;
  for (int k = 2; k <= 10; ++k) {
    const double h = std::pow(10, -k);
    const std::vector<double> above = at(h), below = at(-h);
    REQUIRE(above.size() == exact.size());
    std::vector<double> apart(exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) apart[i] = (above[i] - below[i]) / (2 * h) - exact[i];
    errors.push_back(norm(apart) / norm(exact));
  }
  if (errors[0] > 1e-12) CHECK(errors[1] < 0.02 * errors[0]);  // order 2, but where the dependence is linear
  CHECK(*std::min_element(errors.begin(), errors.end()) < 1e-9);
  CHECK(errors.back() > 1e-10);  // rounding
}

/// between()'s rows at moved nodes with the pairs, sides and shares of both normals that they had.
std::vector<ContactRow> again(std::vector<ContactRow> rows, const Mesh& first, const Mesh& second, const std::vector<Facet>& facets,
                              const std::vector<Facet>& others) {
  const auto sides = contact::sides(first, facets);
  const auto across = contact::smooth_sides({second, others, "second"});
  for (ContactRow& row : rows)
    for (const contact::NodeSide& side : sides) {
      if (side.node != row.node || side.facets != row.facets) continue;
      const Point a = first.point(row.node), b = second.point(row.partners.front().node);
      row.normal = contact::mixed_normal(side.normal, contact::inward_across(side.normal, row.partners, across), row.mix);
      row.weight = side.weight;
      row.gap = 0;
      for (int i = 0; i < 3; ++i) row.gap += (b[i] - a[i]) * row.normal[i];
    }
  return rows;
}

}  // namespace

TEST_CASE("rows between two parts: normal, gap and weight, both sides moving") {
  for (const int dimension : {2, 3})
    for (const auto family : kFamilies) {
      CAPTURE(dimension);
      const Mesh lower = sample(dimension, family, 0), upper = sample(dimension, family, 0.83);
      const auto &facets = lower.parts.at("top"), &others = upper.parts.at("bottom");
      // A gap of 0.03 along the last axis: partners are given, as match() looks for them along normals.
      std::vector<ContactRow> rows;
      for (const auto& side : contact::sides(lower, facets))
        for (const auto& other : contact::nodes(upper, others)) {
          const Point a = lower.point(side.node), b = upper.point(other.node);
          double off = 0;
          for (int i = 0; i < dimension - 1; ++i) off += std::abs(a[i] - b[i]);
          if (off < 1e-12) rows.push_back({side.node, {{side.node, 1}}, {{other.node, 1}}, side.normal, 0, side.weight, side.facets, 0});
        }
      REQUIRE(rows.size() >= 5);
      for (ContactRow& row : rows) row.mix = {{{0.4, 0.1, 0}, {0.1, -0.3, 0.05}, {0, 0.05, 0.2}}};  // as of parts of unlike curvature
      rows = again(rows, lower, upper, facets, others);
      const auto V = random_field(lower, 1), W = random_field(upper, 2);
      check_derivative(numbers(contact::row_derivatives({lower, facets, "lower"}, rows, V, {upper, others, "upper"}, W)), [&](double t) {
        return numbers(again(rows, moved(lower, V, t), moved(upper, W, t), facets, others));
      });
      // One side at rest.
      check_derivative(numbers(contact::row_derivatives({lower, facets, "lower"}, rows, {}, {upper, others, "upper"}, W)),
                       [&](double t) { return numbers(again(rows, lower, moved(upper, W, t), facets, others)); });
    }
}

TEST_CASE("rows of between() itself where both sides move together, what is added to the gap with them") {
  for (const int dimension : {2, 3})
    for (const auto family : kFamilies) {
      CAPTURE(dimension);
      const Mesh lower = sample(dimension, family, 0), upper = sample(dimension, family, 0.8);
      const auto &facets = lower.parts.at("top"), &others = upper.parts.at("bottom");
      const auto move = [&](Mesh m, double t) {
        for (int n = 0; n < m.node_count(); ++n) {
          double* x = &m.coordinates[static_cast<std::size_t>(n) * dimension];
          x[dimension - 1] += t * std::cos(4 * x[0]);
        }
        return m;
      };
      const auto velocity = [&](const Mesh& m) {
        std::vector<double> V = move(m, 1).coordinates;
        for (std::size_t k = 0; k < V.size(); ++k) V[k] -= m.coordinates[k];
        return V;
      };
      const auto rows_at = [&](double t) {
        const Mesh a = move(lower, t), b = move(upper, t);
        return contact::between({a, facets, "lower"}, {b, others, "upper"}, [](const Point&) { return 0.1; });
      };
      const auto rows = rows_at(0);
      check_derivative(numbers(contact::row_derivatives({lower, facets, "lower"}, rows, velocity(lower), {upper, others, "upper"}, velocity(upper))),
                       [&](double t) { return numbers(rows_at(t)); });
      const auto surface = contact::surface(lower, facets, rows, {});
      check_derivative(contact::measure_derivatives(surface, velocity(lower)), [&](double t) {
        const Mesh a = move(lower, t);
        return contact::measures(contact::surface(a, facets, rows_at(t), {}));
      });
    }
}

TEST_CASE("rows against a rigid plane and rigid balls: above the part, beside it, so that lines along normals miss it, and one that conforms") {
  for (const int dimension : {2, 3})
    for (const auto family : kFamilies) {
      CAPTURE(dimension);
      const Mesh m = sample(dimension, family, 0);
      const auto& facets = m.parts.at("top");
      const auto V = random_field(m, 3);
      Point inclined{0.28, 0, 0}, far{0, 0, 0}, above{0.5, 0.4, 0}, beside{2, 0.4, 0};
      inclined[dimension - 1] = -0.96, far[dimension - 1] = 1.5, above[dimension - 1] = 2.5, beside[dimension - 1] = 1.8;
      for (const contact::RigidShape& shape :
           {contact::RigidShape(contact::RigidPlane{far, inclined}), contact::RigidShape(contact::RigidBall{above, 1}),
            contact::RigidShape(contact::RigidBall{above, 0.3}), contact::RigidShape(contact::RigidBall{beside, 0.9})}) {
        const auto rows = contact::against(m, facets, shape, [](const Point&) { return 0.02; }, false);
        const auto at = [&](double t) { return contact::moved_rows(rows, moved(m, V, t), facets, shape, false); };
        for (std::size_t k = 0; k < rows.size(); ++k) {
          CHECK(at(0)[k].normal == rows[k].normal);
          CHECK(at(0)[k].gap == rows[k].gap);
        }
        check_derivative(numbers(contact::row_derivatives(m, facets, rows, shape, V)), [&](double t) { return numbers(at(t)); });
      }
    }
}

TEST_CASE("a gap function's slope is not known: only nodes at rest lie before it") {
  const Mesh m = sample(2, mesh::Family::q1, 0);
  const contact::RigidShape shape = contact::RigidGap{{0, 1, 0}, [](const Point& x) { return x[0]; }};
  const auto rows = contact::against(m, m.parts.at("top"), shape, {}, false);
  std::vector<double> V(m.coordinates.size(), 0.0);
  V[0] = 1;  // the lower left corner
  for (const RowDerivative& d : contact::row_derivatives(m, m.parts.at("top"), rows, shape, V)) {
    CHECK(d.gap == 0);
    CHECK(d.weight == 0);
  }
  V.assign(V.size(), 1.0);
  CHECK_THROWS_WITH_AS(contact::row_derivatives(m, m.parts.at("top"), rows, shape, V),
                       doctest::Contains("given by a gap function, whose slope is not known; take a rigid plane or ball"), InputError);
}

TEST_CASE("tangents turn with the normal") {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int dimension : {2, 3})
    for (int round = 0; round < 10; ++round) {
      Point m{number(engine), number(engine), dimension == 2 ? 0 : number(engine)};
      Point dm{number(engine), number(engine), dimension == 2 ? 0 : number(engine)};
      const auto unit = [&](double t) {
        Point n{m[0] + t * dm[0], m[1] + t * dm[1], m[2] + t * dm[2]};
        const double size = std::hypot(n[0], n[1], n[2]);
        for (double& v : n) v /= size;
        return n;
      };
      const Point n = unit(0);
      const double size = std::hypot(m[0], m[1], m[2]), along = dm[0] * n[0] + dm[1] * n[1] + dm[2] * n[2];
      Point dn;
      for (int i = 0; i < 3; ++i) dn[i] = (dm[i] - along * n[i]) / size;
      const auto flat = [](const std::vector<Point>& points) {
        std::vector<double> out;
        for (const Point& p : points) out.insert(out.end(), p.begin(), p.end());
        return out;
      };
      check_derivative(flat(contact::tangent_derivatives(n, dn, dimension)), [&](double t) { return flat(contact::tangents(unit(t), dimension)); });
    }
}

// Cells of order 2: nodes between corners, curved facets, pieces.
#include "mesh/second_order.hpp"

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <tuple>

#include "../support/meshes.hpp"
#include "base/error.hpp"
#include "mesh/decomposition.hpp"

using namespace dotyk;
using mesh::Facet;
using mesh::Point;

namespace {

std::vector<mesh::Mesh> blocks() {
  std::vector<mesh::Mesh> meshes;
  for (const auto family : test::kSecondOrder) {
    meshes.push_back(test::rectangle(family, 3, 2, -1, 0, 2, 5));
    meshes.push_back(test::box(family, 2, 3, 1, {0, 0, 0}, {1, 2, 3}));
  }
  return meshes;
}

/// The sum of the area vectors of the boundary.
Point closed(const mesh::Mesh& m) {
  Point sum{0, 0, 0};
  for (const Facet f : mesh::boundary(m)) {
    const Point n = m.facet_area_vector(f);
    for (int i = 0; i < 3; ++i) sum[i] += n[i];
  }
  return sum;
}

/// A quarter of a pipe, in space a bent beam; all cells curved. Orientation is kept.
mesh::Mesh bent(int dim, mesh::Family family, int n) {
  mesh::Mesh m = test::unit(dim, family, n);
  mesh::transform(m, [](const Point& x) {
    const double r = 1 + x[1], a = std::numbers::pi / 2 * (1 - x[0]);
    return Point{r * std::cos(a), r * std::sin(a), x[2] * (1 + 0.2 * x[0])};
  });
  return m;
}

}  // namespace

TEST_CASE("nodes and dimension of every cell type are those of its topology") {
  for (int k = 0; k < 8; ++k) {
    const auto element = static_cast<mesh::Element>(k);
    CHECK(mesh::nodes_of(element) == mesh::topology(element).nodes);
    CHECK(mesh::dimension_of(element) == mesh::topology(element).dimension);
  }
}

TEST_CASE("order 2 adds a node an edge, a quadrilateral face and a tensor cell; each shared by the cells that have it") {
  for (const int n : {1, 2, 3}) {
    // Of the lattice of half the spacing, tensor cells and Kuhn's tetrahedra have every point.
    CHECK(test::rectangle(mesh::Family::p2, n, n + 1).node_count() == (2 * n + 1) * (2 * n + 3));
    CHECK(test::rectangle(mesh::Family::q2, n, n + 1).node_count() == (2 * n + 1) * (2 * n + 3));
    CHECK(test::box(mesh::Family::p2, n, n + 1, 2).node_count() == (2 * n + 1) * (2 * n + 3) * 5);
    CHECK(test::box(mesh::Family::q2, n, n + 1, 2).node_count() == (2 * n + 1) * (2 * n + 3) * 5);
    // Euler: edges = nodes + triangles − 1 of a disc.
    const auto disc = test::disc(mesh::Family::p1, n);
    CHECK(test::disc(mesh::Family::p2, n).node_count() == 2 * disc.node_count() + disc.cell_count() - 1);
  }
  for (const auto& m : blocks()) {
    const mesh::ElementTopology& t = m.topology();
    std::set<std::vector<double>> places;
    for (int i = 0; i < m.node_count(); ++i) places.insert({m.node(i), m.node(i) + t.dimension});
    CHECK(static_cast<int>(places.size()) == m.node_count());
    for (int c = 0; c < m.cell_count(); ++c)
      for (std::size_t k = 0; k < t.between.size(); ++k)
        for (int i = 0; i < t.dimension; ++i) {
          double mean = 0;
          for (const int corner : t.between[k]) mean += m.node(m.cell(c)[corner])[i] / static_cast<double>(t.between[k].size());
          CHECK(m.node(m.cell(c)[t.corners + k])[i] == doctest::Approx(mean).epsilon(1e-15));
        }
    CHECK_NOTHROW(mesh::check(m, "m"));
  }
}

TEST_CASE("order 1 and order 2 are of one shape, and each other's") {
  for (const auto& m : blocks()) {
    const mesh::ElementTopology& t = m.topology();
    const mesh::ElementTopology& first = mesh::topology(mesh::first_order(m.element));
    CHECK(mesh::second_order(mesh::first_order(m.element)) == m.element);
    CHECK(std::string(t.shape) == first.shape);
    CHECK(t.corners == first.nodes);
    CHECK(t.nodes == t.corners + static_cast<int>(t.between.size()));
    CHECK(t.nodes <= mesh::kMostNodes);
    CHECK(t.nodes_per_facet <= mesh::kMostFacetNodes);
    const mesh::Mesh again = mesh::second_order(m);
    CHECK(again.cells == m.cells);
    CHECK(again.coordinates == m.coordinates);
  }
}

TEST_CASE("nodes of a facet: corners as of order 1, then the edges' in turn, then the centre") {
  for (const auto& m : blocks()) {
    const mesh::ElementTopology& t = m.topology();
    const mesh::ElementTopology& first = mesh::topology(mesh::first_order(m.element));
    for (int c = 0; c < m.cell_count(); ++c)
      for (int l = 0; l < t.facets; ++l) {
        const auto at = [&](int k) { return m.point(m.facet_node({c, l}, k)); };
        for (int k = 0; k < t.facet_corners; ++k) CHECK(t.facet_nodes[l][k] == first.facet_nodes[l][k]);
        for (int k = t.facet_corners; k < t.nodes_per_facet; ++k)
          for (int i = 0; i < 3; ++i) {
            double mean = 0;  // straight facets: the node is where the corners' hats put it
            for (int corner = 0; corner < t.facet_corners; ++corner) mean += mesh::corner_hat(t, corner, k) * at(corner)[i];
            CHECK(at(k)[i] == doctest::Approx(mean).epsilon(1e-15));
          }
        if (t.dimension == 2) continue;
        for (int k = 0; k < t.facet_corners; ++k)  // between corners k and k + 1
          for (int i = 0; i < 3; ++i)
            CHECK(at(t.facet_corners + k)[i] == doctest::Approx((at(k)[i] + at((k + 1) % t.facet_corners)[i]) / 2).epsilon(1e-15));
      }
  }
}

TEST_CASE("cells share all nodes of a facet: boundaries close, bent ones too") {
  std::vector<mesh::Mesh> meshes = blocks();
  for (const auto family : test::kSecondOrder) {
    for (const int cells : {1, 2, 5}) meshes.push_back(test::disc(family, cells, 2, 1));
    for (const int dim : {2, 3}) meshes.push_back(bent(dim, family, 3));
  }
  for (const auto& m : meshes) {
    CHECK_NOTHROW(mesh::check(m, "m"));
    CHECK(test::length(closed(m)) < 1e-13);
    std::map<std::set<int>, std::vector<Facet>> owners;
    for (int c = 0; c < m.cell_count(); ++c) {
      CHECK(mesh::least_jacobian(m, c) > 0);
      Point sum{0, 0, 0};  // of a cell alone, too
      for (int l = 0; l < m.topology().facets; ++l) {
        std::set<int> nodes;
        for (int k = 0; k < m.topology().nodes_per_facet; ++k) nodes.insert(m.facet_node({c, l}, k));
        owners[nodes].push_back({c, l});
        const Point n = m.facet_area_vector({c, l});
        for (int i = 0; i < 3; ++i) sum[i] += n[i];
      }
      CHECK(test::length(sum) < 1e-14);
    }
    std::size_t single = 0;
    for (const auto& [nodes, facets] : owners) {
      REQUIRE(facets.size() <= 2);
      single += facets.size() == 1;
    }
    CHECK(single == mesh::boundary(m).size());
    std::size_t parts = 0;
    for (const auto& [name, facets] : m.parts) parts += facets.size();
    CHECK(parts == single);
  }
}

TEST_CASE("a cell is inverted once a node between its corners is dragged through it, though corners stay") {
  for (const auto& straight : blocks()) {
    const mesh::ElementTopology& t = straight.topology();
    const Point to = straight.cell_centre(0);
    // Along an edge of length 1 the Jacobian at the ends is 1 ∓ 4s with the node s off the middle: valid below a quarter.
    for (const double s : {0.24, 0.26}) {
      mesh::Mesh m = straight;
      const int a = m.cell(0)[t.between[0][0]], b = m.cell(0)[t.between[0][1]], node = m.cell(0)[t.corners];
      for (int i = 0; i < t.dimension; ++i)
        m.coordinates[static_cast<std::size_t>(node) * t.dimension + i] += s * (m.node(b)[i] - m.node(a)[i]);
      CHECK((mesh::least_jacobian(m, 0) > 0) == (s < 0.25));
      if (s > 0.25)
        CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains("is inverted"), InputError);
      else
        CHECK_NOTHROW(mesh::check(m, "gear"));
    }
    mesh::Mesh m = straight;
    double* x = &m.coordinates[static_cast<std::size_t>(m.cell(0)[t.corners]) * t.dimension];
    for (int i = 0; i < t.dimension; ++i) x[i] += 2.5 * (to[i] - x[i]);
    CHECK(mesh::least_jacobian(m, 0) < 0);
    CHECK_THROWS_WITH_AS(mesh::check(m, "gear"), doctest::Contains("gear: cell "), InputError);
  }
}

TEST_CASE("the least Jacobian does not depend on order where cells are straight simplices, and scales with the measure") {
  for (const int dim : {2, 3}) {
    mesh::Mesh first = test::unit(dim, mesh::Family::p1, 2);
    test::distort(first, 0.08);
    const mesh::Mesh second = mesh::second_order(first);
    for (int c = 0; c < first.cell_count(); ++c)
      CHECK(mesh::least_jacobian(second, c) == doctest::Approx(mesh::least_jacobian(first, c)).epsilon(1e-13));
    const mesh::Mesh tensor = test::unit(dim, mesh::Family::q2, 2);
    for (int c = 0; c < tensor.cell_count(); ++c) CHECK(mesh::least_jacobian(tensor, c) == doctest::Approx(std::pow(0.5, dim)).epsilon(1e-14));
  }
}

TEST_CASE("nodes of a curved disc's boundary are on the circle, those between in the middle of their arc; a quadrilateral is a product of curves") {
  for (const auto family : test::kSecondOrder)
    for (const int cells : {1, 2, 5}) {
      const auto m = test::disc(family, cells, 3, -2, 0.5);
      const auto& t = m.topology();
      for (const Facet f : m.parts.at("boundary")) {
        const auto from_centre = [&](int k) { return Point{m.node(m.facet_node(f, k))[0] - 3, m.node(m.facet_node(f, k))[1] + 2, 0}; };
        for (int k = 0; k < 3; ++k) CHECK(test::length(from_centre(k)) == doctest::Approx(0.5).epsilon(1e-15));
        for (int k : {0, 1})
          CHECK(mesh::dot(from_centre(2), from_centre(k)) == doctest::Approx(mesh::dot(from_centre(2), from_centre(1 - k))).epsilon(1e-14));
        if (t.corners == 3) continue;
        // Transfinite: the centre is half the sum of the edges' nodes less a quarter of the corners'.
        for (int i : {0, 1}) {
          double x = 0;
          for (int k = 0; k < 4; ++k) x += m.node(m.cell(f.cell)[4 + k])[i] / 2 - m.node(m.cell(f.cell)[k])[i] / 4;
          CHECK(m.node(m.cell(f.cell)[8])[i] == doctest::Approx(x).epsilon(1e-14));
        }
      }
    }
}

TEST_CASE("cut at its nodes a mesh keeps its measure, its parts and its nodes") {
  std::vector<mesh::Mesh> meshes = blocks();
  for (const auto family : test::kSecondOrder)
    for (const int dim : {2, 3}) {
      meshes.push_back(test::unit(dim, family, 2));
      test::distort(meshes.back(), 0.05);
      meshes.push_back(bent(dim, family, 3));
    }
  for (const auto& whole : meshes) {
    const mesh::Mesh m = mesh::cut_at_nodes(whole);
    const int dim = m.dimension(), pieces = dim == 2 ? 4 : 8;
    CHECK(m.topology().order == 1);
    CHECK(m.coordinates == whole.coordinates);
    REQUIRE(m.cell_count() == pieces * whole.cell_count());
    CHECK_NOTHROW(mesh::check(m, "pieces"));
    CHECK(test::length(closed(m)) < 1e-13);
    for (const auto& [name, facets] : whole.parts) {
      const auto& cut = m.parts.at(name);
      CHECK(cut.size() == facets.size() * (dim == 2 ? 2 : 4));
      if (dim == 3) continue;  // a chord's ∫n is that of any curve between its ends; of faces that of their rim, which is cut
      Point sum{0, 0, 0};
      for (const auto& [mesh, part, sign] : {std::tuple{&whole, &facets, 1}, {&m, &cut, -1}})
        for (const Facet f : *part)
          for (int i = 0; i < 3; ++i) sum[i] += sign * mesh->facet_area_vector(f)[i];
      CHECK(test::length(sum) < 1e-14);
    }
  }
  for (const auto& whole : blocks()) {
    const mesh::Mesh m = mesh::cut_at_nodes(whole);
    const int pieces = m.cell_count() / whole.cell_count();
    CHECK(test::measure(m) == doctest::Approx(test::measure(whole)).epsilon(1e-14));
    for (int c = 0; c < whole.cell_count(); ++c) {
      double sum = 0;
      for (int k = 0; k < pieces; ++k) sum += test::measure(m, pieces * c + k);
      CHECK(sum == doctest::Approx(test::measure(whole, c)).epsilon(1e-13));
      for (int k = 0; k < pieces; ++k) CHECK(test::measure(m, pieces * c + k) == doctest::Approx(sum / pieces).epsilon(1e-13));
    }
    for (const auto& [name, facets] : whole.parts) CHECK(test::measure(m, m.parts.at(name)) == doctest::Approx(test::measure(whole, facets)).epsilon(1e-13));
  }
  const auto first = test::rectangle(mesh::Family::p1, 2, 2);
  CHECK(mesh::cut_at_nodes(first).cells == first.cells);
}

TEST_CASE("cells kept and pieces of order 2 have the nodes between their corners, and no others") {
  for (const int dim : {2, 3})
    for (const auto family : test::kSecondOrder) {
      const auto whole = test::unit(dim, family, 4);
      const auto kept = mesh::keep(whole, [](const Point& x) { return x[0] < 0.25 || x[0] > 0.75; }, "cut");
      CHECK_NOTHROW(mesh::check(kept, "kept"));
      CHECK(test::measure(kept) == doctest::Approx(0.5).epsilon(1e-13));
      CHECK(test::measure(kept, kept.parts.at("cut")) == doctest::Approx(2).epsilon(1e-13));
      CHECK(kept.node_count() == 2 * 3 * static_cast<int>(std::pow(9, dim - 1)));
      const auto pieces = mesh::split(kept);
      REQUIRE(pieces.size() == 2);
      for (const auto& piece : pieces) {
        CHECK(piece.element == whole.element);
        CHECK_NOTHROW(mesh::check(piece, "piece"));
        CHECK(piece.node_count() == kept.node_count() / 2);
        CHECK(test::measure(piece) == doctest::Approx(0.25).epsilon(1e-13));
      }
    }
}

TEST_CASE("a transform of order 2 bends cells; one that inverts any is undone") {
  for (const int dim : {2, 3})
    for (const auto family : test::kSecondOrder) {
      auto m = bent(dim, family, 4);
      const auto before = m.coordinates;
      CHECK_THROWS_AS(mesh::transform(m, [](const Point& x) { return Point{-x[0], x[1], x[2]}; }), InputError);
      CHECK(m.coordinates == before);
      for (const Facet f : m.parts.at("bottom"))
        if (dim == 2)
          for (int k = 0; k < 3; ++k) CHECK(test::length(m.point(m.facet_node(f, k))) == doctest::Approx(1).epsilon(1e-14));
    }
}

TEST_CASE("METIS cuts a mesh of order 2: every cell in a piece, pieces even") {
  for (const int dim : {2, 3})
    for (const auto family : test::kSecondOrder) {
      const auto m = test::unit(dim, family, dim == 2 ? 8 : 4);
      const auto pieces = mesh::decompose(m, 4);
      REQUIRE(static_cast<int>(pieces.of_cell.size()) == m.cell_count());
      REQUIRE(pieces.count == 4);
      for (const auto& cells : pieces.cells()) {
        CHECK(std::ssize(cells) > m.cell_count() / 6);
        CHECK(std::ssize(cells) < m.cell_count() / 3);
        CHECK(mesh::pieces_of(mesh::submesh(m, cells).mesh).count == 1);
      }
      // The graph of cells is that of order 1.
      mesh::Mesh first = test::unit(dim, mesh::simplices(family) ? mesh::Family::p1 : mesh::Family::q1, dim == 2 ? 8 : 4);
      CHECK(mesh::decompose(first, 4).of_cell == pieces.of_cell);
    }
}

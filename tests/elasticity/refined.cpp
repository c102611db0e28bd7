#include "elasticity/refined.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "../support/elastic.hpp"
#include "elasticity/stress.hpp"
#include "mesh/generators.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Mesh;

namespace {

constexpr Family kEveryFamily[] = {Family::p1, Family::q1, Family::p2, Family::q2};

Mesh bent(Family family, int dimension) {
  const double from[] = {0, 0, 0}, to[] = {2, 1, 1};
  const int cells[] = {3, 2, 2};
  Mesh m = dimension == 2 ? mesh::rectangle(from, to, cells, family, std::array<mesh::Grading, 2>().data())
                          : mesh::box(from, to, cells, family, std::array<mesh::Grading, 3>().data());
  mesh::transform(m, [](const mesh::Point& x) { return mesh::Point{x[0] + 0.1 * x[1] * x[1], x[1] + 0.05 * std::sin(x[0]), x[2] + 0.1 * x[0] * x[2]}; });
  return m;
}

/// ∮ x·n / dimension, of facets by their corners.
double measure(const Mesh& m) {
  double sum = 0;
  for (const mesh::Facet f : mesh::boundary(m)) {
    const mesh::Point x = m.facet_centre(f), n = m.facet_area_vector(f);
    for (int i = 0; i < m.dimension(); ++i) sum += x[i] * n[i] / m.dimension();
  }
  return sum;
}

}  // namespace

TEST_CASE("cells in the plane are cut into 4, in space into 8, parts with them") {
  for (const Family family : kEveryFamily)
    for (const int dimension : {2, 3}) {
      const Mesh coarse = bent(family, dimension), fine = elasticity::refined(coarse);
      CAPTURE(coarse.topology().name);
      CAPTURE(dimension);
      mesh::check(fine, "refined");
      CHECK(fine.element == coarse.element);
      CHECK(fine.cell_count() == coarse.cell_count() * (dimension == 2 ? 4 : 8));
      REQUIRE(fine.parts.size() == coarse.parts.size());
      std::size_t on_parts = 0;
      for (const auto& [name, facets] : fine.parts) {
        CHECK(facets.size() == coarse.parts.at(name).size() * (dimension == 2 ? 2 : 4));
        on_parts += facets.size();
      }
      CHECK(on_parts == mesh::boundary(fine).size());
      for (int i = 0; i < coarse.node_count(); ++i)
        for (int k = 0; k < dimension; ++k) CHECK(fine.node(i)[k] == coarse.node(i)[k]);
    }
}

TEST_CASE("straight simplices fill the same space") {
  for (const int dimension : {2, 3}) {
    const Mesh coarse = bent(Family::p1, dimension), fine = elasticity::refined(elasticity::refined(coarse));
    CHECK(measure(fine) == doctest::Approx(measure(coarse)).epsilon(1e-12));
  }
}

TEST_CASE("a box of tetrahedra is cut into that of half the step, a sheared one likewise") {
  const double from[] = {0, 0, 0}, to[] = {1, 2, 3};
  const auto box = [&](int times, double shear) {
    const int cells[] = {2 * times, times, 3 * times};
    Mesh m = mesh::box(from, to, cells, Family::p1, std::array<mesh::Grading, 3>().data());
    mesh::transform(m, [&](const mesh::Point& x) { return mesh::Point{x[0] + shear * x[1], x[1] - 0.5 * shear * x[2], x[2]}; });
    return m;
  };
  const auto cells = [](const Mesh& m) {  // each as its nodes' places, in units of 1e-6
    std::set<std::set<std::array<long, 3>>> all;
    for (int c = 0; c < m.cell_count(); ++c) {
      std::set<std::array<long, 3>> corners;
      for (int k = 0; k < 4; ++k) {
        const double* x = m.node(m.cell(c)[k]);
        corners.insert({std::lround(1e6 * x[0]), std::lround(1e6 * x[1]), std::lround(1e6 * x[2])});
      }
      all.insert(corners);
    }
    return all;
  };
  for (const double shear : {0.0, 1e-3, 0.02}) CHECK(cells(elasticity::refined(elasticity::refined(box(1, shear)))) == cells(box(4, shear)));
}

TEST_CASE("tetrahedra are cut along the shortest diagonal, and keep their quality when cut again and again") {
  // 12 (3V)^(2/3) / Σ l², 1 for a regular tetrahedron.
  const auto worst = [](const Mesh& m) {
    double least = 1;
    for (int c = 0; c < m.cell_count(); ++c) {
      double edges = 0;
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < a; ++b)
          for (int i = 0; i < 3; ++i) edges += std::pow(m.node(m.cell(c)[a])[i] - m.node(m.cell(c)[b])[i], 2);
      least = std::min(least, 12 * std::pow(mesh::least_jacobian(m, c) / 2, 2.0 / 3) / edges);
    }
    return least;
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int tried = 0; tried < 40;) {
    Mesh m;
    m.element = mesh::Element::tetrahedron_p1;
    m.cells = {0, 1, 2, 3};
    for (int i = 0; i < 12; ++i) m.coordinates.push_back(place(random));
    if (!(mesh::least_jacobian(m, 0) > 0) || worst(m) < 0.3) continue;
    const double before = worst(m);
    ++tried;
    // Midpoints of opposite edges: corner 0 and each other one, the two that remain.
    const Mesh once = elasticity::refined(m);
    double shortest = INFINITY, cut = INFINITY;
    const auto middle = [&](int a, int b, int i) { return (m.node(a)[i] + m.node(b)[i]) / 2; };
    for (int k = 1; k <= 3; ++k) {
      const int p = k % 3 + 1, q = p % 3 + 1;
      double square = 0;
      for (int i = 0; i < 3; ++i) square += std::pow(middle(0, k, i) - middle(p, q, i), 2);
      shortest = std::min(shortest, square);
      std::array<int, 2> ends{-1, -1};
      for (int node = 0; node < once.node_count(); ++node)
        for (int end = 0; end < 2; ++end) {
          double off = 0;
          for (int i = 0; i < 3; ++i) off += std::abs(once.node(node)[i] - (end == 0 ? middle(0, k, i) : middle(p, q, i)));
          if (off < 1e-12) ends[end] = node;
        }
      for (int c = 0; c < once.cell_count(); ++c)
        if (std::count(once.cell(c), once.cell(c) + 4, ends[0]) && std::count(once.cell(c), once.cell(c) + 4, ends[1])) cut = square;
    }
    CHECK(cut <= shortest / 0.9);  // squares; the first diagonal is kept unless another is clearly shorter
    m = elasticity::refined(once);
    const double twice = worst(m);
    for (int k = 0; k < 2; ++k) m = elasticity::refined(m);
    CHECK(worst(m) > 0.75 * before);  // of 60 such tetrahedra the worst kept 0.85, with the first diagonal 0.58
    CHECK(worst(m) == doctest::Approx(twice).epsilon(1e-9));  // few shapes arise
  }
}

TEST_CASE("curved sides stay the same parabolas: all nodes on the boundary, and polygons through them come near as squares of their sides") {
  const double centre[] = {0, 0};
  Mesh m = mesh::disc(centre, 1, 3, Family::p2);
  const double area = std::numbers::pi;
  double before = 0;
  for (int level = 0; level < 3; ++level) {
    double inside = 0;  // the polygon of all boundary nodes
    for (const mesh::Facet f : mesh::boundary(m)) {
      const double *a = m.node(m.facet_node(f, 0)), *b = m.node(m.facet_node(f, 1)), *c = m.node(m.facet_node(f, 2));
      inside += 0.5 * (a[0] * c[1] - a[1] * c[0] + c[0] * b[1] - c[1] * b[0]);
    }
    const double off = std::abs(inside - area);
    if (level > 0) CHECK(before / off == doctest::Approx(4).epsilon(0.1));  // with straight sides nothing changes
    before = off;
    m = elasticity::refined(m);
  }
}

TEST_CASE("functions of coarser meshes: linear displacements are among them, prescribed components not") {
  for (const Family family : kEveryFamily)
    for (const int dimension : {2, 3}) {
      const double from[] = {0, 0, 0}, to[] = {1, 1, 1};
      const int cells[] = {4, 4, 4};
      Mesh m = dimension == 2 ? mesh::rectangle(from, to, cells, family, std::array<mesh::Grading, 2>().data())
                              : mesh::box(from, to, cells, family, std::array<mesh::Grading, 3>().data());
      m = elasticity::refined(m);
      const bool second = m.topology().order == 2;
      REQUIRE(mesh::coarser_nodes(m).size() == (second ? 4 : 3));  // 8 cells, 4, 2, 1; of order 2 first those of order 1
      const auto nodes = static_cast<std::size_t>(m.node_count());
      std::vector<int> unknown(nodes * dimension, -1);
      int count = 0;
      std::vector<double> x;
      for (std::size_t i = 0; i < nodes; ++i)
        for (int k = 0; k < dimension; ++k)
          if (!(k == 1 && m.node(static_cast<int>(i))[1] == 0)) unknown[i * dimension + k] = count++, x.push_back(k == 1 ? m.node(static_cast<int>(i))[1] : m.node(static_cast<int>(i))[0] + 1);
      algebra::Vector u = Eigen::Map<algebra::Vector>(x.data(), count);
      for (const algebra::CoarseFunctions& functions : elasticity::coarse_functions(m, unknown, count, 5)) {
        REQUIRE(functions.rows == u.size());
        const algebra::Vector coarse = functions.at_coarse(u);
        CHECK((functions.times(coarse) - u).lpNorm<Eigen::Infinity>() < 1e-14);
        algebra::SparseRows P;
        functions.to_matrix(P);
        CHECK((P * coarse - u).lpNorm<Eigen::Infinity>() < 1e-14);
        CHECK((P.transpose() * u - functions.transposed_times(u)).lpNorm<Eigen::Infinity>() < 1e-13);  // sums of 27 numbers
        u = coarse;
      }
    }
}

TEST_CASE("near the boundary a mesh refined twice has the nodes, parts and stresses of the whole one, and knows how large that is") {
  for (const Family family : kEveryFamily)
    for (const int dimension : {2, 3}) {
      const Mesh coarse = bent(family, dimension);
      const auto [near, parent, between] = elasticity::refined_near_boundary(coarse, 2);
      const Mesh whole = elasticity::refined(elasticity::refined(coarse));
      CAPTURE(coarse.topology().name);
      CAPTURE(dimension);
      mesh::check(near, "near the boundary");
      REQUIRE(near.whole);
      std::vector<int> nodes = mesh::coarser_nodes(whole);
      CHECK(mesh::coarser_nodes(near) == nodes);
      CHECK(near.whole->nodes.front() == whole.node_count());
      CHECK(near.whole->cells == whole.cell_count());
      CHECK(near.cell_count() < whole.cell_count());
      CHECK(mesh::boundary(near).size() == mesh::boundary(whole).size());
      CHECK(measure(near) == doctest::Approx(measure(whole)).epsilon(1e-13));
      REQUIRE(near.parts.size() == whole.parts.size());
      for (const auto& [name, facets] : near.parts) CHECK(facets.size() == whole.parts.at(name).size());

      std::map<mesh::Point, int> at;
      for (int i = 0; i < whole.node_count(); ++i) at[whole.point(i)] = i;
      std::vector<double> u(whole.coordinates.size()), own;
      for (int i = 0; i < whole.node_count(); ++i)
        for (int k = 0; k < dimension; ++k) u[static_cast<std::size_t>(i * dimension + k)] = std::sin(3 * whole.node(i)[k] + whole.node(i)[0]);
      std::vector<int> same;
      for (int i = 0; i < near.node_count(); ++i) {
        REQUIRE(at.contains(near.point(i)));
        same.push_back(at[near.point(i)]);
        for (int k = 0; k < dimension; ++k) own.push_back(u[static_cast<std::size_t>(same.back() * dimension + k)]);
      }
      const elasticity::MaterialField steel = test::steel(dimension);
      const auto stress = elasticity::nodal_stress(whole, steel, u), of_near = elasticity::nodal_stress(near, steel, own);
      for (const mesh::Facet f : mesh::boundary(near))
        for (int k = 0; k < near.topology().nodes_per_facet; ++k) {
          const int node = near.facet_node(f, k);
          for (std::size_t v = 0; v < 6; ++v) CHECK(of_near[node][v] == doctest::Approx(stress[same[node]][v]).scale(1e3).epsilon(1e-10));
        }
      // The functions of coarser meshes are those of the whole mesh at these nodes.
      for (int i = 0; i < near.node_count(); ++i) CHECK(near.coarser->means[i].size() == whole.coarser->means[same[i]].size());
      for (std::size_t c = 0; c < parent.size(); ++c) {
        mesh::Point lo{1e9, 1e9, 1e9}, hi{-1e9, -1e9, -1e9};
        for (int k = 0; k < coarse.topology().nodes; ++k)
          for (int i = 0; i < dimension; ++i)
            lo[i] = std::min(lo[i], coarse.node(coarse.cell(parent[c])[k])[i]), hi[i] = std::max(hi[i], coarse.node(coarse.cell(parent[c])[k])[i]);
        const mesh::Point x = near.cell_centre(static_cast<int>(c));
        for (int i = 0; i < dimension; ++i) CHECK((x[i] > lo[i] && x[i] < hi[i]));
      }
    }
}

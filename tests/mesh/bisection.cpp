#include "mesh/bisection.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;

namespace {

/// (volume)/(longest edge)^dim: 0 for a flat cell.
double roundness(const mesh::Mesh& m, int c) {
  double longest = 0;
  for (int i = 0; i <= m.dimension(); ++i)
    for (int j = 0; j < i; ++j) {
      double square = 0;
      for (int k = 0; k < m.dimension(); ++k) square += std::pow(m.node(m.cell(c)[i])[k] - m.node(m.cell(c)[j])[k], 2);
      longest = std::max(longest, std::sqrt(square));
    }
  return test::measure(m, c) / std::pow(longest, m.dimension());
}

double least_roundness(const mesh::Mesh& m) {
  double least = INFINITY;
  for (int c = 0; c < m.cell_count(); ++c) least = std::min(least, roundness(m, c));
  return least;
}

/// Edge lengths of a cell relative to its longest, sorted: the same for similar cells.
std::vector<long long> shape_of(const mesh::Mesh& m, int c) {
  std::vector<double> squares;
  for (int i = 0; i <= m.dimension(); ++i)
    for (int j = 0; j < i; ++j) {
      double square = 0;
      for (int k = 0; k < m.dimension(); ++k) square += std::pow(m.node(m.cell(c)[i])[k] - m.node(m.cell(c)[j])[k], 2);
      squares.push_back(square);
    }
  std::sort(squares.begin(), squares.end());
  std::vector<long long> key;
  for (const double s : squares) key.push_back(std::llround(1e6 * s / squares.back()));
  return key;
}

/// Every facet that has no neighbour lies on the boundary of the unit square or cube: no node hangs.
bool conforming(const mesh::Mesh& m) {
  for (const mesh::Facet f : mesh::boundary(m)) {
    const mesh::Point x = m.facet_centre(f);
    double off = 1;
    for (int i = 0; i < m.dimension(); ++i) off = std::min({off, std::abs(x[i]), std::abs(1 - x[i])});
    if (off > 1e-12) return false;
  }
  return true;
}

std::vector<int> some(const mesh::Mesh& m, int count, std::mt19937& random) {
  std::vector<int> cells;
  for (int k = 0; k < count; ++k) cells.push_back(static_cast<int>(random() % static_cast<unsigned>(m.cell_count())));
  return cells;
}

/// The cells that contain the point.
std::vector<int> at(const mesh::Mesh& m, const mesh::Point& x) {
  std::vector<int> cells;
  for (int c = 0; c < m.cell_count(); ++c)
    for (int k = 0; k <= m.dimension(); ++k)
      if (m.point(m.cell(c)[k]) == x) {
        cells.push_back(c);
        break;
      }
  return cells;
}

}  // namespace

TEST_CASE("twenty random rounds of bisection keep the mesh conforming, its volume, its parts and its shapes") {
  for (const int dim : {2, 3}) {
    CAPTURE(dim);
    auto start = test::unit(dim, mesh::Family::p1, 2);
    test::distort(start, 0.05);
    mesh::Bisection bisection(start);
    std::mt19937 random(7);
    double least = INFINITY;
    std::map<int, std::set<std::vector<long long>>> shapes;  // of the descendants of a first cell
    std::vector<int> origin(start.cell_count());
    for (int c = 0; c < start.cell_count(); ++c) origin[c] = c;
    for (int round = 0; round < 20; ++round) {
      const auto before = bisection.mesh();
      const auto refined = test::refine(bisection, some(*before, dim == 2 ? 10 : 4, random));
      const mesh::Mesh& m = *bisection.mesh();
      CHECK_NOTHROW(mesh::check(m, "refined"));
      CHECK(conforming(m));
      CHECK(test::measure(m) == doctest::Approx(1).epsilon(1e-12));
      for (const auto& [name, facets] : start.parts)
        CHECK(test::measure(m, m.parts.at(name)) == doctest::Approx(1).epsilon(1e-12));
      REQUIRE(static_cast<int>(refined.parent.size()) == m.cell_count());
      REQUIRE(before->node_count() + std::ssize(refined.ends) == m.node_count());
      std::vector<double> volume(before->cell_count(), 0);
      std::vector<int> old = origin;
      origin.assign(m.cell_count(), 0);
      for (int c = 0; c < m.cell_count(); ++c) {
        volume[refined.parent[c]] += test::measure(m, c);
        origin[c] = old[refined.parent[c]];
        shapes[origin[c]].insert(shape_of(m, c));
      }
      for (int c = 0; c < before->cell_count(); ++c)
        REQUIRE(volume[c] == doctest::Approx(test::measure(*before, c)).epsilon(1e-10));
      for (std::size_t k = 0; k < refined.ends.size(); ++k)
        for (int i = 0; i < dim; ++i)
          REQUIRE(m.node(before->node_count() + static_cast<int>(k))[i] ==
                  doctest::Approx(0.5 * (m.node(refined.ends[k][0])[i] + m.node(refined.ends[k][1])[i])));
      least = std::min(least, least_roundness(m));
    }
    // Triangles: the 4 shapes of newest vertex bisection, with their mirror images the same set of lengths.
    // Tetrahedra: at most 72 up to translation and scale (Arnold, Mukherjee, Pouly, section 3), seen here: 36.
    std::size_t most = 0;
    for (const auto& [cell, of_cell] : shapes) most = std::max(most, of_cell.size());
    CAPTURE(most);
    CHECK(most <= (dim == 2 ? 4 : 72));
    CHECK(least > 0.1 * least_roundness(start));
  }
}

TEST_CASE("thirty rounds at a corner make cells smaller there only, and no flatter") {
  for (const int dim : {2, 3}) {
    const auto start = test::unit(dim, mesh::Family::p1, 2);
    mesh::Bisection bisection(start);
    for (int round = 0; round < 30; ++round) test::refine(bisection, at(*bisection.mesh(), {0, 0, 0}));
    const mesh::Mesh& m = *bisection.mesh();
    CHECK(conforming(m));
    CHECK(test::measure(m) == doctest::Approx(1).epsilon(1e-12));
    CHECK(least_roundness(m) > 0.3 * least_roundness(start));
    double smallest = INFINITY;
    for (const int c : at(m, {0, 0, 0})) smallest = std::min(smallest, test::measure(m, c));
    CHECK(std::pow(smallest, 1.0 / dim) < 1e-8);
    CHECK(m.cell_count() < (dim == 2 ? 1000 : 30000));  // a bounded number a level
  }
}

TEST_CASE("all cells refined is uniform refinement: every extent halved") {
  for (const int dim : {2, 3}) {
    const auto start = test::unit(dim, mesh::Family::p1, 2);
    mesh::Bisection bisection(start);
    std::vector<int> all(start.cell_count());
    for (int c = 0; c < start.cell_count(); ++c) all[c] = c;
    test::refine(bisection, all);
    CHECK(bisection.mesh()->cell_count() == start.cell_count() << dim);
    CHECK(bisection.mesh()->node_count() == test::unit(dim, mesh::Family::p1, 4).node_count());
  }
}

TEST_CASE("bodies that match on a surface still do after refinement of one of them") {
  for (const int dim : {2, 3}) {
    const auto lower = dim == 2 ? test::rectangle(mesh::Family::p1, 3, 2) : test::box(mesh::Family::p1, 3, 2, 2);
    const auto upper = dim == 2 ? test::rectangle(mesh::Family::p1, 3, 3, 0, 1.25, 1, 2)
                                : test::box(mesh::Family::p1, 3, 2, 3, {0, 0, 1.25}, {1, 1, 2});
    mesh::Bisection below(lower), above(upper);
    std::mt19937 random(3);
    Monitor unwatched;
    for (int round = 0; round < 6; ++round) {
      mesh::Joint joint{0, 1, {}};
      const mesh::Mesh &a = *below.mesh(), &b = *above.mesh();
      for (int i = 0; i < a.node_count(); ++i)
        for (int j = 0; j < b.node_count(); ++j)
          if (a.node(i)[dim - 1] == 1 && b.node(j)[dim - 1] == 1.25 && std::equal(a.node(i), a.node(i) + dim - 1, b.node(j)))
            joint.nodes.emplace_back(i, j);
      const auto traces = [&](const mesh::Mesh& m, double height) {
        std::set<std::vector<std::array<double, 2>>> facets;
        for (const mesh::Facet f : mesh::boundary(m)) {
          std::vector<std::array<double, 2>> corners;
          for (int k = 0; k < dim; ++k)
            if (const double* x = m.node(m.facet_node(f, k)); x[dim - 1] == height) corners.push_back({x[0], dim == 3 ? x[1] : 0});
          std::sort(corners.begin(), corners.end());
          if (std::ssize(corners) == dim) facets.insert(corners);
        }
        return facets;
      };
      CHECK(traces(a, 1) == traces(b, 1.25));
      mesh::refine({&below, &above}, {some(a, 3, random), round % 2 ? some(b, 3, random) : std::vector<int>()}, {joint}, unwatched);
      CHECK(mesh::boundary(*below.mesh()).size() > 0);
    }
    CHECK(above.mesh()->cell_count() > upper.cell_count());
  }
}

TEST_CASE("new nodes of a curved boundary go where the projection puts them") {
  const auto start = test::disc(mesh::Family::p1, 2);
  mesh::Bisection bisection(start);
  for (int round = 0; round < 3; ++round) {
    test::refine(bisection, {0, 3, 7});
    bisection.project("boundary", [](const mesh::Point& x) {
      const double r = std::hypot(x[0], x[1]);
      return mesh::Point{x[0] / r, x[1] / r, 0};
    });
  }
  const mesh::Mesh& m = *bisection.mesh();
  CHECK(m.node_count() > start.node_count());
  for (const mesh::Facet f : mesh::boundary(m))
    for (int k = 0; k < 2; ++k) CHECK(test::length(m.point(m.facet_node(f, k))) == doctest::Approx(1).epsilon(1e-14));
  CHECK_THROWS_WITH_AS(bisection.project("rim", [](const mesh::Point& x) { return x; }), doctest::Contains("no part 'rim'; it has boundary"), InputError);
  test::refine(bisection, {bisection.mesh()->parts.at("boundary")[0].cell});
  const auto unmoved = bisection.mesh();
  CHECK_THROWS_AS(bisection.project("boundary", [](const mesh::Point&) { return mesh::Point{50, 0, 0}; }), InputError);
  CHECK(bisection.mesh() == unmoved);
}

TEST_CASE("a round that is stopped leaves the meshes as they were") {
  struct StopAt final : Monitor {
    explicit StopAt(int time) : left(time) {}
    bool stop() override { return left-- == 0; }
    int left;
  };
  mesh::Bisection stopped(test::rectangle(mesh::Family::p1, 40, 40)), beside(test::rectangle(mesh::Family::p1, 3, 3));
  std::vector<int> all(stopped.mesh()->cell_count());
  std::iota(all.begin(), all.end(), 0);
  const auto before = stopped.mesh(), before_beside = beside.mesh();
  int stops = 0;
  for (bool whole = false; !whole;) {
    StopAt monitor(stops);
    try {
      mesh::refine({&stopped, &beside}, {all, {0}}, {}, monitor);
      whole = true;
    } catch (const Interrupted&) {
      ++stops;
      CHECK(stopped.mesh() == before);
      CHECK(beside.mesh() == before_beside);
    }
  }
  CHECK(stops > 4);  // among others in the midst of the first and of the second
  mesh::Bisection whole(*before);
  test::refine(whole, all);
  CHECK(stopped.mesh()->cells == whole.mesh()->cells);
  CHECK(stopped.mesh()->coordinates == whole.mesh()->coordinates);
}

TEST_CASE("meshes that cannot be bisected and cells that are not there are refused") {
  CHECK_THROWS_WITH_AS(mesh::Bisection(test::rectangle(mesh::Family::q1, 2, 2)), doctest::Contains("quadrilaterals (Q1); only simplices"), InputError);
  mesh::Bisection bisection(test::rectangle(mesh::Family::p1, 2, 2));
  CHECK_THROWS_WITH_AS(test::refine(bisection, {8}), doctest::Contains("cell 9 is to be refined; the mesh has cells 1 to 8"), InputError);
}

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "mesh/second_order.hpp"
#include "meshfile/assemble.hpp"
#include "refused.hpp"

using namespace dotyk;
using namespace dotyk::meshfile;
using test::check_refused;

namespace {

using mesh::Point;

/// Corners of [-1, 1]^d in VTK's order.
constexpr int kCorner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};

std::vector<Point> reference_nodes(const mesh::ElementTopology& t) {
  std::vector<Point> x;
  for (int k = 0; k < t.nodes; ++k) {
    Point p{0, 0, 0};
    const std::vector<int> corners = k < t.corners ? std::vector{k} : t.between[k - t.corners];
    for (const int c : corners)
      for (int i = 0; i < t.dimension; ++i) p[i] += kCorner[c][i] / static_cast<double>(corners.size());
    x.push_back(p);
  }
  return x;
}

/// The serendipity function of a node at r: of a corner ∏(1 + r_i s_i)/2 · (Σ r_i s_i − (d − 1)), of an edge with s_i = 0
/// (1 − r_i²) times the other (1 + r_j s_j)/2.
double serendipity(const Point& s, const Point& r, int dimension) {
  double product = 1, sum = 0;
  bool corner = true;
  for (int i = 0; i < dimension; ++i) {
    if (s[i] == 0) corner = false, product *= 1 - r[i] * r[i];
    else product *= (1 + r[i] * s[i]) / 2, sum += r[i] * s[i];
  }
  return corner ? product * (sum - (dimension - 1)) : product;
}

/// The tensor product of quadratic Lagrange functions.
double lagrange(const Point& s, const Point& r, int dimension) {
  double product = 1;
  for (int i = 0; i < dimension; ++i) product *= s[i] == 0 ? 1 - r[i] * r[i] : r[i] * (r[i] + s[i]) / 2;
  return product;
}

/// Two serendipity cells that share a side, with curved sides at random; the last cell left-handed.
Contents two_serendipity(int dimension, std::mt19937& random) {
  const mesh::Element first = dimension == 2 ? mesh::Element::quadrilateral_q1 : mesh::Element::hexahedron_q1;
  mesh::Mesh two;
  two.element = first;
  for (int z = 0; z < (dimension == 2 ? 1 : 2); ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        for (int i = 0; i < dimension; ++i) two.coordinates.push_back(i == 0 ? x : i == 1 ? y : z);
  two.cells = {0, 1, 4, 3, 1, 2, 5, 4};
  if (dimension == 3) two.cells = {0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10};
  const mesh::Mesh second = mesh::second_order(two);
  const mesh::ElementTopology& t = second.topology();
  Contents c;
  std::uniform_real_distribution<double> off(-0.08, 0.08);
  for (int n = 0; n < second.node_count(); ++n)
    for (int i = 0; i < 3; ++i) c.points.push_back(i < dimension ? second.node(n)[i] + off(random) : 0);
  Block b{dimension == 2 ? Shape::quadrilateral : Shape::hexahedron, {}, {}, 2};
  for (int k = 0; k < 2; ++k) {
    b.nodes.insert(b.nodes.end(), second.cell(k), second.cell(k) + t.corners);
    for (int m = t.corners; m < t.nodes; ++m) b.between.push_back(t.between[m - t.corners].size() == 2 ? second.cell(k)[m] : -1);
  }
  c.blocks = {b};
  return c;
}

/// Two triangles of order 2 on the unit square, the side between them bent: nodes 0-3 its corners, 4-7 its sides, 8 the diagonal.
Contents square() {
  Contents c;
  c.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, 0, 1, 0.5, 0, 0.5, 1, 0, 0, 0.5, 0, 0.55, 0.45, 0};
  c.blocks = {{Shape::triangle, {}, {0, 1, 2}, 2, {4, 5, 8}}, {Shape::triangle, {}, {0, 2, 3}, 2, {8, 6, 7}}};
  return c;
}

}  // namespace

TEST_CASE("centres of faces and cells added to serendipity cells do not change their shape") {
  std::mt19937 random(7);
  for (const int dimension : {2, 3}) {
    const Contents c = two_serendipity(dimension, random);
    const Loaded loaded = assemble(c, {.order = 2}, "f");
    const mesh::Mesh& m = loaded.mesh;
    CHECK(m.node_count() == (dimension == 2 ? 15 : 45));  // 5 × 3 (× 3): shared nodes once
    CHECK(loaded.notes.empty());
    const std::vector<Point> s = reference_nodes(m.topology());
    const Block& b = c.blocks[0];
    const int corners = m.topology().corners, each = m.topology().nodes - corners;
    std::uniform_real_distribution<double> in(-1, 1);
    for (int trial = 0; trial < 20; ++trial) {
      const Point r{in(random), in(random), dimension == 3 ? in(random) : 0};
      for (int cell = 0; cell < 2; ++cell) {
        Point theirs{0, 0, 0}, ours{0, 0, 0};
        for (int k = 0; k < m.topology().nodes; ++k) {
          const int file = k < corners ? b.nodes[cell * corners + k] : b.between[cell * each + k - corners];
          for (int i = 0; i < dimension; ++i) {
            ours[i] += lagrange(s[k], r, dimension) * m.node(m.cell(cell)[k])[i];
            if (file >= 0) theirs[i] += serendipity(s[k], r, dimension) * c.points[3 * static_cast<std::size_t>(file) + i];
          }
        }
        for (int i = 0; i < dimension; ++i) CHECK(ours[i] == doctest::Approx(theirs[i]).epsilon(1e-13));
      }
    }
  }
}

TEST_CASE("the file's nodes between corners are kept, also by cells in left-handed order") {
  Contents c = square();
  const mesh::Mesh m = assemble(c, {.order = 2}, "f").mesh;
  CHECK(m.element == mesh::Element::triangle_p2);
  CHECK(m.node_count() == 9);
  const auto has = [](const mesh::Mesh& mesh, int cell, double x, double y) {
    for (int k = 0; k < 6; ++k)
      if (mesh.node(mesh.cell(cell)[k])[0] == x && mesh.node(mesh.cell(cell)[k])[1] == y) return true;
    return false;
  };
  CHECK((has(m, 0, 0.55, 0.45) && has(m, 1, 0.55, 0.45) && has(m, 0, 1, 0.5) && has(m, 1, 0, 0.5)));
  std::swap(c.blocks[1].nodes[0], c.blocks[1].nodes[1]);  // 2 0 3
  std::swap(c.blocks[1].between[1], c.blocks[1].between[2]);
  const mesh::Mesh turned = assemble(c, {.order = 2}, "f").mesh;
  for (int cell = 0; cell < 2; ++cell) CHECK(mesh::least_jacobian(turned, cell) == doctest::Approx(mesh::least_jacobian(m, cell)).epsilon(1e-14));
  CHECK((has(turned, 1, 0.55, 0.45) && has(turned, 1, 0.5, 1)));
  // In space, a mirrored cell of each shape with bent sides.
  std::mt19937 random(3);
  Contents solid = two_serendipity(3, random);
  const mesh::Mesh sound = assemble(solid, {.order = 2}, "f").mesh;
  for (std::size_t i = 2; i < solid.points.size(); i += 3) solid.points[i] *= -1;
  const mesh::Mesh mirrored = assemble(solid, {.order = 2}, "f").mesh;
  for (int cell = 0; cell < 2; ++cell) CHECK(mesh::least_jacobian(mirrored, cell) == doctest::Approx(mesh::least_jacobian(sound, cell)).epsilon(1e-13));
}

TEST_CASE("parts are found by their corners; regions alone keep what bounds them") {
  Contents c = square();
  c.groups = {{2, "low"}, {2, "high"}, {1, "between"}, {1, "right"}};
  c.blocks[0].groups = {0};
  c.blocks[1].groups = {1};
  c.blocks.push_back({Shape::segment, {2}, {2, 0}, 2});
  c.blocks.push_back({Shape::segment, {3}, {1, 2}, 2});
  const Loaded all = assemble(c, {.order = 2}, "f"), low = assemble(c, {.regions = {"low"}, .order = 2}, "f");
  CHECK(all.mesh.parts.size() == 1);
  CHECK(all.mesh.parts.at("right") == std::vector<mesh::Facet>{{0, 1}});
  CHECK(low.mesh.parts.at("between") == std::vector<mesh::Facet>{{0, 2}});
  CHECK(low.mesh.node_count() == 6);
}

TEST_CASE("elements of order 1 among those of order 2 take their nodes; alone they get their own") {
  Contents c = square();
  c.blocks[1].order = 1;
  c.blocks[1].between.clear();
  const Loaded mixed = assemble(c, {.order = 2}, "f");
  CHECK(mixed.mesh.node_count() == 9);
  REQUIRE(mixed.notes.size() == 1);
  CHECK(mixed.notes[0] == "some of its elements are of order 1; nodes are put in the middle of their straight sides");
  CHECK(mixed.mesh.coordinates == assemble(square(), {.order = 2}, "f").mesh.coordinates);
  CHECK(assemble(c, {}, "f").notes == std::vector<std::string>{"its elements are of order 2; only their corners are used, so that curved sides become straight "
                                                               "(order = 2 takes them as they are)"});
  c.blocks[0].order = 1;
  c.blocks[0].between.clear();
  const Loaded first = assemble(c, {.order = 2}, "f");
  CHECK(first.mesh.coordinates == mesh::second_order(assemble(c, {}, "f").mesh).coordinates);
  CHECK(first.notes == std::vector<std::string>{"its elements are of order 1; nodes are put in the middle of their straight sides"});
  CHECK(assemble(c, {}, "f").notes.empty());
}

TEST_CASE("cells of order 2 that cannot be a mesh say why") {
  Contents bent = square();
  bent.points[24] = 0.9, bent.points[25] = 0.1;
  check_refused(bent, {.order = 2}, "cell 1 (a triangle near");
  check_refused(bent, {.order = 2}, "its sides are bent too far; with straight sides (order = 1) it is sound");
  CHECK(assemble(bent, {}, "f").mesh.cell_count() == 2);
  Contents other = square();
  other.points.insert(other.points.end(), {0.5, 0.5, 0});
  other.blocks[1].between[0] = 9;
  check_refused(other, {.order = 2}, "do not fit together near (0.5, 0.5): two nodes lie between the same corners");
  Contents corner = square();
  corner.blocks[0].between[0] = 3;
  check_refused(corner, {.order = 2}, "a node between corners of one is a corner of another");
  Contents twice = square();
  twice.blocks[0].between[1] = 4;
  check_refused(twice, {.order = 2}, "a node lies between several pairs of corners");
  Contents third = square();
  for (Block& b : third.blocks) b.order = 3, b.between.clear();
  check_refused(third, {.order = 2}, "its elements are of order 3; save it with order 2, or load it with order = 1");
  CHECK(assemble(third, {}, "f").notes == std::vector<std::string>{"its elements are of order 3; only their corners are used, so that curved sides become straight"});
  Contents stray = square();
  stray.blocks[0].between[0] = 9;
  check_refused(stray, {.order = 2}, "has a node that is not there");
  check_refused(stray, {}, "has a node that is not there");
  stray.blocks[0].between.pop_back();
  check_refused(stray, {}, "its triangles are damaged");
  Contents flat = square();  // the node between lifts it off the plane
  flat.points[26] = 0.1;
  check_refused(flat, {.order = 2}, "surface in space");
}

#include "mesh/decomposition.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "../support/meshes.hpp"

using namespace dotyk;

namespace {

/// Cells that can be reached from the first one through facets; found by the definition, slowly.
int reached(const mesh::Mesh& m) {
  const auto& t = m.topology();
  const auto share = [&](int c, int d) {
    int common = 0;
    for (int a = 0; a < t.nodes; ++a) common += std::find(m.cell(d), m.cell(d) + t.nodes, m.cell(c)[a]) != m.cell(d) + t.nodes;
    return common >= t.nodes_per_facet;
  };
  std::vector<int> found{0};
  std::vector<char> seen(m.cell_count(), 0);
  seen[0] = 1;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int d = 0; d < m.cell_count(); ++d)
      if (!seen[d] && share(found[k], d)) seen[d] = 1, found.push_back(d);
  return static_cast<int>(found.size());
}

/// Every cell is in one piece, no piece is empty or falls apart, and their numbers ascend with their least cells.
void check_pieces(const mesh::Mesh& m, const mesh::Pieces& pieces) {
  REQUIRE(static_cast<int>(pieces.of_cell.size()) == m.cell_count());
  int first_unseen = 0;
  for (const int p : pieces.of_cell) {
    CHECK(p <= first_unseen);
    first_unseen = std::max(first_unseen, p + 1);
  }
  CHECK(first_unseen == pieces.count);
  double whole = 0;
  for (const auto& cells : pieces.cells()) {
    REQUIRE(!cells.empty());
    const auto piece = mesh::submesh(m, cells).mesh;
    CHECK(reached(piece) == piece.cell_count());
    whole += test::measure(piece);
  }
  CHECK(whole == doctest::Approx(test::measure(m)).epsilon(1e-12));
}

int greatest(const mesh::Pieces& pieces) {
  std::size_t most = 0;
  for (const auto& cells : pieces.cells()) most = std::max(most, cells.size());
  return static_cast<int>(most);
}

/// Both meshes side by side, without a common node.
mesh::Mesh both(mesh::Mesh a, const mesh::Mesh& b) {
  for (const int n : b.cells) a.cells.push_back(n + a.node_count());
  a.coordinates.insert(a.coordinates.end(), b.coordinates.begin(), b.coordinates.end());
  a.parts.clear();
  return a;
}

}  // namespace

TEST_CASE("METIS's pieces are connected, cover the mesh and are of like size") {
  for (const auto family : test::kFamilies)
    for (const int count : {1, 2, 3, 7, 16}) {
      for (const mesh::Mesh& m : {test::rectangle(family, 20, 12), test::box(family, 6, 5, 7), test::disc(family, 9)}) {
        const auto pieces = mesh::decompose(m, count);
        check_pieces(m, pieces);
        CHECK(pieces.count == count);
        // METIS is told to keep parts within 3 % of each other; with few cells a piece, within some cells.
        CHECK(greatest(pieces) <= 1.03 * m.cell_count() / count + 5);
      }
    }
}

TEST_CASE("one mesh is always cut alike") {
  const auto m = test::box(mesh::Family::p1, 5, 6, 4);
  const auto first = mesh::decompose(m, 9);
  mesh::decompose(test::disc(mesh::Family::q1, 8), 5);
  CHECK(mesh::decompose(m, 9).of_cell == first.of_cell);
}

TEST_CASE("few cells in many pieces") {
  for (const auto family : test::kFamilies)
    for (const int dimension : {2, 3})
      for (const int n : {1, 2, 3, 4}) {
        const auto m = test::unit(dimension, family, n);
        for (int count = 1; count <= m.cell_count() + 2; count += 1 + count / 9) {
          const auto pieces = mesh::decompose(m, count);
          check_pieces(m, pieces);
          CHECK(pieces.count <= m.cell_count());
        }
      }
}

TEST_CASE("a mesh in two parts is cut part by part, by their cells") {
  auto far = test::rectangle(mesh::Family::q1, 4, 4, 3, 0, 4, 1);
  const auto m = both(test::rectangle(mesh::Family::q1, 8, 12), far);
  check_pieces(m, mesh::pieces_of(m));
  CHECK(mesh::pieces_of(m).count == 2);
  CHECK(mesh::pieces_of(far).count == 1);
  for (const int count : {1, 2, 7, 14}) {
    const auto pieces = mesh::decompose(m, count);
    check_pieces(m, pieces);
    CHECK(pieces.count == std::max(2, count));
    const std::set<int> small(pieces.of_cell.begin() + 96, pieces.of_cell.end());
    CHECK(static_cast<int>(small.size()) == std::max(1, count / 7));
  }
}

TEST_CASE("boxes hold the cells whose centres they hold") {
  const auto m = test::box(mesh::Family::q1, 6, 4, 3, {-1, 0, 2}, {2, 2, 5});
  const auto pieces = mesh::decompose(m, {3, 2, 1});
  check_pieces(m, pieces);
  CHECK(pieces.count == 6);
  for (const auto& cells : pieces.cells()) CHECK(cells.size() == 12);
  const auto piece_at = [&](double x, double y) {
    for (int c = 0; c < m.cell_count(); ++c) {
      const auto p = m.cell_centre(c);
      if (std::abs(p[0] - x) < 0.3 && std::abs(p[1] - y) < 0.3) return pieces.of_cell[c];
    }
    return -1;
  };
  CHECK(piece_at(-0.75, 0.25) == piece_at(-0.25, 0.75));
  CHECK(piece_at(-0.75, 0.25) != piece_at(0.25, 0.25));
  CHECK(piece_at(-0.75, 0.75) != piece_at(-0.75, 1.25));
}

TEST_CASE("centres on the plane between two boxes all go the same way, wherever the mesh lies") {
  for (const double x : {0.0, 0.1, 1e3 + 0.3, -77.7}) {
    const auto m = test::rectangle(mesh::Family::q1, 3, 30, x, x, x + 1, x + 1);
    const auto pieces = mesh::decompose(m, {2, 1, 1});
    CHECK(pieces.count == 2);
    CHECK(greatest(pieces) == 60);
  }
}

TEST_CASE("boxes of a mesh that fills them unevenly: pieces fall into their connected parts, empty ones are left out") {
  // A U of 5 × 5 cells: its upper half is two arms.
  const auto square = test::rectangle(mesh::Family::q1, 5, 5);
  std::vector<int> u;
  for (int c = 0; c < 25; ++c)
    if (c % 5 == 0 || c % 5 == 4 || c < 5) u.push_back(c);
  const auto m = mesh::submesh(square, u).mesh;
  const auto halves = mesh::decompose(m, {1, 2, 1});
  check_pieces(m, halves);
  CHECK(halves.count == 3);
  const auto fine = mesh::decompose(m, {5, 5, 1});
  check_pieces(m, fine);
  CHECK(fine.count == m.cell_count());
  CHECK(mesh::decompose(m, {2000000000, 2000000000, 1}).count == m.cell_count());
}

TEST_CASE("cells that touch at a node or along an edge alone are not connected") {
  const auto square = test::rectangle(mesh::Family::q1, 2, 2);
  CHECK(mesh::decompose(mesh::submesh(square, {0, 3}).mesh, 1).count == 2);
  CHECK(mesh::pieces_of(mesh::submesh(square, {0, 3}).mesh).count == 2);
  const auto cube = test::box(mesh::Family::q1, 2, 2, 1);
  CHECK(mesh::decompose(mesh::submesh(cube, {0, 3}).mesh, {1, 1, 1}).count == 2);
  CHECK(mesh::pieces_of(mesh::submesh(cube, {0, 3}).mesh).count == 2);
  CHECK(mesh::decompose(mesh::submesh(cube, {0, 1, 3}).mesh, 1).count == 1);
}

TEST_CASE("a facet of three cells joins them all") {
  auto m = test::rectangle(mesh::Family::p1, 1, 1);
  m.coordinates.insert(m.coordinates.end(), {0.4, 0.1});
  m.cells.insert(m.cells.end(), {0, 4, 3});  // a third triangle on the diagonal
  check_pieces(m, mesh::decompose(m, 1));
  CHECK(mesh::decompose(m, 1).count == 1);
  check_pieces(m, mesh::decompose(m, 2));
}

TEST_CASE("pieces are shared out one each, then where a piece has most cells") {
  CHECK(mesh::share_out(1, {5, 7}) == std::vector<int>{1, 1});
  CHECK(mesh::share_out(12, {100, 100, 400}) == std::vector<int>{2, 2, 8});
  CHECK(mesh::share_out(5, {10, 10}) == std::vector<int>{3, 2});
  CHECK(mesh::share_out(100, {2, 3}) == std::vector<int>{2, 3});
  CHECK(mesh::share_out(4, {1000, 1, 1}) == std::vector<int>{2, 1, 1});
  CHECK(mesh::share_out(4, {}).empty());
}

TEST_CASE("a submesh has its cells' nodes and no others") {
  const auto m = test::disc(mesh::Family::p1, 6);
  const auto piece = mesh::submesh(m, {7, 2, 30});
  CHECK(piece.cell == std::vector<int>{7, 2, 30});
  CHECK(std::is_sorted(piece.node.begin(), piece.node.end()));
  CHECK(piece.mesh.node_count() == static_cast<int>(piece.node.size()));
  for (int k = 0; k < 3; ++k)
    for (int a = 0; a < 3; ++a) {
      const int own = piece.mesh.cell(k)[a];
      CHECK(piece.node[own] == m.cell(piece.cell[k])[a]);
      CHECK(piece.mesh.point(own) == m.point(m.cell(piece.cell[k])[a]));
    }
  CHECK_NOTHROW(mesh::check(piece.mesh, "piece"));
}

#include "contact/multipliers.hpp"

#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "contact/rigid.hpp"

using namespace dotyk;
using contact::FrictionCell;
using contact::Surface;
using contact::Term;
using mesh::Point;

namespace {

/// The top of a square or cube of n cells along each edge against a rigid half-space above it.
struct Top {
  mesh::Mesh mesh;
  std::vector<contact::ContactRow> rows;
  Top(int dim, mesh::Family family, int n) : mesh(test::unit(dim, family, n)) {
    Point at{0, 0, 0}, down{0, 0, 0};
    at[dim - 1] = 1;
    down[dim - 1] = -1;
    rows = contact::against(mesh, mesh.parts.at("top"), contact::RigidPlane{at, down}, {}, false);
  }
  Surface surface() const { return contact::surface(mesh, mesh.parts.at("top"), rows, {}); }
  std::vector<double> values(const std::function<double(const Point&)>& g) const {
    std::vector<double> v;
    for (const auto& row : rows) v.push_back(g(mesh.point(row.node)));
    return v;
  }
  std::vector<char> all() const { return std::vector<char>(rows.size(), 1); }
  /// All but the rows on the rim of the top.
  std::vector<char> inner() const {
    std::vector<char> moves;
    for (const auto& row : rows) {
      const Point x = mesh.point(row.node);
      bool rim = x[0] == 0 || x[0] == 1;
      if (mesh.dimension() == 3) rim = rim || x[1] == 0 || x[1] == 1;
      moves.push_back(!rim);
    }
    return moves;
  }
};

double total(const std::vector<FrictionCell>& cells, double FrictionCell::*what) {
  double sum = 0;
  for (const auto& cell : cells) sum += cell.*what;
  return sum;
}

/// Rows (jumps times `scale`) against the nodes that move.
template <class Row>
Eigen::MatrixXd matrix(const std::vector<Row>& rows, const std::vector<char>& moves) {
  std::vector<int> column(moves.size(), -1);
  int columns = 0;
  for (std::size_t k = 0; k < moves.size(); ++k)
    if (moves[k]) column[k] = columns++;
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(static_cast<int>(rows.size()), columns);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const Term& t : rows[r].jumps)
      if (column[t.row] >= 0) B(static_cast<int>(r), column[t.row]) += t.weight * rows[r].measure;
  return B;
}

/// Dimension of the multipliers that no displacement notices. Singular values of these small well-scaled
/// matrices are 0 to 1e-15 or above 1e-3.
template <class Row>
int kernel(const std::vector<Row>& rows, const std::vector<char>& moves) {
  std::vector<Row> present;
  for (const Row& row : rows)
    if (!row.jumps.empty()) present.push_back(row);
  const Eigen::MatrixXd B = matrix(present, moves);
  const algebra::Vector svd = algebra::singular_values(B);
  int rank = 0;
  for (int k = 0; k < svd.size(); ++k) rank += svd[k] > 1e-9 * svd[0];
  return static_cast<int>(B.rows()) - rank;
}

}  // namespace

TEST_CASE("dual cells: their bounds are the integral of the bound, their rows those of Simpson's rule by hand") {
  const Top top(2, mesh::Family::p1, 4);  // h = 1/4
  const auto g = [](const Point& x) { return 1 + 2 * x[0]; };
  const auto cells = contact::friction_cells(top.surface(), top.values(g), top.all(), 0);
  REQUIRE(cells.size() == 5);
  CHECK(total(cells, &FrictionCell::bound) == doctest::Approx(2).epsilon(1e-14));
  CHECK(total(cells, &FrictionCell::measure) == doctest::Approx(1).epsilon(1e-14));
  for (const auto& cell : cells) {
    REQUIRE(cell.nodes.size() == 1);
    CHECK(cell.nodes[0].weight == doctest::Approx(1));
    const double x = top.mesh.point(top.rows[cell.nodes[0].row].node)[0];
    const bool end = x == 0 || x == 1;
    CHECK(cell.measure == doctest::Approx(end ? 0.125 : 0.25));
    CHECK(cell.jumps.size() == (end ? 2 : 3));
    double sum = 0;
    for (const Term& t : cell.jumps) sum += t.weight;
    CHECK(sum == doctest::Approx(1).epsilon(1e-14));  // a slip of 1 everywhere has mean 1
    if (x != 0.5) continue;
    // ∫ over (3/8, 5/8) of g φ_j by hand: with s the distance from the midpoint in units of h,
    // g = 2 + s/2; ∫ gφ over the cell: the node's own h(2·3/4), the right neighbour's h(2·1/8 + 1/2·1/24).
    for (const Term& t : cell.jumps) {
      const double s = (top.mesh.point(top.rows[t.row].node)[0] - 0.5) * 4;
      const double by_hand = s == 0 ? 2 * 0.75 : 2 * 0.125 + s * 0.5 / 24;
      CHECK(t.weight * cell.bound == doctest::Approx(0.25 * by_hand).epsilon(1e-14));
    }
  }
}

TEST_CASE("cells of friction cover the surface, and carry the whole bound") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const double size : {0.0, 0.25, 0.3, 0.5, 1.0}) {
        const Top top(dim, family, 8);
        // Bilinear on the top's cells where these are parallelograms, linear for triangles.
        const auto g = [](const Point& x) { return 1 + x[0] + (x[1] < 1 ? 0.5 * x[1] : 0); };
        const auto cells = contact::friction_cells(top.surface(), top.values(g), top.all(), size);
        double integral = 0;
        const auto measures = contact::measures(top.surface());
        const auto values = top.values(g);
        for (std::size_t k = 0; k < measures.size(); ++k) integral += measures[k] * values[k];
        CHECK(total(cells, &FrictionCell::bound) == doctest::Approx(integral).epsilon(1e-13));
        CHECK(total(cells, &FrictionCell::measure) == doctest::Approx(1).epsilon(1e-13));
        std::vector<double> share(top.rows.size(), 0), pulled(top.rows.size(), 0);
        for (const auto& cell : cells) {
          for (const Term& t : cell.nodes) share[t.row] += t.weight;
          for (const Term& t : cell.jumps) pulled[t.row] += t.weight * cell.bound;
        }
        for (const double s : share) CHECK(s == doctest::Approx(1).epsilon(1e-13));
        double sum = 0;
        for (const double p : pulled) sum += p;
        CHECK(sum == doctest::Approx(integral).epsilon(1e-13));
        if (dim == 3 && (size == 0 || size == 0.25)) CHECK(cells.size() == 16);
        if (dim == 3 && size == 0.5) CHECK(cells.size() == 4);
        if (size == 1) CHECK(cells.size() == 1);
      }
}

TEST_CASE("a bound that vanishes leaves no cell") {
  for (int dim : {2, 3}) {
    const Top top(dim, mesh::Family::p1, 8);
    const auto cells = contact::friction_cells(
        top.surface(), top.values([](const Point& x) { return std::max(0.0, x[0] - 0.5); }), top.all(), 0);
    CHECK(cells.size() == (dim == 2 ? 5 : 8));  // the cell about x = 1/2 reaches into the support
    for (const auto& cell : cells) CHECK(cell.bound > 0);
    CHECK(contact::friction_cells(top.surface(), std::vector<double>(top.rows.size(), 0), top.all(), 0).empty());
  }
}

TEST_CASE("normal rows with the Gram matrix: pressures and gaps of degree one are integrated exactly") {
  for (const auto family : test::kFamilies) {
    const Top top(3, family, 4);
    const auto rows = contact::gram_normal_rows(top.surface(), top.rows, top.all());
    const auto p = [](const Point& x) { return 2 + x[0] - 3 * x[1]; };
    const auto v = [](const Point& x) { return 1 - x[0] + 2 * x[1]; };
    double work = 0, area = 0;
    for (std::size_t j = 0; j < rows.size(); ++j) {
      double mean = 0;
      for (const Term& t : rows[j].jumps) mean += t.weight * v(top.mesh.point(top.rows[t.row].node));
      work += p(top.mesh.point(top.rows[j].node)) * rows[j].measure * mean;
      area += rows[j].measure;
      REQUIRE(rows[j].values.size() == 1);
    }
    CHECK(area == doctest::Approx(1).epsilon(1e-14));
    // ∫∫ (2 + x − 3y)(1 − x + 2y) = 2 − 1 + 2 + 1/2 − 1/3 + 1/2 − 3/2 + 3/4 − 2
    CHECK(work == doctest::Approx(2 - 1 + 2 + 0.5 - 1.0 / 3 + 0.5 - 1.5 + 0.75 - 2).epsilon(1e-13));
  }
}

TEST_CASE("nodes that do not move: multipliers of their own oscillate unnoticed, shared out they do not") {
  // The counts are those of the collected failure cases: kernels of multiplier spaces on an edge with clamped ends.
  for (const auto family : test::kFamilies)
    for (int n : {3, 4, 7, 16}) {
      const Top top(2, family, n);
      const auto inner = top.inner();
      const std::vector<double> one(top.rows.size(), 1);
      // Constants on the edges: the checkerboard.
      std::vector<contact::NormalRow> edges;
      for (const auto& f : top.surface().facets) {
        const auto g = contact::gram(top.mesh, f.facet);
        edges.push_back({{{f.row[0], g[0][0] + g[0][1]}, {f.row[1], g[1][0] + g[1][1]}}, {}, 1});
      }
      CHECK(kernel(edges, inner) == 1);
      const Eigen::MatrixXd B = matrix(edges, inner);
      Eigen::VectorXd checkerboard(n);
      const auto surface = top.surface();
      for (int k = 0; k < n; ++k)
        checkerboard[k] = std::lround(top.mesh.facet_centre(surface.facets[k].facet)[0] * n - 0.5) % 2 ? -1 : 1;
      CHECK((B.transpose() * checkerboard).norm() < 1e-14);
      // Hats at all nodes: λ_i = r^i, r = −2 ± √3.
      const auto hats = contact::gram_normal_rows(surface, top.rows, top.all());
      CHECK(kernel(hats, inner) == 2);
      for (const double r : {-2 + std::sqrt(3.0), -2 - std::sqrt(3.0)}) {
        Eigen::VectorXd lambda(n + 1);
        for (std::size_t k = 0; k < top.rows.size(); ++k)
          lambda[static_cast<int>(k)] = std::pow(r, std::lround(top.mesh.point(top.rows[k].node)[0] * n));
        CHECK((matrix(hats, inner).transpose() * lambda).norm() < 1e-13 * lambda.norm());
      }
      CHECK(kernel(contact::friction_cells(surface, one, top.all(), 0), inner) == 2);
      // Shared out among their neighbours.
      const auto merged = contact::gram_normal_rows(surface, top.rows, inner);
      CHECK(kernel(merged, inner) == 0);
      const auto cells = contact::friction_cells(surface, one, inner, 0);
      CHECK(cells.size() == static_cast<std::size_t>(n - 1));
      CHECK(kernel(cells, inner) == 0);
      CHECK(total(cells, &FrictionCell::bound) == doctest::Approx(1).epsilon(1e-14));
    }
}

TEST_CASE("the same in space") {
  for (const auto family : test::kFamilies) {
    const Top top(3, family, 6);
    const auto inner = top.inner();
    const std::vector<double> one(top.rows.size(), 1);
    const auto merged = contact::gram_normal_rows(top.surface(), top.rows, inner);
    CHECK(kernel(merged, inner) == 0);
    CHECK(kernel(contact::gram_normal_rows(top.surface(), top.rows, top.all()), inner) > 0);
    double area = 0;
    for (const auto& row : merged)
      if (!row.jumps.empty()) area += row.measure;
    CHECK(area == doctest::Approx(1).epsilon(family == mesh::Family::q1 ? 1e-13 : 0.02));  // a triangle in a corner has no moving node
    CHECK(kernel(contact::friction_cells(top.surface(), one, inner, 0), inner) == 0);
    CHECK(kernel(contact::friction_cells(top.surface(), one, inner, 1e-3), inner) > 0);  // one cell a facet
  }
}

TEST_CASE("a crack's tip has no jump, and its half cell goes to the neighbour") {
  Top part(2, mesh::Family::p1, 4);
  std::erase_if(part.rows, [&](const auto& row) { return part.mesh.point(row.node)[0] == 1; });
  // The right side shares the corner (1, 1).
  const auto surface =
      contact::surface(part.mesh, part.mesh.parts.at("top"), part.rows, part.mesh.parts.at("right"));
  REQUIRE(surface.facets.size() == 4);
  const std::vector<double> one(part.rows.size(), 1);
  const auto cells = contact::friction_cells(surface, one, part.all(), 0);
  CHECK(cells.size() == 4);
  CHECK(total(cells, &FrictionCell::bound) == doctest::Approx(1).epsilon(1e-14));
  // Without the shared corner the last edge overhangs, and is no contact.
  CHECK(contact::surface(part.mesh, part.mesh.parts.at("top"), part.rows, {}).facets.size() == 3);
}

TEST_CASE("pieces join into cells of the size asked for, component by component") {
  std::vector<contact::Piece> pieces;
  for (int side : {0, 1})
    for (int i = 0; i < 12; ++i)
      pieces.push_back({{i + 0.5, 0, 0}, {{1.0 * i, 0, 0}, {i + 1.0, 0, 0}}, side});
  for (double size : {1.0, 2.0, 2.5, 3.0, 5.0, 12.0, 100.0}) {
    const auto cell = contact::partition(pieces, size);
    const int per_side = static_cast<int>(std::ceil(12 / size));
    CHECK(*std::max_element(cell.begin(), cell.end()) == 2 * per_side - 1);
    for (int i = 0; i < 12; ++i) CHECK(cell[12 + i] == cell[i] + per_side);
    for (int i = 1; i < 12; ++i) CHECK((cell[i] == cell[i - 1] || cell[i] == cell[i - 1] + 1));
  }
  CHECK(contact::partition({}, 1).empty());
}

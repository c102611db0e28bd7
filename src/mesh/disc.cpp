#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/generators.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::mesh {
namespace {

using std::numbers::pi;

Mesh rings(const double center[2], double radius, int n) {
  Mesh mesh;
  mesh.element = Element::triangle_p1;
  mesh.coordinates = {center[0], center[1]};
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= n; ++ring)
    for (int k = 0; k < 6 * ring; ++k) {
      // Sectors meet at 0°, 60°, …: the lowest and highest points, where discs are put in contact,
      // lie inside a sector, where the mesh is regular and nodal pressure converges at order 2.
      const double r = radius * ring / n, angle = 2 * pi * k / (6 * ring) - pi / 3;
      mesh.coordinates.insert(mesh.coordinates.end(),
                              {center[0] + r * std::cos(angle), center[1] + r * std::sin(angle)});
    }
  for (int ring = 1; ring <= n; ++ring)
    for (int sector = 0; sector < 6; ++sector)
      for (int k = 0; k < ring; ++k) {
        const auto outer = [&](int i) { return first(ring) + (sector * ring + i) % (6 * ring); };
        const auto inner = [&](int i) {
          return ring == 1 ? 0 : first(ring - 1) + (sector * (ring - 1) + i) % (6 * (ring - 1));
        };
        mesh.cells.insert(mesh.cells.end(), {outer(k), outer(k + 1), inner(k)});
        if (ring == n) mesh.parts["boundary"].push_back({mesh.cell_count() - 1, 0});
        if (k + 1 < ring)
          mesh.cells.insert(mesh.cells.end(), {inner(k), outer(k + 1), inner(k + 1)});
      }
  return mesh;
}

/// A square core with sides bulging towards the circle, and a ring of four blocks.
Mesh core_and_ring(const double center[2], double radius, int n) {
  Mesh mesh;
  mesh.element = Element::quadrilateral_q1;
  const int layers = (n + 1) / 2, around = 4 * n;
  const double half = 0.5 * radius / std::numbers::sqrt2 * 1.2;  // the core's half side
  // Bulge of 0.3 of the way from the square's side to its circumscribed circle keeps corner angles near 110°.
  const auto core_point = [&](double s, double t) -> std::array<double, 2> {
    const double x = half * s, y = half * t;
    const double side = std::max(std::abs(x), std::abs(y)), r = std::hypot(x, y);
    const double scale = r > 0 ? 0.7 + 0.3 * side * std::numbers::sqrt2 / r : 1.0;
    return {x * scale, y * scale};
  };
  const auto add = [&](const std::array<double, 2>& p) {
    mesh.coordinates.insert(mesh.coordinates.end(), {center[0] + p[0], center[1] + p[1]});
  };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) add(core_point(2.0 * i / n - 1, 2.0 * j / n - 1));
  const auto core = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      mesh.cells.insert(mesh.cells.end(), {core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)});
  // Core nodes around its rim, counter-clockwise from the lower left corner (angle 5π/4).
  std::vector<int> rim;
  for (int i = 0; i < n; ++i) rim.push_back(core(i, 0));
  for (int j = 0; j < n; ++j) rim.push_back(core(n, j));
  for (int i = 0; i < n; ++i) rim.push_back(core(n - i, n));
  for (int j = 0; j < n; ++j) rim.push_back(core(0, n - j));
  const int ring_first = mesh.node_count();
  for (int layer = 1; layer <= layers; ++layer)
    for (int k = 0; k < around; ++k) {
      const double angle = 5 * pi / 4 + 2 * pi * k / around, w = static_cast<double>(layer) / layers;
      const double inner[2] = {mesh.node(rim[k])[0] - center[0], mesh.node(rim[k])[1] - center[1]};
      add({(1 - w) * inner[0] + w * radius * std::cos(angle), (1 - w) * inner[1] + w * radius * std::sin(angle)});
    }
  const auto at = [&](int layer, int k) {
    return layer == 0 ? rim[k % around] : ring_first + (layer - 1) * around + k % around;
  };
  for (int layer = 0; layer < layers; ++layer)
    for (int k = 0; k < around; ++k) {
      mesh.cells.insert(mesh.cells.end(), {at(layer, k), at(layer + 1, k), at(layer + 1, k + 1), at(layer, k + 1)});
      if (layer + 1 == layers) mesh.parts["boundary"].push_back({mesh.cell_count() - 1, 1});
    }
  return mesh;
}

/// Puts the outer edges' nodes on the circle; a quadrilateral's centre follows by half (transfinite interpolation).
void bend(Mesh& mesh, const double center[2], double radius) {
  const ElementTopology& t = mesh.topology();
  for (const Facet f : mesh.parts.at("boundary")) {
    double* x = &mesh.coordinates[2 * static_cast<std::size_t>(mesh.facet_node(f, 2))];
    const double dx = x[0] - center[0], dy = x[1] - center[1], outwards = radius / std::hypot(dx, dy) - 1;
    x[0] += outwards * dx, x[1] += outwards * dy;
    if (t.corners == 3) continue;
    double* middle = &mesh.coordinates[2 * static_cast<std::size_t>(mesh.cell(f.cell)[t.nodes - 1])];
    middle[0] += outwards * dx / 2, middle[1] += outwards * dy / 2;
  }
}

}  // namespace

Mesh disc(const double center[2], double radius, int cells, Family family) {
  if (cells < 1) throw InputError(text("cells is ", cells, "; it must be at least 1"));
  if (!(radius > 0) || !std::isfinite(radius))
    throw InputError(text("radius is ", radius, "; it must be positive"));
  Mesh mesh = of_family(simplices(family) ? rings(center, radius, cells) : core_and_ring(center, radius, cells), family);
  if (mesh.topology().order == 2) bend(mesh, center, radius);
  return mesh;
}

}  // namespace dotyk::mesh

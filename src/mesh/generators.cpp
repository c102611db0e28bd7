#include "mesh/generators.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::mesh {
namespace {

using std::numbers::pi;

/// How a box of the grid is made of cells: the corners of each as bits, bit k set at the upper end of axis k, in the order of the cell's
/// nodes. Simplices are Kuhn's: the corners of each lie on a path along the axes from corner 0 to the last one. They are listed in an order that makes each
/// cell positive. With this order cut_at_nodes() cuts a grid into the grid of half the step.
using Corners = std::vector<std::vector<int>>;

const Corners& corners_of(int dimension, bool simplices) {
  static const Corners triangles{{0, 1, 3}, {0, 3, 2}}, quadrilateral{{0, 1, 3, 2}},
      tetrahedra{{0, 1, 3, 7}, {0, 7, 5, 1}, {0, 7, 3, 2}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 7, 6, 4}}, hexahedron{{0, 1, 3, 2, 4, 5, 7, 6}};
  if (dimension == 2) return simplices ? triangles : quadrilateral;
  return simplices ? tetrahedra : hexahedron;
}

/// Part names by axis and end.
constexpr const char* kPlaneParts[2][2] = {{"left", "right"}, {"bottom", "top"}};
constexpr const char* kSpaceParts[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};

/// Names the facets of the last cell that lie on a side of the grid; `bits` of its nodes, `at`: which box it is in.
void name_facets(Mesh& mesh, const std::vector<int>& bits, const int at[3], const int* cells) {
  const ElementTopology& t = mesh.topology();
  for (int l = 0; l < t.facets; ++l)
    for (int axis = 0; axis < t.dimension; ++axis)
      for (int end = 0; end < 2; ++end) {
        if (at[axis] != (end ? cells[axis] - 1 : 0)) continue;
        bool on = true;
        for (int k = 0; k < t.nodes_per_facet && on; ++k) on = ((bits[t.facet_nodes[l][k]] >> axis) & 1) == end;
        if (on) mesh.parts[(t.dimension == 2 ? kPlaneParts : kSpaceParts)[axis][end]].push_back({mesh.cell_count() - 1, l});
      }
}

/// The grid of every second tick; null where an axis has an odd number of cells. A node between its nodes is the mean of all corners of the edge, face or
/// box that it lies in. For simplices two of them would do, but with all of them multigrid takes a third fewer iterations.
std::shared_ptr<const Coarser> every_second(int dimension, const int cells[3]) {
  if (std::any_of(cells, cells + dimension, [](int n) { return n % 2 != 0; })) return nullptr;
  int half[3] = {0, 0, 0}, nodes[3] = {1, 1, 1}, stride[3] = {1, 1, 1};
  for (int i = 0; i < dimension; ++i) half[i] = cells[i] / 2, nodes[i] = cells[i] + 1;
  for (int i = 1; i < 3; ++i) stride[i] = stride[i - 1] * (half[i - 1] + 1);
  auto coarser = std::make_shared<Coarser>();
  coarser->means = Buckets(nodes[0] * nodes[1] * nodes[2], [&](auto&& put) {
    int node = 0;
    for (int k = 0; k < nodes[2]; ++k)
      for (int j = 0; j < nodes[1]; ++j)
        for (int i = 0; i < nodes[0]; ++i, ++node) {
          const int least = i / 2 + j / 2 * stride[1] + k / 2 * stride[2], odd = i % 2 + 2 * (j % 2) + 4 * (k % 2);
          for (int corner = 0; corner < 8; ++corner)
            if ((corner & odd) == corner)
              put(node, least + (corner & 1) + (corner >> 1 & 1) * stride[1] + (corner >> 2) * stride[2]);
        }
  });
  coarser->node_count = stride[2] * (half[2] + 1);
  coarser->next = every_second(dimension, half);
  return coarser;
}

/// Boxes between ticks of each axis, two or three, cut into cells.
Mesh grid(int dimension, const double* from, const double* to, const int* cells, Family family, const Grading* grading) {
  constexpr const char* kAxis[] = {"x", "y", "z"};
  const bool simplex = simplices(family);
  Mesh mesh;
  mesh.element = dimension == 2 ? (simplex ? Element::triangle_p1 : Element::quadrilateral_q1) : simplex ? Element::tetrahedron_p1 : Element::hexahedron_q1;
  std::vector<double> tick[3] = {{}, {}, {0}};
  int count[3] = {1, 1, 1}, stride[3] = {1, 1, 1};
  for (int i = 0; i < dimension; ++i) {
    tick[i] = ticks(from[i], to[i], cells[i], grading[i], kAxis[i]);
    count[i] = cells[i];
    for (int k = i + 1; k < 3; ++k) stride[k] *= cells[i] + 1;
  }
  const std::vector<std::vector<int>>& corners = corners_of(dimension, simplex);
  mesh.coordinates.reserve(tick[0].size() * std::max<std::size_t>(tick[1].size(), 1) * tick[2].size() * dimension);
  mesh.cells.reserve(static_cast<std::size_t>(count[0]) * count[1] * count[2] * corners.size() * corners[0].size());
  for (const double z : tick[2])
    for (const double y : tick[1])
      for (const double x : tick[0]) {
        const double place[3] = {x, y, z};
        mesh.coordinates.insert(mesh.coordinates.end(), place, place + dimension);
      }
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i)
        for (const std::vector<int>& bits : corners) {
          const int at[3] = {i, j, k};
          for (const int corner : bits) {
            int node = 0;
            for (int axis = 0; axis < dimension; ++axis) node += (at[axis] + ((corner >> axis) & 1)) * stride[axis];
            mesh.cells.push_back(node);
          }
          name_facets(mesh, bits, at, cells);
        }
  mesh.coarser = every_second(dimension, cells);
  mesh.generated = {mesh.coordinates.size(), mesh.cells.size()};
  return of_family(std::move(mesh), family);
}

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

std::vector<double> ticks(double a, double b, int n, const Grading& grading, const char* axis) {
  if (n < 1) throw InputError(text("cells along ", axis, " is ", n, "; it must be at least 1"));
  if (!(b > a))
    throw InputError(text("'to' must exceed 'from' along ", axis, " (from ", a, " to ", b, ")"));
  if (!std::isfinite(b - a))
    throw InputError(text("the extent along ", axis, ", from ", a, " to ", b, ", is beyond the range of numbers; choose another unit of length"));
  std::vector<double> t(n + 1);
  double before = -INFINITY;
  for (int i = 0; i <= n; ++i) {
    double s = static_cast<double>(i) / n;
    if (grading) s = grading(s);
    t[i] = i == 0 && !grading ? a : i == n && !grading ? b : a + (b - a) * s;
    if (!std::isfinite(t[i]) || !(s > before))
      throw InputError(text("grading.", axis, " must increase and be finite; at s = ",
                            static_cast<double>(i) / n, " it gives ", s));
    if (i > 0 && !(t[i] > t[i - 1]))
      throw InputError(text("the ", n, " cells along ", axis, ", from ", a, ", are so narrow that their nodes coincide in rounding; ",
                            "take fewer cells, or move them nearer to the origin"));
    before = s;
  }
  if (grading && (std::abs(t[0] - a) > 1e-9 * (b - a) || std::abs(t[n] - b) > 1e-9 * (b - a)))
    throw InputError(text("grading.", axis, " must map 0 to 0 and 1 to 1; it gives ",
                          (t[0] - a) / (b - a), " and ", (t[n] - a) / (b - a)));
  t[0] = a;
  t[n] = b;
  return t;
}

Mesh rectangle(const double from[2], const double to[2], const int cells[2], Family family, const Grading grading[2]) {
  return grid(2, from, to, cells, family, grading);
}

Mesh box(const double from[3], const double to[3], const int cells[3], Family family, const Grading grading[3]) {
  return grid(3, from, to, cells, family, grading);
}

Mesh disc(const double center[2], double radius, int cells, Family family) {
  if (cells < 1) throw InputError(text("cells is ", cells, "; it must be at least 1"));
  if (!(radius > 0) || !std::isfinite(radius))
    throw InputError(text("radius is ", radius, "; it must be positive"));
  Mesh mesh = of_family(simplices(family) ? rings(center, radius, cells) : core_and_ring(center, radius, cells), family);
  if (mesh.topology().order == 2) bend(mesh, center, radius);
  return mesh;
}

}  // namespace dotyk::mesh

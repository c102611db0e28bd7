#include "elasticity/refined.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "base/text.hpp"
#include "elasticity/kernel.hpp"
#include "mesh/second_order.hpp"
#include "mesh/submesh.hpp"

namespace dotyk::elasticity {
namespace {

/// Moves the nodes between corners of the pieces of a mesh of order 2 to where its cells map them.
template <class E>
void place_between(const mesh::Mesh& whole, mesh::Mesh& pieces) {
  const mesh::ElementTopology& t = whole.topology();
  const int each = pieces.cell_count() / whole.cell_count();
  for (int c = 0; c < pieces.cell_count(); ++c) {
    const int *parent = whole.cell(c / each), *piece = pieces.cell(c);
    double x[E::nodes][E::dim];
    cell_coordinates<E>(whole, c / each, x);
    for (std::size_t k = 0; k < t.between.size(); ++k) {
      std::array<double, E::dim> xi{};
      for (const int corner : t.between[k]) {
        const auto at = E::node(static_cast<int>(std::find(parent, parent + E::nodes, piece[corner]) - parent));
        for (int i = 0; i < E::dim; ++i) xi[i] += at[i] / static_cast<double>(t.between[k].size());
      }
      const auto shape = E::shape(xi);
      double* node = &pieces.coordinates[static_cast<std::size_t>(piece[t.corners + k]) * E::dim];
      for (int i = 0; i < E::dim; ++i) {
        node[i] = 0;
        for (int a = 0; a < E::nodes; ++a) node[i] += shape[a] * x[a][i];
      }
    }
  }
}

}  // namespace

mesh::Mesh refined(const mesh::Mesh& mesh, Monitor* watch) {
  const auto go_on = [&] { if (watch) watch->check(); };
  mesh::Mesh second = mesh::second_order(mesh, watch);
  go_on();
  mesh::Mesh cut = mesh::cut_at_nodes(std::move(second));
  if (mesh.topology().order == 1) return cut;
  go_on();
  mesh::Mesh pieces = mesh::second_order(std::move(cut), watch);
  go_on();
  dispatch(mesh.element, [&]<class E>() {
    if constexpr (E::order == 2) place_between<E>(mesh, pieces);
  });
  return pieces;
}

namespace {

/// How many corners, edges, faces and cells a mesh has. A plane mesh has no faces here.
struct Counts {
  double corners = 0, edges = 0, faces = 0, cells = 0;
  bool plane = true, simplex = true;

  /// Corners once the cells are cut; nodes of order 2.
  double next_corners() const { return corners + edges + (simplex ? 0 : faces + cells); }
  Counts next() const {
    Counts n = *this;
    n.corners = next_corners();
    if (plane) n.edges = 2 * edges + (simplex ? 3 : 4) * cells, n.cells = 4 * cells;
    else if (simplex) n.edges = 2 * edges + 3 * faces + cells, n.faces = 4 * faces + 8 * cells, n.cells = 8 * cells;
    else n.edges = 2 * edges + 4 * faces + 6 * cells, n.faces = 4 * faces + 12 * cells, n.cells = 8 * cells;
    return n;
  }
};

/// `second`: how many nodes the mesh has as one of order 2.
Counts counts(const mesh::Mesh& mesh, int second, std::size_t boundary) {
  const mesh::ElementTopology& t = mesh.topology();
  Counts n{0, 0, 0, static_cast<double>(mesh.cell_count()), t.dimension == 2, t.corners == t.dimension + 1};
  std::vector<char> corner(static_cast<std::size_t>(mesh.node_count()), 0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < t.corners; ++k) corner[mesh.cell(c)[k]] = 1;
  n.corners = static_cast<double>(std::ranges::count(corner, 1));
  if (!n.plane) n.faces = (t.facets * n.cells + static_cast<double>(boundary)) / 2;
  n.edges = second - n.corners - (n.simplex ? 0 : n.faces + n.cells);
  return n;
}

/// The cells at flagged nodes, and the nodes of these cells flagged as well.
std::vector<int> cells_at(const mesh::Mesh& mesh, std::vector<char>& flagged) {
  const int per_cell = mesh::nodes_of(mesh.element);
  std::vector<int> cells;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (std::any_of(mesh.cell(c), mesh.cell(c) + per_cell, [&](int node) { return flagged[node] != 0; })) cells.push_back(c);
  for (const int c : cells)
    for (int k = 0; k < per_cell; ++k) flagged[mesh.cell(c)[k]] = 1;
  return cells;
}

/// These cells with their facets of parts, and the coarser mesh of `from`.
mesh::Submesh some_cells(const mesh::Mesh& from, std::vector<int> cells) {
  std::vector<int> place(static_cast<std::size_t>(from.cell_count()), -1);
  for (std::size_t k = 0; k < cells.size(); ++k) place[cells[k]] = static_cast<int>(k);
  mesh::Submesh some = mesh::submesh(from, std::move(cells));
  for (const auto& [name, facets] : from.parts)
    for (const mesh::Facet f : facets)
      if (place[f.cell] >= 0) some.mesh.parts[name].push_back({place[f.cell], f.local});
  const auto means = [&](auto&& put) {
    for (std::size_t i = 0; i < some.node.size(); ++i)
      for (const int p : from.coarser->means[some.node[i]]) put(static_cast<int>(i), p);
  };
  some.mesh.coarser = std::make_shared<mesh::Coarser>(mesh::Coarser{Buckets(static_cast<int>(some.node.size()), means), from.coarser->node_count, from.coarser->next});
  return some;
}

}  // namespace

mesh::Mesh refined_near_boundary(const mesh::Mesh& mesh, int times, std::vector<int>& parent, Monitor* watch) {
  const std::string boundary(1, '\0');  // a part of the mesh while it is refined
  auto whole = std::make_shared<mesh::Whole>();
  whole->nodes = mesh::coarser_nodes(mesh);
  whole->nodes.insert(whole->nodes.begin(), mesh.node_count());
  mesh::Mesh now = mesh;
  now.parts[boundary] = mesh::boundary(mesh);
  parent.resize(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(parent.begin(), parent.end(), 0);
  Counts count;
  for (int k = 0; k < times; ++k) {
    mesh::Mesh finer = refined(now, watch);
    if (k == 0) count = counts(mesh, mesh.topology().order == 2 ? mesh.node_count() : finer.node_count(), now.parts[boundary].size());
    count = count.next();
    const double nodes = mesh.topology().order == 2 ? count.next_corners() : count.corners;
    if (nodes * mesh.dimension() > std::numeric_limits<int>::max())
      throw InputError(text("refined ", times, times == 1 ? " time" : " times", " the mesh would have some ", nodes, " nodes; at most ",
                            std::numeric_limits<int>::max() / mesh.dimension(), " can be numbered"));
    whole->nodes.insert(whole->nodes.begin(), static_cast<int>(nodes));
    std::vector<char> near(static_cast<std::size_t>(finer.node_count()), 0);
    for (const mesh::Facet f : finer.parts[boundary])
      for (int a = 0; a < finer.topology().nodes_per_facet; ++a) near[finer.facet_node(f, a)] = 1;
    cells_at(finer, near);
    mesh::Submesh layers = some_cells(finer, cells_at(finer, near));
    const int each = finer.cell_count() / now.cell_count();
    std::vector<int> of_layers;
    for (const int c : layers.cell) of_layers.push_back(parent[c / each]);
    parent.swap(of_layers), now = std::move(layers.mesh);
  }
  whole->cells = count.cells;
  whole->boundary = std::move(now.parts[boundary]);
  std::ranges::sort(whole->boundary);
  now.parts.erase(boundary);
  now.whole = std::move(whole);
  now.generated = {now.coordinates.size(), now.cells.size()};
  return now;
}

}  // namespace dotyk::elasticity

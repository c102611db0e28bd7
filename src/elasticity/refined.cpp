#include "elasticity/refined.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "base/memory.hpp"
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

double refining_bytes(const mesh::Mesh& mesh) {
  const double pieces = mesh.dimension() == 2 ? 4 : 8;
  return 2 * pieces * (4.0 * static_cast<double>(mesh.cells.size()) + 8.0 * static_cast<double>(mesh.coordinates.size()));
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

/// Edges between corners.
double edges(const mesh::Mesh& mesh) {
  const mesh::ElementTopology& t = mesh::topology(mesh::second_order(mesh.element));
  const Buckets ends(mesh.node_count(), [&](auto&& put) {
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (const std::vector<int>& corners : t.between)
        if (corners.size() == 2) {
          const auto [low, high] = std::minmax(mesh.cell(c)[corners[0]], mesh.cell(c)[corners[1]]);
          put(low, high);
        }
  });
  double count = 0;
  std::vector<int> of_node;
  for (int i = 0; i < ends.count(); ++i) {
    of_node.assign(ends[i].begin(), ends[i].end());
    std::ranges::sort(of_node);
    count += static_cast<double>(std::ranges::unique(of_node).begin() - of_node.begin());
  }
  return count;
}

Counts counts(const mesh::Mesh& mesh, std::size_t boundary) {
  const mesh::ElementTopology& t = mesh.topology();
  Counts n{0, edges(mesh), 0, static_cast<double>(mesh.cell_count()), t.dimension == 2, t.corners == t.dimension + 1};
  std::vector<char> corner(static_cast<std::size_t>(mesh.node_count()), 0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < t.corners; ++k) corner[mesh.cell(c)[k]] = 1;
  n.corners = static_cast<double>(std::ranges::count(corner, 1));
  if (!n.plane) n.faces = (t.facets * n.cells + static_cast<double>(boundary)) / 2;
  return n;
}

/// Flags the nodes of cells that have a flagged node.
void widen(const mesh::Mesh& mesh, std::vector<char>& flagged) {
  const int per_cell = mesh::nodes_of(mesh.element);
  const std::vector<char> before = flagged;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (std::any_of(mesh.cell(c), mesh.cell(c) + per_cell, [&](int node) { return before[node] != 0; }))
      for (int k = 0; k < per_cell; ++k) flagged[mesh.cell(c)[k]] = 1;
}

/// Two layers of cells at these facets, with all facets of parts that they have.
mesh::Submesh two_layers(const mesh::Mesh& from, const std::vector<mesh::Facet>& at) {
  const int per_cell = mesh::nodes_of(from.element);
  std::vector<char> near(static_cast<std::size_t>(from.node_count()), 0);
  for (const mesh::Facet f : at)
    for (int a = 0; a < from.topology().nodes_per_facet; ++a) near[from.facet_node(f, a)] = 1;
  widen(from, near);
  std::vector<int> cells, place(static_cast<std::size_t>(from.cell_count()), -1);
  for (int c = 0; c < from.cell_count(); ++c)
    if (std::any_of(from.cell(c), from.cell(c) + per_cell, [&](int node) { return near[node] != 0; })) place[c] = static_cast<int>(cells.size()), cells.push_back(c);
  mesh::Submesh layers = mesh::submesh(from, std::move(cells));
  for (const auto& [name, facets] : from.parts)
    for (const mesh::Facet f : facets)
      if (place[f.cell] >= 0) layers.mesh.parts[name].push_back({place[f.cell], f.local});
  return layers;
}

/// Node i, of a mesh that refines some cells of another, as the mean of that mesh's nodes. `of_cells` has them by the nodes of these cells, `node` of each of these the other mesh's.
std::shared_ptr<const mesh::Coarser> coarser_of(const mesh::Submesh& layers, const mesh::Coarser& of_cells, const std::vector<int>& node, int node_count,
                                                std::shared_ptr<const mesh::Coarser> next) {
  const auto means = [&](auto&& put) {
    for (std::size_t i = 0; i < layers.node.size(); ++i)
      for (const int p : of_cells.means[layers.node[i]]) put(static_cast<int>(i), node[p]);
  };
  return std::make_shared<mesh::Coarser>(mesh::Coarser{Buckets(static_cast<int>(layers.node.size()), means), node_count, std::move(next)});
}

}  // namespace

mesh::Mesh refined_near_boundary(const mesh::Mesh& mesh, int times, std::vector<int>& parent, Monitor* watch) {
  const std::string boundary(1, '\0');  // a part of the mesh while it is refined
  auto whole = std::make_shared<mesh::Whole>();
  whole->nodes = mesh::coarser_nodes(mesh);
  whole->nodes.insert(whole->nodes.begin(), mesh.node_count());
  const std::vector<mesh::Facet> outside = mesh::boundary(mesh);
  Counts count = counts(mesh, outside.size());

  mesh::Mesh with_boundary = mesh;
  with_boundary.parts[boundary] = outside;
  mesh::Submesh now = two_layers(with_boundary, outside);  // all that lies near the boundary on finer meshes is in these
  with_boundary = {};
  parent = now.cell;
  std::vector<int> node = std::move(now.node);
  int node_count = mesh.node_count();
  std::shared_ptr<const mesh::Coarser> coarser = mesh.coarser;
  for (int k = 0; k < times; ++k) {
    count = count.next();
    const double nodes = mesh.topology().order == 2 ? count.next_corners() : count.corners;
    if (nodes * mesh.dimension() > std::numeric_limits<int>::max())
      throw InputError(text("refined ", times, times == 1 ? " time" : " times", " the mesh would have some ", nodes, " nodes; at most ",
                            std::numeric_limits<int>::max() / mesh.dimension(), " can be numbered"));
    whole->nodes.insert(whole->nodes.begin(), static_cast<int>(nodes));
    require_memory(refining_bytes(now.mesh), "the boundary of the refined mesh");
    mesh::Mesh finer = refined(now.mesh, watch);
    mesh::Submesh layers = two_layers(finer, finer.parts[boundary]);
    layers.mesh.coarser = coarser_of(layers, *finer.coarser, node, node_count, coarser);
    const int each = finer.cell_count() / now.mesh.cell_count();
    std::vector<int> of_layers;
    for (const int c : layers.cell) of_layers.push_back(parent[c / each]);
    parent.swap(of_layers), now = std::move(layers);
    node_count = now.mesh.node_count(), coarser = now.mesh.coarser;
    node.resize(static_cast<std::size_t>(node_count));
    std::iota(node.begin(), node.end(), 0);
  }
  whole->cells = static_cast<std::int64_t>(count.cells);
  whole->boundary = std::move(now.mesh.parts[boundary]);
  std::ranges::sort(whole->boundary);
  now.mesh.parts.erase(boundary);
  now.mesh.whole = std::move(whole);
  now.mesh.generated = {now.mesh.coordinates.size(), now.mesh.cells.size()};
  return std::move(now.mesh);
}

}  // namespace dotyk::elasticity

#include "elasticity/refined.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "base/memory.hpp"
#include "elasticity/kernel.hpp"
#include "mesh/second_order.hpp"
#include "mesh/decomposition.hpp"

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
  Counts n{0, edges(mesh), 0, static_cast<double>(mesh.cell_count()), t.dimension == 2, t.simplex()};
  std::vector<char> corner(static_cast<std::size_t>(mesh.node_count()), 0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < t.corners; ++k) corner[mesh.cell(c)[k]] = 1;
  n.corners = static_cast<double>(std::ranges::count(corner, 1));
  if (!n.plane) n.faces = (t.facets * n.cells + static_cast<double>(boundary)) / 2;
  return n;
}

/// Two layers of cells at the boundary, whose facets are `outside`, as a part of the mesh.
mesh::Submesh two_layers(const mesh::Mesh& from, const std::vector<mesh::Facet>& outside) {
  std::vector<char> near = mesh::flag_nodes(from, outside);
  for (const int c : mesh::cells_at(from, near)) std::for_each_n(from.cell(c), mesh::nodes_of(from.element), [&](int node) { near[node] = 1; });
  mesh::Submesh layers = mesh::submesh(from, mesh::cells_at(from, near));
  std::vector<int> place(static_cast<std::size_t>(from.cell_count()), -1);
  for (std::size_t k = 0; k < layers.cell.size(); ++k) place[layers.cell[k]] = static_cast<int>(k);
  const auto placed = [&](std::vector<mesh::Facet> facets) {
    for (mesh::Facet& f : facets) f.cell = place[f.cell];
    std::erase_if(facets, [](mesh::Facet f) { return f.cell < 0; });
    return facets;
  };
  for (const auto& [name, facets] : from.parts) layers.mesh.parts[name] = placed(facets);
  layers.mesh.whole = std::make_shared<mesh::Whole>(mesh::Whole{placed(outside), {}});
  return layers;
}

/// What the layers of a finer mesh refine: a mesh of `node_count` nodes. `means`: of all nodes of the finer mesh, by the nodes of the cells that were cut; `node`: which
/// node of the coarser mesh each of these is.
std::shared_ptr<const mesh::Coarser> coarser_of(const mesh::Submesh& layers, const Buckets& means, const std::vector<int>& node, int node_count,
                                                std::shared_ptr<const mesh::Coarser> next) {
  const auto put_all = [&](auto&& put) {
    for (std::size_t i = 0; i < layers.node.size(); ++i)
      for (const int p : means[layers.node[i]]) put(static_cast<int>(i), node[p]);
  };
  return std::make_shared<mesh::Coarser>(mesh::Coarser{Buckets(static_cast<int>(layers.node.size()), put_all), node_count, std::move(next)});
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

NearBoundary refined_near_boundary(const mesh::Mesh& mesh, int times, Monitor* watch) {
  std::vector<int> nodes = mesh::coarser_nodes(mesh);  // of whole meshes
  nodes.insert(nodes.begin(), mesh.node_count());
  const std::vector<mesh::Facet> outside = mesh::boundary(mesh);
  Counts count = counts(mesh, outside.size());
  mesh::Submesh now = two_layers(mesh, outside);  // all that lies near the boundary on finer meshes is in these
  std::vector<int> parent = now.cell;
  std::vector<std::vector<double>> between;
  std::vector<int> node = now.node;
  int node_count = mesh.node_count();
  std::shared_ptr<const mesh::Coarser> coarser = mesh.coarser;
  for (int k = 0; k < times; ++k) {
    count = count.next();
    const double all = mesh.topology().order == 2 ? count.next_corners() : count.corners;
    if (all * mesh.dimension() > std::numeric_limits<int>::max())
      throw InputError(text("refined ", times, times == 1 ? " time" : " times", " the mesh would have some ", all, " nodes; at most ",
                            std::numeric_limits<int>::max() / mesh.dimension(), " can be numbered"));
    nodes.insert(nodes.begin(), static_cast<int>(all));
    require_memory(refining_bytes(now.mesh), "the boundary of the refined mesh");
    const mesh::Mesh finer = refined(now.mesh, watch);
    const int each = finer.cell_count() / now.mesh.cell_count();
    if (k > 0) between.insert(between.begin(), std::move(now.mesh.coordinates));
    now = two_layers(finer, mesh::boundary(finer));
    coarser = now.mesh.coarser = coarser_of(now, finer.coarser->means, node, node_count, coarser);
    std::vector<int> of_layers;
    for (const int c : now.cell) of_layers.push_back(parent[c / each]);
    parent.swap(of_layers);
    node_count = now.mesh.node_count();
    node.resize(static_cast<std::size_t>(node_count));
    std::iota(node.begin(), node.end(), 0);
  }
  now.mesh.whole = std::make_shared<mesh::Whole>(mesh::Whole{mesh::boundary(now.mesh), std::move(nodes), static_cast<std::int64_t>(count.cells)});
  now.mesh.generated = {now.mesh.coordinates.size(), now.mesh.cells.size()};
  return {std::move(now.mesh), std::move(parent), std::move(between)};
}

std::vector<algebra::CoarseFunctions> coarse_functions(const mesh::Mesh& mesh, SharedList<int> unknown, int unknowns, int levels) {
  const int d = mesh.dimension();
  std::vector<algebra::CoarseFunctions> all;
  std::shared_ptr<const mesh::Coarser> coarser = mesh.coarser;
  for (int level = 0; level < levels; ++level) {
    algebra::CoarseFunctions functions{d, coarser ? std::shared_ptr<const Buckets>(coarser, &coarser->means) : nullptr, unknown, {}, unknowns, 0};
    const int coarse = coarser ? coarser->node_count : functions.nodes();
    std::vector<int> column(static_cast<std::size_t>(d) * coarse);
    std::iota(column.begin(), column.end(), 0);
    for (int node = 0; node < functions.nodes(); ++node)
      if (const int p = functions.same(node); p >= 0)
        for (int k = 0; k < d; ++k)
          if (functions.row[d * node + k] < 0) column[d * p + k] = -1;
    unknown = functions.column = std::move(column);
    unknowns = functions.columns = d * coarse;
    all.push_back(std::move(functions));
    if (coarser) coarser = coarser->next;
  }
  return all;
}

}  // namespace dotyk::elasticity

#include "mesh/decomposition.hpp"

#include <metis.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>

#include "base/error.hpp"

namespace dotyk::mesh {
namespace {

/// The least member of the set that c is in; `set` points towards it.
int least_member(std::vector<int>& set, int c) {
  while (set[c] != c) c = set[c] = set[set[c]];
  return c;
}

/// Parts of cells in connected pieces. `neighbour`: cell × facets, see facet_neighbours().
Pieces connected(const std::vector<int>& neighbour, const std::vector<int>& part) {
  const int cells = static_cast<int>(part.size());
  std::vector<int> set(cells);
  std::iota(set.begin(), set.end(), 0);
  const std::size_t facets = cells ? neighbour.size() / cells : 0;
  for (std::size_t k = 0; k < neighbour.size(); ++k) {
    const int c = static_cast<int>(k / facets), n = neighbour[k];
    if (n < 0 || part[n] != part[c]) continue;
    const int a = least_member(set, c), b = least_member(set, n);
    set[std::max(a, b)] = std::min(a, b);
  }
  Pieces result;
  result.of_cell.resize(cells);
  for (int c = 0; c < cells; ++c) {  // its least member has been numbered before it
    const int least = least_member(set, c);
    result.of_cell[c] = least == c ? result.count++ : result.of_cell[least];
  }
  return result;
}

/// The graph of `members` (ascending) that share a facet, in compressed rows; symmetric.
struct Graph {
  std::vector<idx_t> start, adjacent;
};

Graph graph_of(const std::vector<int>& members, const std::vector<int>& neighbour, std::size_t facets,
               const std::vector<int>& rank) {
  const auto sides = [&](int c) { return neighbour.begin() + static_cast<std::ptrdiff_t>(c) * static_cast<std::ptrdiff_t>(facets); };
  const auto visit = [&](auto&& edge) {
    for (const int c : members)
      for (std::size_t l = 0; l < facets; ++l) {
        const int n = sides(c)[l];
        if (n < 0) continue;
        edge(rank[c], rank[n]);
        // Of three cells at one facet, one is not named by its neighbour.
        if (std::find(sides(n), sides(n + 1), c) == sides(n + 1)) edge(rank[n], rank[c]);
      }
  };
  const Buckets neighbours(static_cast<int>(members.size()), visit);
  Graph graph{{0}, {}};
  for (std::size_t k = 0; k < members.size(); ++k) {
    const auto own = neighbours[static_cast<int>(k)];
    graph.adjacent.insert(graph.adjacent.end(), own.begin(), own.end());
    graph.start.push_back(static_cast<idx_t>(graph.adjacent.size()));
  }
  return graph;
}

/// METIS's k-way partition of a connected graph.
std::vector<idx_t> partition(Graph graph, int count) {
  idx_t vertices = static_cast<idx_t>(graph.start.size()) - 1, constraints = 1, parts = count, cut = 0;
  std::vector<idx_t> part(vertices, 0);
  if (count == 1) return part;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_CONTIG] = 1;
  if (METIS_PartGraphKway(&vertices, &constraints, graph.start.data(), graph.adjacent.data(), nullptr, nullptr, nullptr,
                          &parts, nullptr, nullptr, options, &cut, part.data()) != METIS_OK)
    throw std::runtime_error("METIS could not cut the mesh into subdomains");
  return part;
}

/// Gives the nodes of the cells, numbered as in a mesh of so many nodes, numbers of their own.
void number_nodes(int nodes_of_whole, Submesh& piece) {
  std::vector<int>& cells = piece.mesh.cells;
  constexpr std::size_t kLarge = 16;  // a piece of more than such a part of the mesh: to look at all nodes is faster than to sort its own
  if (kLarge * cells.size() < static_cast<std::size_t>(nodes_of_whole)) {
    piece.node = cells;
    std::sort(piece.node.begin(), piece.node.end());
    piece.node.erase(std::unique(piece.node.begin(), piece.node.end()), piece.node.end());
    for (int& n : cells) n = static_cast<int>(std::lower_bound(piece.node.begin(), piece.node.end(), n) - piece.node.begin());
    return;
  }
  std::vector<int> number(static_cast<std::size_t>(nodes_of_whole), -1);
  for (const int n : cells) number[n] = 0;
  for (int n = 0; n < nodes_of_whole; ++n)
    if (number[n] == 0) number[n] = static_cast<int>(piece.node.size()), piece.node.push_back(n);
  for (int& n : cells) n = number[n];
}

}  // namespace

std::vector<std::vector<int>> Pieces::cells() const {
  std::vector<std::vector<int>> result(count);
  for (std::size_t c = 0; c < of_cell.size(); ++c) result[of_cell[c]].push_back(static_cast<int>(c));
  return result;
}

Pieces pieces_of(const Mesh& mesh) {
  return connected(facet_neighbours(mesh), std::vector<int>(mesh.cell_count(), 0));
}

Pieces decompose(const Mesh& mesh, int count) {
  const std::vector<int> neighbour = facet_neighbours(mesh);
  const std::size_t facets = mesh.topology().facets;
  const auto bodies = connected(neighbour, std::vector<int>(mesh.cell_count(), 0)).cells();
  std::vector<int> sizes, rank(mesh.cell_count());
  for (const auto& members : bodies) {
    sizes.push_back(static_cast<int>(members.size()));
    for (std::size_t k = 0; k < members.size(); ++k) rank[members[k]] = static_cast<int>(k);
  }
  const std::vector<int> shares = share_out(count, sizes);
  std::vector<int> part(mesh.cell_count());
  int first = 0;
  for (std::size_t b = 0; b < bodies.size(); first += shares[b++]) {
    const auto of = partition(graph_of(bodies[b], neighbour, facets, rank), shares[b]);
    for (std::size_t k = 0; k < of.size(); ++k) part[bodies[b][k]] = first + static_cast<int>(of[k]);
  }
  return connected(neighbour, part);
}

Pieces decompose(const Mesh& mesh, const std::array<int, 3>& boxes) {
  std::vector<int> part(mesh.cell_count());
  std::map<std::array<int, 3>, int> used;
  const Box whole = mesh.box();
  for (int c = 0; c < mesh.cell_count(); ++c) {
    std::array<int, 3> box{};
    for (int i = 0; i < mesh.dimension(); ++i) {
      // A centre on the plane between two boxes, up to rounding, is above it.
      const double at = (mesh.cell_centre(c)[i] - whole.low[i]) * (boxes[i] / whole.extent(i)) + 1e-9;
      box[i] = static_cast<int>(std::min(at, boxes[i] - 1.0));
    }
    part[c] = used.try_emplace(box, static_cast<int>(used.size())).first->second;
  }
  return connected(facet_neighbours(mesh), part);
}

std::vector<int> share_out(int count, const std::vector<int>& cells) {
  std::vector<int> share(cells.size(), 1);
  using Entry = std::pair<double, int>;  // cells in a piece, minus the body: of equals the first
  std::priority_queue<Entry> next;
  for (std::size_t b = 0; b < cells.size(); ++b) next.push({cells[b], -static_cast<int>(b)});
  for (int left = count - static_cast<int>(cells.size()); left > 0 && !next.empty(); --left) {
    const int b = -next.top().second;
    if (next.top().first <= 1) break;
    next.pop();
    ++share[b];
    next.push({static_cast<double>(cells[b]) / share[b], -b});
  }
  return share;
}

Submesh submesh(const Mesh& whole, std::vector<int> cells) {
  Submesh piece;
  piece.mesh.element = whole.element;
  const int per_cell = whole.topology().nodes, dim = whole.dimension();
  piece.mesh.cells.reserve(cells.size() * per_cell);
  for (const int c : cells) piece.mesh.cells.insert(piece.mesh.cells.end(), whole.cell(c), whole.cell(c) + per_cell);
  number_nodes(whole.node_count(), piece);
  piece.mesh.coordinates.reserve(piece.node.size() * dim);
  for (const int n : piece.node)
    piece.mesh.coordinates.insert(piece.mesh.coordinates.end(), whole.node(n), whole.node(n) + dim);
  piece.cell = std::move(cells);
  return piece;
}

std::vector<Mesh> split(const Mesh& whole) {
  const Pieces pieces = pieces_of(whole);
  std::vector<Mesh> result;
  std::vector<int> place(whole.cell_count());
  for (const std::vector<int>& cells : pieces.cells()) {
    for (std::size_t k = 0; k < cells.size(); ++k) place[cells[k]] = static_cast<int>(k);
    result.push_back(submesh(whole, cells).mesh);
  }
  for (const auto& [name, facets] : whole.parts)
    for (const Facet f : facets) result[pieces.of_cell[f.cell]].parts[name].push_back({place[f.cell], f.local});
  return result;
}

Mesh keep(const Mesh& mesh, const std::function<bool(const Point&)>& chosen, const std::string& new_part) {
  std::vector<int> cells, own(mesh.cell_count(), -1);
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (chosen(mesh.cell_centre(c))) {
      own[c] = static_cast<int>(cells.size());
      cells.push_back(c);
    }
  if (cells.empty()) throw InputError(text("no cell is kept: the function is false at the centre of each of the ", mesh.cell_count()));
  Submesh sub = submesh(mesh, std::move(cells));
  Mesh& kept = sub.mesh;
  for (const auto& [name, facets] : mesh.parts) {
    std::vector<Facet> left;
    for (const Facet f : facets)
      if (own[f.cell] >= 0) left.push_back({own[f.cell], f.local});
    if (!left.empty()) kept.parts[name] = std::move(left);
  }
  std::vector<Facet> old;
  for (const Facet f : boundary(mesh))
    if (own[f.cell] >= 0) old.push_back({own[f.cell], f.local});
  std::vector<Facet>& bare = kept.parts[new_part];
  for (const Facet f : boundary(kept))
    if (!std::binary_search(old.begin(), old.end(), f)) bare.push_back(f);
  if (bare.empty()) kept.parts.erase(new_part);
  return std::move(kept);
}

}  // namespace dotyk::mesh

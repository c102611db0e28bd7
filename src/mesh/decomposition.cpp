#include "mesh/decomposition.hpp"

#include <metis.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>

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

}  // namespace dotyk::mesh

#include "contact/multipliers.hpp"

#include <map>
#include <numeric>
#include <set>

#include "elasticity/load.hpp"

namespace dotyk::contact {

using mesh::Facet;
using mesh::Mesh;

Surface surface(const Mesh& mesh, const std::vector<Facet>& facets, const std::vector<ContactRow>& rows,
                const std::vector<Facet>& second) {
  const int corners = mesh.topology().facet_corners;
  std::vector<SurfaceFacet> all;
  for (const Facet f : facets) all.push_back({f, corners, {-1, -1, -1, -1}});
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const int k : rows[r].facets)
      for (int c = 0; c < corners; ++c)
        if (mesh.facet_node(facets[k], c) == rows[r].node) all[k].row[c] = static_cast<int>(r);
  std::vector<char> shared(mesh.node_count(), 0);
  for (const Facet f : second)
    for (int c = 0; c < corners; ++c) shared[mesh.facet_node(f, c)] = 1;
  std::erase_if(all, [&](const SurfaceFacet& f) {
    int touching = 0;
    for (int c = 0; c < corners; ++c) {
      if (f.row[c] < 0 && !shared[mesh.facet_node(f.facet, c)]) return true;
      touching += f.row[c] >= 0;
    }
    return touching == 0;
  });
  return {mesh, std::move(all), static_cast<int>(rows.size())};
}

Gram gram(const Mesh& mesh, Facet facet) {
  Gram g{};
  elasticity::for_each_facet_point(mesh, facet, [&](const elasticity::FacetPoint& p) {
    for (int a = 0; a < p.nodes; ++a)
      for (int b = 0; b < p.nodes; ++b) g[a][b] += p.measure * p.shape[a] * p.shape[b];
  });
  return g;
}

std::vector<double> measures(const Surface& surface) {
  std::vector<double> sum(surface.rows, 0);
  for (const SurfaceFacet& f : surface.facets)
    elasticity::for_each_facet_point(surface.mesh, f.facet, [&](const elasticity::FacetPoint& p) {
      for (int a = 0; a < f.corners; ++a)
        if (f.row[a] >= 0) sum[f.row[a]] += p.measure * p.shape[a];
    });
  return sum;
}

std::vector<int> components(const Surface& surface) {
  std::vector<int> parent(surface.rows);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int r) {
    while (parent[r] != r) r = parent[r] = parent[parent[r]];
    return r;
  };
  std::vector<char> touched(surface.rows, 0);
  for (const SurfaceFacet& f : surface.facets) {
    int first = -1;
    for (int a = 0; a < f.corners; ++a) {
      if (f.row[a] < 0) continue;
      touched[f.row[a]] = 1;
      if (first < 0)
        first = root(f.row[a]);
      else
        parent[root(f.row[a])] = first;
    }
  }
  std::vector<int> component(surface.rows, -1);
  for (int r = 0; r < surface.rows; ++r)
    if (touched[r]) component[r] = root(r);
  return component;
}

std::vector<NormalRow> nodal_normal_rows(const std::vector<ContactRow>& rows) {
  std::vector<NormalRow> result;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const int row = static_cast<int>(k);
    result.push_back({{{row, 1}}, {{row, 1}}, rows[k].weight});
  }
  return result;
}

namespace {

/// The Gram matrix of the hats, row by row; and ∫φ of each, with what crack tips take of it.
struct Hats {
  std::vector<std::map<int, double>> gram;
  std::vector<double> measure;
  std::vector<std::set<int>> neighbours;
};

Hats hats(const Surface& surface) {
  Hats h{std::vector<std::map<int, double>>(surface.rows), measures(surface),
         std::vector<std::set<int>>(surface.rows)};
  for (const SurfaceFacet& f : surface.facets) {
    const Gram local = gram(surface.mesh, f.facet);
    for (int a = 0; a < f.corners; ++a)
      for (int b = 0; b < f.corners; ++b) {
        if (f.row[a] < 0 || f.row[b] < 0) continue;
        h.gram[f.row[a]][f.row[b]] += local[a][b];
        if (a != b) h.neighbours[f.row[a]].insert(f.row[b]);
      }
  }
  return h;
}

}  // namespace

std::vector<NormalRow> gram_normal_rows(const Surface& surface, const std::vector<ContactRow>& rows,
                                        const std::vector<char>& moves) {
  const Hats h = hats(surface);
  std::vector<NormalRow> result = nodal_normal_rows(rows);
  for (int j = 0; j < surface.rows; ++j)
    if (h.measure[j] > 0) result[j].values = moves[j] ? std::vector<Term>{{j, 1}} : std::vector<Term>{};
  for (int j = 0; j < surface.rows; ++j) {
    if (h.measure[j] == 0 || moves[j]) continue;
    std::vector<int> takers;
    for (const int k : h.neighbours[j])
      if (moves[k]) takers.push_back(k);
    for (const int k : takers) result[k].values.push_back({j, 1.0 / static_cast<double>(takers.size())});
  }
  for (int j = 0; j < surface.rows; ++j) {
    if (h.measure[j] == 0) continue;
    std::map<int, double> jumps;
    NormalRow& row = result[j];
    row.measure = 0;
    for (const Term& value : row.values) {
      row.measure += value.weight * h.measure[value.row];
      for (const auto& [k, g] : h.gram[value.row]) jumps[k] += value.weight * g;
    }
    row.jumps.clear();
    for (const auto& [k, weight] : jumps) row.jumps.push_back({k, weight / row.measure});
  }
  return result;
}

}  // namespace dotyk::contact

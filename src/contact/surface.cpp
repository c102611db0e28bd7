#include "contact/surface.hpp"

#include <numeric>

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

}  // namespace dotyk::contact

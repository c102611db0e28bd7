#include <map>
#include <set>

#include "contact/multipliers.hpp"

namespace dotyk::contact {

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

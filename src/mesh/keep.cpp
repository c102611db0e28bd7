#include <algorithm>
#include <tuple>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/mesh.hpp"
#include "mesh/submesh.hpp"

namespace dotyk::mesh {
namespace {

bool before(Facet a, Facet b) { return std::tie(a.cell, a.local) < std::tie(b.cell, b.local); }

}  // namespace

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
    if (!std::binary_search(old.begin(), old.end(), f, before)) bare.push_back(f);
  if (bare.empty()) kept.parts.erase(new_part);
  return std::move(kept);
}

}  // namespace dotyk::mesh

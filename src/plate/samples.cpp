#include "plate/samples.hpp"

#include <map>

#include "base/error.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;
using problem::LawChoice;

LawChoice law_at(const LawField& law, const std::string& part, const Vector2d& x) {
  const LawChoice at = law(x[0], x[1]);
  try {
    require_valid(at);
  } catch (const InputError& error) {
    throw InputError(text("edge '", part, "' at (", x[0], ", ", x[1], "): ", error.what()));
  }
  if (at->breaks) throw InputError(text("edge '", part, "': supports of plates do not break; capped_elastic yields instead"));
  return at;
}

std::vector<Sample> samples(const Plate& plate, const Space& space, bool rotation) {
  const bool morley = space.element == Element::morley;
  std::vector<Sample> out;
  for (int support = 0; support < static_cast<int>(plate.edges.size()); ++support) {
    const EdgeSupport& on = plate.edges[support];
    const LawField& law = rotation ? on.rotation : on.deflection;
    if (!law) continue;
    std::map<std::pair<int, int>, std::size_t> seen;  // samples of vertices; where two edges act on slopes of their own, by edge
    for (const mesh::Facet f : on.facets) {
      const int e = space.edges.of_cell[f.cell][f.local];
      const Edge& edge = space.edges.edges[e];
      if (rotation)
        out.push_back({support, false, e, {e, -1}, false, edge.length * (morley ? 1 : 2. / 3), edge.middle, law_at(law, on.part, edge.middle)});
      if (rotation && morley) continue;
      for (const int node : edge.node) {
        const bool along_node = rotation && space.boundary[node].smooth;
        const double share = edge.length / (rotation ? 6 : 2);
        const auto [place, fresh] = seen.emplace(std::pair(node, rotation && !along_node ? e : -1), out.size());
        if (fresh) {
          const Vector2d x = node_position(*space.mesh, node);
          out.push_back({support, true, node, {e, -1}, along_node, share, x, law_at(law, on.part, x)});
        } else {
          out[place->second].share += share;
          out[place->second].edges[1] = e;
        }
      }
    }
  }
  return out;
}

Functional deflection(const Space& space, const Sample& sample) {
  if (space.element == Element::morley) return space.deflection_of_vertex(sample.place);
  Functional out;
  for (const int edge : sample.edges)
    if (edge >= 0)
      for (Term term : space.mean_deflection(edge, sample.place)) out.push_back({term.freedom, term.factor / sample.share});
  return out;
}

Vector2d slope_direction(const Space& space, const Sample& sample) {
  return sample.along_node ? space.boundary[sample.place].normal : space.edges.edges[sample.edges[0]].normal;
}

Functional rotation(const Space& space, const Sample& sample) {
  if (!sample.at_vertex) return space.slope_of_edge(sample.place);
  return space.slope_of_vertex(sample.place, slope_direction(space, sample));
}

}  // namespace dotyk::plate

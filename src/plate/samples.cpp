#include "plate/samples.hpp"

#include <map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "plate/element/edges.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;
using problem::SupportLaw;

namespace {

int edge_of(const Space& space, const mesh::Facet& facet) { return space.edges.of_cell[facet.cell][facet.local]; }

}  // namespace

SupportLaw law_at(const LawField& law, const std::string& part, const Vector2d& x) {
  const SupportLaw at = law(x[0], x[1]);
  try {
    require_valid(at);
  } catch (const InputError& error) {
    throw InputError(text("edge '", part, "' at (", x[0], ", ", x[1], "): ", error.what()));
  }
  if (at.kind == SupportLaw::Kind::breaking) throw InputError(text("edge '", part, "': supports of plates do not break; capped_elastic yields instead"));
  return at;
}

namespace {

/// Samples of one support, those of a vertex together where `same` says so.
class SampleCollector {
 public:
  SampleCollector(const Space& space, const std::string& part, const LawField& law, int support, std::vector<Sample>& out)
      : space_(space), part_(part), law_(law), support_(support), out_(out) {}

  void middle(int edge, double share) {
    const Vector2d x = space_.edges.edges[edge].middle;
    out_.push_back({support_, false, edge, {edge, -1}, false, share, x, law_at(law_, part_, x)});
  }
  /// `apart`: of this edge alone.
  void vertex(int node, int edge, double share, bool apart, bool along_node) {
    const auto [place, fresh] = seen_.emplace(std::pair(node, apart ? edge : -1), out_.size());
    if (fresh) {
      const Vector2d x = node_position(*space_.mesh, node);
      out_.push_back({support_, true, node, {edge, -1}, along_node, share, x, law_at(law_, part_, x)});
    } else {
      out_[place->second].share += share;
      out_[place->second].edges[1] = edge;
    }
  }

 private:
  const Space& space_;
  const std::string& part_;
  const LawField& law_;
  int support_;
  std::vector<Sample>& out_;
  std::map<std::pair<int, int>, std::size_t> seen_;
};

}  // namespace

std::vector<Sample> deflection_samples(const Plate& plate, const Space& space) {
  std::vector<Sample> out;
  for (std::size_t s = 0; s < plate.edges.size(); ++s) {
    if (!plate.edges[s].deflection) continue;
    SampleCollector collect(space, plate.edges[s].part, plate.edges[s].deflection, static_cast<int>(s), out);
    for (const mesh::Facet f : plate.edges[s].facets) {
      const int e = edge_of(space, f);
      for (const int node : space.edges.edges[e].node) collect.vertex(node, e, space.edges.edges[e].length / 2, false, false);
    }
  }
  return out;
}

std::vector<Sample> rotation_samples(const Plate& plate, const Space& space) {
  std::vector<Sample> out;
  const bool morley = space.element == Element::morley;
  for (std::size_t s = 0; s < plate.edges.size(); ++s) {
    if (!plate.edges[s].rotation) continue;
    SampleCollector collect(space, plate.edges[s].part, plate.edges[s].rotation, static_cast<int>(s), out);
    for (const mesh::Facet f : plate.edges[s].facets) {
      const int e = edge_of(space, f);
      const Edge& edge = space.edges.edges[e];
      collect.middle(e, edge.length * (morley ? 1 : 2. / 3));
      if (morley) continue;
      for (const int node : edge.node) {
        const bool smooth = space.boundary[node].smooth;
        collect.vertex(node, e, edge.length / 6, !smooth, smooth);
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

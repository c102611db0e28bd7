#include <algorithm>
#include <cmath>

#include "contact/across.hpp"
#include "contact/second_facets.hpp"

namespace dotyk::contact {

std::vector<Across> node_to_segment(const Face& first, const Face& second, const std::vector<NodeSide>& sides) {
  constexpr double kRim = 1e-6;  // of a facet's width: a node on the rim is inside
  const SecondFacets all(second);
  const int dim = first.mesh.dimension();
  std::vector<Across> result(sides.size());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const View view(first.mesh.point(sides[k].node), sides[k].normal, dim);
    double nearest = INFINITY, furthest = 0, widest = 0;
    all.for_each_near(view, 0, [&](int f, double width) {
      const Shadow shadow(second.mesh, second.facets[f], view);
      if (!shadow.holds({0, 0}, kRim)) return;
      const double distance = std::abs(shadow.height_at({0, 0}));
      furthest = std::max(furthest, distance), widest = std::max(widest, width);
      if (distance >= nearest) return;
      nearest = distance;
      const auto shape = shadow.shape({0, 0});
      result[k] = {{}, sides[k].weight, width};
      for (int a = 0; a < shadow.nodes; ++a)
        if (std::abs(shape[a]) > 1e-14) result[k].partners.push_back({second.mesh.facet_node(second.facets[f], a), shape[a]});
    });
    result[k].folded = furthest > nearest + 0.1 * widest;
  }
  return result;
}

}  // namespace dotyk::contact

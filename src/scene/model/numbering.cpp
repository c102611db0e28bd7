#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/statement/body.hpp"

namespace dotyk::scene {

elasticity::Numbering number(const Body& body) {
  const int dim = body.dimension();
  std::vector<char> fixed(body.mesh->coordinates.size(), 0);
  std::vector<double> value(fixed.size(), 0.0);
  std::vector<const Support*> by(fixed.size(), nullptr);
  double largest = 0;
  for (const Support& s : body.supports)
    for (const mesh::Point& v : s.values)
      for (int i = 0; i < dim; ++i) largest = std::max(largest, std::abs(v[i]));
  for (const Support& s : body.supports)
    for (std::size_t k = 0; k < s.nodes.size(); ++k)
      for (int i = 0; i < dim; ++i) {
        if (!s.components[k][i]) continue;
        const std::size_t at = static_cast<std::size_t>(s.nodes[k]) * dim + i;
        if (fixed[at] && std::abs(value[at] - s.values[k][i]) > 1e-12 * largest)
          throw InputError(text("contradictory supports on '", body.name, "': at the node ",
                                point_text(body.mesh->node(s.nodes[k]), dim), " part '", by[at]->part.name,
                                "' prescribes u", "xyz"[i], " = ", value[at], " and part '", s.part.name,
                                "' prescribes ", s.values[k][i]));
        fixed[at] = 1;
        value[at] = s.values[k][i];
        by[at] = &s;
      }
  return elasticity::number(*body.mesh, fixed, std::move(value));
}

}  // namespace dotyk::scene

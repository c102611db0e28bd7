#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/sides.hpp"
#include "scene/statement/body.hpp"

namespace dotyk::scene {
namespace {

/// A support of all the part's nodes, nothing prescribed yet.
Support on_nodes(const Part& part, SupportKind kind) {
  Support support{kind, part.mark(), {}, {}, {}, {}, {}, part.facets};
  for (const contact::NodeSide& n : contact::nodes(*part.body->mesh, part.facets)) {
    support.nodes.push_back(n.node);
    support.normals.push_back(n.normal);
  }
  return support;
}

/// The last support up to `s` that prescribes component i at a node, `s` itself where it names the node twice.
const Support& last_before(const Body& body, const Support& s, int node, int i) {
  const Support* last = &s;
  for (const Support* other = body.supports.data(); other != &s; ++other)
    for (std::size_t k = 0; k < other->nodes.size(); ++k)
      if (other->nodes[k] == node && other->components[k][i]) last = other;
  return *last;
}

}  // namespace

elasticity::Numbering number(const Body& body) {
  const int dim = body.dimension();
  std::vector<char> fixed(body.mesh->coordinates.size(), 0);
  double largest = 0;
  for (const Support& s : body.supports)
    for (const mesh::Point& v : s.values)
      for (int i = 0; i < dim; ++i) largest = std::max(largest, std::abs(v[i]));
  std::vector<double> value(largest > 0 ? fixed.size() : 0, 0.0);
  for (const Support& s : body.supports)
    for (std::size_t k = 0; k < s.nodes.size(); ++k)
      for (int i = 0; i < dim; ++i) {
        if (!s.components[k][i]) continue;
        const std::size_t at = static_cast<std::size_t>(s.nodes[k]) * dim + i;
        if (largest > 0 && fixed[at] && std::abs(value[at] - s.values[k][i]) > 1e-12 * largest)
          throw InputError(text("contradictory supports on '", body.name, "': at the node ",
                                point_text(body.mesh->node(s.nodes[k]), dim), " part '", last_before(body, s, s.nodes[k], i).part.name,
                                "' prescribes u", "xyz"[i], " = ", value[at], " and part '", s.part.name,
                                "' prescribes ", s.values[k][i]));
        fixed[at] = 1;
        if (largest > 0) value[at] = s.values[k][i];
      }
  return elasticity::number(*body.mesh, fixed, std::move(value));
}

void hold(Body& body, const std::function<void(Body&)>& change) {
  Body changed = body;
  change(changed);
  require_laws_free(changed, number(changed));
  body = std::move(changed);
}

void fix(Part& part, const std::array<bool, 3>& components) {
  Support support = on_nodes(part, SupportKind::fix);
  support.components.assign(support.nodes.size(), components);
  support.values.assign(support.nodes.size(), {0, 0, 0});
  hold(*part.body, [&](Body& body) { body.supports.push_back(std::move(support)); });
}

void slide(Part& part) {
  Support support{SupportKind::slide, part.mark(), {}, {}, {}, {}, {}, part.facets};
  const auto facets = std::make_shared<const std::vector<mesh::Facet>>(part.facets);
  std::vector<SlideRow> oblique;
  for (const contact::NodeSide& side : contact::sides(*part.body->mesh, part.facets)) {
    std::array<bool, 3> along{false, false, false};
    bool axis = false;
    for (int i = 0; i < part.body->dimension(); ++i) {
      along[i] = std::abs(std::abs(side.normal[i]) - 1) < kAlongAxis;
      axis = axis || along[i];
    }
    if (axis) {
      support.nodes.push_back(side.node);
      support.components.push_back(along);
      support.values.push_back({0, 0, 0});
      support.normals.push_back(side.normal);
    } else {
      oblique.push_back({support.part, side.node, side.normal, facets});
    }
  }
  hold(*part.body, [&](Body& body) {
    if (!support.nodes.empty()) body.supports.push_back(std::move(support));
    body.slides.insert(body.slides.end(), oblique.begin(), oblique.end());
  });
}

void displace(Part& part, const std::array<elasticity::ScalarField, 3>& components, const std::string& load_case) {
  Support support = on_nodes(part, SupportKind::displace);
  support.load_case = load_case;
  std::array<bool, 3> given;
  for (int i = 0; i < 3; ++i) given[i] = static_cast<bool>(components[i]);
  support.components.assign(support.nodes.size(), given);
  for (int n : support.nodes) {
    mesh::Point value{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      if (given[i]) value[i] = components[i](part.body->mesh->point(n));
    support.values.push_back(value);
  }
  hold(*part.body, [&](Body& body) { body.supports.push_back(std::move(support)); });
}

}  // namespace dotyk::scene

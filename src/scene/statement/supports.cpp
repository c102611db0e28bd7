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

/// Takes the support, or leaves the body as it was where the support contradicts another.
void hold(Body& body, Support support) {
  body.supports.push_back(std::move(support));
  try {
    require_laws_free(body, number(body));
  } catch (...) {
    body.supports.pop_back();
    throw;
  }
}

}  // namespace

void fix(Part& part, const std::array<bool, 3>& components) {
  Support support = on_nodes(part, SupportKind::fix);
  support.components.assign(support.nodes.size(), components);
  support.values.assign(support.nodes.size(), {0, 0, 0});
  hold(*part.body, std::move(support));
}

void slide(Part& part) {
  Body& body = *part.body;
  Support support{SupportKind::slide, part.mark(), {}, {}, {}, {}, {}, part.facets};
  const auto facets = std::make_shared<const std::vector<mesh::Facet>>(part.facets);
  std::vector<SlideRow> oblique;
  for (const contact::NodeSide& side : contact::sides(*body.mesh, part.facets)) {
    std::array<bool, 3> along{false, false, false};
    bool axis = false;
    for (int i = 0; i < body.dimension(); ++i) {
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
  if (!support.nodes.empty()) hold(body, std::move(support));
  const std::size_t before = body.slides.size();
  body.slides.insert(body.slides.end(), oblique.begin(), oblique.end());
  try {
    require_laws_free(body, number(body));
  } catch (...) {
    body.slides.resize(before);
    throw;
  }
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
  hold(*part.body, std::move(support));
}

}  // namespace dotyk::scene

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/sides.hpp"
#include "scene/body.hpp"

namespace dotyk::scene {
namespace {

/// A normal closer than this to an axis is taken as along it: the component is then eliminated.
constexpr double kAlongAxis = 1e-9;

std::vector<int> nodes_of(const Part& part) {
  std::vector<int> nodes;
  for (const mesh::Facet f : part.facets)
    for (int k = 0; k < part.body->mesh->topology().nodes_per_facet; ++k)
      nodes.push_back(part.body->mesh->facet_node(f, k));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void fix(Part& part, const std::array<bool, 3>& components) {
  Support support{SupportKind::fix, part.name, nodes_of(part), {}, {}};
  support.components.assign(support.nodes.size(), components);
  support.values.assign(support.nodes.size(), {0, 0, 0});
  part.body->supports.push_back(std::move(support));
}

void slide(Part& part) {
  Body& body = *part.body;
  Support support{SupportKind::slide, part.name, {}, {}, {}};
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
    } else {
      body.slides.push_back({part.name, side.node, side.normal});
    }
  }
  if (!support.nodes.empty()) body.supports.push_back(std::move(support));
}

void displace(Part& part, const std::array<elasticity::ScalarField, 3>& components) {
  Support support{SupportKind::displace, part.name, nodes_of(part), {}, {}};
  std::array<bool, 3> given;
  for (int i = 0; i < 3; ++i) given[i] = static_cast<bool>(components[i]);
  support.components.assign(support.nodes.size(), given);
  for (int n : support.nodes) {
    mesh::Point value{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      if (given[i]) value[i] = components[i](part.body->mesh->point(n));
    support.values.push_back(value);
  }
  part.body->supports.push_back(std::move(support));
}

}  // namespace dotyk::scene

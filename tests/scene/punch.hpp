#pragma once

#include <memory>

#include "mesh/generators.hpp"
#include "scene/result/solution.hpp"
#include "solver/active/pdas.hpp"

// Scenes S2 and S3 of the reference values: a rigid parabola pressed into a block.

namespace punch {

using namespace dotyk;

struct Punch {
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
  scene::Part bottom;
};

inline Punch make(std::shared_ptr<const mesh::Mesh> mesh, const elasticity::ScalarField& gap,
                  mesh::Point normal) {
  const int dim = mesh->dimension();
  auto body = scene::make_body(
      "block", mesh,
      elasticity::MaterialField(elasticity::isotropic(1000, 0.3, dim, elasticity::Plane::strain)), {});
  Punch p;
  p.bottom = scene::named_part(body, "bottom");
  scene::fix(p.bottom, {true, true, true});
  p.scene = scene::make_scene({body});
  p.contact = scene::add_contact(*p.scene, scene::named_part(body, "top"),
                                 contact::RigidGap{normal, gap}, {}, false);
  return p;
}

inline Punch plane(int n, mesh::Family family = mesh::Family::p1) {
  const double from[2] = {-1, -1}, to[2] = {1, 0};
  const int cells[2] = {n, n / 2};
  const mesh::Grading even[2];
  return make(std::make_shared<mesh::Mesh>(mesh::rectangle(from, to, cells, family, even)),
              [](const mesh::Point& x) { return x[0] * x[0] / 4 - 0.02; }, {0, 1, 0});
}

inline Punch space(int n, mesh::Family family = mesh::Family::p1) {
  const double from[3] = {0, 0, 0}, to[3] = {1, 1, 1};
  const int cells[3] = {n, n, n};
  const mesh::Grading even[3];
  return make(std::make_shared<mesh::Mesh>(mesh::box(from, to, cells, family, even)),
              [](const mesh::Point& x) {
                return ((x[0] - .5) * (x[0] - .5) + (x[1] - .5) * (x[1] - .5)) / 2 - 0.02;
              },
              {0, 0, 1});
}

}  // namespace punch

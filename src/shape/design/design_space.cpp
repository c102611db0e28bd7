#include "shape/design/design_space.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/model/moved.hpp"
#include "shape/derivative/boundary_motion.hpp"

namespace dotyk::shape {
namespace {

void require_velocities(const scene::Scene& scene, const Velocities& V, std::size_t variable) {
  const auto fail = [&](const auto&... why) { throw InputError(text("design variable ", variable + 1, " ", why...)); };
  if (V.size() != scene.bodies.size()) fail("has velocities of ", V.size(), " bodies; the scene has ", scene.bodies.size());
  bool moves = false;
  for (std::size_t b = 0; b < V.size(); ++b) {
    const scene::Body& body = *scene.bodies[b];
    if (!V[b].empty() && V[b].size() != body.mesh->coordinates.size())
      fail("has ", V[b].size(), " velocity components of '", body.name, "', which has ", body.mesh->coordinates.size(), " coordinates");
    for (const double v : V[b]) {
      if (!std::isfinite(v)) fail("moves a node of '", body.name, "' with the velocity ", v);
      moves = moves || v != 0;
    }
  }
  if (!moves) fail("moves nothing");
}

}  // namespace

DesignSpace::DesignSpace(std::shared_ptr<const scene::Scene> scene, std::vector<Velocities> variables)
    : scene_(std::move(scene)), variables_(std::move(variables)) {
  for (const auto& body : scene_->bodies) require_first_order(*body);
  if (variables_.empty()) throw InputError("a design needs variables: parts that move");
  for (std::size_t i = 0; i < variables_.size(); ++i) require_velocities(*scene_, variables_[i], i);
}

Velocities DesignSpace::along(const algebra::Vector& beta) const {
  Velocities sum(scene_->bodies.size());
  for (std::size_t i = 0; i < variables_.size(); ++i)
    for (std::size_t b = 0; b < sum.size(); ++b) {
      const std::vector<double>& V = variables_[i][b];
      if (!V.empty() && sum[b].empty()) sum[b].assign(V.size(), 0.0);
      for (std::size_t k = 0; k < V.size(); ++k) sum[b][k] += beta[static_cast<Eigen::Index>(i)] * V[k];
    }
  return sum;
}

std::shared_ptr<scene::Scene> DesignSpace::at(const algebra::Vector& alpha) const {
  Velocities points = along(alpha);
  for (std::size_t b = 0; b < points.size(); ++b) {
    const std::vector<double>& rest = scene_->bodies[b]->mesh->coordinates;
    for (std::size_t k = 0; k < points[b].size(); ++k) points[b][k] += rest[k];
  }
  return scene::moved(*scene_, points);
}

}  // namespace dotyk::shape

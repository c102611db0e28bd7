#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/body.hpp"

namespace dotyk::scene {
namespace {

using elasticity::FacetPoint;
using mesh::Point;

/// The nodal loads of a case, made where there are none yet.
std::vector<double>& nodal_loads(Body& body, const std::string& load_case) {
  if (load_case.empty()) return body.force;
  for (LoadCase& known : body.cases)
    if (known.name == load_case) return known.force;
  body.cases.push_back({load_case, std::vector<double>(body.force.size(), 0.0)});
  return body.cases.back().force;
}

/// Adds the traction (a function of the facet point) to the nodal loads and keeps its mean for drawing.
template <class Traction>
void add(Part& part, const std::string& load_case, Traction&& traction) {
  Body& body = *part.body;
  const int dim = body.dimension();
  std::vector<double> force(body.force.size(), 0.0);  // the fields may throw: change nothing before all are known
  std::vector<LoadArrow> arrows;
  const PartMark mark = part.mark();
  for (const mesh::Facet f : part.facets) {
    LoadArrow arrow{mark, body.mesh->facet_centre(f), {0, 0, 0}, load_case, f};
    double area = 0;
    elasticity::add_traction(*body.mesh, {f}, [&](const FacetPoint& p) {
      const Point t = traction(p);
      area += p.measure;
      for (int i = 0; i < dim; ++i) arrow.value[i] += p.measure * t[i];
      return t;
    }, force);
    for (double& v : arrow.value) v /= area;
    arrows.push_back(arrow);
  }
  std::vector<double>& total = nodal_loads(body, load_case);
  for (std::size_t k = 0; k < force.size(); ++k) total[k] += force[k];
  body.arrows.insert(body.arrows.end(), arrows.begin(), arrows.end());
}

}  // namespace

void load(Part& part, const elasticity::VectorField& traction, const std::string& load_case) {
  add(part, load_case, [&](const FacetPoint& p) { return traction(p.x); });
}

void pressure(Part& part, const elasticity::ScalarField& value, const std::string& load_case) {
  add(part, load_case, [&](const FacetPoint& p) {
    const double v = value(p.x);
    return Point{-v * p.normal[0], -v * p.normal[1], -v * p.normal[2]};
  });
}

void spring(Part& part, const std::array<elasticity::ScalarField, 3>& stiffness) {
  std::vector<SpringPatch> patches;
  const PartMark mark = part.mark();
  for (const mesh::Facet f : part.facets) {
    SpringPatch patch{mark, {f, {}}};
    elasticity::for_each_facet_point(*part.body->mesh, f, [&](const FacetPoint& p) {
      std::array<double, 3> k{0, 0, 0};
      for (int i = 0; i < 3; ++i) {
        if (stiffness[i]) k[i] = stiffness[i](p.x);
        if (!(k[i] >= 0) || !std::isfinite(k[i]))
          throw InputError(text("stiffness is ", k[i], " at ", point_text(p.x.data(), part.body->dimension()),
                                "; a spring's stiffness must be zero or positive"));
      }
      patch.spring.stiffness.push_back(k);
    });
    patches.push_back(std::move(patch));
  }
  part.body->springs.insert(part.body->springs.end(), patches.begin(), patches.end());
}

}  // namespace dotyk::scene

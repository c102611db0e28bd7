#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "scene/statement/body.hpp"

namespace dotyk::scene {
namespace {

using elasticity::FacetPoint;
using mesh::Point;

int values_per_point(const FacetLoad& load, int dimension) { return load.pressure ? 1 : dimension; }

void add_nodal(Body& body, const FacetLoad& load) {
  std::vector<double>& total = nodal_loads(body, load.load_case);
  for (std::size_t k = 0; k < load.facets.size(); ++k)
    elasticity::add_traction(*body.mesh, {load.facets[k]}, [&](const FacetPoint& p) { return load.traction(k, p, body.dimension()); }, total);
}

/// Takes a load whose values at a facet point `add_values` appends; it may throw, and then the body is as it was.
template <class AddValues>
void add(Part& part, const std::string& load_case, bool pressure, AddValues&& add_values) {
  Body& body = *part.body;
  FacetLoad load{part.mark(), load_case, pressure, part.facets, {}};
  load.values.reserve(part.facets.size() * elasticity::facet_points(*body.mesh) * values_per_point(load, body.dimension()));
  for (const mesh::Facet f : part.facets)
    elasticity::for_each_facet_point(*body.mesh, f, [&](const FacetPoint& p) { add_values(p, load.values); });
  add_nodal(body, load);
  body.facet_loads.push_back(std::move(load));
}

void add_volume_forces(const Body& body, std::vector<double>& nodal) {
  elasticity::add_body_force(*body.mesh, [&](const elasticity::CellPoint& p) { return body.volume_load->at(p.cell, p.index, body.dimension()); }, nodal);
}

}  // namespace

std::vector<double>& nodal_loads(Body& body, const std::string& load_case) {
  const auto made = [&](std::vector<double>& force) -> std::vector<double>& {
    if (force.empty()) force.assign(body.mesh->coordinates.size(), 0.0);
    return force;
  };
  if (load_case.empty()) return made(body.force);
  for (LoadCase& known : body.cases)
    if (known.name == load_case) return made(known.force);
  body.cases.push_back({load_case, {}});
  return made(body.cases.back().force);
}

Point FacetLoad::traction(std::size_t facet, const FacetPoint& p, int dimension) const {
  if (pressure) return mesh::times(-pressure_at(facet, p), p.normal);
  Point t{0, 0, 0};
  const std::size_t points = values.size() / facets.size() / dimension;
  for (int i = 0; i < dimension; ++i) t[i] = values[(facet * points + p.index) * dimension + i];
  return t;
}

double FacetLoad::pressure_at(std::size_t facet, const FacetPoint& p) const {
  return values[facet * (values.size() / facets.size()) + p.index];
}

Point VolumeLoad::at(int cell, int point, int dimension) const {
  Point f{0, 0, 0};
  const std::size_t first = uniform ? 0 : (static_cast<std::size_t>(cell) * points + point) * dimension;
  for (int i = 0; i < dimension; ++i) f[i] = factor * (*values)[first + i];
  return f;
}

void load(Part& part, const elasticity::VectorField& traction, const std::string& load_case) {
  const int dim = part.body->dimension();
  add(part, load_case, false, [&](const FacetPoint& p, std::vector<double>& values) {
    const Point t = traction(p.x);
    values.insert(values.end(), t.begin(), t.begin() + dim);
  });
}

void pressure(Part& part, const elasticity::ScalarField& value, const std::string& load_case) {
  add(part, load_case, true, [&](const FacetPoint& p, std::vector<double>& values) { values.push_back(value(p.x)); });
}

void load_volume(Body& body, const elasticity::CellField& force) {
  const std::size_t dim = body.dimension();
  VolumeLoad load{elasticity::cell_points(*body.mesh), true, nullptr, 1};
  std::vector<double> values;  // while they are all alike, one
  std::size_t known = 0;
  elasticity::for_each_cell_point(*body.mesh, [&](const elasticity::CellPoint& p) {
    const Point f = force(p);
    if (known > 0 && load.uniform && !std::equal(f.begin(), f.begin() + dim, values.begin())) {
      load.uniform = false;
      values.reserve(static_cast<std::size_t>(body.mesh->cell_count()) * load.points * dim);
      for (std::size_t k = dim; k < known * dim; ++k) values.push_back(values[k - dim]);
    }
    if (known == 0 || !load.uniform) values.insert(values.end(), f.begin(), f.begin() + dim);
    ++known;
  });
  load.values = std::make_shared<const std::vector<double>>(std::move(values));
  body.volume_load = std::move(load);
  if (!body.unrefined) add_volume_forces(body, nodal_loads(body));
}

void load_volume(Body& body, const elasticity::VectorField& force) {
  load_volume(body, [&](const elasticity::CellPoint& p) { return force(p.x); });
}

std::vector<double> volume_forces(const Body& body) {
  std::vector<double> nodal;
  if (body.volume_load) nodal.assign(body.mesh->coordinates.size(), 0.0), add_volume_forces(body, nodal);
  return nodal;
}

void sum_loads(Body& body) {
  body.force.clear();
  for (LoadCase& one : body.cases) one.force.clear();
  if (body.volume_load && !body.unrefined) add_volume_forces(body, nodal_loads(body));
  for (const FacetLoad& load : body.facet_loads) add_nodal(body, load);
}

std::vector<LoadArrow> load_arrows(const Body& body) {
  std::vector<LoadArrow> arrows;
  std::map<mesh::Facet, std::size_t> place;
  for (const FacetLoad& load : body.facet_loads)
    for (std::size_t k = 0; k < load.facets.size(); ++k) {
      const mesh::Facet facet = load.facets[k];
      Point sum{0, 0, 0};
      double area = 0;
      elasticity::for_each_facet_point(*body.mesh, facet, [&](const FacetPoint& p) {
        area += p.measure;
        sum = mesh::plus(sum, mesh::times(p.measure, load.traction(k, p, body.dimension())));
      });
      const auto [found, fresh] = place.try_emplace(facet, arrows.size());
      if (fresh) arrows.push_back({facet, body.mesh->facet_centre(facet), {0, 0, 0}});
      Point& value = arrows[found->second].value;
      value = mesh::plus(value, mesh::times(1 / area, sum));
    }
  return arrows;
}

std::vector<Point> cell_forces(const Body& body) {
  std::vector<Point> forces;
  if (!body.volume_load) return forces;
  const VolumeLoad& load = *body.volume_load;
  forces.assign(body.mesh->cell_count(), Point{0, 0, 0});
  for (int c = 0; c < body.mesh->cell_count(); ++c)
    for (int q = 0; q < load.points; ++q) {
      const Point f = load.at(c, q, body.dimension());
      for (int i = 0; i < 3; ++i) forces[c][i] += f[i] / load.points;
    }
  return forces;
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

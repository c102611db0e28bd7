#include "plate/element/stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::plate {

using algebra::SparseMatrix;
using algebra::Vector;
using Eigen::Vector2d;

namespace {

LocalMatrix cell_stiffness(const std::vector<double>& D, double nu, const Space& space, int cell) {
  const Triangle t = triangle(*space.mesh, space.edges, cell);
  const Rule& rule = stiffness_rule(space.element);
  const std::size_t points = rule.points.size(), first = D.size() > points ? cell * points : 0;
  LocalMatrix K = stiffness(*basis(space.element, t), rule, t, nu, &D[first]);
  space.to_freedoms(cell, K);
  K.transposeInPlace();
  space.to_freedoms(cell, K);
  return K;
}

}  // namespace

std::vector<double> bending_stiffness(const Plate& plate) {
  const Rule& rule = stiffness_rule(plate.element);
  if (!plate.D_of) return std::vector<double>(rule.points.size(), plate.D);
  const mesh::Mesh& mesh = *plate.mesh;
  std::vector<double> out;
  out.reserve(rule.points.size() * mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const Barycentric& b : rule.points) {
      Vector2d x(0, 0);
      for (int k = 0; k < 3; ++k) x += b[k] * node_position(mesh, mesh.cell(c)[k]);
      out.push_back(plate.D_of(x[0], x[1]));
      if (!(out.back() > 0) || !std::isfinite(out.back())) throw InputError(text("D is ", out.back(), " at (", x[0], ", ", x[1], "); it must be positive"));
    }
  return out;
}

Stiffness stiffness(const std::vector<double>& D, double nu, const Space& space, const Held& held, const std::vector<int>& unknown) {
  const auto n = static_cast<Eigen::Index>(unknown.size() - std::count(unknown.begin(), unknown.end(), -1));
  Stiffness out{SparseMatrix(n, n), Vector::Zero(n)};
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(space.mesh->cell_count()) * space.local_size() * (space.local_size() + 1) / 2);
  for (int c = 0; c < space.mesh->cell_count(); ++c) {
    std::array<int, 12> at = space.freedoms(c);
    for (int& i : at) i = unknown[i];
    const LocalMatrix K = cell_stiffness(D, nu, space, c);
    for (int j = 0; j < K.cols(); ++j)
      for (int i = 0; i < K.rows(); ++i)
        if (at[j] >= 0 && at[i] >= at[j]) entries.emplace_back(at[i], at[j], K(i, j));
    const LocalVector v = space.of_cell(c, held.value);
    if (v.isZero(0)) continue;
    const LocalVector force = K * v;
    out.energy_of_held += 0.5 * v.dot(force);
    for (int i = 0; i < v.size(); ++i)
      if (at[i] >= 0) out.force_of_held[at[i]] += force[i];
  }
  out.on_free.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Vector holding_forces(const std::vector<double>& D, double nu, const Space& space, const Held& held, const Vector& load, const Vector& u) {
  Vector out = Vector::Zero(u.size());
  for (int c = 0; c < space.mesh->cell_count(); ++c) {
    const auto freedom = space.freedoms(c);
    const auto end = freedom.begin() + space.local_size();
    if (std::none_of(freedom.begin(), end, [&](int i) { return held.is[i]; })) continue;
    const LocalVector force = cell_stiffness(D, nu, space, c) * space.of_cell(c, u);
    for (int i = 0; i < force.size(); ++i)
      if (held.is[freedom[i]]) out[freedom[i]] += force[i];
  }
  for (int i = 0; i < out.size(); ++i)
    if (held.is[i]) out[i] -= load[i];
  return out;
}

}  // namespace dotyk::plate

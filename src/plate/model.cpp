#include "plate/model.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "plate/loads.hpp"

namespace dotyk::plate {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using Eigen::Vector2d;
using Eigen::Vector3d;
using algebra::SparseMatrix;

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

/// a + b (x − x₀)/ℓ + c (y − y₀)/ℓ.
Motion motion(const Vector3d& p, const Vector2d& centre, double unit, double noise = 1e-9) {
  const Vector2d slope = p.tail<2>();
  if (slope.norm() < noise * std::abs(p[0])) return {Motion::Kind::translation, {0, 0, p[0] < 0 ? -1.0 : 1.0}, {}, false, std::abs(p[0])};
  const Vector2d on_axis = centre - p[0] * unit / slope.squaredNorm() * slope;
  const Vector2d along = Vector2d(slope[1], -slope[0]).normalized();
  return {Motion::Kind::rotation, {along[0], along[1], 0}, {on_axis[0], on_axis[1], 0}, false, slope.norm() / unit};
}

/// Motions a + bx + cy that no held freedom stops.
struct FreeMotions {
  DenseMatrix kernel;  ///< unknowns × motions
  problem::Motions motions;
};

FreeMotions free_motions(const Space& space, const Held& held, const std::vector<int>& unknown) {
  const DenseMatrix R = space.motions();
  Eigen::Matrix3d stopped = Eigen::Matrix3d::Zero();
  int count = 0, unknowns = 0;
  for (int i = 0; i < R.rows(); ++i) {
    if (held.is[i]) stopped += R.row(i).transpose() * R.row(i), ++count;
    else ++unknowns;
  }
  // A motion that moves no held freedom by more than 1e-6 of what it moves others by.
  const algebra::Eigenpairs3 eigen = algebra::eigenpairs3(stopped);
  int free = 0;
  while (free < 3 && eigen.values[free] <= 1e-12 * std::max(count, 1)) ++free;
  const DenseMatrix coefficients = free == 3 ? DenseMatrix(DenseMatrix::Identity(3, 3)) : free > 0 ? algebra::pure(eigen.vectors.leftCols(free)) : DenseMatrix(3, 0);
  FreeMotions out;
  out.kernel.resize(unknowns, free);
  for (int i = 0; i < R.rows(); ++i)
    if (unknown[i] >= 0) out.kernel.row(unknown[i]) = R.row(i) * coefficients;
  for (int j = 0; j < free; ++j) out.motions.push_back(motion(coefficients.col(j), space.centre(), space.unit));
  out.motions.sum = [coefficients, centre = space.centre(), unit = space.unit](const Vector& amounts) { return motion(coefficients * amounts, centre, unit, 1e-6); };
  return out;
}

/// Takes off what quadrature leaves of a load that balances: a resultant below 1e-6 of the forces.
void balance(const DenseMatrix& R, Vector& f) {
  if (R.cols() == 0) return;
  const Vector resultant = R.transpose() * f;
  if (resultant.lpNorm<Eigen::Infinity>() > 1e-6 * f.lpNorm<1>()) return;
  f -= R * algebra::Ldlt(R.transpose() * R).solve(resultant);
}

/// Is a load along an edge a function?
bool load_varies(const std::vector<Sample>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample &a = samples[i - 1], &b = samples[i];
    if (a.support == b.support && a.law->load && b.law->load && a.law.force() != b.law.force()) return true;
  }
  return false;
}

/// `by_quadrature`: the load is integrated approximately.
problem::Block block(const Plate& plate, const Model& model, bool by_quadrature) {
  problem::Block block;
  block.name = "plate";
  Stiffness K = stiffness(model.D, plate.nu, model.space, model.held, model.unknown);
  block.K = std::move(K.on_free);
  block.offset = K.energy_of_held - model.load.dot(model.held.value);
  block.f = -K.force_of_held;
  for (int i = 0; i < model.space.count(); ++i)
    if (model.unknown[i] >= 0) block.f[model.unknown[i]] += model.load[i];
  FreeMotions motions = free_motions(model.space, model.held, model.unknown);
  if (by_quadrature) balance(motions.kernel, block.f);
  block.kernel = std::move(motions.kernel);
  block.motions = std::move(motions.motions);
  return block;
}

/// What the model keeps of it.
Plate without_functions(Plate plate) {
  plate.D_of = plate.f_of = plate.obstacle = {};
  for (EdgeSupport& edge : plate.edges) edge.deflection = edge.rotation = {};
  return plate;
}

/// Freedoms of a vertex that no row acts on stand apart from those that rows do: the condensed problem is smaller without them.
std::vector<int> nodes(const Model& model) {
  const std::vector<char> touched = touched_by_rows(model.problem);
  std::vector<int> out;
  int last = -1;
  for (int i = 0; i < model.space.count(); ++i) {
    const int unknown = model.unknown[i];
    if (unknown < 0) continue;
    const bool same = unknown > 0 && model.space.node(i) == last && touched[unknown] == touched[unknown - 1];
    out.push_back(out.empty() ? 0 : out.back() + (same ? 0 : 1));
    last = model.space.node(i);
  }
  return out;
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

Vector Model::freedoms(const Vector& unknowns) const {
  Vector all = held.value;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i] >= 0) all[i] = unknowns[unknown[i]];
  return all;
}

Vector Model::unknowns(const Vector& freedoms) const {
  Vector out(problem.unknowns());
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i] >= 0) out[unknown[i]] = freedoms[i];
  return out;
}

Model build(Plate plate) {
  Stopwatch watch;
  require_valid(plate);
  mesh::check(*plate.mesh, "the plate's mesh");
  Model model{without_functions(plate), bending_stiffness(plate), Space(plate.element, *plate.mesh), {}, {}, {}, {}, {}, {}, {}, {}, 0};
  model.deflections = samples(plate, model.space, false);
  model.rotations = samples(plate, model.space, true);
  model.held = hold(plate, model.space, model.deflections, model.rotations);
  model.unknown.assign(model.space.count(), -1);
  int count = 0;
  for (std::size_t i = 0; i < model.unknown.size(); ++i)
    if (!model.held.is[i]) model.unknown[i] = count++;
  if (count == 0) throw InputError("its supports hold every freedom: the mesh is too coarse; give it more cells");
  model.load = loads(plate, model.space);
  const bool by_quadrature = plate.f_of || load_varies(model.deflections) || load_varies(model.rotations);
  add_law_loads(plate, model.space, model.deflections, model.rotations, model.load);
  problem::add(model.problem, block(plate, model, by_quadrature));
  add_rows(plate, model);
  if (model.problem.rows() > 0) problem::require_moderate(model.problem, problem::kMostForceOnRows);
  model.problem.blocks.front().node = nodes(model);
  for (const auto* samples : {&model.deflections, &model.rotations})
    for (auto& chain : row_chains(model, *samples)) model.problem.chains.push_back(std::move(chain));
  model.seconds = watch.seconds();
  return model;
}

}  // namespace dotyk::plate

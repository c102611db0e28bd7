#include "problem/sizes.hpp"

#include <cmath>
#include <limits>

namespace dotyk::problem {

using algebra::Vector;

Forces external_forces(const Problem& problem, const State& state) {
  Forces all{{}, problem.B.transpose() * state.lambda, Vector(problem.unknowns())};
  for (const Block& block : problem.blocks) all.load.segment(block.first, block.size()) = block.f;
  return all;
}

Forces forces(const Problem& problem, const State& state) {
  Forces all = external_forces(problem, state);
  all.internal = stiffness_times(problem, state.u);
  return all;
}

Vector gross_forces(const Block& block, const Vector& w) {
  Vector sum = Vector::Zero(w.size());
  for (int j = 0; j < block.K.outerSize(); ++j)
    for (algebra::SparseMatrix::InnerIterator it(block.K, j); it; ++it) {
      sum[it.row()] += std::abs(it.value() * w[j]);
      if (it.row() != j) sum[j] += std::abs(it.value() * w[it.row()]);
    }
  return sum;
}

bool any_loaded(const std::vector<Sizes>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Sizes& part) { return part.load > 0; });
}

void add(double& norm, const Eigen::Ref<const Vector>& v) { norm = std::hypot(norm, v.stableNorm()); }

namespace {

double greatest(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; }

/// About ‖|K||w|‖ and rarely less, without a pass over K: no entry is greater than the greatest on the diagonal.
double size_of_gross_forces(const Block& block, const Vector& w) {
  double greatest = 0;
  int entries = 0;
  for (int j = 0; j < block.size(); ++j) {
    const int* outer = block.K.outerIndexPtr() + j;
    greatest = std::max(greatest, block.K.valuePtr()[*outer]);
    entries = std::max(entries, 2 * (outer[1] - outer[0]));
  }
  return greatest * entries * w.stableNorm();
}
/// Where half of the digits of K|u| are below this part of the forces of contact they need not be known.
constexpr double kBelowForces = 0.01;

void add_scales_of_others(std::vector<Sizes>& parts) {
  std::vector<double> force, length;
  for (const Sizes& part : parts) force.push_back(part.external()), length.push_back(part.greatest_displacement);
  const bool loaded = any_loaded(parts);
  force = least_beside_others(force, loaded), length = least_beside_others(length, loaded);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].load > 0) continue;
    parts[p].least_force = std::max(parts[p].least_force, force[p]);
    parts[p].least_length = length[p];
  }
}

}  // namespace

std::vector<Sizes> sizes(const Problem& problem, const State& state, const Forces& all, const Parts& parts) {
  std::vector<Sizes> result(static_cast<std::size_t>(parts.count));
  const auto each_block = [&](const auto& visit) {
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) visit(problem.blocks[b], result[static_cast<std::size_t>(parts.of_block[b])]);
  };
  each_block([&](const Block& block, Sizes& part) {
    const auto own = [&](const Vector& v) { return v.segment(block.first, block.size()); };
    if (all.internal.size() > 0) add(part.internal, own(all.internal));
    add(part.contact, own(all.contact)), add(part.load, block.f);
    part.greatest_load = std::max(part.greatest_load, greatest(block.f));
    part.greatest_displacement = std::max(part.greatest_displacement, greatest(own(state.u)));
  });
  const double half = std::sqrt(std::numeric_limits<double>::epsilon());
  each_block([&](const Block& block, Sizes& part) {
    if (part.load > 0) return;
    const Vector u = state.u.segment(block.first, block.size());
    if (half * size_of_gross_forces(block, u) < kBelowForces * part.contact) return;
    const Vector gross = gross_forces(block, u);
    add(part.least_force, half * gross);
    part.least_work += half * gross.dot(u.cwiseAbs());
  });
  add_scales_of_others(result);
  return result;
}

}  // namespace dotyk::problem

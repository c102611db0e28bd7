#include "problem/parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/dense/generalised_inverse.hpp"
#include "algebra/dense/null_space.hpp"
#include "base/parallel.hpp"

namespace dotyk::problem {

using algebra::Vector;

std::vector<double> Parts::greatest(const Vector& v) const {
  std::vector<double> most(count, 0);
  for (Eigen::Index r = 0; r < v.size(); ++r) most[of_row[r]] = std::max(most[of_row[r]], std::abs(v[r]));
  return most;
}

std::vector<double> least_beside_others(const std::vector<double>& of_part, bool loaded) {
  const double of_others = loaded ? 1e-4 : 1;
  const auto most = std::max_element(of_part.begin(), of_part.end());
  double second = 0;
  for (auto it = of_part.begin(); it != of_part.end(); ++it)
    if (it != most) second = std::max(second, *it);
  std::vector<double> least(of_part.size(), of_others * *most);
  least[static_cast<std::size_t>(most - of_part.begin())] = of_others * second;
  return least;
}

Parts parts(const Problem& problem) {
  if (problem.hides()) return {1, std::vector<int>(problem.blocks.size(), 0), std::vector<int>(problem.rows(), 0)};
  algebra::Triplets joins;
  for (int r = 0; r < problem.rows(); ++r)
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it)
      if (it.value() != 0) joins.emplace_back(r, static_cast<int>(problem.block_of(it.col())), 1);
  const auto pieces = algebra::pieces(algebra::from_triplets(problem.rows(), static_cast<Eigen::Index>(problem.blocks.size()), joins));
  Parts result{std::max(1, static_cast<int>(pieces.size())), std::vector<int>(problem.blocks.size()), std::vector<int>(problem.rows())};
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (const int b : pieces[p].columns) result.of_block[b] = static_cast<int>(p);
    for (const int r : pieces[p].rows) result.of_row[r] = static_cast<int>(p);
  }
  return result;
}

Forces external_forces(const Problem& problem, const State& state) {
  Problem::NearRows near = problem.near_rows();
  return {field(problem, state.u), std::nullopt, std::nullopt, std::move(near.unknowns), near.B.transpose() * state.lambda};
}

Forces forces(const Problem& problem, const State& state) {
  Forces all = external_forces(problem, state);
  all.internal = stiffness_times(problem, algebra::LongField(*all.u), true);
  if (problem.loaded()) all.load = whole_load(problem, all.u->where());
  return all;
}

bool any_loaded(const std::vector<Sizes>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Sizes& part) { return part.load > 0; });
}

namespace {

/// a · b, on all cores.
double dot(const Eigen::Ref<const Vector>& a, const Eigen::Ref<const Vector>& b) {
  constexpr int kFew = 100'000;  // numbers, for a thread
  return parallel_sum(a.size(), kFew, [&](int first, int end) { return a.segment(first, end - first).dot(b.segment(first, end - first)); });
}

/// Is the square of the norm within the range of numbers?
bool moderate(double norm) {
  constexpr double kSquares = 1e140;
  return norm < kSquares && norm > 1 / kSquares;
}

}  // namespace

void add(double& norm, const Eigen::Ref<const Vector>& v) {
  const double plain = std::sqrt(dot(v, v));
  norm = std::hypot(norm, moderate(plain) ? plain : v.stableNorm());
}

template <class OfAll, class OfBlock>
std::vector<double> OfParts::each(const OfAll& of_all, const OfBlock& of_block) const {
  if (parts_.count == 1) return {of_all()};
  std::vector<double> sums(static_cast<std::size_t>(parts_.count), 0);
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) of_block(problem_.blocks[b], sums[static_cast<std::size_t>(parts_.of_block[b])]);
  return sums;
}

std::vector<double> OfParts::dot(const algebra::Field& a, const algebra::Field& b) const {
  const bool one = parts_.count == 1;
  const Vector of_a = one ? Vector() : a.get(), of_b = one ? Vector() : b.get();
  return each([&] { return a.dot(b); },
              [&](const Block& block, double& sum) { sum += problem::dot(of_a.segment(block.first, block.size()), of_b.segment(block.first, block.size())); });
}

std::vector<double> OfParts::norm(const algebra::Field& v) const {
  const Vector all = parts_.count == 1 ? Vector() : v.get();
  return each(
      [&] {
        const double plain = std::sqrt(v.dot(v));
        return moderate(plain) || (plain == 0 && v.greatest() == 0) ? plain : v.get().stableNorm();
      },
      [&](const Block& block, double& norm) { add(norm, all.segment(block.first, block.size())); });
}

std::vector<double> OfParts::greatest(const algebra::Field& v) const {
  const Vector all = parts_.count == 1 ? Vector() : v.get();
  return each([&] { return v.greatest(); }, [&](const Block& block, double& most) { most = std::max(most, all.segment(block.first, block.size()).lpNorm<Eigen::Infinity>()); });
}

namespace {

/// About ‖|K||w|‖ for a w of this norm, and rarely less, without a pass over K: no entry is greater than the greatest on the diagonal.
double size_of_gross_forces(const Block& block, double norm) {
  int entries = 0;
  if (block.K.slices()) entries = block.K.slices()->most_entries();
  else
    for (const int *outer = block.K.lower().outerIndexPtr(), *end = outer + block.size(); outer < end; ++outer) entries = std::max(entries, 2 * (outer[1] - outer[0]));
  return block.K.greatest_on_diagonal() * entries * norm;
}

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
  const OfParts of(problem, parts);
  const std::vector<double> moved = of.greatest(*all.u), internal = all.internal ? of.norm(*all.internal) : std::vector<double>(result.size(), 0);
  for (std::size_t p = 0; p < result.size(); ++p) result[p].greatest_displacement = moved[p], result[p].internal = internal[p];
  const auto each_block = [&](const auto& visit) {
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) visit(problem.blocks[b], result[static_cast<std::size_t>(parts.of_block[b])]);
  };
  each_block([&](const Block& block, Sizes& part) {
    const auto place = [&](int unknown) { return std::ranges::lower_bound(all.unknowns, unknown) - all.unknowns.begin(); };
    const Eigen::Index first = place(block.first), end = place(block.first + block.size());
    add(part.contact, all.contact.segment(first, end - first));
    if (problem.sliced_load != 0) return;
    add(part.load, block.f);
    part.greatest_load = std::max(part.greatest_load, block.f.lpNorm<Eigen::Infinity>());
  });
  if (problem.sliced_load != 0) {  // all blocks are one part
    const algebra::Field whole = all.load ? *all.load : whole_load(problem, all.u->where());
    result[0].load = of.norm(whole)[0], result[0].greatest_load = whole.greatest();
  }
  // Where half of the digits of K|u| are below this part of the forces of contact they need not be known.
  constexpr double kBelowForces = 0.01;
  const double half = std::sqrt(std::numeric_limits<double>::epsilon());
  each_block([&](const Block& block, Sizes& part) {
    if (part.load > 0) return;
    double size = 0;
    if (problem.blocks.size() == 1) size = of.norm(*all.u)[0];
    else add(size, state.u.here().segment(block.first, block.size()));
    if (half * size_of_gross_forces(block, size) < kBelowForces * part.contact) return;
    const Vector u = state.u.here().segment(block.first, block.size());
    const Vector gross = block.K.gross_times(u);
    add(part.least_force, half * gross);
    part.least_work += half * gross.dot(u.cwiseAbs());
  });
  add_scales_of_others(result);
  return result;
}

}  // namespace dotyk::problem

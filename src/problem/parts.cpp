#include "problem/parts.hpp"

#include "algebra/dense/null_space.hpp"

namespace dotyk::problem {

using algebra::Vector;

std::vector<double> Parts::greatest(const Vector& v) const {
  std::vector<double> most(count, 0);
  for (Eigen::Index r = 0; r < v.size(); ++r) most[of_row[r]] = std::max(most[of_row[r]], std::abs(v[r]));
  return most;
}

std::vector<double> Parts::norm(const Vector& v) const {
  std::vector<double> norm(static_cast<std::size_t>(count), 0);
  for (Eigen::Index r = 0; r < v.size(); ++r) norm[of_row[r]] = std::hypot(norm[of_row[r]], v[r]);
  return norm;
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

}  // namespace dotyk::problem

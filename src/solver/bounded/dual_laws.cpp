#include "solver/bounded/dual_laws.hpp"

#include "solver/rows/projection.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Law;
using problem::Limits;
using problem::Problem;
using problem::RowGroup;

namespace {

/// Steps in which the change must fall by a tenth.
constexpr int kBoundsPatience = 8;
constexpr double kLeastStep = 1.0 / 32;

bool has_kinks(const RowGroup& group) {
  for (int r = 0; r < group.count; ++r)
    if (problem::kinked_at_zero(*group.law, r)) return true;
  return false;
}

std::shared_ptr<const Law> half(const RowGroup& group, bool above) {
  std::vector<Limits> rows;
  for (int r = 0; r < group.count; ++r) {
    const problem::Springs k = group.law->springs(r).value();
    rows.push_back(above ? Limits{k.above, 0, Law::kUnbounded} : Limits{k.below, -Law::kUnbounded, 0});
  }
  return problem::limited(group.law->name(), std::move(rows));
}

}  // namespace

SeparableSet admissible(const Problem& problem, const Vector& scale, const Vector& bounds, const Vector& shift) {
  Vector low = Vector::Constant(shift.size(), -INFINITY), high = Vector::Constant(shift.size(), INFINITY);
  std::vector<SeparableSet::Disc> discs;
  const auto interval = [&](int r, double least, double greatest) {
    low[r] = least / scale[r] - shift[r];
    high[r] = greatest / scale[r] - shift[r];
  };
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const problem::Interval m = group.law->multipliers(r - group.first);
      interval(r, m.low, m.high);
    }
  Eigen::Index point = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k, ++point) {
      const int r = group.row(k);
      const double bound = bounds[point];
      if (!(bound < kNoSlip)) continue;
      if (group.components == 1)
        interval(r, -bound, bound);
      else
        discs.push_back({r, r + 1, {-shift[r], -shift[r + 1]}, bound / scale[r]});
    }
  return SeparableSet(std::move(low), std::move(high), std::move(discs));
}

Vector law_compliance(const Problem& problem) {
  Vector compliance = Vector::Zero(problem.rows());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (const double k = group.law->springs(r - group.first).value().above; k > 0) compliance[r] = 1 / k;
  return compliance;
}

bool has_two_springs(const Problem& problem) {
  return std::any_of(problem.groups.begin(), problem.groups.end(), has_kinks);
}

OpposedSprings opposed_springs(const Problem& whole) {
  OpposedSprings out{whole, std::vector<int>(whole.rows())};
  Problem& problem = out.problem;
  std::iota(out.from.begin(), out.from.end(), 0);
  for (std::size_t g = 0; g < whole.groups.size(); ++g) {
    const RowGroup& group = whole.groups[g];
    if (!has_kinks(group)) continue;
    problem.groups[g].law = half(group, true);
    problem.groups.push_back({group.name, half(group, false), static_cast<int>(out.from.size()), group.count});
    for (int r = 0; r < group.count; ++r) out.from.push_back(group.first + r);
  }
  problem.c = whole.c(out.from);
  problem.B = algebra::pick_rows(whole.B, out.from);
  if (whole.row_name) problem.row_name = [name = whole.row_name, from = out.from](int row) { return name(from[row]); };
  return out;
}

Result joined(Result result, const std::vector<int>& from, int rows) {
  const auto join = [&](auto& of_rows, auto&& both) {
    for (std::size_t r = rows; r < from.size(); ++r) of_rows[from[r]] = both(of_rows[from[r]], of_rows[r]);
  };
  join(result.state.lambda, [](double a, double b) { return a + b; });
  result.state.lambda.conservativeResize(rows);
  for (auto& active : result.active_sets) {
    join(active, [](char a, char b) -> char { return a || b; });
    active.resize(rows);
  }
  if (!result.slipping.empty()) result.slipping.resize(rows);
  return result;
}

bool SettlingBounds::follow(const Vector& next) {
  const double size = next.stableNorm();
  const bool bounded = (now_.array() < kNoSlip).all();
  change_ = bounded ? (next - now_).stableNorm() / (size > 0 ? size : 1) : 1;
  now_ = bounded ? Vector(now_ + step_ * (next - now_)) : next;
  since_best_ = change_ < 0.9 * best_ ? 0 : since_best_ + 1;
  best_ = std::min(best_, change_);
  if (since_best_ == 0 || since_best_ % kBoundsPatience != 0) return true;
  if (step_ <= kLeastStep) return false;
  step_ /= 2;
  return true;
}

}  // namespace dotyk::solver

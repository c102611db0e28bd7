#include "solver/core/near_rows.hpp"

#include <algorithm>
#include <optional>

#include "solver/core/settled_overlap.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

/// Leaving rows out is worth it from so many rows on, and where it leaves out at least so many of a hundred.
constexpr int kFewRows = 150, kLeastLeftOut = 20;
/// Where bodies settle is a guess: rows that are apart by so much of the greatest overlap are taken as well.
constexpr double kNearly = 0.1;

/// Points of a friction law picked from all.
class Picked final : public problem::Friction {
 public:
  Picked(std::shared_ptr<const Friction> law, std::vector<int> points) : law_(std::move(law)), points_(std::move(points)) {}
  std::string name() const override { return law_->name(); }
  double bound(int point, double normal) const override { return law_->bound(points_[point], normal); }
  double bound_slope(int point) const override { return law_->bound_slope(points_[point]); }

 private:
  std::shared_ptr<const Friction> law_;
  std::vector<int> points_;
};

/// How far rows overlap at rest or, where bodies are free, after they have settled; nothing where no row does.
std::optional<Vector> overlap(const Problem& problem) {
  const bool held = std::all_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& b) { return b.kernel.cols() == 0; });
  std::optional<Vector> all = held ? std::optional<Vector>(-problem.c) : settled_overlap(problem);
  if (all && !held) all->array() += kNearly * std::max(0.0, all->maxCoeff());
  const auto some = [&](const RowGroup& g) { return g.law->unilateral() && (all->segment(g.first, g.count).array() > 0).any(); };
  if (all && std::none_of(problem.groups.begin(), problem.groups.end(), some)) all.reset();
  return all;
}

/// Coulomb's friction goes with its normal row; given friction acts on open points as well.
void add_friction(const Problem& problem, std::vector<char>& near) {
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      if (group.normal[k] >= 0 && group.law->bound(k, 0) == 0)
        std::fill_n(near.begin() + group.row(k), group.components, near[group.normal[k]]);
}

}  // namespace

NearRows::NearRows(const Problem& problem, const std::vector<char>& start) : problem_(problem) {
  std::vector<char> near(problem.rows(), 1);
  if (const auto over = problem.rows() >= kFewRows ? overlap(problem) : std::nullopt) {
    for (const RowGroup& group : problem.groups)
      for (int r = group.first; r < group.first + group.count; ++r)
        near[r] = !group.law->unilateral() || (*over)[r] >= 0 || (!start.empty() && start[r]);
    add_friction(problem, near);
    const auto left_out = std::count(near.begin(), near.end(), 0);
    if (100 * left_out < kLeastLeftOut * problem.rows()) std::fill(near.begin(), near.end(), 1);
  }
  take(std::move(near));
}

void NearRows::take(std::vector<char> near) {
  near_ = std::move(near);
  rows_.clear();
  for (std::size_t r = 0; r < near_.size(); ++r)
    if (near_[r]) rows_.push_back(static_cast<int>(r));
}

Problem NearRows::restricted() const {
  Problem out;
  out.blocks = problem_.blocks;
  std::vector<int> place(near_.size(), -1);
  out.B = algebra::pick_rows(problem_.B, rows_);
  out.c.resize(count());
  for (int k = 0; k < count(); ++k) {
    place[rows_[k]] = k;
    out.c[k] = problem_.c[rows_[k]];
    const auto row = static_cast<std::size_t>(rows_[k]);
    if (!problem_.measure.empty()) out.measure.push_back(row < problem_.measure.size() ? problem_.measure[row] : 0);
  }
  const auto before = [&](int row) { return static_cast<int>(std::lower_bound(rows_.begin(), rows_.end(), row) - rows_.begin()); };
  for (const RowGroup& group : problem_.groups) {
    const int first = before(group.first), count = before(group.first + group.count) - first;
    if (count > 0) out.groups.push_back({group.name, group.law, first, count});
  }
  for (const FrictionGroup& group : problem_.friction) {
    FrictionGroup picked{group.name, group.law, before(group.first), group.components, {}};
    std::vector<int> points;
    for (int k = 0; k < group.points(); ++k) {
      if (!near_[group.row(k)]) continue;
      points.push_back(k);
      picked.normal.push_back(group.normal[k] < 0 ? -1 : place[group.normal[k]]);
    }
    if (points.empty()) continue;
    picked.law = std::make_shared<Picked>(group.law, std::move(points));
    out.friction.push_back(std::move(picked));
  }
  for (const auto& chain : problem_.chains) {
    std::vector<int> kept;
    for (const int row : chain)
      if (near_[row]) kept.push_back(place[row]);
    if (kept.size() > 1) out.chains.push_back(std::move(kept));
  }
  if (problem_.row_name) out.row_name = [name = problem_.row_name, rows = rows_](int row) { return name(rows[row]); };
  return out;
}

std::vector<char> NearRows::restricted(const std::vector<char>& flags) const {
  std::vector<char> out;
  if (!flags.empty())
    for (const int row : rows_) out.push_back(flags[row]);
  return out;
}

problem::State NearRows::restricted(const problem::State& state) const { return {state.u, state.lambda(rows_)}; }

void NearRows::extend(Result& result) const {
  const auto spread = [&](std::vector<char>& flags) {
    if (flags.empty()) return;
    std::vector<char> out(near_.size(), 0);
    for (int k = 0; k < count(); ++k) out[rows_[k]] = flags[k];
    flags = std::move(out);
  };
  Vector lambda = Vector::Zero(static_cast<Eigen::Index>(near_.size()));
  lambda(rows_) = result.state.lambda;
  result.state.lambda = std::move(lambda);
  for (auto& flags : result.active_sets) spread(flags);
  spread(result.slipping);
}

bool NearRows::join(const Vector& u) {
  const Vector x = problem_.B * u - problem_.c;
  double most = 0;
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (!near_[r]) most = std::max(most, x[r]);
  if (!(most > 0)) return false;
  std::vector<char> near = near_;
  for (const RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (x[r] > -most) near[r] = 1;
  add_friction(problem_, near);
  take(std::move(near));
  return true;
}

}  // namespace dotyk::solver

#include "solver/core/row_subset.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;

namespace {

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

}  // namespace

void RowSubset::take(std::vector<char> kept) {
  kept_ = std::move(kept);
  rows_.clear();
  for (std::size_t r = 0; r < kept_.size(); ++r)
    if (kept_[r]) rows_.push_back(static_cast<int>(r));
}

Problem RowSubset::restricted() const {
  Problem out;
  out.blocks = problem_.blocks, out.sliced_load = problem_.sliced_load;
  std::vector<int> place(kept_.size(), -1);
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
      if (!kept_[group.row(k)]) continue;
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
      if (kept_[row]) kept.push_back(place[row]);
    if (kept.size() > 1) out.chains.push_back(std::move(kept));
  }
  if (problem_.row_name) out.row_name = [name = problem_.row_name, rows = rows_](int row) { return name(rows[row]); };
  return out;
}

std::vector<int> RowSubset::places(const std::vector<char>& part) const {
  std::vector<int> out;
  for (int k = 0; k < count(); ++k)
    if (part[rows_[k]]) out.push_back(k);
  return out;
}

std::vector<char> RowSubset::restricted(const std::vector<char>& flags) const {
  std::vector<char> out;
  if (!flags.empty())
    for (const int row : rows_) out.push_back(flags[row]);
  return out;
}

problem::State RowSubset::restricted(const problem::State& state) const { return {state.u, state.lambda(rows_)}; }

Beginning RowSubset::restricted(const Beginning& from) const {
  return {restricted(from.start), nullptr, from.from ? std::make_shared<problem::State>(restricted(*from.from)) : nullptr};
}

void RowSubset::extend(Result& result) const {
  const auto spread = [&](std::vector<char>& flags) {
    if (flags.empty()) return;
    std::vector<char> out(kept_.size(), 0);
    for (int k = 0; k < count(); ++k) out[rows_[k]] = flags[k];
    flags = std::move(out);
  };
  Vector lambda = Vector::Zero(static_cast<Eigen::Index>(kept_.size()));
  lambda(rows_) = result.state.lambda;
  result.state.lambda = std::move(lambda);
  for (auto& flags : result.active_sets) spread(flags);
  spread(result.slipping);
}

}  // namespace dotyk::solver

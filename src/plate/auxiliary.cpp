#include "plate/auxiliary.hpp"

#include <algorithm>
#include <cmath>

#include "plate/rows.hpp"
#include "solver/core/default_method.hpp"

namespace dotyk::plate {

using algebra::SparseRows;
using algebra::Vector;
using problem::Problem;

namespace {

/// The condensed problem is dense: beyond so many unknowns that rows act on, or so many against the root of all, a sparse factorisation an
/// iteration costs less. Obstacles under squares, where rows act on a quarter (Morley) and a sixth (HCT) of the unknowns: alike at 24 to 28 cells a side.
constexpr double kMostCondensed = 6000, kMostAgainstRoot = 11;

bool condensed_pays(const Problem& problem) {
  const std::vector<char> touched = touched_by_rows(problem);
  const auto count = static_cast<double>(std::count(touched.begin(), touched.end(), 1));
  return count <= kMostCondensed && count <= kMostAgainstRoot * std::sqrt(problem.unknowns());
}

/// The rows of a problem that are left, group by group.
struct Remaining {
  Problem problem;
  std::vector<int> row;  ///< of the whole problem
};

/// One law for the rows of another that are kept.
class Kept final : public problem::Law {
 public:
  Kept(std::shared_ptr<const Law> law, std::vector<int> rows) : law_(std::move(law)), rows_(std::move(rows)) {}
  std::string name() const override { return law_->name(); }
  problem::Projection project(int row, double y, double rho) const override { return law_->project(rows_[row], y, rho); }
  double energy(int row, double x) const override { return law_->energy(rows_[row], x); }
  double conjugate(int row, double lambda) const override { return law_->conjugate(rows_[row], lambda); }
  problem::Interval multipliers(int row) const override { return law_->multipliers(rows_[row]); }
  bool unilateral() const override { return law_->unilateral(); }
  std::optional<problem::Springs> springs(int row) const override { return law_->springs(rows_[row]); }
  std::optional<double> linear_stiffness(int row) const override { return law_->linear_stiffness(rows_[row]); }

 private:
  std::shared_ptr<const Law> law_;
  std::vector<int> rows_;
};

Remaining without(const Problem& whole, const std::vector<char>& left_out) {
  Remaining out;
  out.problem.blocks = whole.blocks;
  for (const problem::RowGroup& group : whole.groups) {
    std::vector<int> kept;
    for (int k = 0; k < group.count; ++k)
      if (!left_out[group.first + k]) kept.push_back(k);
    if (kept.empty()) continue;
    out.problem.groups.push_back({group.name, nullptr, static_cast<int>(out.row.size()), static_cast<int>(kept.size())});
    for (const int k : kept) out.row.push_back(group.first + k);
    out.problem.groups.back().law = std::make_shared<Kept>(group.law, std::move(kept));
  }
  const int rows = static_cast<int>(out.row.size());
  std::vector<Eigen::Triplet<double>> entries;
  out.problem.c.resize(rows);
  for (int r = 0; r < rows; ++r) {
    out.problem.c[r] = whole.c[out.row[r]];
    for (SparseRows::InnerIterator it(whole.B, out.row[r]); it; ++it) entries.emplace_back(r, static_cast<int>(it.col()), it.value());
  }
  out.problem.B = SparseRows(rows, whole.unknowns());
  out.problem.B.setFromTriplets(entries.begin(), entries.end());
  out.problem.row_name = [name = whole.row_name, row = out.row](int r) { return name(row[r]); };
  return out;
}

}  // namespace

solver::Result run(const Problem& problem, const solver::Method& method, Monitor& monitor) {
  return solver::solve(problem, method, {}, monitor, condensed_pays(problem));
}

std::optional<LimitCase> solve_limit_case(const Model& model, const Vector& motion, const solver::Method& method, Monitor& monitor) {
  const Problem& whole = model.problem;
  const Vector moved = model.unknowns(motion);
  const Vector by = by_motion(whole.B, moved);
  std::vector<char> known(whole.rows(), 0);
  Vector lambda = Vector::Zero(whole.rows());
  for (const problem::RowGroup& group : whole.groups)
    for (int k = 0; k < group.count; ++k) {
      const int r = group.first + k;
      if (by[r] == 0) continue;
      const problem::Interval bounds = group.law->multipliers(k);
      known[r] = 1;
      lambda[r] = by[r] > 0 ? bounds.high : bounds.low;
      if (!std::isfinite(lambda[r])) return std::nullopt;
    }
  Remaining left = without(whole, known);
  Vector& f = left.problem.blocks.front().f;
  f -= whole.B.transpose() * lambda;
  const auto rigid = problem::rigid_motions(left.problem);
  if (rigid.unnoticed.cols() != 1) return std::nullopt;
  const algebra::SparseMatrix free = problem::unnoticed_displacements(left.problem, rigid);  // to rounding, as `motion` need not be
  f = problem::least(free, f);
  LimitCase out{run(left.problem, method, monitor), {}};
  for (std::size_t r = 0; r < left.row.size(); ++r) lambda[left.row[r]] = out.result.state.lambda[static_cast<Eigen::Index>(r)];
  out.result.state.lambda = lambda;
  out.result.method = left.row.empty() ? "auxiliary problem" : "auxiliary problem, " + out.result.method;
  out.result.active_sets.clear();
  out.all = family(model, out.result.state, motion);
  const double begin = std::isfinite(out.all.from) ? out.all.from : std::isfinite(out.all.to) ? out.all.to : 0;
  out.result.state.u += begin * moved;
  out.all.from -= begin;
  out.all.to -= begin;
  return out;
}

}  // namespace dotyk::plate

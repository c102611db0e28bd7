#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "plate/solution.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/settle.hpp"

namespace dotyk::plate {

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
  out.problem.B = algebra::pick_rows(whole.B, out.row);
  out.problem.c = whole.c(out.row);
  out.problem.row_name = [name = whole.row_name, row = out.row](int r) { return name(row[r]); };
  return out;
}

/// By the method; without one linearly where there are no rows, else by PDAS: on the condensed problem while rows act on few unknowns,
/// else on the unknowns, begun with an interior point method (Pdas::held), as over an obstacle, which has a row at every vertex.
solver::Result run(const Problem& problem, const solver::Method& method, Monitor& monitor) {
  return solver::solve(problem, method, {}, monitor, condensed_pays(problem));
}

/// The limit case, in which the load does no work against the supports on one motion: every row that notices the motion bears the most, or least, that
/// its law allows on the side to which it would move, so its multiplier is known, and what is left is a problem without these rows, linear where
/// there are no others (P5, lemma 10 and remark 20: Aw = f, ∂ₙw = 0, Tₙw = 0 or −κ). Its solution is moved to where the laws of these rows
/// begin to be obeyed; `all` are the others. Nothing where another motion would become free.
struct LimitCase {
  solver::Result result;
  Family all;
};
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
  out.result.state.u.change() += begin * moved;
  out.all.from -= begin;
  out.all.to -= begin;
  return out;
}

/// Takes off the part in the three motions, so that (u, 1) = (u, x) = (u, y) = 0 over the plate.
void normalise(const Model& model, Vector& unknowns) {
  const algebra::DenseMatrix R = model.space.motions();
  Plate with;
  with.mesh = std::shared_ptr<const mesh::Mesh>(std::shared_ptr<void>(), model.space.mesh);
  algebra::DenseMatrix moments(R.rows(), 3);
  const Eigen::Vector2d centre = model.space.centre();
  for (int i = 0; i < 3; ++i) {
    with.f_of = [&, i](double x, double y) { return i == 0 ? 1 : (i == 1 ? x - centre[0] : y - centre[1]) / model.space.unit; };
    moments.col(i) = loads(with, model.space);
  }
  unknowns -= R * algebra::Lu(moments.transpose() * R).solve(moments.transpose() * unknowns);
}

/// Edges apart from one another may bear the most that they can, one up and one down, and leave the plate free to move. All solutions then,
/// if they differ by one motion; the state becomes the least of them.
std::optional<Family> settled(const Model& model, solver::Result& result) {
  const problem::FreeMotions free = solver::settle(model.problem, {}, result);
  if (free.count != 1) return {};
  return family(model, result.state, of_freedoms(model, Vector(free.motions.col(0))));
}

/// What is known before in place of what methods say of it in general.
void tell(const std::string& note, std::string& reason) {
  if (note.empty()) return;
  for (const char* general : {"; unique up to", "; a limit case"}) reason.erase(std::min(reason.find(general), reason.size()));
  reason += "; " + note;
}

}  // namespace

std::shared_ptr<const Solution> solve(std::shared_ptr<const Model> model, const solver::Method& method, Monitor& monitor) {
  Stopwatch total;
  const Verdict verdict = require_solvable(*model);
  solver::Result result;
  std::optional<Family> all;
  std::optional<LimitCase> limit;
  if (verdict.motion && model->problem.rows() > 0) limit = solve_limit_case(*model, *verdict.motion, method, monitor);
  if (limit) {
    result = std::move(limit->result);
    all = std::move(limit->all);
  } else {
    result = run(model->problem, method, monitor);
    all = settled(*model, result);
    if (verdict.motion && result.converged && !all) all = family(*model, result.state, *verdict.motion);
  }
  tell(verdict.note, result.reason);
  if (model->problem.rows() == 0 && model->problem.blocks.front().kernel.cols() == 3) normalise(*model, result.state.u.change());
  result.clock.assembly += model->seconds;
  result.clock.total = model->seconds + total.seconds();
  return std::make_shared<const Solution>(std::move(model), std::move(result), std::move(all));
}

}  // namespace dotyk::plate

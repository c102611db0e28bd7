#include <iomanip>
#include <utility>

#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "scene/solve/breaking.hpp"
#include "scene/solve/path_error.hpp"
#include "scene/result/solution.hpp"
#include "solver/core/default_method.hpp"

namespace dotyk::scene {

namespace {

/// Tells the watcher which step is at work.
class StepMonitor final : public Monitor {
 public:
  StepMonitor(Monitor& watcher, int step, std::size_t count) : watcher_(watcher), step_(step), count_(count) {}
  void phase(const std::string& what) override { watcher_.phase(text("step ", step_, " of ", count_, ": ", what)); }
  void iteration(const IterationInfo& info) override {
    IterationInfo told = info;
    told.step = step_;
    watcher_.iteration(told);
  }
  bool stop() override { return watcher_.stop(); }

 private:
  Monitor& watcher_;
  int step_;
  std::size_t count_;
};

/// Throws InputError where slip on the rows of one is not slip on the rows of the other.
void require_same_rows(const Model& model, const Model& before) {
  bool same = model.problem.rows() == before.problem.rows() && model.friction.size() == before.friction.size();
  for (std::size_t c = 0; same && c < model.friction.size(); ++c) {
    same = model.friction[c].size() == before.friction[c].size();
    for (std::size_t k = 0; same && k < model.friction[c].size(); ++k)
      for (int i = 0; i < 2; ++i) same = same && model.friction[c][k].row[i] == before.friction[c][k].row[i];
  }
  for (std::size_t b = 0; same && b < model.support_row.size(); ++b) {
    same = b < before.support_row.size() && model.support_row[b].size() == before.support_row[b].size();
    for (std::size_t s = 0; same && s < model.support_row[b].size(); ++s)
      same = model.bodies[b].laws[s].part == before.bodies[b].laws[s].part &&
             model.bodies[b].laws[s].tangential.kind == before.bodies[b].laws[s].tangential.kind;
  }
  if (!same)
    throw InputError("the solution given as 'after' has other contact rows than the scene; it must be of the same "
                     "meshes, contacts and friction, only supports' values and loads may differ");
}

/// Solves a scene step by step.
class History {
 public:
  History(std::shared_ptr<const Scene> scene, const solver::Method& method, const Start& start, Monitor& monitor)
      : scene_(std::make_shared<const Scene>(*scene)),  // on_iteration may run a script that adds to the scene
        method_(method), start_(start), monitor_(monitor), condenser_(start.condenser), last_(start.after) {
    if (last_) loading_ = last_->loading();
    for (const auto& body : scene_->bodies) bodies_.push_back(*body);
    if (last_) take_broken(last_->model().bodies, bodies_);
    breaks_ = may_break(bodies_);
  }

  std::shared_ptr<Solution> run(const std::vector<Step>& steps) {
    if (steps.empty()) return advance({}, monitor_, true);
    if (!condenser_ && (steps.size() > 1 || breaks_)) condenser_ = std::make_shared<problem::Condenser>();
    for (std::size_t k = 0;; ++k) try {
        StepMonitor monitor(monitor_, static_cast<int>(k) + 1, steps.size());
        const auto solution = advance(steps[k], monitor, k + 1 == steps.size());
        const bool converged = solution->result().converged;
        if (!converged) solution->name_step(text("step ", k + 1, " of ", steps.size(), ": "));
        if (!converged || k + 1 == steps.size()) return solution;
        steps_.push_back(solution);
      } catch (const InputError& error) {
        throw InputError(text("step ", k + 1, ": ", error.what()));
      }
  }

 private:
  std::shared_ptr<Solution> advance(const Step& step, Monitor& monitor, bool is_last) {
    load(step, monitor);
    solver::Result result = breaks_ ? cascade(monitor) : iterate(monitor);
    if (last_ && !last_->result().converged) result.reason += "; it follows a solution that has not converged";
    add_times(result.clock);
    Past past{loading_, last_ ? last_->slip() : algebra::Vector(), last_ ? last_->dissipated() : std::vector<double>(),
              steps_};
    if (is_last) model_.problem.subdomains = {};  // of use to methods alone
    const algebra::StopFactoring stop(monitor);  // of what a solution asks about its free motions
    const auto solution = std::make_shared<Solution>(scene_, is_last ? std::move(model_) : without_stiffness(),
                                                     is_last ? nullptr : &model_.problem, std::move(result),
                                                     std::move(past));
    if (const auto share = is_last && !solution->follows() && solution->result().converged ? share_of_path(*solution) : std::nullopt)
      solution->add_reason(text("; one load step, while friction follows the path: of its force ", std::setprecision(3), 100 * *share,
                                " % is at points that closed on the way and stick, or of bodies that another contact stopped on the way, where one step may be "
                                "wrong; path_error() says how far from eight"));
    solution->set_total(watch_.seconds());
    clock_ = solution->clock();
    last_ = solution;
    return solution;
  }

  void load(const Step& step, Monitor& monitor) {
    loading_.take(step, *scene_);
    if (!built_) model_ = build(*scene_, clock_, monitor, loading_, method_.decomposition());
    if (built_ || (last_ && breaks_)) reload(*scene_, bodies_, loading_, model_, clock_);
    built_ = true;
    if (last_ && last_ == start_.after) require_same_rows(model_, last_->model());
    add_slip();
  }

  /// Friction opposes the increment of slip.
  void add_slip() {
    if (!last_) return;
    for (const problem::FrictionGroup& group : model_.problem.friction) {
      const int count = group.points() * group.components;
      model_.problem.c.segment(group.first, count) += last_->slip().segment(group.first, count);
    }
  }

  /// Breaks supports until none bears too much: see breaking.hpp.
  solver::Result cascade(Monitor& monitor) {
    solver::Result result = iterate(monitor);
    int rounds = 0, broken = 0;
    while (result.converged && !monitor.stop()) {
      const int more = break_worst(model_, result.state.lambda, bodies_);
      if (more == 0) break;
      ++rounds, broken += more;
      monitor.phase(text(broken, " nodes of supports are broken"));
      add_times(result.clock);
      reload(*scene_, bodies_, loading_, model_, clock_);
      add_slip();
      try {
        result = iterate(monitor);
      } catch (const InputError& error) {
        throw InputError(text("after ", broken, broken == 1 ? " node" : " nodes", " of breaking supports broke: ", error.what()));
      }
    }
    result.reason += cascade_note(model_, result.state.u, rounds);
    return result;
  }

  solver::Result iterate(Monitor& monitor) const {
    return solver::solve(model_.problem, method_, {flags(), condenser_, state()}, monitor);
  }

  bool begins() const { return !last_ || last_ == start_.after; }

  /// The state to go on from: that of a solution with the same rows on the same meshes.
  std::shared_ptr<const problem::State> state() const {
    if (!begins() || !start_.coarse || !same_rows(*scene_, model_, *start_.coarse)) return nullptr;
    return {start_.coarse, &start_.coarse->result().state};
  }

  std::vector<char> flags() const {
    if (begins() && (start_.coarse || start_.closed)) return start_flags(*scene_, model_, start_);
    std::vector<char> flags;
    if (last_)
      for (int r = 0; r < model_.problem.rows(); ++r) flags.push_back(last_->active(r));
    return flags;
  }

  /// Times are since the first step began.
  void add_times(problem::Clock& step) {
    clock_.add_solve(step);
    step = clock_;
  }

  /// A copy of the model but for K and subdomains, which the next step needs and no earlier solution does.
  Model without_stiffness() {
    std::vector<algebra::SparseMatrix> kept;
    for (problem::Block& block : model_.problem.blocks) kept.push_back(std::exchange(block.K, {}));
    auto subdomains = std::exchange(model_.problem.subdomains, {});
    Model copy = model_;
    model_.problem.subdomains = std::move(subdomains);
    for (std::size_t b = 0; b < kept.size(); ++b) model_.problem.blocks[b].K = std::move(kept[b]);
    return copy;
  }

  Stopwatch watch_;
  std::shared_ptr<const Scene> scene_;
  const solver::Method& method_;
  const Start& start_;
  Monitor& monitor_;
  std::vector<Body> bodies_;  ///< as the script gave them, unscaled
  Loading loading_;
  Model model_;
  bool built_ = false;
  bool breaks_ = false;
  problem::Clock clock_;
  std::shared_ptr<problem::Condenser> condenser_;
  std::shared_ptr<const Solution> last_;
  std::vector<std::shared_ptr<const Solution>> steps_;
};

}  // namespace

std::shared_ptr<Solution> solve(std::shared_ptr<const Scene> scene, const solver::Method& method, const Start& start,
                                Monitor& monitor, const std::vector<Step>& steps) {
  return History(std::move(scene), method, start, monitor).run(steps);
}

}  // namespace dotyk::scene

#include <algorithm>
#include <utility>

#include "algebra/direct/stop_factoring.hpp"
#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "scene/result/solution.hpp"
#include "solver/active/pdas.hpp"
#include "solver/core/default_method.hpp"
#include "solver/pieces/enumeration.hpp"

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
             model.bodies[b].laws[s].tangential.law.spec == before.bodies[b].laws[s].tangential.law.spec;
  }
  if (!same)
    throw InputError("the solution given as 'after' has other contact rows than the scene; it must be of the same "
                     "meshes, contacts and friction, only supports' values and loads may differ");
}

// Supports that break are not monotone, and the energy has many local minima; on a part with n nodes 2ⁿ choices of
// broken ones would have to be tried. A scene follows one path instead, a cascade: all whole, the convex problem is
// solved; the nodes that exceed their limit most, relative to it, break (ties together); and so on until none
// exceeds it. What is broken stays so, over the steps of a history as well. Where at the end each broken node is
// displaced by more than what breaks it, the state is a local minimum of the energy; there may be others, lower ones.


constexpr double kEqual = 1e-9;  // forces whose relative difference may be the solver's

/// Calls visit(body, LawSupport, node) for every node of every breaking law.
template <class Visit>
void for_each_breaking(const std::vector<Body>& bodies, Visit&& visit) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t s = 0; s < bodies[b].laws.size(); ++s)
      if (bodies[b].laws[s].normal->breaks)
        for (std::size_t k = 0; k < bodies[b].laws[s].nodes.size(); ++k) visit(b, s, k);
}

/// Does any law of these bodies break?
bool may_break(const std::vector<Body>& bodies) {
  bool any = false;
  for_each_breaking(bodies, [&](auto, auto, auto) { any = true; });
  return any;
}

/// Breaks the worst nodes of a solution λ of `model` in `bodies`; how many, 0 where all bear what they must.
int break_worst(const Model& model, const algebra::Vector& lambda, std::vector<Body>& bodies) {
  const auto overload = [&](std::size_t b, std::size_t s, std::size_t k) {
    const LawSupport& on = model.bodies[b].laws[s];
    const int row = model.support_row[b][s][k].normal;
    if (row < 0 || on.breaks(k) || !(lambda[row] > 0)) return 0.0;
    return lambda[row] / (on.normal[k].bound() * on.nodes[k].weight);
  };
  double worst = 0;
  for_each_breaking(model.bodies, [&](auto b, auto s, auto k) { worst = std::max(worst, overload(b, s, k)); });
  int count = 0;
  if (!(worst > 1 + kEqual)) return 0;
  for_each_breaking(model.bodies, [&](auto b, auto s, auto k) {
    if (overload(b, s, k) < (1 - kEqual) * worst) return;
    LawSupport& on = bodies[b].laws[s];
    on.broken.resize(on.nodes.size(), 0);
    on.broken[k] = 1;
    ++count;
  });
  return count;
}

/// Takes over which nodes are broken; bodies without counterpart stay.
void take_broken(const std::vector<Body>& from, std::vector<Body>& to) {
  for (std::size_t b = 0; b < from.size() && b < to.size(); ++b)
    for (const LawSupport& known : from[b].laws)
      for (LawSupport& on : to[b].laws)
        if (on.part == known.part && on.normal->breaks) on.broken = known.broken;
}

/// What the cascade did, for the solution's reason; empty where nothing is broken.
std::string cascade_note(const Model& model, const algebra::Vector& u, int rounds) {
  int broken = 0, back = 0;
  std::vector<std::vector<double>> moved;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) moved.push_back(model.displacement(static_cast<int>(b), u));
  for_each_breaking(model.bodies, [&](auto b, auto s, auto k) {
    const LawSupport& on = model.bodies[b].laws[s];
    if (!on.breaks(k)) return;
    const double against = mesh::dot(mesh::at_node(moved[b], on.nodes[k].node, model.bodies[b].dimension()), on.nodes[k].normal);
    ++broken;
    back += on.normal[k].stiffness() * against < (1 - kEqual) * on.normal[k].bound();
  });
  if (broken == 0) return "";
  std::string note = text("; ", broken, broken == 1 ? " node is" : " nodes are", " broken, those of this load in ", rounds,
                          rounds == 1 ? " round" : " rounds", ", the worst first: ");
  return note + (back > 0 ? text(back, " of them came back by more than what broke them: this state is what the cascade leaves, and no "
                                       "local minimum of the energy")
                          : "one local minimum of the energy, perhaps of several");
}

/// Bodies that ranks refine are solved where they are, though no method was named.
const solver::Method& method_for(const Scene& scene, const solver::Method& named) {
  static const solver::Method multigrid{solver::Multigrid()};
  return !named && std::ranges::any_of(scene.bodies, [](const auto& body) { return body->unrefined != nullptr; }) ? multigrid : named;
}

/// Solves a scene step by step.
class History {
 public:
  History(std::shared_ptr<const Scene> scene, const solver::Method& method, const Start& start, Monitor& monitor)
      : scene_(std::make_shared<const Scene>(*scene)),  // on_iteration may run a script that adds to the scene
        method_(method_for(*scene_, method)), start_(start), monitor_(monitor), condenser_(start.condenser), last_(start.after) {
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
    if (is_last && !solution->follows() && solution->result().converged && follows_path(*solution))
      solution->add_reason("; one load step from rest, while friction follows the path of the load: path_error() compares it with eight");
    solution->set_total(watch_.seconds());
    clock_ = solution->clock();
    last_ = solution;
    return solution;
  }

  void load(const Step& step, Monitor& monitor) {
    loading_.take(step, *scene_);
    if (!built_) model_ = build(*scene_, clock_, monitor, loading_, method_.decomposition(), [&](const problem::Problem& p) {
        const bool held = std::ranges::all_of(p.blocks, [](const problem::Block& b) { return b.kernel.cols() == 0; });  // else K is needed to choose
        if (!method_ && held) choose(p);
        return method_ ? method_.takes_slices() : held && choice_->by == solver::Choice::By::multigrid;
      });
    if (!method_ && !choice_) choose(model_.problem);
    if (built_ || (last_ && breaks_)) reload(*scene_, bodies_, loading_, model_, clock_);
    built_ = true;
    if (last_ && last_ == start_.after) require_same_rows(model_, last_->model());
    add_slip();
  }

  void choose(const problem::Problem& problem) { choice_ = solver::choose(problem, memory_limit(), condenser_.get()); }

  /// Friction opposes the increment of slip.
  void add_slip() {
    if (!last_) return;
    for (const problem::FrictionGroup& group : model_.problem.friction) {
      const int count = group.points() * group.components;
      model_.problem.c.segment(group.first, count) += last_->slip().segment(group.first, count);
    }
  }

  /// Breaks supports until none bears too much.
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
    solver::Beginning from{flags(), condenser_, state()};
    return method_ ? solver::solve(model_.problem, method_, std::move(from), monitor) : solver::solve_chosen(model_.problem, *choice_, std::move(from), monitor);
  }

  bool begins() const { return !last_ || last_ == start_.after; }

  /// The state to go on from: that of a solution with the same rows on the same meshes. Hidden unknowns stay with the slices of the other one.
  std::shared_ptr<const problem::State> state() const {
    if (!begins() || !start_.coarse || model_.problem.hides() || !same_rows(*scene_, model_, *start_.coarse)) return nullptr;
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
    auto subdomains = std::exchange(model_.problem.subdomains, {});
    Model copy = model_;
    model_.problem.subdomains = std::move(subdomains);
    for (problem::Block& block : copy.problem.blocks) block.K = {};
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
  std::optional<solver::Choice> choice_;  ///< where no method is named: for all steps
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

AllSolutions all_solutions(std::shared_ptr<const Scene> scene, Monitor& monitor) {
  Stopwatch watch;
  scene = std::make_shared<const Scene>(*scene);
  problem::Clock clock;
  const Model model = build(*scene, clock, monitor);
  solver::Enumeration found = solver::enumerate(model.problem, monitor);
  AllSolutions all{{}, {}, found.summary()};
  const auto add = [&](solver::Enumeration::Solution& each) {
    each.result.clock.assembly += clock.assembly;
    all.solutions.push_back(std::make_shared<Solution>(scene, model, nullptr, std::move(each.result), Past{}));
    all.solutions.back()->set_total(watch.seconds());
  };
  for (solver::Enumeration::Solution& each : found.solutions) add(each);
  for (solver::Enumeration::Family& family : found.families) {
    all.families.push_back({family.dimension, {}, family.unbounded > 0, family.forces_only, family.connected});
    for (solver::Enumeration::Solution& end : family.ends) {
      all.families.back().ends.push_back(static_cast<int>(all.solutions.size()));
      add(end);
    }
  }
  return all;
}

}  // namespace dotyk::scene

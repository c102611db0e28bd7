#include "scene/result/solution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "scene/solve/after_solve.hpp"
#include "scene/solve/doubts.hpp"
#include "scene/result/locate.hpp"
#include "scene/solve/path_error.hpp"
#include "solver/core/ending.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::scene {

using mesh::Point;

namespace {

/// What a displacement that is not unique shall be near to: the step before, at the beginning rest; u itself where that step is not at hand.
algebra::Vector state_before(const Past& past, const algebra::Vector& u) {
  if (!past.steps.empty()) return past.steps.back()->result().state.u;
  return past.slip.size() > 0 ? u : algebra::Vector(algebra::Vector::Zero(u.size()));
}

}  // namespace

Solution::Solution(std::shared_ptr<const Scene> scene, Model model, const problem::Problem* with_stiffness,
                   solver::Result result, Past past)
    : scene_(std::move(scene)), model_(std::move(model)), result_(std::move(result)), past_(std::move(past)),
      stress_(scene_->bodies.size()), locators_(scene_->bodies.size()) {
  Stopwatch watch;
  const problem::Problem& problem = with_stiffness ? *with_stiffness : model_.problem;
  if (result_.method != "enumeration")  // which gives every one
    settle(*scene_, model_, problem, state_before(past_, result_.state.u), result_);
  result_.clock.motions += watch.lap();
  residual_ = solver::judge(problem, result_, model_.softest);
  if (with_stiffness) rounding_of_forces_ = problem::rounding_of_forces(problem, result_.state);
  take_state(problem);
  for (const std::string& body : describe_nearly_free(*scene_, model_)) result_.reason += "; " + body;
  result_.clock.recover += watch.lap();
}

void Solution::take_state(const problem::Problem& problem) {
  friction_energy_ = problem::friction_energy(problem, result_.state);
  add_step(problem);
  displacement_.clear();
  for (std::size_t b = 0; b < scene_->bodies.size(); ++b)
    displacement_.push_back(model_.displacement(static_cast<int>(b), result_.state.u));
}

Solution::Solution(const Solution& other, algebra::Vector u)
    : scene_(other.scene_), model_(other.model_), result_(other.result_), past_(other.past_), stress_(scene_->bodies.size()), locators_(scene_->bodies.size()) {
  result_.state.u = std::move(u);
  residual_ = problem::residual(model_.problem, result_.state);
  take_state(model_.problem);
}

std::shared_ptr<Solution> Solution::with(algebra::Vector u) const { return std::shared_ptr<Solution>(new Solution(*this, std::move(u))); }

void Solution::add_step(const problem::Problem& problem) {
  const algebra::Vector x = problem.B * result_.state.u - problem.c;
  slip_ = past_.slip.size() ? past_.slip : algebra::Vector::Zero(x.size());
  dissipated_ = past_.dissipated.empty() ? std::vector<double>(x.size(), 0.0) : past_.dissipated;
  for (const problem::FrictionGroup& group : problem.friction)
    for (int r = group.first; r < group.first + group.points() * group.components; ++r) {
      slip_[r] += x[r];
      dissipated_[r] += result_.state.lambda[r] * x[r];
    }
}

std::vector<std::shared_ptr<const Solution>> Solution::steps() const {
  auto all = past_.steps;
  all.push_back(shared_from_this());
  return all;
}

Solution::~Solution() = default;

const std::vector<elasticity::Stress>& Solution::stress(int body) const {
  if (stress_[body].empty()) {
    Stopwatch watch;
    const Body& b = this->body(body);
    stress_[body] = elasticity::nodal_stress(*b.mesh, b.material, displacement_[body]);
    result_.clock.recover += watch.seconds();
    result_.clock.total += watch.seconds();
  }
  return stress_[body];
}

const Locator& Solution::locator(int body) const {
  if (!locators_[body]) locators_[body] = std::make_unique<Locator>(*this->body(body).mesh);
  return *locators_[body];
}

namespace {

Place place(const Locator& locator, const Body& body, const Point& x) {
  const auto found = locator.find(x);
  if (!found)
    throw InputError(text("the point ", point_text(x.data(), body.dimension()), " lies outside '",
                          body.name, "' at rest"));
  return *found;
}

}  // namespace

Point Solution::displacement(int body, const Point& x) const {
  const Body& b = this->body(body);
  const Place at = place(locator(body), b, x);
  Point u{0, 0, 0};
  for (int a = 0; a < b.mesh->topology().nodes; ++a)
    for (int i = 0; i < b.dimension(); ++i)
      u[i] += at.shape[a] * displacement_[body][static_cast<std::size_t>(b.mesh->cell(at.cell)[a]) * b.dimension() + i];
  return u;
}

elasticity::Stress Solution::stress(int body, const Point& x) const {
  const Body& b = this->body(body);
  const Place at = place(locator(body), b, x);
  const auto& nodal = stress(body);
  elasticity::Stress s{};
  for (int a = 0; a < b.mesh->topology().nodes; ++a)
    for (std::size_t v = 0; v < s.size(); ++v) s[v] += at.shape[a] * nodal[b.mesh->cell(at.cell)[a]][v];
  return s;
}

const algebra::Vector& Solution::rounding_of_forces() const {
  if (!rounding_of_forces_) rounding_of_forces_ = problem::rounding_of_forces(model_.problem, result_.state);
  return *rounding_of_forces_;
}

bool Solution::active(int row) const {
  return !result_.active_sets.empty() && result_.active_sets.back()[row];
}

namespace {

/// A force without the rounding left in components that balance.
std::string force_text(std::array<double, 3> force, int dimension) {
  const double length = std::hypot(force[0], force[1], force[2]);
  for (double& component : force)
    if (std::abs(component) < 1e-12 * length) component = 0;
  return point_text(force.data(), dimension);
}

/// To so many unknowns printing a solution may cost the steps of path_error(), some tenths of a second.
constexpr int kMostToPrintPath = 4000;

/// What one load step from rest leaves out of friction's path; empty where nothing.
std::string path_text(const Solution& s) {
  if (s.follows() || !s.result().converged || !follows_path(s)) return "";
  const std::string known = "  friction follows the path of the load, this is one step of it: ";
  if (s.unknowns() > kMostToPrintPath) return known + "path_error() says how far from eight steps\n";
  Monitor quiet;
  try {
    return known + text(std::setprecision(3), "friction forces differ by ", 100 * s.path_error(quiet), " % from those of eight steps\n");
  } catch (const InputError& error) {
    return known + error.what() + "\n";
  }
}

}  // namespace

std::string describe(const Solution& s) {
  std::string out = "solution: " + solver::ending(s.result()) + "\n";
  out += text("  unknowns ", s.unknowns(), ", rows ", s.rows(), ", energy ", s.energy(), "\n");
  out += "  residual: " + problem::describe(s.residual()) + "\n";
  for (const auto& contact : s.scene().contacts) {
    if (contact->kind != Contact::Kind::contact) continue;
    const ContactResult c = s.contact(*contact);
    out += text("  ", contact->name, ": force ", force_text(c.force, s.scene().dimension()), "\n    ",
                c.stick + c.slip > 0 ? text(c.stick, " stick, ", c.slip, " slip, ") : "",
                c.closed > 0 || c.stick + c.slip == 0 ? text(c.closed, " closed, ") : "", c.open, " open, greatest pressure ",
                c.max_pressure, c.dissipated > 0 ? text(", dissipated ", c.dissipated) : "", "\n");
  }
  for (std::size_t b = 0; b < s.scene().bodies.size(); ++b)
    for (const LawSupport& on : s.body(static_cast<int>(b)).laws) {
      const SupportResult r = s.support({s.scene().bodies[b], on.part.name, on.facets});
      out += text("  support of '", s.scene().bodies[b]->name, "' ", on.part.name, " (", describe(on), "): ",
                  describe(r, s.scene().dimension()), "\n");
    }
  out += path_text(s);
  const problem::Clock& t = s.clock();
  out += text(std::setprecision(3), "  seconds: total ", t.total, " (assembly ", t.assembly, ", motions ", t.motions, ", ordering ", t.ordering,
              ", factor ", t.factor, ", iterate ", t.iterate, ", recover ", t.recover, ")");
  return out + describe(doubts(s));
}

}  // namespace dotyk::scene

#include "scene/solution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "scene/locate.hpp"
#include "scene/path_error.hpp"

namespace dotyk::scene {

using mesh::Point;

namespace {

/// Of forces; stresses of which so much is rounding are no result.
constexpr double kMostGranted = 0.1;

/// The equilibrium residual less what rounding of motions as a whole makes of it, where that is what is too great: the
/// reason then says whose stresses suffer.
double honest_equilibrium(const problem::Problem& problem, double raw, double allowed, solver::Result& result) {
  if (raw <= allowed || raw > kMostGranted) return raw;
  const problem::MotionResidual motion = problem::motion_residual(problem, result.state);
  const double honest = std::max(motion.beyond, motion.resultants);
  if (motion.most >= 0 && honest <= allowed)
    result.reason += text("; '", problem.blocks[motion.most].name, "' moves as a whole far more than it deforms: rounding "
                          "of the displacements leaves its stresses uncertain by about ", raw);
  return honest;
}

bool loaded(const problem::Problem& problem) {
  return std::any_of(problem.blocks.begin(), problem.blocks.end(), [](const problem::Block& block) { return !block.f.isZero(0); });
}

/// Where rounding is most of what a method returns, that is no solution.
void refuse_noise(const problem::Problem& problem, const problem::Residual& r, solver::Result& result) {
  if (!result.converged) return;
  const bool equilibrium_alone = result.penalty || result.feti;  // the rest is what was asked for
  const double allowed = equilibrium_alone ? result.noise : std::max(result.noise, result.asked);
  const double equilibrium = honest_equilibrium(problem, r.equilibrium, allowed, result);
  const double worst = equilibrium_alone ? equilibrium : std::max({equilibrium, r.penetration, r.complementarity});
  if (worst <= allowed) return;
  result.converged = false;
  result.reason = text("rounding leaves ", equilibrium_alone ? "the displacements out of equilibrium by " : "a residual of ",
                       worst, loaded(problem) ? "" : " (no load gives forces a scale: if they should vanish, take pdas, which ends exactly)",
                       ": stiffnesses, supports or sizes are too far apart ",
                       result.feti ? "for this decomposition, or tol is too great"
                                   : "(a material nearly incompressible, a spring nearly absent, cells nearly flat)");
}

/// A motion held by a part of the body's own stiffness is known to rounding over that part, whatever the residuals say:
/// a factor of K is no better.
void refuse_lost_motions(double softest, solver::Result& result) {
  const double lost = std::numeric_limits<double>::epsilon() / softest;
  if (!result.converged || lost <= result.noise) return;
  result.converged = false;
  result.reason = text("rounding may leave ", lost, " of a motion that supports hardly hold");
}

}  // namespace

Solution::Solution(std::shared_ptr<const Scene> scene, Model model, const problem::Problem* with_stiffness,
                   solver::Result result, Past past)
    : scene_(std::move(scene)), model_(std::move(model)), result_(std::move(result)), past_(std::move(past)),
      stress_(scene_->bodies.size()), locators_(scene_->bodies.size()) {
  const problem::Problem& problem = with_stiffness ? *with_stiffness : model_.problem;
  residual_ = problem::residual(problem, result_.state);
  energy_ = problem::energy(problem, result_.state);
  friction_energy_ = problem::friction_energy(problem, result_.state);
  const double sum = energy_ + residual_.equilibrium + residual_.penetration + residual_.complementarity;
  if (!result_.state.u.allFinite() || !result_.state.lambda.allFinite() || !std::isfinite(sum))
    throw std::runtime_error(
        "the solution has values beyond the range of numbers: stiffness, loads or sizes are too large or too "
        "small; choose units in which they are moderate");
  refuse_noise(problem, residual_, result_);
  refuse_lost_motions(model_.softest, result_);
  add_step(problem);
  for (std::size_t b = 0; b < scene_->bodies.size(); ++b)
    if (!model_.nearly_free[b].empty()) result_.reason += "; '" + scene_->bodies[b]->name + "' is " + model_.nearly_free[b];
  for (std::size_t b = 0; b < scene_->bodies.size(); ++b)
    displacement_.push_back(model_.displacement(static_cast<int>(b), result_.state.u));
}

void Solution::add_step(const problem::Problem& problem) {
  const algebra::Vector x = problem.B * result_.state.u - problem.c;
  slip_ = past_.slip.size() ? past_.slip : algebra::Vector::Zero(x.size());
  dissipated_ = past_.dissipated.empty() ? std::vector<double>(scene_->contacts.size(), 0.0) : past_.dissipated;
  for (std::size_t c = 0; c < model_.friction.size(); ++c)
    for (const FrictionRows& rows : model_.friction[c])
      for (int i = 0; i < rows.count; ++i) {
        slip_[rows.row[i]] += x[rows.row[i]];
        dissipated_[c] += result_.state.lambda[rows.row[i]] * x[rows.row[i]];
      }
  for (std::size_t b = 0; b < model_.support_row.size(); ++b)
    for (std::size_t s = 0; s < model_.support_row[b].size(); ++s) {
      if (model_.bodies[b].laws[s].tangential.kind != problem::SupportLaw::Kind::friction) continue;
      for (const SupportRows& rows : model_.support_row[b][s])
        for (int i = 0; i < rows.count; ++i) slip_[rows.row[i]] += x[rows.row[i]];
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

/// To so many unknowns printing a solution may cost two more solves.
constexpr int kMostToPrintPath = 20000;

/// What one load step from rest leaves out of friction's path; empty where nothing.
std::string path_text(const Solution& s) {
  if (s.follows() || !s.result().converged || !follows_path(s)) return "";
  const std::string known = "  friction follows the path of the load, this is one step of it: ";
  if (s.unknowns() > kMostToPrintPath) return known + "path_error() says how far from two steps\n";
  Monitor quiet;
  try {
    return known + text(std::setprecision(3), "friction forces differ by ", 100 * s.path_error(quiet), " % from those of two steps\n");
  } catch (const InputError& error) {
    return known + error.what() + "\n";
  }
}

}  // namespace

std::string describe(const Solution& s) {
  const solver::Result& r = s.result();
  std::string out = text("solution: ", r.converged ? "converged" : "NOT CONVERGED", " (", r.method, ", ",
                         r.iterations, r.iterations == 1 ? " iteration" : " iterations", "; ", r.reason, ")\n");
  out += text("  unknowns ", s.unknowns(), ", rows ", s.rows(), ", energy ", s.energy(), "\n");
  out += text(std::setprecision(3), "  residual: equilibrium ", s.residual().equilibrium, ", penetration ", s.residual().penetration,
              ", complementarity ", s.residual().complementarity, "\n");
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
  out += text(std::setprecision(3), "  seconds: total ", t.total, " (assembly ", t.assembly, ", ordering ", t.ordering,
              ", factor ", t.factor, ", iterate ", t.iterate, ", recover ", t.recover, ")");
  return out;
}

}  // namespace dotyk::scene

#include "scene/result/solution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "scene/result/inner_cells.hpp"
#include "scene/solve/doubts.hpp"
#include "solver/core/settle.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::scene {
namespace {

using algebra::Vector;
using mesh::Point;
using solver::kOnBound;

/// Smaller ones are rounding.
constexpr double kRounding = 1e-12;
/// Half the width of contact, in cells, that does not tell a rotation from none.
constexpr double kNarrow = 1.5;

/// Rows whose multiplier is rounding bear nothing, nor do those where it is as good as none and which have parted.
void open_without_force(const problem::Problem& problem, solver::Result& result) {
  if (result.active_sets.empty()) return;
  const Vector& lambda = result.state.lambda;
  const Vector x = problem::jumps(problem, result.state.u);
  const problem::Measure measure(problem, result.state);
  const problem::NoForce none(problem, measure, lambda, kOnBound);
  for (const problem::RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r) {
      const bool parted = x[r] < -kOnBound * measure.length_of_row(r);
      if (lambda[r] <= kRounding * measure.force_of_row(r) || (parted && none(r, lambda[r], -x[r]))) result.active_sets.back()[r] = 0;
    }
}

/// The width of the widest cell of contact that presses.
double widest_cell(const Scene& scene, const Model& model, const Vector& lambda) {
  double widest = 0;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    for (std::size_t k = 0; k < model.contact_row[c].size(); ++k)
      if (const int r = model.contact_row[c][k]; r >= 0 && lambda[r] > kOnBound * lambda.lpNorm<Eigen::Infinity>())
        widest = std::max(widest, std::pow(scene.contacts[c]->rows[k].weight, 1.0 / (scene.dimension() - 1)));
  return widest;
}

/// A rotation that contact hardly wider than its cells resists.
std::string resisted_by_cells(const Scene& scene, const Model& model, const problem::Problem& problem, const problem::FreeMotions& free,
                              const Vector& lambda) {
  if (free.weakest.size() == 0) return "";
  const auto modes = problem::body_motions(problem);
  if (modes.size() != static_cast<std::size_t>(free.weakest.size())) return "";
  Eigen::Index most;
  free.weakest.cwiseAbs().maxCoeff(&most);
  const std::string& name = modes[static_cast<std::size_t>(most)].body;
  const auto motions = problem::told(modes, free.weakest[most] < 0 ? Vector(-free.weakest) : free.weakest);
  const auto it = std::find_if(motions.begin(), motions.end(), [&](const problem::BodyMotion& one) { return one.body == name; });
  if (it->motion.kind != Motion::Kind::rotation) return "";
  for (const auto& body : scene.bodies)
    if (body->name == name && free.grip * body->mesh->size() / 2 <= kNarrow * widest_cell(scene, model, lambda))
      return text("; ", it->text(), " is resisted only by terms of the order of the mesh (contact is hardly wider than its cells): how far it goes "
                  "is the mesh's");
  return "";
}

/// As solver::settle(). A rotation that contact no wider than its cells resists is named as well.
void settle(const Scene& scene, const Model& model, const problem::Problem& problem, const problem::Displacement& before, solver::Result& result) {
  if (!result.converged || problem.rows() == 0) return;
  const problem::FreeMotions free = solver::settle(problem, before, result);
  if (free.count == 0) result.reason += resisted_by_cells(scene, model, problem, free, result.state.lambda);
}

/// What a displacement that is not unique shall be near to: the step before, at the beginning rest; u itself where that step is not at hand.
problem::Displacement state_before(const Past& past, const problem::Displacement& u) {
  if (!past.steps.empty()) return past.steps.back()->result().state.u;
  return past.slip.size() > 0 ? u : problem::Displacement();
}

/// A force without the rounding left in components that balance.
std::string force_text(std::array<double, 3> force, int dimension) {
  const double length = std::hypot(force[0], force[1], force[2]);
  for (double& component : force)
    if (std::abs(component) < 1e-12 * length) component = 0;
  return point_text(force.data(), dimension);
}

/// To so many unknowns printing a solution may cost the steps of path_error(), some tenths of a second.
constexpr int kMostToPrintPath = 4000;
/// A smaller path error is rounding.
constexpr double kSamePath = 1e-7;

/// What one load step from rest leaves out of friction's path; empty where nothing.
std::string path_text(const Solution& s) {
  if (s.follows() || !s.result().converged || !follows_path(s)) return "";
  const std::string known = "  friction follows the path of the load, this is one step of it: ";
  if (s.unknowns() > kMostToPrintPath) return known + "path_error() says how far from eight steps\n";
  Monitor quiet;
  try {
    const double error = s.path_error(quiet);
    return known + (error > kSamePath ? text(std::setprecision(3), "friction forces differ by ", 100 * error, " % from those of eight steps\n") : "eight steps give the same\n");
  } catch (const InputError& error) {
    return known + error.what() + "\n";
  }
}

/// How the motion displaces the unknowns of the body, and how far it moves the node that it moves most.
std::pair<Vector, double> displacement(const Solution& solution, int body, const RigidMotion& motion) {
  const mesh::Mesh& mesh = *solution.body(body).mesh;
  const elasticity::Numbering& numbering = solution.model().numbering[body];
  Vector w = Vector::Zero(numbering.count());
  double most = 0;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const mesh::Point moved = mesh::plus(motion.translation, mesh::cross(motion.rotation, mesh::minus(mesh.point(n), motion.about)));
    most = std::max(most, mesh::length(moved));
    for (int i = 0; i < mesh.dimension(); ++i) {
      const int unknown = numbering.unknown[n * mesh.dimension() + i];
      if (unknown >= 0) w[unknown] = moved[i];
      else if (moved[i] != 0)
        throw InputError(text("its supports hold '", solution.body(body).name, "' at (", mesh.point(n)[0], ", ", mesh.point(n)[1],
                              mesh.dimension() == 3 ? text(", ", mesh.point(n)[2]) : "", ") against this motion"));
    }
  }
  return {std::move(w), most};
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
  if (result_.converged && result_.method != "enumeration") open_without_force(problem, result_);
  if (with_stiffness) rounding_of_forces_ = problem::rounding_of_forces(problem, result_.state), measure_.emplace(problem, result_.state);
  take_state(problem);
  for (const std::string& body : describe_nearly_free(*scene_, model_)) result_.reason += "; " + body;
  result_.clock.recover += watch.lap();
}

void Solution::take_state(const problem::Problem& problem) {
  friction_energy_ = problem::friction_energy(problem, result_.state);
  const Vector x = problem::jumps(problem, result_.state.u);
  slip_ = past_.slip.size() ? past_.slip : Vector::Zero(x.size());
  dissipated_ = past_.dissipated.empty() ? std::vector<double>(x.size(), 0.0) : past_.dissipated;
  for (const problem::FrictionGroup& group : problem.friction)
    for (int r = group.first; r < group.first + group.points() * group.components; ++r) {
      slip_[r] += x[r];
      dissipated_[r] += result_.state.lambda[r] * x[r];
    }
  displacement_.assign(scene_->bodies.size(), {});
}

Solution::Solution(const Solution& other, Vector u)
    : scene_(other.scene_), model_(other.model_), result_(other.result_), past_(other.past_), stress_(scene_->bodies.size()), locators_(scene_->bodies.size()) {
  result_.state.u = std::move(u);
  residual_ = problem::residual(model_.problem, result_.state);
  take_state(model_.problem);
}

const std::vector<double>& Solution::displacement(int body) const {
  if (displacement_[body].empty()) displacement_[body] = model_.displacement(body, result_.state.u);
  return displacement_[body];
}

std::shared_ptr<Solution> Solution::with(Vector u) const { return std::shared_ptr<Solution>(new Solution(*this, std::move(u))); }

std::vector<std::shared_ptr<const Solution>> Solution::steps() const {
  auto all = past_.steps;
  all.push_back(shared_from_this());
  return all;
}

const std::vector<elasticity::Stress>& Solution::stress(int body) const {
  if (stress_[body].empty()) {
    Stopwatch watch;
    const Body& b = this->body(body);
    stress_[body] = elasticity::nodal_stress(*b.mesh, b.material, displacement(body));
    result_.clock.recover += watch.seconds();
    result_.clock.total += watch.seconds();
  }
  return stress_[body];
}

std::optional<Place> Solution::place(int body, const Point& x) const {
  if (!locators_[body]) locators_[body].emplace(*this->body(body).mesh);
  return locators_[body]->find(x);
}

InnerValues Solution::inside(int body, const Point& x) const {
  const Body& b = this->body(body);
  if (b.unrefined)
    if (const auto values = inner_values(*this, body, x)) return *values;
  throw InputError(text("the point ", point_text(x.data(), b.dimension()), " lies outside '", b.name, "' at rest"));
}

Point Solution::displacement(int body, const Point& x) const {
  const Body& b = this->body(body);
  const auto found = place(body, x);
  if (!found) return inside(body, x).displacement;
  const Place& at = *found;
  Point u{0, 0, 0};
  for (int a = 0; a < b.mesh->topology().nodes; ++a)
    u = mesh::plus(u, mesh::times(at.shape[a], mesh::at_node(displacement(body), b.mesh->cell(at.cell)[a], b.dimension())));
  return u;
}

elasticity::Stress Solution::stress(int body, const Point& x) const {
  const Body& b = this->body(body);
  const auto found = place(body, x);
  if (!found) return inside(body, x).stress;
  const Place& at = *found;
  const auto& nodal = stress(body);
  elasticity::Stress s{};
  for (int a = 0; a < b.mesh->topology().nodes; ++a)
    for (std::size_t v = 0; v < s.size(); ++v) s[v] += at.shape[a] * nodal[b.mesh->cell(at.cell)[a]][v];
  return s;
}

const Vector& Solution::rounding_of_forces() const {
  if (!rounding_of_forces_) rounding_of_forces_ = problem::rounding_of_forces(model_.problem, result_.state);
  return *rounding_of_forces_;
}

const problem::Measure& Solution::measure() const {
  if (!measure_) measure_.emplace(model_.problem, result_.state);
  return *measure_;
}

bool Solution::active(int row) const {
  return !result_.active_sets.empty() && result_.active_sets.back()[row];
}

std::string describe(const Solution& s) {
  std::string out = "solution: " + solver::ending(s.result()) + "\n";
  out += text("  unknowns ", s.model().problem.all_unknowns(), ", rows ", s.rows(), ", energy ", s.energy(), "\n");
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

std::shared_ptr<Solution> moved_rigidly(const Solution& solution, int body, const RigidMotion& motion) {
  require_whole(solution.scene(), "a solution moved rigidly");
  const problem::Problem& problem = solution.model().problem;
  const problem::Block& block = problem.blocks[body];
  if (block.K.rows() == 0) throw InputError("a step that is not the last of its history has no other members; solve up to it");
  const auto [w, most] = displacement(solution, body, motion);
  constexpr double kRounding = 1e-9;
  const Vector amounts = block.kernel.cols() > 0 ? algebra::least_squares(block.kernel, w) : Vector();
  const double held = block.kernel.cols() > 0 ? (block.kernel * amounts - w).lpNorm<Eigen::Infinity>() : w.lpNorm<Eigen::Infinity>();
  if (held > kRounding * most) throw InputError(text("supports hold '", block.name, "' elastically against this motion"));
  problem::State state = solution.result().state;
  state.u.change().segment(block.first, block.size()) += w;
  const double off = problem::distance_from_laws(problem, state);
  if (!(off <= solution.result().noise))
    throw InputError(text("contacts or laws do not allow it: moved by this, '", block.name, "' is ", off, " off its laws (relative; rounding leaves ",
                          solution.result().noise, "). Solutions that differ by a motion say so in their reason"));
  return solution.with(state.u.here());
}

}  // namespace dotyk::scene

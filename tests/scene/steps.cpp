#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "../support/scenes.hpp"
#include "scene/result/solution.hpp"

using namespace dotyk;
using algebra::Vector;
using mesh::Point;

namespace {

/// A free block on a held one, pressed and pulled to and fro; and the path of the pull.
struct Rubbed {
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
  std::vector<scene::Step> steps;
};

Rubbed rubbed(int dim, const problem::LawSpec* kind, double value,
              contact::Multipliers multipliers = contact::Multipliers::nodal) {
  const auto lower = test::block("lower", dim, mesh::Family::p1, 4), upper = test::block("upper", dim, mesh::Family::p1, 4, 1, 400);
  test::fix(lower, "bottom");
  auto top = test::part(upper, "top"), side = test::part(upper, "right");
  scene::load(top, [=](const Point& x) {
    Point t{0, 0, 0};
    t[dim - 1] = -1 - 0.5 * x[0];
    return t;
  });
  scene::load(top, [](const Point&) { return Point{0.3, 0, 0}; }, "x");
  scene::load(side, [=](const Point& x) { return dim == 3 ? Point{0, 0.1 * x[2], 0} : Point{0.1, 0, 0}; }, "y");
  Rubbed r;
  r.scene = scene::make_scene({lower, upper});
  r.contact = scene::add_contact(*r.scene, test::part(upper, "bottom"), test::part(lower, "top"), {},
                                 {*kind, [=](const Point& x) { return value * (1 + x[0]); }}, false, {multipliers, 0});
  const double path[][3] = {{1, 0, 0}, {1, .7, 0}, {1, .7, 1}, {.8, -.5, 1}, {1.2, -.7, -1}, {1, .6, .3}, {1, .6, .3}, {.7, 0, 0}};
  for (const auto& p : path) {
    scene::Step step;
    step.all = p[0];
    step.factor = {{"x", p[1]}, {"y", p[2]}};
    r.steps.push_back(step);
  }
  return r;
}

/// The friction rows of a model, ascending by contact.
std::vector<int> friction_rows(const scene::Model& model) {
  std::vector<int> rows;
  for (const auto& cells : model.friction)
    for (const auto& cell : cells) rows.insert(rows.end(), cell.row, cell.row + cell.count);
  return rows;
}

double load_work(const scene::Solution& s, const Vector& by) {
  double work = 0;
  for (const problem::Block& block : s.model().problem.blocks) work += block.f.dot(by.segment(block.first, block.size()));
  return work;
}

}  // namespace

TEST_CASE("the energy balance of every step of a history") {
  // With Ku + Bᵀλ = f in each step, exactly:
  //   ½(f_k + f_{k−1})ᵀΔu = ΔW + ½(λ_k + λ_{k−1})ᵀBΔu              (trapezoidal work, W = ½uᵀKu)
  //   f_kᵀΔu = ΔW + D_k + ½ΔuᵀKΔu + λ_n,k (x_n,k − x_n,k−1)  with D_k = λ_t,k·Δx_t the dissipated work,
  // and all of D_k, ½ΔuᵀKΔu and λ_n,k (x_n,k − x_n,k−1) = −λ_n,k x_n,k−1 are ≥ 0: loads never do less
  // work, taken at the step's end, than is stored and dissipated.
  for (int dim : {2, 3})
    for (const auto& [kind, value, multipliers] :
         {std::tuple{&problem::laws::friction, 0.3, contact::Multipliers::nodal},
          {&problem::laws::friction, 0.3, contact::Multipliers::p1_p0},
          {&problem::laws::coulomb, 0.35, contact::Multipliers::nodal}}) {
      const Rubbed r = rubbed(dim, kind, value, multipliers);
      Monitor quiet;
      const auto last = scene::solve(r.scene, {}, {}, quiet, r.steps);
      REQUIRE_MESSAGE(last->result().converged, last->result().reason);
      const auto steps = last->steps();
      REQUIRE(steps.size() == r.steps.size());
      const problem::Problem& p = last->model().problem;  // K and B of all of them
      Vector u = Vector::Zero(p.unknowns()), lambda = Vector::Zero(p.rows()), slip = lambda;
      const scene::Solution* before = nullptr;
      double dissipated = 0;
      for (const auto& s : steps) {
        const auto& now = s->result().state;
        const Vector du = now.u.here() - u, Kdu = stiffness_times(p, du);
        const double stored = 0.5 * (now.u.here() + u).dot(Kdu);
        const double jump_work = 0.5 * (now.lambda + lambda).dot(p.B * du);
        const double scale = std::abs(load_work(*s, now.u));
        const double trapezoid = 0.5 * (load_work(*s, du) + (before ? load_work(*before, du) : 0));
        CHECK(std::abs(trapezoid - stored - jump_work) < 1e-10 * scale);
        // Dissipation point by point.
        double D = 0;
        for (int row : friction_rows(s->model())) {
          CHECK(std::abs(s->slip()[row] - (p.B * now.u.here())[row]) < 1e-12 * now.u.here().lpNorm<Eigen::Infinity>());
          const double increment = s->slip()[row] - slip[row];
          D += now.lambda[row] * increment;
        }
        for (const auto& cell : s->model().friction[0]) {
          double work = 0;
          for (int i = 0; i < cell.count; ++i) work += now.lambda[cell.row[i]] * (s->slip()[cell.row[i]] - slip[cell.row[i]]);
          CHECK(work >= -1e-12 * scale);
        }
        CHECK(std::abs(D - s->friction_energy()) < 1e-10 * scale);
        dissipated += D;
        CHECK(std::abs(s->contact(*r.contact).dissipated - dissipated) < 1e-11 * scale);
        double normal = 0;
        for (int row : s->model().contact_row[0]) {
          const double x = (p.B * now.u.here())[row], was = (p.B * u)[row];
          normal += now.lambda[row] * (x - was);
        }
        CHECK(normal >= -1e-11 * scale);
        CHECK(std::abs(load_work(*s, du) - stored - D - 0.5 * du.dot(Kdu) - normal) < 1e-10 * scale);
        u = now.u;
        lambda = now.lambda;
        slip = s->slip();
        before = s.get();
      }
      CHECK(dissipated > 0);
      // Nothing changed in the last step but one: it dissipates nothing.
      CHECK(steps[6]->friction_energy() < 1e-12 * std::abs(steps[6]->energy()));
      CHECK(steps[6]->result().state.u.here().isApprox(steps[5]->result().state.u.here(), 1e-9));
    }
}

TEST_CASE("the steps of a history share one factorisation, and each is what a solve of its own gives") {
  const Rubbed r = rubbed(2, &problem::laws::coulomb, 0.35);
  Monitor quiet;
  const auto last = scene::solve(r.scene, {}, {}, quiet, r.steps);
  std::shared_ptr<const scene::Solution> alone;
  const auto steps = last->steps();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    CHECK(steps[k]->clock().factor == steps[0]->clock().factor);
    CHECK((steps[k]->model().problem.blocks[0].K.rows() == 0) == (k + 1 < steps.size()));
    scene::Start start;
    start.after = alone;
    alone = scene::solve(r.scene, {}, start, quiet, {r.steps[k]});
    CHECK((alone->result().state.u.here() - steps[k]->result().state.u.here()).norm() < 1e-10 * alone->result().state.u.here().norm());
    const auto whole = [](const scene::Solution& s) { return std::accumulate(s.dissipated().begin(), s.dissipated().end(), 0.0); };
    CHECK(std::abs(whole(*alone) - whole(*steps[k])) < 1e-10 * std::abs(alone->energy()));
  }
}

#include "scene/solve/breaking.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace dotyk::scene {
namespace {

using Kind = problem::SupportLaw::Kind;

constexpr double kEqual = 1e-9;  // forces whose relative difference may be the solver's

/// Calls visit(body, LawSupport, node) for every node of every breaking law.
template <class Visit>
void for_each_breaking(const std::vector<Body>& bodies, Visit&& visit) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t s = 0; s < bodies[b].laws.size(); ++s)
      if (bodies[b].laws[s].normal.kind == Kind::breaking)
        for (std::size_t k = 0; k < bodies[b].laws[s].nodes.size(); ++k) visit(b, s, k);
}

}  // namespace

bool may_break(const std::vector<Body>& bodies) {
  bool any = false;
  for_each_breaking(bodies, [&](auto, auto, auto) { any = true; });
  return any;
}

int break_worst(const Model& model, const algebra::Vector& lambda, std::vector<Body>& bodies) {
  const auto overload = [&](std::size_t b, std::size_t s, std::size_t k) {
    const LawSupport& on = model.bodies[b].laws[s];
    const int row = model.support_row[b][s][k].normal;
    if (row < 0 || on.breaks(k) || !(lambda[row] > 0)) return 0.0;
    return lambda[row] / (on.normal.limit * on.nodes[k].weight);
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

void take_broken(const std::vector<Body>& from, std::vector<Body>& to) {
  for (std::size_t b = 0; b < from.size() && b < to.size(); ++b)
    for (const LawSupport& known : from[b].laws)
      for (LawSupport& on : to[b].laws)
        if (on.part == known.part && on.normal.kind == Kind::breaking) on.broken = known.broken;
}

std::string cascade_note(const Model& model, const algebra::Vector& u, int rounds) {
  int broken = 0, back = 0;
  std::vector<std::vector<double>> moved;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) moved.push_back(model.displacement(static_cast<int>(b), u));
  for_each_breaking(model.bodies, [&](auto b, auto s, auto k) {
    const LawSupport& on = model.bodies[b].laws[s];
    if (!on.breaks(k)) return;
    const int dim = model.bodies[b].dimension();
    double against = 0;
    for (int i = 0; i < dim; ++i) against += moved[b][static_cast<std::size_t>(on.nodes[k].node) * dim + i] * on.nodes[k].normal[i];
    ++broken;
    back += on.normal.value * against < (1 - kEqual) * on.normal.limit;
  });
  if (broken == 0) return "";
  std::string note = text("; ", broken, broken == 1 ? " node is" : " nodes are", " broken, those of this load in ", rounds,
                          rounds == 1 ? " round" : " rounds", ", the worst first: ");
  return note + (back > 0 ? text(back, " of them came back by more than what broke them: this state is what the cascade leaves, and no "
                                       "local minimum of the energy")
                          : "one local minimum of the energy, perhaps of several");
}

}  // namespace dotyk::scene

// moves = { … } of dotyk.shape: the design variables.
#include "script/bind/bind.hpp"
#include "script/bind/shape/bind_shape.hpp"
#include "script/bind/scene/space.hpp"
#include "shape/design/bspline.hpp"
#include "shape/design/extension.hpp"

namespace dotyk::script {
namespace {

using shape::Extension;
using shape::Velocities;

std::vector<Key> move_keys() {
  const Key bound = key::number("", "");
  return {key::object<scene::Part>("part", "a part that moves, by a B-spline").otherwise("body and velocity"),
          key::either("control_points", {key::integer("", "").at_least(2), key::list("", key::integer("", "").at_least(2), "").count(2)},
                      "of the B-spline, a design variable each; in space also two numbers, along the longest and the second longest extent of the part").fallback(6.0),
          key::integer("degree", "of the B-spline").within(1, 3).into(&shape::ControlPoints::degree),
          key::vector("direction", "in which control points go; its length scales the variables").otherwise("along the outward normal"),
          key::boolean("symmetric", "control points mirrored at the middle of the part are one variable").fallback(false),
          key::choice<Extension>("extension", {{"harmonic", Extension::harmonic}, {"structured", Extension::structured}},
                      "how the mesh follows: each component harmonic, or linear along the lines of a grid to the opposite side (in the plane)").fallback(Extension::harmonic),
          key::list("fixed", key::object<scene::Part>("", ""), "parts of the body that stay").otherwise("what is not beside the moving part stays by itself"),
          key::object<scene::Body>("body", "a body whose nodes move by one variable, as velocity says").otherwise("part"),
          key::function("velocity", "f(x, y[, z]) → components of a node's velocity per unit of the variable"),
          key::either("lower", {bound, key::vector("", "")}, "least value of the variables, or one each").required().unit("length"),
          key::either("upper", {bound, key::vector("", "")}, "greatest value, likewise").required().unit("length"),
          key::either("start", {bound, key::vector("", "")}, "of the first design, likewise; 0 is the shape as it was set up").fallback(0.0).unit("length")};
}

/// A number for all, or one each.
void append(const Arguments& move, const char* name, std::size_t count, double fallback, std::vector<double>& values) {
  if (!move.has(name) || move.is(name, LUA_TNUMBER)) {
    values.insert(values.end(), count, move.has(name) ? move.number(name) : fallback);
    return;
  }
  const std::vector<double> each = move.vector(name);
  if (each.size() != count) throw InputError(text("'", name, "' has ", each.size(), " entries; these are ", count, " design variables"));
  values.insert(values.end(), each.begin(), each.end());
}

/// More than a part has nodes are refused later; this many fit an int.
int counted(long long points) { return static_cast<int>(std::min(points, 1000000LL)); }

std::vector<std::vector<double>> by_spline(const Arguments& move, const scene::Scene& scene) {
  const auto part = move.object<scene::Part>("part");
  auto points = move.filled<shape::ControlPoints>();
  if (move.has("control_points") && !move.is("control_points", LUA_TNUMBER)) {
    if (scene.dimension() == 2) throw InputError("'control_points' are two numbers, for parts in space; in the plane give one");
    const auto counts = move.integers("control_points");
    for (int k = 0; k < 2; ++k) points.count[k] = counted(counts[static_cast<std::size_t>(k)]);
  } else if (move.has("control_points")) {
    points.count[0] = points.count[1] = counted(move.integer("control_points"));
  }
  if (move.has("direction")) points.direction = point_of(move.vector("direction"), scene.dimension(), "direction");
  shape::BoundaryMotion motion = bspline_motion(*part, points);
  if (move.boolean("symmetric")) {
    if (scene.dimension() == 3) throw InputError("'symmetric' is for parts in the plane");
    motion = combined(std::move(motion), shape::symmetric_ties(points.count[0]));
  }
  std::vector<scene::Part> fixed;
  if (move.has("fixed"))
    for (const auto& stays : move.objects<scene::Part>("fixed")) fixed.push_back(*stays);
  return extend(motion, fixed, move.choice<Extension>("extension"));
}

std::vector<double> by_function(const Arguments& move, const scene::Body& body) {
  return at_nodes(Field(move.function("velocity"), static_cast<std::size_t>(body.dimension())), *body.mesh);
}

void read(const Arguments& move, const scene::Scene& scene, Variables& variables) {
  if (move.has("part") == move.has("velocity") || move.has("body") != move.has("velocity"))
    throw InputError("an entry of 'moves' has either part, moved by a B-spline, or body and velocity");
  const scene::Body* body = move.has("part") ? move.object<scene::Part>("part")->body.get() : move.object<scene::Body>("body").get();
  if (move.has("velocity"))
    for (const char* name : {"control_points", "degree", "direction", "symmetric", "extension", "fixed"})
      if (move.has(name)) throw InputError(text("'", name, "' belongs to part, which a B-spline moves, not to velocity"));
  const int index = scene.index_of(body);
  if (index < 0) throw InputError(text("'", body->name, "' is not of the scene"));
  const auto fields = move.has("part") ? by_spline(move, scene) : std::vector<std::vector<double>>{by_function(move, *body)};
  for (const auto& field : fields) {
    variables.velocities.emplace_back(scene.bodies.size());
    variables.velocities.back()[static_cast<std::size_t>(index)] = field;
  }
  append(move, "lower", fields.size(), 0, variables.lower);
  append(move, "upper", fields.size(), 0, variables.upper);
  append(move, "start", fields.size(), 0, variables.start);
}

}  // namespace

Key moves_key() {
  return key::list("moves", key::table("", move_keys(), ""), "what moves: parts by B-splines, or bodies by functions").count(1, 256).required();
}

Variables read_moves(const Call& call, const scene::Scene& scene) {
  Variables variables;
  const std::vector<Arguments> moves = call.tables("moves");
  for (std::size_t k = 0; k < moves.size(); ++k) {
    try {
      read(moves[k], scene, variables);
    } catch (const InputError& error) {
      if (moves.size() == 1) throw;
      throw InputError(text("'moves': entry ", k + 1, ": ", error.what()));
    }
  }
  for (std::size_t i = 0; i < variables.lower.size(); ++i)
    if (!(variables.lower[i] <= variables.upper[i]))
      throw InputError(text("design variable ", i + 1, " has lower = ", variables.lower[i], " above upper = ", variables.upper[i]));
  return variables;
}

}  // namespace dotyk::script

// dotyk.shape: design variables, what is sought, one design at a time.
#include "script/bind/shape/bind_shape.hpp"

#include "scene/model/moved.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"
#include "shape/design/bspline.hpp"
#include "shape/design/extension.hpp"

namespace dotyk::script {
namespace {

using algebra::Vector;
using shape::Extension;
using shape::Velocities;

const std::vector<std::string> kQuantities = {"compliance", "volume", "peak_pressure"};

std::shared_ptr<const shape::Quantity> built_in(const std::string& name, double exponent) {
  if (name == "compliance") return shape::compliance();
  if (name == "volume") return shape::volume();
  return shape::peak_pressure(exponent);
}

/// A function of a script as a quantity, called once a design.
class FunctionQuantity final : public shape::Quantity {
 public:
  FunctionQuantity(Function function, lua_State* L, const Shape& shape, std::string what)
      : function_(std::move(function)), L_(L), shape_(shape), what_(std::move(what)) {}
  std::string name() const override { return "function"; }
  double value(const shape::DesignState& state) const override { return at(state).value; }
  Vector gradient(const shape::DesignState& state) const override { return at(state).gradient; }

 private:
  const Dual& at(const shape::DesignState& state) const {
    if (known_of_ == state.solution()) return known_;
    const auto design = std::make_shared<Design>(state.shared_from_this(), shape_);
    design->derivatives = shape_.step == 0;
    function_.result(design);
    known_ = take_dual(L_, design->derivatives ? state.space().variables() : 0, what_);
    known_of_ = state.solution();
    return known_;
  }

  Function function_;
  lua_State* L_;
  const Shape& shape_;
  std::string what_;
  mutable std::shared_ptr<const scene::Solution> known_of_;
  mutable Dual known_;
};

/// A function is kept, under that name, with the shape on top of the stack.
QuantityChoice quantity_choice(const Call& call, const Arguments& from, const char* key, double exponent, const std::string& kept) {
  if (!from.is(key, LUA_TFUNCTION)) return {"", built_in(from.text(key), exponent)};
  call.keep(-1, kept, from.slot(key));
  return {kept, nullptr};
}

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
void append(const Arguments& move, const char* name, std::size_t count, algebra::Vector& values) {
  const bool each = move.is(name, LUA_TTABLE);
  const auto more = each ? move.vector(name) : std::vector<double>(count, move.number(name));
  if (more.size() != count) throw InputError(text("'", name, "' has ", more.size(), " entries; these are ", count, " design variables"));
  const algebra::Vector before = values;
  values.resize(before.size() + static_cast<Eigen::Index>(count));
  values << before, vector_of(more);
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

void read(const Arguments& move, const scene::Scene& scene, Shape& shape, std::vector<Velocities>& velocities) {
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
    velocities.emplace_back(scene.bodies.size());
    velocities.back()[static_cast<std::size_t>(index)] = field;
  }
  append(move, "lower", fields.size(), shape.lower);
  append(move, "upper", fields.size(), shape.upper);
  append(move, "start", fields.size(), shape.start);
}

/// What `moves` makes: velocities, and the shape's lower, upper and start.
std::vector<Velocities> read_moves(const Call& call, const scene::Scene& scene, Shape& shape) {
  std::vector<Velocities> velocities;
  const std::vector<Arguments> moves = call.tables("moves");
  for (std::size_t k = 0; k < moves.size(); ++k) {
    try {
      read(moves[k], scene, shape, velocities);
    } catch (const InputError& error) {
      if (moves.size() == 1) throw;
      throw InputError(text("'moves': entry ", k + 1, ": ", error.what()));
    }
  }
  for (Eigen::Index i = 0; i < shape.lower.size(); ++i)
    if (!(shape.lower[i] <= shape.upper[i]))
      throw InputError(text("design variable ", i + 1, " has lower = ", shape.lower[i], " above upper = ", shape.upper[i]));
  return velocities;
}

Key quantity_key(const char* name, const char* help) {
  return key::either(name, {key::choice("", kQuantities, ""), key::function("", "f(design) → a number or dual number")}, help);
}

std::vector<Key> constraint_keys() {
  return {quantity_key("quantity", "what").required(), key::number("most", "its greatest value").otherwise("of volume: the first design's")};
}

std::vector<Key> shape_keys() {
  return {key::object<scene::Scene>("scene", "the first design").required(),
          key::list("moves", key::table("", move_keys(), ""), "what moves: parts by B-splines, or bodies by functions").count(1, 256).required(),
          quantity_key("objective", "what is to be least: compliance is minus the least energy (friction's included); peak_pressure is smoothed, see exponent; a function "
                                    "gets a design and computes with its dual numbers").fallback("compliance"),
          key::list("constraints", key::table("", constraint_keys(), ""), "quantities that are to stay below a bound").otherwise("none but the variables' bounds"),
          key::number("exponent", "q of peak_pressure, (mean of p^q over the contacts)^(1/q)").at_least(1).into(&Shape::exponent),
          key::object<Solver>("method", "how each design is solved").otherwise("as dotyk.solve"),
          key::number("differences", "h: forward differences instead of exact derivatives, to compare").above(0).unit("length").otherwise("exact derivatives").into(&Shape::step)};
}

void take_constraint(const Call& call, const Arguments& item, Shape& shape) {
  const std::string kept = text("constraint ", shape.constraints.size() + 1);
  shape.constraints.push_back(quantity_choice(call, item, "quantity", shape.exponent, kept));
  const bool volume = item.is("quantity", LUA_TSTRING) && item.text("quantity") == "volume";
  if (!item.has("most") && !volume) throw InputError(text(kept, " needs 'most', its greatest value"));
  shape.most.push_back(item.has("most") ? item.number("most") : shape::volume_of(shape.space->first()));
}

Given<Shape> make_shape(Call& call) {
  auto shape = std::make_shared<Shape>(call.filled<Shape>());
  // The scene and its bodies may be added to later; designs are of them as they are now.
  const auto first = std::shared_ptr<const scene::Scene>(scene::copy(*call.object<scene::Scene>("scene")));
  shape->space = std::make_shared<const shape::DesignSpace>(first, read_moves(call, *first, *shape));
  shape->places = std::make_shared<Places>(shape->space->first());
  if (call.has("method")) shape->method = call.object<Solver>("method")->method;
  const auto constraints = call.tables("constraints");
  const auto given = call.give_keeping(shape, {});
  shape->objective = quantity_choice(call, call, "objective", shape->exponent, "objective");
  for (const Arguments& item : constraints) take_constraint(call, item, *shape);
  return given;
}

std::shared_ptr<Design> design(Call& call) {
  const auto shape = call.self<Shape>();
  const Vector alpha = call.has("alpha") ? variables_of(call.vector("alpha"), *shape->space, "alpha") : shape->start;
  Watch watch(call.state(), "solving");
  const auto state = std::make_shared<const shape::DesignState>(shape->space, alpha, shape->method, nullptr, std::make_shared<shape::Cost>(), watch);
  watch.judge(state->solution()->result());
  watch.answer();
  return std::make_shared<Design>(state, *shape);
}

}  // namespace

Vector variables_of(const std::vector<double>& values, const shape::DesignSpace& space, const char* what) {
  if (static_cast<int>(values.size()) != space.variables())
    throw InputError(text("'", what, "' has ", values.size(), " components; there are ", space.variables(), " design variables"));
  return vector_of(values);
}

Sought sought(const Call& call, const Shape& shape) {
  const auto take = [&](const QuantityChoice& choice) -> std::shared_ptr<const shape::Quantity> {
    if (choice.quantity) return choice.quantity;
    return std::make_shared<FunctionQuantity>(call.kept_function(1, choice.kept).front(), call.state(), shape, "the function of " + (choice.kept == "objective" ? "the objective" : choice.kept));
  };
  Sought sought{take(shape.objective), {}};
  for (std::size_t j = 0; j < shape.constraints.size(); ++j) sought.constraints.push_back({take(shape.constraints[j]), shape.most[j]});
  return sought;
}

void bind_shape(Library& library) {
  bind_design(library);
  library.module("dotyk.dual", "Functions of dual numbers, values with their derivatives, for functions of designs; + - * / ^ and comparisons work as on numbers.");
  library.function(
      {.name = "dotyk.shape",
       .help = "Shapes of a scene: design variables move parts of its bodies, meshes follow, and the solution's derivatives are exact, contact "
               "included. Nodes are at X + sum of alpha_i V_i, X as the scene was set up, V_i made once. Loads and stiffnesses per length or area, "
               "prescribed displacements, friction and gaps given go with their material points, contacts keep their pairs of nodes.\n"
               "Where all contact is with force, derivatives are linear in the direction (and cost an adjoint solve); where nodes touch without "
               "force they solve a quadratic program, one for each direction. Friction at the edge of slip has none and is refused.",
       .setup = setup::shape(),
       .example = "local design = shape:design{ 0.01, 0, 0, 0, 0.01 }\n"
                  "print(design.peak_pressure.value, design.peak_pressure.gradient[1])",
       .arguments = {key::table(shape_keys())},
       .run = make_shape});
  library.type<Shape>("A scene whose parts may move, and what is sought.")
      .setup(setup::shape())
      .field("variables", "how many design variables there are", [](const Shape& s) { return s.space->variables(); })
      .field("lower", "their least values", [](const Shape& s) { return std::vector<double>(s.lower.begin(), s.lower.end()); }, "length")
      .field("upper", "their greatest values", [](const Shape& s) { return std::vector<double>(s.upper.begin(), s.upper.end()); }, "length")
      .method({.name = "shape:design",
               .help = "Solves one design.",
               .example = "local d = shape:design()\nprint(d.compliance)",
               .arguments = {key::vector("alpha", "the design variables, also beyond their bounds").count(1, 4096).unit("length").otherwise("the first design")},
               .run = design})
      .text([](const Shape& s) {
        return text("shape: ", s.space->variables(), " design variables, least ", s.objective.name(), ", ", s.constraints.size(), " constraints");
      });
  bind_optimum(library);
}

}  // namespace dotyk::script

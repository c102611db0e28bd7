// dotyk.shape: design variables, what is sought, one design at a time.
#include "script/bind/shape/bind_shape.hpp"

#include "scene/model/moved.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

using algebra::Vector;

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
      : function_(std::move(function)), L_(L), places_(shape.places), exponent_(shape.exponent), exact_(shape.step == 0), what_(std::move(what)) {}
  std::string name() const override { return "function"; }
  double value(const shape::DesignState& state) const override { return at(state).value; }
  Vector gradient(const shape::DesignState& state) const override { return at(state).gradient; }

 private:
  const Dual& at(const shape::DesignState& state) const {
    if (known_of_ == state.solution()) return known_;
    const auto design = std::make_shared<Design>();
    design->state = state.shared_from_this();
    design->places = places_;
    design->exponent = exponent_;
    design->derivatives = exact_;
    function_.result(design);
    known_ = take_dual(L_, exact_ ? state.space().variables() : 0, what_);
    known_of_ = state.solution();
    return known_;
  }

  Function function_;
  lua_State* L_;
  std::shared_ptr<Places> places_;
  double exponent_;
  bool exact_;
  std::string what_;
  mutable std::shared_ptr<const scene::Solution> known_of_;
  mutable Dual known_;
};

QuantityChoice quantity_choice(const Arguments& from, const char* key, double exponent, const std::string& kept) {
  if (from.is(key, LUA_TFUNCTION)) return {kept, nullptr};
  return {"", built_in(from.text(key), exponent)};
}

Key quantity_key(const char* name, const char* help) {
  return key::either(name, {key::choice("", kQuantities, ""), key::function("", "f(design) → a number or dual number")}, help);
}

std::vector<Key> constraint_keys() {
  return {quantity_key("quantity", "what").required(), key::number("most", "its greatest value").otherwise("of volume: the first design's")};
}

std::vector<Key> shape_keys() {
  return {key::object<scene::Scene>("scene", "the first design").required(),
          moves_key(),
          quantity_key("objective", "what is to be least: compliance is minus the least energy (friction's included); peak_pressure is smoothed, see exponent; a function "
                                    "gets a design and computes with its dual numbers").fallback("compliance"),
          key::list("constraints", key::table("", constraint_keys(), ""), "quantities that are to stay below a bound").otherwise("none but the variables' bounds"),
          key::number("exponent", "q of peak_pressure, (mean of p^q over the contacts)^(1/q)").at_least(1).into(&Shape::exponent),
          key::object<Solver>("method", "how each design is solved").otherwise("as dotyk.solve"),
          key::number("differences", "h: forward differences instead of exact derivatives, to compare").above(0).unit("length").otherwise("exact derivatives").into(&Shape::step)};
}

/// The constraints, their bounds and functions: these are kept with the shape on top of the stack.
void take_constraints(Call& call, Shape& shape, const shape::DesignSpace& space) {
  for (const Arguments& item : call.tables("constraints")) {
    const std::string kept = text("constraint ", shape.constraints.size() + 1);
    shape.constraints.push_back(quantity_choice(item, "quantity", shape.exponent, kept));
    if (item.has("most")) {
      shape.most.push_back(item.number("most"));
    } else if (item.is("quantity", LUA_TSTRING) && item.text("quantity") == "volume") {
      shape.most.push_back(shape::volume_of(space.first()));
    } else {
      throw InputError(text(kept, " needs 'most', its greatest value"));
    }
  }
}

Given<Shape> make_shape(Call& call) {
  auto shape = std::make_shared<Shape>(call.filled<Shape>());
  // The scene and its bodies may be added to later; designs are of them as they are now.
  const auto first = std::shared_ptr<const scene::Scene>(scene::copy(*call.object<scene::Scene>("scene")));
  Variables variables = read_moves(call, *first);
  shape->lower = vector_of(variables.lower);
  shape->upper = vector_of(variables.upper);
  shape->start = vector_of(variables.start);
  shape->space = std::make_shared<const shape::DesignSpace>(first, std::move(variables.velocities));
  shape->places = std::make_shared<Places>(shape->space->first());
  if (call.has("method")) shape->method = call.object<Solver>("method")->method;
  shape->objective = quantity_choice(call, "objective", shape->exponent, "objective");
  take_constraints(call, *shape, *shape->space);
  call.give(shape);
  const int at = lua_gettop(call.state());
  if (!shape->objective.quantity) call.keep(at, "objective", call.slot("objective"));
  const auto items = call.tables("constraints");
  for (std::size_t j = 0; j < items.size(); ++j)
    if (!shape->constraints[j].quantity) call.keep(at, shape->constraints[j].kept, items[j].slot("quantity"));
  lua_settop(call.state(), at);
  return {};
}

std::shared_ptr<Design> design(Call& call) {
  const auto shape = call.self<Shape>();
  const Vector alpha = call.has("alpha") ? variables_of(call.vector("alpha"), *shape->space, "alpha") : shape->start;
  Watch watch(call.state(), "solving");
  auto design = std::make_shared<Design>();
  design->state = std::make_shared<const shape::DesignState>(shape->space, alpha, shape->method, nullptr, std::make_shared<shape::Cost>(), watch);
  watch.judge(design->state->solution()->result());
  watch.answer();
  design->places = shape->places;
  design->exponent = shape->exponent;
  return design;
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

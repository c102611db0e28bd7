// One design: its numbers with their derivatives by the design variables.
#include "script/bind/bind.hpp"
#include "script/bind/shape/bind_shape.hpp"
#include "script/bind/scene/space.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {

void push(lua_State* L, const Dual& dual) {
  luaL_checkstack(L, 8, nullptr);
  push_own_function(L, "dual", "make");
  push(L, dual.value);
  push(L, std::vector<double>(dual.gradient.begin(), dual.gradient.end()));
  lua_call(L, 2, 1);
}

Dual take_dual(lua_State* L, Eigen::Index size, const std::string& what) {
  if (size > 0 && lua_type(L, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1)))
    throw std::runtime_error(what + " returned the number " + number_text(lua_tonumber(L, -1)) + ", which has no derivatives: compute with the design's dual numbers, "
                             "not with what .value and design.solution give, or let dotyk.shape take differences");
  const auto fail = [&](const std::string& why) { throw std::runtime_error(what + why); };
  Dual dual{0, algebra::Vector::Zero(size)};
  if (lua_type(L, -1) == LUA_TNUMBER) {
    dual.value = lua_tonumber(L, -1);
  } else if (lua_istable(L, -1) && meta_text(L, -1, "__name") == "dual number") {
    lua_pushliteral(L, "value");
    lua_rawget(L, -2);
    lua_pushliteral(L, "gradient");
    lua_rawget(L, -3);
    dual.value = lua_tonumber(L, -2);
    if (lua_type(L, -1) != LUA_TTABLE || static_cast<Eigen::Index>(lua_rawlen(L, -1)) != size)
      fail(text(" returned a dual number with another number of derivatives than ", size));
    dual.gradient = vector_of(read_value<std::vector<double>>(L, lua_gettop(L)));
    lua_pop(L, 2);
  } else {
    fail(" returned " + describe_value(L, -1) + ", expected a number or a dual number (what the design's fields and methods give)");
  }
  if (!std::isfinite(dual.value)) fail(std::isnan(dual.value) ? std::string(" returned nan (not a number)") : text(" returned ", dual.value, "; it must be finite"));
  for (Eigen::Index i = 0; i < size; ++i)
    if (!std::isfinite(dual.gradient[i]))
      fail(text(" returned ", dual.value, ", whose derivative by design variable ", i + 1, " is ", std::isnan(dual.gradient[i]) ? "not a number" : "infinite"));
  lua_pop(L, 1);
  return dual;
}

scene::Place Places::find(int body, const mesh::Point& x) {
  auto& locator = locators_[static_cast<std::size_t>(body)];
  const scene::Body& of = *scene_.bodies[static_cast<std::size_t>(body)];
  if (!locator) locator = std::make_unique<scene::Locator>(*of.mesh);
  const auto place = locator->find(x);
  if (!place) throw InputError(text(point_text(x.data(), of.dimension()), " is outside '", of.name, "' as it was first designed"));
  return *place;
}

Dual Design::dual(const shape::Quantity& quantity) const {
  return {quantity.value(*state), derivatives ? quantity.gradient(*state) : algebra::Vector(0)};
}

namespace {

using shape::DesignState;

Eigen::Index size(const Design& d) { return d.derivatives ? d.state->space().variables() : 0; }

int body_index(const Design& d, const scene::Body& body) {
  const int index = d.state->scene().index_of(&body);
  if (index < 0) throw InputError(text("'", body.name, "' is not of the scene that is designed"));
  return index;
}

/// With derivatives of(variable).
template <class Of>
Dual dual(const Design& d, double value, Of&& of) {
  Dual result{value, algebra::Vector(size(d))};
  for (int i = 0; i < result.gradient.size(); ++i) result.gradient[i] = of(i);
  return result;
}

/// Σ φ_a v_a, v node × dimension, empty: zero.
double interpolated(const mesh::Mesh& mesh, const scene::Place& at, const std::vector<double>& v, int component) {
  double sum = 0;
  if (v.empty()) return sum;
  for (int a = 0; a < mesh.topology().nodes; ++a)
    sum += at.shape[static_cast<std::size_t>(a)] * v[static_cast<std::size_t>(mesh.cell(at.cell)[a]) * mesh.dimension() + component];
  return sum;
}

/// A vector of nodes at a material point: value and, with get(variable), derivatives.
template <class Get>
int give_at_point(Call& call, const Design& d, int body, const std::vector<double>& values, Get&& get) {
  const mesh::Mesh& mesh = *d.state->scene().bodies[static_cast<std::size_t>(body)]->mesh;
  const scene::Place at = d.places->find(body, point_of(call, d.state->scene().dimension()));
  for (int k = 0; k < mesh.dimension(); ++k)
    push(call.state(), dual(d, interpolated(mesh, at, values, k), [&](int i) { return interpolated(mesh, at, get(i), k); }));
  return mesh.dimension();
}

int design_displacement(Call& call) {
  const auto d = call.self<Design>();
  const int body = body_index(*d, *call.object<scene::Body>("body"));
  return give_at_point(call, *d, body, d->state->solution()->displacement(body), [&](int i) -> const std::vector<double>& {
    return d->state->derivative(i).displacement[static_cast<std::size_t>(body)];
  });
}

int design_position(Call& call) {
  const auto d = call.self<Design>();
  const int body = body_index(*d, *call.object<scene::Body>("body"));
  return give_at_point(call, *d, body, d->state->scene().bodies[static_cast<std::size_t>(body)]->mesh->coordinates,
                       [&](int i) -> const std::vector<double>& { return d->state->space().variable(i)[static_cast<std::size_t>(body)]; });
}

std::vector<Record> design_contact(Call& call) {
  const auto d = call.self<Design>();
  const auto contact = call.object<scene::Contact>("contact");
  const DesignState& state = *d->state;
  const int index = state.scene().index_of(*contact);
  if (index < 0) throw InputError(text(contact->name, " is not of the scene that is designed"));
  const scene::Contact& of = *state.scene().contacts[static_cast<std::size_t>(index)];
  if (of.kind != scene::Contact::Kind::contact) throw InputError("glued parts have no contact nodes");
  const auto nodes = state.solution()->contact(of).nodes;
  const int body = state.scene().index_of(of.first.body.get());
  const int dimension = state.scene().dimension();
  std::vector<std::vector<shape::ContactValue>> derivatives;  // by variable and node
  for (int i = 0; i < size(*d); ++i) derivatives.push_back(contact_derivatives(*state.solution(), index, state.space().variable(i), state.derivative(i)));
  std::vector<Record> records;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const scene::ContactNode& n = nodes[k];
    const auto with = [&](double value, auto&& of_node) { return dual(*d, value, [&](int i) { return of_node(derivatives[static_cast<std::size_t>(i)][k]); }); };
    Record& record = records.emplace_back(Record{"contact node of a design", {}});
    for (int c = 0; c < dimension; ++c)
      record.add({{std::string(1, "xyz"[c]), dual(*d, n.x[static_cast<std::size_t>(c)], [&](int i) {
                     const std::vector<double>& V = state.space().variable(i)[static_cast<std::size_t>(body)];
                     return V.empty() ? 0.0 : V[static_cast<std::size_t>(n.node) * dimension + c];
                   })}});
    record.add({{"force", with(n.force, std::mem_fn(&shape::ContactValue::force))}, {"gap", with(n.gap, std::mem_fn(&shape::ContactValue::gap))},
                {"weight", with(n.weight, std::mem_fn(&shape::ContactValue::weight))},
                {"pressure", with(n.pressure, [&](const shape::ContactValue& v) { return n.weight > 0 ? (v.force - n.pressure * v.weight) / n.weight : 0.0; })},
                {"status", problem::status_name(n.status)}});
  }
  return records;
}

std::shared_ptr<Design> along(Call& call) {
  const auto d = call.self<Design>();
  const algebra::Vector beta = variables_of(call.vector("direction"), d->state->space(), "direction");
  if ((beta.array() == 0).all()) throw InputError("'direction' is zero; derivatives go along one that moves something");
  auto line = std::make_shared<Design>(*d);
  line->state = std::make_shared<const DesignState>(*d->state, beta);
  line->derivatives = true;
  return line;
}

std::vector<Dual> variables(const Design& d) {
  std::vector<Dual> duals;
  for (Eigen::Index i = 0; i < d.state->alpha().size(); ++i) duals.push_back({d.state->alpha()[i], d.derivatives ? d.state->alpha_gradient(i) : algebra::Vector(0)});
  return duals;
}

}  // namespace

void bind_design(Library& library) {
  library.type<Design>("A design of dotyk.shape, solved. Its numbers are dual numbers: value, and gradient by the design variables (at a "
                       "kink one-sided derivatives, as each variable grows); arithmetic with them and dotyk.dual.sqrt and the like go on differentiating.")
      .setup(setup::shape() + "local design = shape:design{ 0.01, 0, 0, 0, 0.01 }\n")
      .field("alpha", "the design variables", variables, "length")
      .field("compliance", "minus the least energy, that of springs and given friction included: -(energy + friction_energy) of its solution", [](const Design& d) { return d.dual(*shape::compliance()); }, "force·length")
      .field("volume", "of all bodies; area in the plane", [](const Design& d) { return d.dual(*shape::volume()); })
      .field("peak_pressure", "smoothed: (mean of p^q over the contacts)^(1/q), q the exponent of dotyk.shape; the mean is by the first design's length or area", [](const Design& d) { return d.dual(*shape::peak_pressure(d.exponent)); }, "force per area")
      .field("solution", "the solution, for everything else", [](const Design& d) { return d.state->solution(); })
      .field("smooth", "are derivatives linear in the direction? Not where something touches without force", [](const Design& d) { return d.state->sensitivity().smooth(); })
      .field("weak", "the nodes that touch without force, in words; empty where smooth", [](const Design& d) { return d.state->sensitivity().weak_text(); })
      .method({.name = "design:displacement",
               .help = "The displacement, dual numbers, at a point that moves with the mesh.",
               .example = "local ux, uy = design:displacement(block, 0, 0.5)\nprint(uy.value, uy.gradient[1])",
               .arguments = point_keys("a point of the first design, at rest: it moves with the mesh"),
               .run = design_displacement})
      .method({.name = "design:position",
               .help = "Where a point of the first design is in this one, at rest: dual numbers.",
               .example = "local x, y = design:position(block, 0, 0)",
               .arguments = point_keys("a point of the first design, at rest: it moves with the mesh"),
               .run = design_position})
      .method({.name = "design:contact",
               .help = "The nodes of a contact, in order: x, y (z), force, gap, weight, pressure as dual numbers, and status.",
               .example = "local sum = 0\nfor _, n in ipairs(design:contact(contact)) do sum = sum + n.pressure ^ 2 * n.weight end",
               .arguments = {key::object<scene::Contact>("contact", "which contact").required()},
               .run = design_contact})
      .method({.name = "design:along",
               .help = "The same design with derivatives along one direction: gradients have one entry, the one-sided derivative as "
                       "the design moves that way. At a kink it is not the negative of that along the opposite direction.",
               .example = "local forward, backward = design:along{ 1, 0, 0, 0, 0 }, design:along{ -1, 0, 0, 0, 0 }\nprint(forward.peak_pressure.gradient[1])",
               .arguments = {key::vector("direction", "an entry a design variable").count(1, 4096).required()},
               .run = along})
      .text([](const Design& d) {
        std::string alpha;
        for (const double a : d.state->alpha()) alpha += (alpha.empty() ? "" : ", ") + text(a);
        const solver::Result& result = d.state->solution()->result();
        return text("design: alpha = (", alpha, "), volume ", shape::volume()->value(*d.state), ", energy ", d.state->solution()->energy(),
                    result.converged ? "" : ", NOT CONVERGED: " + result.reason);
      });
}

}  // namespace dotyk::script

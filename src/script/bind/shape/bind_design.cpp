// One design: its numbers with their derivatives by the design variables.
#include "script/bind/bind.hpp"
#include "script/bind/shape/bind_shape.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {

scene::Place Places::find(int body, const mesh::Point& x) {
  auto& locator = locators_[static_cast<std::size_t>(body)];
  const scene::Body& of = *scene_.bodies[static_cast<std::size_t>(body)];
  if (!locator) locator = std::make_unique<scene::Locator>(*of.mesh);
  const auto place = locator->find(x);
  if (!place) throw InputError(text("(", x[0], ", ", x[1], of.dimension() == 3 ? text(", ", x[2]) : "", ") is outside '", of.name, "' as it was first designed"));
  return *place;
}

Dual Design::dual(const shape::Quantity& quantity) const {
  return {quantity.value(*state), derivatives ? quantity.gradient(*state) : algebra::Vector(0)};
}

namespace {

using shape::DesignState;
using shape::Velocities;

Eigen::Index size(const Design& d) { return d.derivatives ? d.state->space().variables() : 0; }

int body_index(const Design& d, const scene::Body& body) {
  const int index = d.state->scene().index_of(&body);
  if (index < 0) throw InputError(text("'", body.name, "' is not of the scene that is designed"));
  return index;
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
  for (int k = 0; k < mesh.dimension(); ++k) {
    Dual dual{interpolated(mesh, at, values, k), algebra::Vector::Zero(size(d))};
    for (int i = 0; i < dual.gradient.size(); ++i) dual.gradient[i] = interpolated(mesh, at, get(i), k);
    push(call.state(), dual);
  }
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

int contact_index(const Design& d, const scene::Contact& contact) {
  const int index = d.state->scene().index_of(contact);
  if (index < 0) throw InputError(text(contact.name, " is not of the scene that is designed"));
  return index;
}

int design_contact(Call& call) {
  const auto d = call.self<Design>();
  lua_State* L = call.state();
  const DesignState& state = *d->state;
  const int index = contact_index(*d, *call.object<scene::Contact>("contact"));
  const scene::Contact& of = *state.scene().contacts[static_cast<std::size_t>(index)];
  if (of.kind != scene::Contact::Kind::contact) throw InputError("glued parts have no contact nodes");
  const auto nodes = state.solution()->contact(of).nodes;
  const int body = state.scene().index_of(of.first.body.get());
  const int dimension = state.scene().dimension();
  std::vector<std::vector<shape::ContactValue>> derivatives;
  for (int i = 0; i < size(*d); ++i) derivatives.push_back(contact_derivatives(*state.solution(), index, state.space().variable(i), state.derivative(i)));
  const auto dual = [&](double value, auto&& of_variable) {
    Dual result{value, algebra::Vector(size(*d))};
    for (int i = 0; i < result.gradient.size(); ++i) result.gradient[i] = of_variable(i);
    return result;
  };
  lua_createtable(L, static_cast<int>(nodes.size()), 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const scene::ContactNode& n = nodes[k];
    lua_createtable(L, 0, 8);
    const auto set = [&](const char* name, const auto& value) {
      push(L, value);
      lua_setfield(L, -2, name);
    };
    for (int c = 0; c < dimension; ++c)
      set(c == 0 ? "x" : c == 1 ? "y" : "z", dual(n.x[static_cast<std::size_t>(c)], [&](int i) {
            const std::vector<double>& V = state.space().variable(i)[static_cast<std::size_t>(body)];
            return V.empty() ? 0.0 : V[static_cast<std::size_t>(n.node) * dimension + c];
          }));
    set("force", dual(n.force, [&](int i) { return derivatives[static_cast<std::size_t>(i)][k].force; }));
    set("gap", dual(n.gap, [&](int i) { return derivatives[static_cast<std::size_t>(i)][k].gap; }));
    set("weight", dual(n.weight, [&](int i) { return derivatives[static_cast<std::size_t>(i)][k].weight; }));
    set("pressure", dual(n.pressure, [&](int i) {
          const shape::ContactValue& v = derivatives[static_cast<std::size_t>(i)][k];
          return n.weight > 0 ? (v.force - n.pressure * v.weight) / n.weight : 0.0;
        }));
    set("status", std::string(problem::status_name(n.status)));
    make_strict(L, "contact node of a design");
    lua_rawseti(L, -2, static_cast<lua_Integer>(k) + 1);
  }
  return 1;
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

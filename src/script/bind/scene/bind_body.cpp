#include "multigrid/multigrid.hpp"
#include "script/bind/bind.hpp"
#include "script/help/nearest.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

using scene::Body;
using scene::Part;

Given<Material> make_material(Call& call) {
  auto material = std::make_shared<Material>(call.filled<Material>());
  if (call.has("stiffness")) {
    if (call.has("E") || call.has("nu")) throw InputError("give either E and nu, or stiffness, not both");
    const auto rows = call.matrix("stiffness");
    material->stiffness = elasticity::from_voigt(dense_matrix(rows, static_cast<Eigen::Index>(rows.size()), "stiffness",
                                                              "the matrix must be 3x3 (plane) or 6x6 (space)"));
    return call.give_keeping(material, {});
  }
  if (!call.has("E")) throw InputError("E is missing: give E and nu, or a stiffness matrix");
  if (!call.is("E", LUA_TFUNCTION)) material->E = call.field("E")({})[0];
  if (!call.is("nu", LUA_TFUNCTION)) material->nu = call.has("nu") ? call.field("nu")({})[0] : 0.3;
  elasticity::check_isotropic(material->E.value_or(1), material->nu.value_or(0), material->plane == elasticity::Plane::stress);
  return call.give_keeping(material, {"E", "nu"});
}

std::string material_text(const Material& m) {
  if (m.stiffness) return text("material: general stiffness, ", m.stiffness->dimension, "-D");
  const auto shown = [](const std::optional<double>& value) { return value ? text(*value) : "function"; };
  return "material: E = " + shown(m.E) + ", nu = " + shown(m.nu) + ", plane " +
         (m.plane == elasticity::Plane::strain ? "strain" : "stress");
}

/// The material on a mesh, cell by cell where E or nu is a function.
elasticity::MaterialField material_field(const Call& call, const Material& material, const mesh::Mesh& mesh) {
  if (material.stiffness) return elasticity::MaterialField(*material.stiffness);
  const int dim = mesh.dimension();
  const bool plane_stress = dim == 2 && material.plane == elasticity::Plane::stress;
  if (material.E && material.nu) {
    elasticity::check_isotropic(*material.E, *material.nu, plane_stress);  // in space "plane" says nothing
    return elasticity::MaterialField(elasticity::isotropic(*material.E, *material.nu, dim, material.plane));
  }
  const auto sample = [&](const std::optional<double>& constant, const char* name) {
    std::vector<double> values(mesh.cell_count(), constant.value_or(0));
    if (constant) return values;
    const Function f = call.kept_function(call.slot("material"), name).at(0);
    for (int c = 0; c < mesh.cell_count(); ++c) {
      const mesh::Point x = mesh.cell_centre(c);
      values[c] = f.number({x.data(), static_cast<std::size_t>(dim)});
    }
    return values;
  };
  auto E = sample(material.E, "E"), nu = sample(material.nu, "nu");
  for (int c = 0; c < mesh.cell_count(); ++c) try {
      elasticity::check_isotropic(E[c], nu[c], plane_stress);
    } catch (const InputError& error) {
      throw InputError(text("material at ", point_text(mesh.cell_centre(c).data(), dim), ": ", error.what()));
    }
  return {std::move(E), std::move(nu), dim, material.plane};
}

std::shared_ptr<Body> make_body(Call& call) {
  const auto mesh = call.object<MeshHandle>("mesh")->mesh;
  const auto material = call.object<Material>("material");
  elasticity::VectorField force;
  if (call.has("force")) force = vector_field(call.field("force", mesh->dimension()), mesh->dimension());
  const auto times = call.has("refine") ? call.integer("refine") : 0;
  if (times == 0) return scene::make_body(call.text("name"), mesh, material_field(call, *material, *mesh), force);
  if (multigrid::count_ranks() == 1) require_room_to_refine(*mesh, times);
  Watch watch(call.state(), "refining");
  return scene::make_refined_body(call.text("name"), mesh, material_field(call, *material, *mesh), static_cast<int>(times), force, watch);
}

std::shared_ptr<Part> make_part(Call& call) {
  const auto body = call.self<Body>();
  const std::string name = call.text("name");
  if (!call.has("chosen")) {
    const auto known = scene::part_names(*body);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string near = nearest(name, known);
      if (!near.empty()) throw InputError(text("'", body->name, "' has no part '", name, "', did you mean '", near, "'?"));
    }
    return std::make_shared<Part>(scene::named_part(body, name));
  }
  const Function chosen = call.function("chosen");
  const auto dim = static_cast<std::size_t>(body->dimension());
  return std::make_shared<Part>(
      scene::chosen_part(body, name, [&](const mesh::Point& x, const mesh::Point& n) {
        std::vector<double> arguments(x.begin(), x.begin() + dim);
        arguments.insert(arguments.end(), n.begin(), n.begin() + dim);
        return chosen.truth(arguments);
      }));
}

/// Refuses "z" in the plane.
void require_axis(const Part& part, int axis) {
  if (axis >= part.body->dimension())
    throw InputError(text("component 'z' does not exist: '", part.body->name, "' is 2-D"));
}

Self fix(Call& call) {
  auto part = call.self<Part>();
  std::array<bool, 3> components{false, false, false};
  bool any = false;
  for (const char* name : {"first", "second", "third"})
    if (call.has(name)) {
      require_axis(*part, static_cast<int>(call.choice(name)));
      components[call.choice(name)] = any = true;
    }
  if (!any) components = {true, true, true};
  scene::fix(*part, components);
  return call.give_self();
}

Self slide(Call& call) {
  scene::slide(*call.self<Part>());
  return call.give_self();
}

Self part_support(Call& call) {
  if (!call.has("normal") && !call.has("tangential")) throw InputError("name at least one law: normal or tangential");
  const auto part = call.self<Part>();
  const int dimension = part->body->dimension();
  scene::support(*part, given_law(call, "normal", dimension), given_law(call, "tangential", dimension));
  return call.give_self();
}

/// The fields given under x, y, z.
std::array<elasticity::ScalarField, 3> components(const Call& call, const Part& part) {
  std::array<elasticity::ScalarField, 3> result;
  const char* const axis[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    if (call.has(axis[i])) {
      require_axis(part, i);
      result[i] = scalar_field(call.field(axis[i]), part.body->dimension());
    }
  if (!result[0] && !result[1] && !result[2]) throw InputError("name at least one component: x, y or z");
  return result;
}

std::string load_case_of(const Call& call) { return call.has("case") ? call.text("case") : ""; }

Self displace(Call& call) {
  auto part = call.self<Part>();
  scene::displace(*part, components(call, *part), load_case_of(call));
  return call.give_self();
}

Self spring(Call& call) {
  auto part = call.self<Part>();
  scene::spring(*part, components(call, *part));
  return call.give_self();
}

Self load_part(Call& call) {
  auto part = call.self<Part>();
  const int dimension = part->body->dimension();
  scene::load(*part, vector_field(call.field("traction", dimension), dimension), load_case_of(call));
  return call.give_self();
}

Self pressure(Call& call) {
  auto part = call.self<Part>();
  scene::pressure(*part, scalar_field(call.field("value"), part->body->dimension()), load_case_of(call));
  return call.give_self();
}

std::string show_body(const Body& b) {
  return text("body '", b.name, "': ", b.mesh->topology().name, " ", b.mesh->topology().shapes, ", ",
              b.node_count(), " nodes, ", b.supports.size() + b.laws.size() + (b.slides.empty() ? 0 : 1), " supports");
}

Key component(const char* name) { return key::choice(name, {"x", "y", "z"}, "a component"); }

Key load_case() {
  return key::string("case", "a name by which the steps of a history scale it apart from others (dotyk.solve, steps)");
}

std::vector<Key> component_keys(const std::string& help, const std::string& unit) {
  const auto one = [&](const char* name) { return key::field(name, help).unit(unit); };
  return {one("x"), one("y"), one("z")};
}

void bind_part(Library& library) {
  library.type<Part>("Some boundary facets of a body, to hold, load or put in contact.")
      .setup(setup::block() + "local top = block:part \"top\"\n")
      .field("name", "its name", &Part::name)
      .field("body", "the body it is of", &Part::body)
      .field("facet_count", "number of facets", [](const Part& p) { return p.facets.size(); })
      .method({.name = "part:fix",
               .help = "Holds the displacement at zero: all components, or those named.",
               .example = "block:part\"bottom\":fix()\nblock:part\"left\":fix \"x\"",
               .arguments = {component("first"), component("second"), component("third")},
               .run = fix})
      .method({.name = "part:slide",
               .help = "Bilateral contact without friction: no displacement along the normal. At an edge between two "
                       "sides of the part it holds for both normals.",
               .example = "block:part\"left\":slide()",
               .run = slide})
      .method({.name = "part:displace",
               .help = "Prescribes displacement components; those not named stay free.",
               .example = "block:part\"right\":displace{ x = 0.01 }\nblock:part\"top\":displace{ y = -0.1, case = \"press\" }",
               .arguments = {key::table(joined(component_keys("displacement, a number or a function of the coordinates", "length"), {load_case()}))},
               .run = displace})
      .method({.name = "part:load",
               .help = "A load per length (2-D) or area (3-D): a table of its components, or a function of the coordinates that returns "
                       "them. Loads add up. A total force F on a part of length or area A is the load F/A.",
               .example = "top:load{ 0, -10 }\ntop:load(function(x, y) return 0, -x end)\ntop:load({ 4, 0 }, \"shear\")",
               .arguments = {key::field("traction", "its components").unit("force/length (2-D), force/area (3-D)").required(), load_case()},
               .run = load_part})
      .method({.name = "part:pressure",
               .help = "A load along the inward normal, constant or a function of the coordinates.",
               .example = "top:pressure(10)",
               .arguments = {key::field("value", "positive when it pushes").unit("force/length (2-D), force/area (3-D)").required(), load_case()},
               .run = pressure})
      .method({.name = "part:spring",
               .help = "An elastic support (Newton's condition): a force against the displacement.",
               .example = "top:spring{ x = 1e3, y = 1e3 }",
               .arguments = {key::table(component_keys("stiffness per length (2-D) or area (3-D), zero or positive", "stress/length"))},
               .run = spring})
      .method({.name = "part:support",
               .help = "A support by laws of dotyk.law along the normal and along the tangents, at each node for its share of "
                       "the boundary: stiffnesses, bounds and loads are per length (2-D) or area (3-D), a prescribed value is a "
                       "displacement. Normal: any law; the displacement v is positive away from the support, into "
                       "the body, so that one-sided laws push the body off it, like a foundation without tension "
                       "(one_sided_elastic), one with another stiffness in tension (unequal_elastic) or a rigid base "
                       "without a gap (signorini); load is a pressure. Tangential in 2-D: "
                       "free, prescribed, load, elastic, friction or capped_elastic, v positive along the outward normal turned by "
                       "90 degrees anticlockwise (along x at a bottom, along -x at a top). Tangential in 3-D: free, "
                       "prescribed(0), elastic or friction, alike in all directions. Friction is given (dotyk.law.friction, dotyk.friction.tresca), or mu times the "
                       "normal law's pressure (dotyk.friction.coulomb), and in a history opposes the increment of slip. breaking: the nodes that "
                       "exceed their limit most break first, until none does; s.reason tells what became of it. Results: solution:support, "
                       "solution:reaction.",
               .example = "block:part\"bottom\":support{ normal = dotyk.law.one_sided_elastic(1e3), tangential = dotyk.law.friction(2) }",
               .arguments = {key::table({law_field_key("normal", "the law along the normal"),
                                         law_field_key("tangential", "the law along the tangents")})},
               .run = part_support})
      .text([](const Part& p) { return text("part ", p.label(), ": ", p.facets.size(), " facets"); });
}

}  // namespace

void bind_material(Library& library) {
  using elasticity::Plane;
  library.function(
      {.name = "dotyk.material",
       .help = "A linearly elastic material: isotropic with E and nu, or general with a stiffness matrix in "
               "Voigt's order (xx yy xy; xx yy zz yz xz xy; engineering shear). E and nu may be functions "
               "of the coordinates; they are evaluated at the cells' centres when a body is made.",
       .example = "local steel = dotyk.material{ E = 210e3, nu = 0.3 }",
       .arguments = {key::table(
           {key::field("E", "Young's modulus").unit("stress"),
            key::field("nu", "Poisson's ratio, above -1 and below 0.5").otherwise("0.3"),
            key::choice<Plane>("plane", {{"strain", Plane::strain}, {"stress", Plane::stress}},
                               "what a plane body assumes of the third direction").into(&Material::plane),
            key::matrix("stiffness", "3x3 in the plane, 6x6 in space, instead of E and nu").unit("stress"),
            key::number("density", "mass per volume, for scripts to use").unit("mass/volume").above(0).into(&Material::density)})},
       .run = make_material});
  library.type<Material>("An elastic material.")
      .field("E", "Young's modulus; nil where it is a function or the material is general", &Material::E, "stress")
      .field("nu", "Poisson's ratio; nil where it is a function or the material is general", &Material::nu)
      .field("density", "mass per volume, 0 if none was given", [](const Material& m) { return m.density.value_or(0); }, "mass/volume")
      .text(material_text);
}

void bind_body(Library& library) {
  library.function({.name = "dotyk.body",
                    .help = "An elastic body: a mesh with a material, perhaps a force per volume.",
                    .setup = setup::mesh() + "local steel = dotyk.material{ E = 210e3, nu = 0.3 }\n",
                    .example = "local block = dotyk.body{ name = \"block\", mesh = m, material = steel }",
                    .arguments = {key::table(
                        {key::string("name", "what messages and figures call it").fallback("body"),
                         key::object<MeshHandle>("mesh", "its shape at rest").required(),
                         key::object<Material>("material", "what it is made of").required(),
                         key::field("force", "force per volume, its components").unit("force/volume").otherwise("none"),
                         key::integer("refine", "how often every cell is halved in each direction, as by mesh:refined; E and nu are those of the cells before, a force is linear in each. "
                                                "With several ranks each refines its own share, none has the whole mesh, and only multigrid can solve. All bodies of a scene are refined as often, and pictures show the boundary. Curved sides of meshes of order 1 remain polygons").within(0, 10).otherwise("0")})},
                    .run = make_body});
  library.type<Body>("An elastic body with its supports and loads.")
      .setup(setup::block())
      .field("name", "its name", [](const Body& b) { return b.name; })
      .field("dimension", "2 or 3", [](const Body& b) { return b.dimension(); })
      .field("node_count", "number of nodes", [](const Body& b) { return b.node_count(); })
      .field("cell_count", "number of cells", [](const Body& b) { return b.cell_count(); })
      .field("parts", "names of the parts that its mesh brings", scene::part_names)
      .method({.name = "body:part",
               .help = "A part of the boundary: one that the mesh names, or the facets that a function of the facet's "
                       "centre and outward normal accepts: f(x, y, nx, ny), f(x, y, z, nx, ny, nz) in space.",
               .example = "local top = block:part \"top\"\n"
                          "local patch = block:part(\"patch\", function(x, y, nx, ny) return ny > 0.9 and x < 0 end)",
               .arguments = {key::string("name", "its name").required().of<Body>(scene::part_names),
                             key::function("chosen", "accepts a facet or not")},
               .run = make_part})
      .text(show_body);
  bind_part(library);
}

}  // namespace dotyk::script

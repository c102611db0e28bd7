#include "algebra/direct/stop_factoring.hpp"
#include "scene/study/inf_sup.hpp"
#include "problem/uniqueness.hpp"
#include "scene/model/model.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

using scene::CellEnds;
using scene::Contact;
using scene::Discretisation;
using scene::Part;
using scene::Scene;
using scene::InfSupSettings;
using scene::MultiplierPart;
using contact::Multipliers;

std::shared_ptr<Scene> make_scene(Call& call) { return scene::make_scene(call.items<scene::Body>()); }

scene::InterfaceLaws laws(const Call& call, const Scene& scene) {
  if (call.has("friction") && call.has("tangential")) throw InputError("'friction' is a tangential law; it is given with 'tangential'");
  if (call.holds<problem::LawChoice>("friction") && !(*call.object<problem::LawChoice>("friction"))->rubs())
    throw InputError(text("'friction' is a law of friction, and this is ", problem::describe(*call.object<problem::LawChoice>("friction")), "; give it as tangential"));
  return {given_law(call, "normal", scene.dimension(), {&problem::laws::signorini}),
          given_law(call, call.has("friction") ? "friction" : "tangential", scene.dimension())};
}

/// None where nodes decide.
std::optional<contact::Pairing> pairing(Call& call) {
  std::optional<contact::Pairing> given;
  call.read("pairing", given);
  return given;
}

contact::RigidShape rigid_shape(const Call& call, int dimension) {
  const auto rigid = call.object<Rigid>("rigid");
  if (rigid->dimension != dimension)
    throw InputError(text("the ", contact::name(rigid->shape), " has ", rigid->dimension, " components, the scene is ", dimension, "-D"));
  contact::RigidShape shape = rigid->shape;
  if (auto* given = std::get_if<contact::RigidGap>(&shape); given && !given->gap) given->gap = kept_field(call, "rigid", "gap", dimension);
  return shape;
}

std::shared_ptr<const Contact> add_contact(Call& call) {
  const auto scene = call.self<Scene>();
  const auto parts = call.items<Part>();
  elasticity::ScalarField added;
  if (call.has("gap")) added = scalar_field(call.field("gap"), scene->dimension());
  const scene::InterfaceLaws given = laws(call, *scene);
  const bool interference = call.boolean("interference");
  const auto discretisation = call.filled<Discretisation>();
  if (call.has("rigid")) {
    if (parts.size() != 1) throw InputError("give one part with 'rigid', or two parts without it");
    if (call.has("pairing")) throw InputError("'pairing' is for two parts; it is given with 'rigid'");
    return scene::add_contact(*scene, *parts[0], rigid_shape(call, scene->dimension()), added, interference, given, discretisation);
  }
  if (parts.size() != 2) throw InputError("give two parts, or one part and 'rigid'");
  Watch watch(call.state(), "pairing");
  return scene::add_contact(*scene, *parts[0], *parts[1], added, given, interference, discretisation, pairing(call), &watch);
}

std::shared_ptr<const Contact> add_glue(Call& call) {
  const auto parts = call.items<Part>();
  Watch watch(call.state(), "pairing");
  return scene::add_glue(*call.self<Scene>(), *parts[0], *parts[1], pairing(call), &watch);
}

Record balance(Call& call) {
  const auto scene = call.self<Scene>();
  problem::Clock clock;
  Watch watch(call.state(), "assembling");
  const scene::Model model = scene::build(*scene, clock, watch);
  watch.phase("rigid motions");
  const algebra::StopFactoring stop(watch);
  const auto rigid = problem::rigid_motions(model.problem);
  const auto s = problem::solvability(rigid, model.problem);
  using Verdict = problem::Solvability::Verdict;
  const bool one = s.verdict == Verdict::unique && !problem::has_coulomb(model.problem) && problem::uniqueness(rigid, model.problem).unique;
  const char* verdict = s.verdict == Verdict::unsolvable ? "unsolvable" : s.verdict == Verdict::up_to_motion ? "up to motion" : one ? "unique" : "unknown";
  return {"balance", {{"verdict", verdict}, {"limit", s.limit}, {"motion", s.motion.size() ? describe(rigid.motions, s.motion) : std::string()},
                      {"work", s.work}, {"solvable", s.carried || s.verdict == Verdict::unsolvable ? std::optional(s.carried) : std::nullopt}}};
}

Record uniqueness(Call& call) {
  const auto scene = call.self<Scene>();
  Watch watch(call.state(), "assembling");
  const scene::UniquenessOfScene u = scene::uniqueness(*scene, watch);
  return {"uniqueness", {{"text", u.text}, {"exists", u.exists}, {"unique", u.unique}, {"factor", u.factor}}};
}

Given<Rigid> rigid_gap(Call& call) {
  contact::RigidGap shape{unit_vector(call.vector("normal"), "normal"), nullptr};
  if (!call.is("gap", LUA_TFUNCTION)) shape.gap = scalar_field(call.field("gap"), 0);
  return call.give_keeping(std::make_shared<Rigid>(Rigid{shape, static_cast<int>(call.vector("normal").size())}), {"gap"});
}

std::shared_ptr<Rigid> rigid_plane(Call& call) {
  const auto normal = call.vector("normal");
  const int dim = static_cast<int>(normal.size());
  return std::make_shared<Rigid>(Rigid{contact::RigidPlane{point_of(call.vector("point"), dim, "point"), unit_vector(normal, "normal")}, dim});
}

std::shared_ptr<Rigid> rigid_ball(Call& call) {
  const auto center = call.vector("center");
  return std::make_shared<Rigid>(Rigid{contact::RigidBall{point_of(center), call.number("radius")}, static_cast<int>(center.size())});
}

void bind_friction(Library& library) {
  library.module("dotyk.friction", "Friction laws for scene:contact and part:support. A normal and a tangential force at each contact node, or, for given friction, multipliers = \"P1-P0\" of scene:contact.");
  library.function({.name = "dotyk.friction.tresca",
                    .help = "Given friction (Tresca): the shear is at most g, whatever the pressure. math.huge: no slip at all.",
                    .setup = setup::two_blocks(),
                    .example = "local c = scene:contact{ upper:part \"bottom\", lower:part \"top\", friction = dotyk.friction.tresca(2.5) }",
                    .arguments = law_number_keys(problem::laws::friction),
                    .run = [](Call& call) { return make_law(call, problem::laws::friction); }});
  library.function({.name = "dotyk.friction.coulomb",
                    .help = "Coulomb friction: the shear is at most mu times the pressure.",
                    .setup = setup::two_blocks(),
                    .example = "local c = scene:contact{ upper:part \"bottom\", lower:part \"top\", friction = dotyk.friction.coulomb(0.3) }",
                    .arguments = law_number_keys(problem::laws::coulomb),
                    .run = [](Call& call) { return make_law(call, problem::laws::coulomb); }});
}

void bind_rigid(Library& library) {
  library.module("dotyk.rigid", "Rigid obstacles: no mesh, no unknowns.");
  library.function({.name = "dotyk.rigid.gap",
                    .help = "An obstacle given by its gap: u·normal <= gap(x) at each contact node. A negative gap "
                            "presses in by that much.",
                    .example = "local punch = dotyk.rigid.gap{ normal = {0,1}, gap = function(x, y) return x^2/4 - 0.02 end }",
                    .arguments = {key::table({key::vector("normal", "direction in which the gap is measured, out of the body").count(2, 3).required(),
                                              key::field("gap", "a number or a function of the coordinates").unit("length").required()})},
                    .run = rigid_gap});
  library.function({.name = "dotyk.rigid.plane",
                    .help = "A rigid half-space, a floor or a wall. Its normal points out of it, towards the body.",
                    .example = "local floor = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }",
                    .arguments = {key::table({key::vector("point", "a point of its surface").count(2, 3).unit("length").required(),
                                              key::vector("normal", "out of it").count(2, 3).required()})},
                    .run = rigid_plane});
  library.function({.name = "dotyk.rigid.ball",
                    .help = "A rigid disc (2-D) or ball outside the body. On a flat part gaps are along the part's normal; on a curved one along the mean of that "
                            "and the line to the centre, as between two curved parts. Gaps are measured with the body at rest.",
                    .example = "local ball = dotyk.rigid.ball{ center = {0,1.5}, radius = 1 }",
                    .arguments = {key::table({key::vector("center", "its middle").count(2, 3).unit("length").required(),
                                              key::positive("radius", "radius").unit("length").required()})},
                    .run = rigid_ball});
  library.type<Rigid>("A rigid obstacle.").text([](const Rigid& r) { return text(contact::name(r.shape), ", ", r.dimension, "-D"); });
}

Record inf_sup(Call& call) {
  const auto settings = call.filled<InfSupSettings>();
  Watch watch(call.state(), "inf-sup constants");
  const scene::InfSup s = scene::inf_sup(*call.self<Contact>(), settings, watch);
  return {"inf-sup", {{"constant", s.constant}, {"above_kernel", s.above_kernel}, {"kernel", s.kernel}, {"multipliers", s.multipliers},
                      {"h", s.h}, {"H", s.H}, {"cone", s.cone}}};
}

void bind_contact(Library& library) {
  library.type<Contact>("A contact or a glue of a scene.")
      .setup(setup::pressed_block())
      .field("name", "what messages call it", [](const Contact& c) { return c.name; })
      .field("rows", "number of contact conditions", [](const Contact& c) { return c.rows.size(); })
      .method({.name = "contact:inf_sup",
               .help = "Stability constant of the contact's multipliers (inf-sup, Babuška–Brezzi). Near 1 is good; 0: some multipliers are not controlled. Gives constant, the least b(mu, v)/(|v|_1 |mu|_-1/2) over multipliers, greatest over "
                       "displacements; 0 where multipliers form a kernel that no displacement notices (kernel, its dimension; "
                       "above_kernel, the least constant but 0); multipliers, h, H. "
                       "Supports, meshes and multipliers enter, the material does not.",
               .example = "print(contact:inf_sup{ part = \"normal\" }.constant)",
               .arguments = {key::table({key::choice<MultiplierPart>("part", {{"tangential", MultiplierPart::tangential}, {"normal", MultiplierPart::normal},
                                                                                {"both", MultiplierPart::both}}, "which multipliers").into(&InfSupSettings::part),
                                         key::choice<bool>("fixed_nodes", {{"shared", true}, {"kept", false}},
                                                     "multipliers of nodes held on both sides, and those of friction at corners of the part: shared out among their neighbours, as in a solve, or kept").into(&InfSupSettings::share_fixed),
                                         key::choice<bool>("norm", {{"shear", false}, {"multiplier", true}}, "of friction: of the shear g mu, or of mu itself, as TR965 (3.16) has it").into(&InfSupSettings::own_norm),
                                         key::boolean("cone", "also .cone: the least constant found over pressures that are not negative").into(&InfSupSettings::cone)})},
               .run = inf_sup})
      .text([](const Contact& c) { return c.name; });
}

Key pairing_key() {
  using contact::Pairing;
  return key::choice<Pairing>("pairing", {{"matching", Pairing::matching}, {"node_to_segment", Pairing::node_to_segment}, {"mortar", Pairing::mortar}},
                     "how the displacement opposite a node is found. matching: that of the node there, refused where there is none. mortar: a weighted mean over "
                     "the node's surroundings, exact for uniform pressure. node_to_segment: that at the foot point, not exact for uniform pressure. "
                     "Facets of a curved part are chords. Where two curved parts fit and their nodes do not match, the gaps between the chords (height h²/8R) "
                     "count as gaps; meshes of order 2 follow the curve").otherwise("matching where nodes match, else mortar");
}

}  // namespace

void bind_scene(Library& library) {
  library.function({.name = "dotyk.scene",
                    .help = "Bodies that are solved together. Add contacts with scene:contact and scene:glue. The model is linear elasticity at rest: strains and rotations are small (s.warnings tells where they are not), and what touches is what faces each other before the load.",
                    .setup = setup::block(),
                    .example = "local scene = dotyk.scene{ block }\nprint(scene)",
                    .arguments = {key::table({}).with(key::object<scene::Body>("bodies", "the bodies"))},
                    .run = make_scene});
  library.type<Scene>("Bodies and what joins them.")
      .setup(setup::two_blocks())
      .field("bodies", "its bodies", &Scene::bodies)
      .field("contacts", "its contacts and glues, in order", &Scene::contacts)
      .field("dimension", "2 or 3", &Scene::dimension)
      .method({.name = "scene:contact",
               .help = "Contact of two parts, or of one part with a rigid obstacle. Default: no penetration, no friction. Laws are per length (2-D) or area (3-D) of the "
                       "first part. The normal law depends on the gap of the deformed bodies (compliance: asperities, one_sided_elastic: a "
                       "coating, elastic: glue that yields, prescribed: bodies that slide on each other and never part, free: none), the tangential law on the slip. "
                       "At a corner of the (first) part there is one condition for each adjoining side. "
                       "Conditions, pressures and statuses are at the first part's nodes. If nodes do not match, name first the part that the other covers and whose nodes "
                       "supports leave free (of two meshes the coarser's nodes are taken in either order). "
                       "On P2 and Q2 they are at the facets' corners, means over their surroundings.",
               .example = "local wall = dotyk.rigid.plane{ point = {1,0}, normal = {-1,0} }\n"
                          "local w = scene:contact{ upper:part \"right\", rigid = wall }\n"
                          "local c = scene:contact{ upper:part \"bottom\", lower:part \"top\", pairing = \"mortar\" }",
               .arguments = {key::table({law_field_key("normal", "a law of dotyk.law but load and breaking").otherwise("signorini"),
                                         law_field_key("tangential", "a law of dotyk.friction, or of dotyk.law: free, prescribed(0), elastic, friction, in 2-D capped_elastic"),
                                         key::object<problem::LawChoice>("friction", "dotyk.friction.tresca(g) or dotyk.friction.coulomb(mu), short for tangential").otherwise("none"),
                                         key::object<Rigid>("rigid", "a rigid obstacle in place of the second part"),
                                         key::field("gap", "added to the geometric gap: more than 0 for a clearance (a pin in a hole), less than 0 for an interference (a press or shrink fit, the preload of a bolt); a number or a function of the coordinates").unit("length").otherwise("0"),
                                         pairing_key(),
                                         key::choice<Multipliers>("multipliers", {{"nodal", Multipliers::nodal}, {"P1-P0", Multipliers::p1_p0}},
                                                     "nodal: a normal and a tangential force at each node. P1-P0: pressure continuous and piecewise "
                                                     "linear; friction piecewise constant times its given bound, in the plane on the dual cells between "
                                                     "midpoints of edges, in space on cells of several facets; not with Coulomb friction").into(&Discretisation::multipliers),
                                         key::positive("friction_size", "P1-P0: extent H of the cells of friction. In space the inf-sup constant settles at about 0.8 with H = 2h "
                                                       "as h falls, and goes to 0 with H = h (contact:inf_sup)").unit("length").otherwise("in the plane one dual cell, in space twice the widest facet").into(&Discretisation::friction_size),
                                         key::choice<CellEnds>("friction_ends", {{"own", CellEnds::own}, {"joined", CellEnds::joined}, {"bare", CellEnds::bare}},
                                                     "P1-P0 in the plane: the half cells at the ends of the contact line have friction of their own, "
                                                     "that of the next cell, or none (TR965 (2.14)). At a corner within the line they are always the next cell's").into(&Discretisation::ends),
                                         key::boolean("interference", "true allows parts to overlap at rest (press fits; how much is their place or gap); false makes an overlap "
                                                      "at the first part's nodes an error: of two meshes name the finer one first").fallback(false)})
                                 .with(key::object<Part>("parts", "one part, or two").count(1, 2))},
               .run = add_contact})
      .method({.name = "scene:glue",
               .help = "Ties two parts together: no jump of the displacement at the first part's nodes, or in their surroundings' mean. "
                       "They must touch: where they are further apart than a tenth of a facet, and than curved facets make them, the glue is refused.",
               .example = "scene:glue{ upper:part \"bottom\", lower:part \"top\" }",
               .arguments = {key::table({pairing_key()}).with(key::object<Part>("parts", "the two parts").count(2))},
               .run = add_glue})
      .method({.name = "scene:plan",
               .help = "What will be modelled and within which limits, what is free to move, whether a solution exists, which method and why.",
               .example = "print(scene:plan())",
               .run = [](Call& call) {
                 Watch watch(call.state(), "plan");
                 const algebra::StopFactoring stop(watch);
                 return call.give(scene::plan(*call.self<Scene>()));
               }})
      .method({.name = "scene:balance",
               .help = "Can supports and contacts carry the load? Looks at rigid motions only, solves nothing: verdict "
                       "(\"unique\" where that is proved, \"up to motion\", \"unknown\" before solving, \"unsolvable\"; without Coulomb friction "
                       "the stress is unique in all but the last), solvable (rigid bodies would be in balance: with Coulomb friction "
                       "elastic ones may still find no pressure great enough; nil where neither was found out), limit (true: turned by an angle of 1e-6, the load "
                       "would be unsolvable, or solvable), motion (what is free) and the load's work on it.",
               .example = "print(scene:balance().verdict)",
               .run = balance})
      .method({.name = "scene:uniqueness",
               .help = "Is there exactly one solution? Gives text, and exists and unique where that is proved. With Coulomb friction on held bodies also factor: the solution is "
                       "unique for coefficients of friction below factor times the scene's. This takes as long as a solve, and factor falls as the mesh is refined; nil "
                       "where none is known.",
               .example = "print(scene:uniqueness().text)",
               .run = uniqueness})
      .text([](const Scene& s) { return scene::describe(s); });
  bind_contact(library);
  bind_rigid(library);
  bind_friction(library);
}

}  // namespace dotyk::script

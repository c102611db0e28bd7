#include "scene/result/distance.hpp"
#include "scene/solve/doubts.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

using scene::Body;
using scene::Contact;
using scene::Solution;

std::vector<double> components(const mesh::Point& p, int dimension) { return {p.begin(), p.begin() + dimension}; }

Record distance(Call& call) {
  const scene::Distance d = scene::distance(*call.self<Solution>(), *call.object<Solution>("reference"));
  return {"distance", {{"energy", d.energy}, {"displacement", d.displacement}, {"pressure", d.pressure}, {"peak_pressure", d.peak_pressure}}};
}

std::optional<Record> working_set_record(const Solution& s) {
  const auto& w = s.result().working_set;
  if (!w) return std::nullopt;
  return Record{"working set", {{"added", w->added}, {"dropped", w->dropped}, {"singular", w->singular}, {"survived", w->survived},
                                {"factorisations", w->factorisations}, {"repeats", w->repeats}}};
}

std::optional<Record> penalty_record(const Solution& s) {
  const auto& p = s.result().penalty;
  if (!p) return std::nullopt;
  return Record{"penalty", {{"factor", p->factor}, {"penetration", p->penetration}, {"energy", p->energy}}};
}

std::optional<Record> multigrid_record(const Solution& s) {
  const auto& m = s.result().multigrid;
  if (!m) return std::nullopt;
  return Record{"multigrid", {{"levels", m->levels}, {"cg", m->cg}, {"newton", m->newton}}};
}

std::optional<Record> feti_record(const Solution& s) {
  const auto& f = s.result().feti;
  if (!f) return std::nullopt;
  return Record{"feti", {{"subdomains", f->subdomains}, {"factors", f->factors}, {"rows", f->rows}, {"kernel", f->kernel}, {"inner", f->inner},
                         {"products", f->products}, {"loops", f->loops}, {"norm", f->norm}, {"rho", f->rho},
                         {"condition", f->condition > 0 ? std::optional(f->condition) : std::nullopt}}};
}

std::vector<Record> screws(const Solution& s) {
  std::vector<Record> placements;
  for (const solver::ScrewPlacement& p : s.result().screws) {
    std::vector<double> rows;
    for (const int row : p.rows) rows.push_back(row + 1);
    placements.push_back({"screws", {{"rows", rows}, {"regularity", p.regularity}, {"determinant", p.determinant}}});
  }
  return placements;
}

long long kernel_size(const Solution& s) {
  long long size = 0;
  for (const auto& block : s.model().problem.blocks) size += block.kernel.cols();
  return size;
}

int index_of(const Solution& s, const Body& body) {
  const int index = s.scene().index_of(&body);
  if (index < 0) throw InputError(text("'", body.name, "' is not of the scene that was solved"));
  return index;
}

mesh::Point vector_of(const Arguments& from, const char* name, int dimension) {
  mesh::Point out{};
  if (!from.has(name)) return out;
  const std::vector<double> given = from.vector(name);
  if (static_cast<int>(given.size()) != dimension) throw InputError(text("'", name, "' has ", given.size(), " components in a scene of ", dimension, " dimensions"));
  std::copy(given.begin(), given.end(), out.begin());
  return out;
}

std::shared_ptr<Solution> moved(Call& call) {
  const auto s = call.self<Solution>();
  const int dim = s->scene().dimension();
  scene::RigidMotion motion{vector_of(call, "translation", dim), {}, vector_of(call, "about", dim)};
  const bool angle = call.is("rotation", LUA_TNUMBER);
  if (angle && dim == 3) throw InputError("'rotation' is a number, but in space it is a vector along the axis");
  if (angle) motion.rotation = {0, 0, call.number("rotation")};
  else motion.rotation = vector_of(call, "rotation", 3);
  if (dim == 2 && !angle && call.has("rotation")) throw InputError("'rotation' is a vector, but in the plane it is a number");
  return scene::moved_rigidly(*s, index_of(*s, *call.object<Body>("body")), motion);
}

int solution_displacement(Call& call) {
  const auto s = call.self<Solution>();
  const auto u = s->displacement(index_of(*s, *call.object<Body>("body")), point_of(call, s->scene().dimension()));
  return call.give_all(components(u, s->scene().dimension()));
}

Record stress(Call& call) {
  const auto s = call.self<Solution>();
  const elasticity::Stress v = s->stress(index_of(*s, *call.object<Body>("body")), point_of(call, s->scene().dimension()));
  const auto principal = elasticity::principal(v);
  Record record{"stress", {{"xx", v[0]}, {"yy", v[1]}, {"xy", v[5]}, {"zz", v[2]}}};
  if (s->scene().dimension() == 3) record.add({{"yz", v[3]}, {"xz", v[4]}});
  record.add({{"von_mises", elasticity::von_mises(v)}, {"principal", std::vector<double>(principal.begin(), principal.end())}});
  return record;
}

Record place_record(const char* name, const mesh::Point& x, int dimension) {
  Record r{name, {{"x", x[0]}, {"y", x[1]}}};
  return dimension == 3 ? r.add({{"z", x[2]}}) : r;
}

Record node_record(const scene::ContactNode& n, int dimension) {
  return place_record("contact node", n.x, dimension)
      .add({{"gap", n.gap}, {"pressure", n.pressure}, {"shear", components(n.shear, dimension)}, {"slip", components(n.slip, dimension)},
            {"status", problem::status_name(n.status)}, {"force", n.force}, {"weight", n.weight}, {"normal", components(n.normal, dimension)}, {"centre", components(n.centre, dimension)}});
}

Record node_record(const scene::SupportNode& n, int dimension) {
  return place_record("support node", n.x, dimension)
      .add({{"away", n.away}, {"pressure", n.pressure}, {"slip", components(n.slip, dimension)}, {"shear", components(n.shear, dimension)},
            {"status", problem::status_name(n.status)}, {"tangential", problem::status_name(n.tangential)}, {"broken", n.broken},
            {"weight", n.weight}, {"normal", components(n.normal, dimension)}});
}

template <class Node>
std::vector<Record> node_records(const std::vector<Node>& nodes, int dimension) {
  std::vector<Record> records;
  for (const Node& n : nodes) records.push_back(node_record(n, dimension));
  return records;
}

Record solution_contact(Call& call) {
  const auto s = call.self<Solution>();
  const auto asked = call.object<Contact>("contact");
  const auto c = scene::as_given(*asked, s->contact(*asked));
  const int dim = s->scene().dimension();
  return {"contact result",
          {{"force", components(c.force, dim)}, {"area", c.area}, {"friction_force", components(c.friction_force, dim)},
           {"dissipated", c.dissipated}, {"max_pressure", c.max_pressure}, {"open", c.open}, {"closed", c.closed},
           {"stick", c.stick}, {"slip", c.slip}, {"nodes", node_records(c.nodes, dim)}}};
}

Record solution_support(Call& call) {
  const auto s = call.self<Solution>();
  const auto r = s->support(*call.object<scene::Part>("part"));
  const int dim = s->scene().dimension();
  return {"support result",
          {{"force", components(r.force, dim)}, {"area", r.area}, {"max_pressure", r.max_pressure}, {"open", r.open}, {"closed", r.closed},
           {"stick", r.stick}, {"slip", r.slip}, {"tangential_stick", r.tangential_stick}, {"tangential_slip", r.tangential_slip},
           {"broken", r.broken}, {"dissipated", r.dissipated}, {"nodes", node_records(r.nodes, dim)}}};
}

int solution_reaction(Call& call) {
  const auto s = call.self<Solution>();
  return call.give_all(components(s->reaction(*call.object<scene::Part>("part")), s->scene().dimension()));
}

int error_estimate(Call& call) {
  const auto s = call.self<Solution>();
  const scene::ErrorEstimate& e = s->error_estimate();
  const elasticity::ErrorParts& p = e.parts;
  std::vector<std::vector<double>> cells;
  for (const auto& of_body : e.cells) {
    if (s->model().problem.hides()) break;  // numbers of cells mean nothing where there are not all
    cells.emplace_back();
    for (const auto& cell : of_body) cells.back().push_back(std::sqrt(cell.sum()));
  }
  return call.give(e.relative, Record{"error estimate",
                                      {{"absolute", e.absolute}, {"relative", e.relative}, {"recovery", std::sqrt(p.recovery)},
                                       {"bulk", std::sqrt(p.bulk)}, {"jump", std::sqrt(p.jump)}, {"boundary", std::sqrt(p.boundary)},
                                       {"contact_pressure", std::sqrt(p.contact_pressure)}, {"complementarity", std::sqrt(p.complementarity)},
                                       {"friction", std::sqrt(p.friction)}, {"laws", std::sqrt(p.laws)}, {"cells", cells}}});
}

Record times(const Solution& s) {
  double pairing = 0;
  for (const auto& contact : s.scene().contacts) pairing += contact->seconds;
  return time_record(s.clock()).add({{"pairing", pairing}});
}

}  // namespace

void bind_solution(Library& library) {
  auto type = library.type<Solution>("What a solve gives: the state, how it ended, how far to trust it, what it cost.").setup(setup::solved_block());
  type.field("converged", "did the method end as it should", [](const Solution& s) { return s.result().converged; })
      .field("method", "which method", [](const Solution& s) { return s.result().method; })
      .field("iterations", "how many", [](const Solution& s) { return s.result().iterations; })
      .field("reason", "why it ended", [](const Solution& s) { return s.result().reason; })
      .field("warnings", "what makes the answer doubtful though the method has converged, strains beyond small ones among it: a list of sentences, mostly empty",
             [](const Solution& s) { return scene::doubts(s); })
      .field("screw_moves", "magnetic screws moved because they pulled", [](const Solution& s) { return s.result().screw_moves; })
      .field("screws", "magnetic screws, first and after each move: rows, regularity (least over greatest singular value "
                       "of their equilibrium), determinant", screws)
      .field("kernel", "rigid motions that supports leave free, all bodies", kernel_size)
      .field("energy", "½uᵀKu − fᵀu, springs and laws of supports included, friction not", [](const Solution& s) { return s.energy(); }, "force·length")
      .field("friction_energy", "the friction term of the energy: what friction dissipates in this step", [](const Solution& s) { return s.friction_energy(); }, "force·length")
      .field("steps", "the solutions of a history's steps, the last is this one", [](const Solution& s) { return s.steps(); })
      .field("unknowns", "displacement unknowns", [](const Solution& s) { return s.model().problem.all_unknowns(); })
      .field("rows", "interface conditions", [](const Solution& s) { return s.rows(); })
      .field("time", "seconds, of a history since its first step: total assembly motions ordering factor iterate recover; pairing, before and not in "
                     "total: what scene:contact and scene:glue took", times, "s")
      .field("residual", "relative: equilibrium penetration complementarity friction law", [](const Solution& s) { return residual_record(s.residual()); })
      .field("working_set", "of active_set, else nil: added dropped singular survived factorisations repeats", working_set_record)
      .field("penalty", "of penalty, else nil: factor, penetration (length), energy (force·length, too low by)", penalty_record)
      .field("multigrid", "of multigrid, else nil: levels, cg (iterations of conjugate gradients in all), newton (steps)", multigrid_record)
      .field("feti", "of feti, else nil: subdomains, factors (distinct ones), rows of the dual problem, kernel (size of the coarse "
                     "space), inner (steps), products (with F), loops (updates of Coulomb's bounds), norm (bound of |PFP|), "
                     "rho (the last penalty, in units of norm), condition (of PFP, with spectrum = true, else nil)", feti_record)
      .field("history", "one entry an iteration: active stick slip changed residual time, and of newton singular_value: the least one "
                         "of the scaled derivative of that step; of coulomb_loop contraction", [](const Solution& s) { return history_records(s.result()); })
      .field("ordering", "elimination order used", [](const Solution& s) { return s.result().ordering; })
      .field("factor_bytes", "size of the sparse factors", [](const Solution& s) { return s.result().factor_bytes; }, "bytes");
  type.method({.name = "solution:displacement",
               .help = "Components of the displacement at a point of a body at rest. Inside a body with refine on several ranks they refine their cells once more for each such point.",
               .example = "local ux, uy = s:displacement(block, 0, 0.5)",
               .arguments = point_keys("the point at rest"),
               .run = solution_displacement})
      .method({.name = "solution:stress",
               .help = "Recovered stress at a point of a body at rest: xx yy xy zz (yz xz), von_mises, principal. Inside a body with refine on several ranks as costly as solution:displacement.",
               .example = "print(s:stress(block, 0, 0.5).von_mises)",
               .arguments = point_keys("the point at rest"),
               .run = stress})
      .method({.name = "solution:contact",
               .help = "A contact's force on its first part and the part of it by friction (friction_force), area (where it presses: with Signorini's law the edge of contact is "
                       "sought between nodes), max_pressure, the work dissipated by friction over all steps, counts of open, closed, stick and "
                       "slip nodes, and nodes[i] with x y z gap pressure shear slip status force weight normal centre. Force is pressure times weight, the node's share of the "
                       "length or area. Pressure and shear (the friction on the first part) are means over the node's surroundings: the values at centre, which at an "
                       "end of the part is a third of the facet off the node. Slip is the tangential jump since the beginning, status what "
                       "the node did in this step. The result is computed at each call: keep it in a variable.",
               .example = "local c = s:contact(contact)\nprint(c.max_pressure, c.nodes[1].status)",
               .arguments = {key::object<Contact>("contact", "what scene:contact returned").required()},
               .run = solution_contact})
      .method({.name = "solution:support",
               .help = "A part's support by laws (part:support): its force on the body, area (of nodes that are not open), "
                       "max_pressure, counts of nodes: open, closed, stick, slip (along the normal), tangential_stick, "
                       "tangential_slip and broken, the work dissipated by friction over all steps, and nodes[i] with x y z, away (displacement "
                       "along the normal, positive away from the support), pressure, slip and shear (components of "
                       "the tangential displacement, and of the reaction on the body per length or area), status (along the normal: "
                       "open where it bears nothing, closed; stick or slip where the law has a greatest force), tangential (the "
                       "same of the tangents), broken, weight, normal.",
               .setup = setup::supported_block(),
               .example = "local r = s:support(block:part \"bottom\")\nprint(r.max_pressure, r.nodes[1].status)",
               .arguments = {key::object<scene::Part>("part", "a part with part:support").required()},
               .run = solution_support})
      .method({.name = "solution:reaction",
               .help = "Components of the force that the supports of a part, laws included, exert on its body.",
               .example = "local fx, fy = s:reaction(block:part \"left\")",
               .arguments = {key::object<scene::Part>("part", "a supported part").required()},
               .run = solution_reaction})
      .method({.name = "solution:error_estimate",
               .help = "Gives the relative error estimate, and a table of its parts. Error if the solve has not converged. It is a posteriori, contact included, in the energy norm: the "
                       "square root of twice the energy of strains, springs and elastic laws of supports (that of solution:distance). For cells of order 1 (P1, Q1). The table: absolute (of ‖u - u_h‖, √(force·length)), relative, its parts, whose squares add up to "
                       "absolute²: recovery (stress against recovered stress), bulk (equilibrium of the recovered stress inside cells), "
                       "jump (of its tractions where the material jumps), boundary (against loads and free boundaries), "
                       "contact_pressure and friction (against the contact's pressure and shear; friction also slip against its law), "
                       "complementarity (pressure where the gap opens), laws (elastic ones act at nodes, not between them); and cells[i], the estimate of each cell of the i-th body (empty where several ranks have refined the bodies).",
               .example = "local relative, parts = s:error_estimate()\nprint(relative, parts.contact_pressure, #parts.cells[1])",
               .run = error_estimate})
      .method({.name = "solution:moved",
               .help = "Where s.reason says that a body can move rigidly without changing forces: the solution with that body moved. "
                       "Of all such solutions a solve gives the one of least displacement. Refused where supports or laws do not allow the motion.",
               .example = "print(pcall(s.moved, s, { body = block, translation = {0.1, 0} }))",
               .arguments = {key::table({key::object<Body>("body", "which body").required(),
                                         key::vector("translation", "by which all of it moves").count(2, 3).unit("length").otherwise("none"),
                                         key::either("rotation", {key::number("", ""), key::vector("", "").count(3, 3)}, "small; in the plane anticlockwise, in space a vector along the axis").unit("rad").otherwise("none"),
                                         key::vector("about", "a point that the rotation leaves").count(2, 3).unit("length").otherwise("the origin")})},
               .run = moved})
      .method({.name = "solution:path_error",
               .help = "How far one load step from rest is from eight equal ones: the sum of |friction force - that after eight steps| "
                       "over the nodes of contacts and supports, relative. 0 without solving where steps change nothing: Coulomb friction, no node closed from a gap. Else it costs eight "
                       "more solves with one factorisation, once. To be rid of it, solve in steps, and halve them until forces no longer change.",
               .example = "print(s:path_error())",
               .run = [](Call& call) {
                 Watch watch(call.state(), "path error");
                 return call.give(call.self<Solution>()->path_error(watch));
               }})
      .method({.name = "solution:distance",
               .help = "Relative difference from another solution of the same bodies and contacts, taken for exact: usually on a finer "
                       "mesh, which should refine this one's (elsewhere its kinks are smoothed and the energy comes out too small). Gives energy (norm of the difference: the square root of twice the energy of "
                       "strains, springs and elastic laws of supports), displacement (L2 over the bodies), and with "
                       "contact pressure (L2 over the contacts, at this solution's nodes) and peak_pressure.",
               .example = "local soft = dotyk.solver.penalty{ factor = 100 }:solve(scene)\nprint(soft:distance(s).energy)",
               .arguments = {key::object<Solution>("reference", "what is taken for exact").required()},
               .run = distance})
      .method({.name = "solution:write_contact",
               .help = "Writes (exports, saves) the contact nodes of all contacts as comma-separated values (CSV): contact, node, coordinates, gap, "
                       "pressure, force, weight, components of shear and slip, status.",
               .example = "s:write_contact \"contact.csv\"",
               .arguments = {key::file("file", "where to").written().required()},
               .run = [](Call& call) {
                 scene::write_contact(*call.self<Solution>(), call.text("file"));
                 return 0;
               }})
      .text([](const Solution& s) { return scene::describe(s); });
}

}  // namespace dotyk::script

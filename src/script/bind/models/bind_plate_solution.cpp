// Solved plates and their figures.
#include "figure/compose/compose_plate.hpp"
#include "plate/reaction.hpp"
#include "script/bind/figure_keys.hpp"
#include "script/bind/models/models.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::script {
namespace {

using PlateSolution = plate::Solution;

std::vector<Key> plane_point_keys() { return {key::number("x", "where").unit("length").required(), key::number("y", "where").unit("length").required()}; }

int deflection(Call& call) { return call.give(call.self<PlateSolution>()->deflection(call.number("x"), call.number("y"))); }

int slope(Call& call) {
  const Eigen::Vector2d at = call.self<PlateSolution>()->slope(call.number("x"), call.number("y"));
  return call.give(at[0], at[1]);
}

int moment(Call& call) {
  const plate::Moment m = call.self<PlateSolution>()->moment(call.number("x"), call.number("y"));
  const double mean = (m.xx + m.yy) / 2, radius = std::hypot((m.xx - m.yy) / 2, m.xy);
  return call.give(Record{"moment", {{"xx", m.xx}, {"yy", m.yy}, {"xy", m.xy}, {"principal", std::vector<double>{mean + radius, mean - radius}}}});
}

Record point_record(const plate::EdgePoint& p, std::size_t piece) {
  return {"edge point", {{"x", p.x}, {"y", p.y}, {"at", p.at}, {"piece", piece + 1}, {"length", p.length}, {"deflection", p.deflection},
                         {"slope", p.slope}, {"force", p.force}, {"reaction", p.per_length()}, {"moment", p.moment / p.length}, {"status", problem::status_name(p.status)},
                         {"corner", p.corner}}};
}

std::vector<std::string> edge_names(const PlateSolution& s) {
  std::vector<std::string> names;
  for (const auto& edge : s.plate().edges) names.push_back(edge.part);
  return names;
}

int edge_reaction(Call& call, const PlateSolution& s, const std::string& part) {
  const plate::EdgeReaction r = plate::reaction(s, find_edge(s.plate(), part));
  std::vector<Record> points;
  for (std::size_t piece = 0; piece < r.pieces.size(); ++piece)
    for (const plate::EdgePoint& p : r.pieces[piece]) points.push_back(point_record(p, piece));
  return call.give(Record{"reaction", {{"force", r.force}, {"length", r.length}, {"open", r.open}, {"points", points}}});
}

int plate_reaction(Call& call) {
  const auto s = call.self<PlateSolution>();
  if (call.is("part", LUA_TSTRING)) return edge_reaction(call, *s, call.text("part"));
  const auto number = static_cast<int>(call.number("part"));
  const int count = static_cast<int>(s->plate().supports.size());
  if (number < 1 || number > count || number != call.number("part"))
    throw InputError(count == 0 ? "it has no point supports" : text("there are supports 1 to ", count));
  return call.give(Record{"reaction", {{"force", plate::point_reaction(*s, number - 1)}}});
}

int plate_distance(Call& call) {
  const plate::Distance d = plate::distance(*call.self<PlateSolution>(), *call.object<PlateSolution>("other"));
  return call.give(Record{"distance", {{"energy", d.energy}, {"displacement", d.displacement}}});
}

int corners(Call& call) {
  std::vector<Record> out;
  for (const plate::CornerForce& c : plate::corner_forces(*call.self<PlateSolution>())) out.push_back({"corner", {{"x", c.x}, {"y", c.y}, {"force", c.force}}});
  return call.give(out);
}

/// All solutions, where there are many.
std::optional<Record> solution_family(const PlateSolution& s) {
  if (!s.family()) return std::nullopt;
  return Record{"family", {{"from", s.family()->from}, {"to", s.family()->to}}};
}

int motion(Call& call) {
  const auto s = call.self<PlateSolution>();
  if (!s->family()) return call.give(0.0);
  return call.give(s->motion(call.number("x"), call.number("y")));
}

/// What the obstacle bears, and vertices that lie on it.
std::pair<double, std::vector<Record>> on_obstacle(const PlateSolution& s) {
  const auto& lambda = s.result().state.lambda;
  const double noise = 1e-9 * (lambda.size() ? lambda.lpNorm<Eigen::Infinity>() : 0);
  double force = 0;
  std::vector<Record> nodes;
  for (std::size_t n = 0; n < s.model().obstacle_row.size(); ++n) {
    const int row = s.model().obstacle_row[n];
    if (row < 0 || lambda[row] <= noise) continue;
    force += lambda[row];
    const double* x = s.plate().mesh->node(static_cast<int>(n));
    nodes.push_back({"node", {{"x", x[0]}, {"y", x[1]}, {"force", lambda[row]}}});
  }
  return {force, nodes};
}

std::optional<Record> obstacle_contact(const PlateSolution& s) {
  if (s.model().obstacle_row.empty()) return std::nullopt;
  const auto [force, nodes] = on_obstacle(s);
  return Record{"contact", {{"force", force}, {"nodes", nodes}}};
}

std::string plate_solution_text(const PlateSolution& s) {
  const solver::Result& r = s.result();
  std::string out = text("plate solution: ", solver::ending(r), "\n  energy ", s.energy(), ", ", s.model().problem.unknowns(), " unknowns, ", s.model().problem.rows(), " rows, ", r.clock.total, " s\n  residual: ",
                         problem::describe(s.residual()));
  for (std::size_t e = 0; e < s.plate().edges.size(); ++e) {
    const plate::EdgeReaction at = plate::reaction(s, static_cast<int>(e));
    out += text("\n  ", s.plate().edges[e].part, ": force ", at.force, ", length ", at.length);
    if (at.open > 0) out += text(", of that open ", at.open);
  }
  for (std::size_t k = 0; k < s.plate().supports.size(); ++k)
    out += text("\n  support at (", s.plate().supports[k].x, ", ", s.plate().supports[k].y, "): force ", plate::point_reaction(s, static_cast<int>(k)));
  if (!s.model().obstacle_row.empty()) out += text("\n  obstacle: force ", on_obstacle(s).first);
  if (s.family()) out += text("\n  not the only solution: all are u + t motion, ", s.family()->from, " <= t <= ", s.family()->to);
  return out;
}

using figure::PlateField;
using figure::PlateView;

std::string render_plate(Call& call) {
  auto chosen = call.filled<figure::PlateOptions>();
  if (call.is("deform", LUA_TNUMBER)) chosen.deform = call.number("deform");
  chosen.units = read_units(call);
  figure::PlatePicture picture = figure::compose(*call.self<plate::Solution>(), chosen);
  if (picture.view == PlateView::surface) picture.height = 800;
  picture.edges = read_edges(call, picture.edges);
  call.fill(picture);
  if (call.has("eye") && picture.view == PlateView::plan) throw InputError("'eye' is for view = \"surface\"; a plan is seen from above");
  picture.view_from = read_direction(call, "eye");
  return draw(call, std::move(picture));
}

}  // namespace

void bind_plate_solution(Library& library) {
  library.type<PlateSolution>("A solved plate: what it does, and how it ended.").setup(setup::solved_plate())
      .field("converged", "did the method end as it should", [](const PlateSolution& s) { return s.result().converged; })
      .field("method", "which method", [](const PlateSolution& s) { return s.result().method; })
      .field("iterations", "how many", [](const PlateSolution& s) { return s.result().iterations; })
      .field("reason", "why it ended, and up to what the solution is unique", [](const PlateSolution& s) { return s.result().reason; })
      .field("energy", "with the supports'", [](const PlateSolution& s) { return s.energy(); }, "force·length")
      .field("unknowns", "free deflections and slopes", [](const PlateSolution& s) { return s.model().problem.unknowns(); })
      .field("rows", "conditions of laws, point supports and the obstacle", [](const PlateSolution& s) { return s.model().problem.rows(); })
      .field("time", "seconds: total assembly motions ordering factor iterate recover", [](const PlateSolution& s) { return time_record(s.result().clock); }, "s")
      .field("residual", "relative: equilibrium penetration complementarity law", [](const PlateSolution& s) { return residual_record(s.residual()); })
      .field("history", "one entry an iteration: active changed residual time", [](const PlateSolution& s) { return history_records(s.result()); })
      .field("family", "where the solution is not the only one: all are u + t motion, from <= t <= to, motion as plate_solution:motion gives it; else nil", solution_family)
      .field("contact", "of the plate with its obstacle: force upwards, and nodes (x, y, force) that bear; nil without one", obstacle_contact)
      .method({.name = "plate_solution:deflection", .help = "The deflection at a point, positive upwards.", .example = "print(s:deflection(0.5, 0.5))", .arguments = plane_point_keys(), .run = deflection})
      .method({.name = "plate_solution:slope", .help = "The gradient of the deflection: along x and along y.", .example = "print(s:slope(0.5, 0.5))", .arguments = plane_point_keys(), .run = slope})
      .method({.name = "plate_solution:moment",
               .help = "Bending moments per length, -D[(1 - nu) u_ij + nu Δu δ_ij]: xx, yy, xy, and the two principal ones. Means of the cells about each node, linear between.",
               .example = "print(s:moment(0.5, 0.5).xx)", .arguments = plane_point_keys(), .run = moment})
      .method({.name = "plate_solution:motion", .help = "Where s.family is not nil: the motion that may be added, at a point; its greatest value is 1. Else 0.",
               .example = "print(s:motion(0.5, 0.5))", .arguments = plane_point_keys(), .run = motion})
      .method({.name = "plate_solution:reaction",
               .help = "What a part of the edge does to the plate: force (upwards), length, how much of it is open, and points in order along the edge: x, y, at (along the edge), piece, "
                       "length, deflection, slope (outwards), force, reaction (per length), moment (per length), status (open, closed, stick, slip), corner. Of a point support, by its number: force.",
               .example = "print(s:reaction(\"edge\").force)",
               .arguments = {key::either("part", {key::string("", "a part of the edge that has laws; \"edge\" where all has the same").of<PlateSolution>(edge_names),
                                                key::integer("", "which of the point supports")}, "which support").required()},
               .run = plate_reaction})
      .method({.name = "plate_solution:distance",
               .help = "How far this solution is from another one of the same plate, on another mesh or with the other element, relative to the other: energy, of the curvatures, weighted "
                       "by the bending stiffness; displacement, of the deflection in L2.",
               .example = "print(s:distance(dotyk.solve(plate(24))).energy)",
               .arguments = {key::object<PlateSolution>("other", "a solution, as a rule a finer one").required()}, .run = plate_distance})
      .method({.name = "plate_solution:corners",
               .help = "The forces that the supports concentrate at the corners of the edge (x, y, force, upwards): what a corner bears beyond the reaction per length of the nodes next to it.",
               .example = "for _, c in ipairs(s:corners()) do print(c.x, c.y, c.force) end", .arguments = {}, .run = corners})
      .method(
      {.name = "plate_solution:write",
       .help = "Writes the solution for ParaView and returns the file's name: the plate at rest, with displacement (along z), moment and, where there "
               "is an obstacle, obstacle_force at the nodes.",
       .example = "s:write \"a.vtu\"",
       .arguments = {key::file("file", "where to; ends in .vtu or .pvtu, its folder must exist").written().required()},
       .run = [](Call& call) {
         figure::write(figure::compose_grid(*call.self<PlateSolution>(), call.text("file")));
         return call.text("file");
       }})
      .method(
      {.name = "plate_solution:render",
       .help = "Draws the plate into a file and returns its name. surface: in space, its deflection magnified, over the outline at rest; edges that have "
               "left their support show the gap. plan: from above, with contour lines, reactions per length as areas along the edges and those at corners "
               "and point supports as dots with their numbers. Both show the status of edges, point supports, and hatched what bears on the obstacle.",
       .example = "s:render{ file = \"a.png\", view = \"plan\", field = \"von_mises\", units = { length = \"m\", force = \"kN\" } }",
       .arguments = {key::table(joined(
           {picture_key(),
            key::choice<PlateView>("view", {{"surface", PlateView::surface}, {"plan", PlateView::plan}}, "the deflected surface, or the plan").into(&figure::PlateOptions::view),
            key::choice<PlateField>("field", {{"none", PlateField::none}, {"deflection", PlateField::deflection}, {"mxx", PlateField::xx}, {"myy", PlateField::yy},
                                              {"mxy", PlateField::xy}, {"m1", PlateField::greatest}, {"m2", PlateField::least}, {"von_mises", PlateField::von_mises}},
                                    "what the colours show: deflection, moments per length, the principal ones m1 >= m2, von Mises' of them").into(&figure::PlateOptions::field),
            key::either("deform", {key::number("", ""), key::choice("", {"auto"}, "")}, "surface: factor on the deflection; auto: such that it can be seen").fallback("auto"),
            key::boolean("edges", "edges of the triangles").otherwise("on a surface while they can be told apart, none on a plan"),
            key::vector("range", "least and greatest value of the colours").count(2).otherwise("the field's").into(&figure::PlatePicture::field_range),
            key::vector("eye", "surface: direction towards the eye").count(3).otherwise("{1, -1.7, 0.8}"),
            title_key(), units_key()},
           size_keys("{1200, 800}, a plan {1200, 1100}")))},
       .run = render_plate})
      .text(plate_solution_text);
}

}  // namespace dotyk::script

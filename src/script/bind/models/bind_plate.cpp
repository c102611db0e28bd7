#include "script/bind/models/models.hpp"

#include "plate/solvable.hpp"
#include "script/bind/bind.hpp"
#include "script/help/nearest.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {
namespace {

using plate::Plate;
using problem::LawChoice;

plate::Field in_the_plane(const script::Field& field) {
  return [field](double x, double y) { return field(std::vector<double>{x, y})[0]; };
}

std::vector<Key> edge_keys() {
  return {law_field_key("rotation", "of the slope along the outward normal, per length: a law of dotyk.law but breaking, or f(x, y) → law"),
          law_field_key("deflection", "of the deflection, per length: the same")};
}

plate::LawField edge_law(const Arguments& from, const char* name) {
  const LawOfPlace law = law_field_without_normal(from, name);
  if (!law) return {};
  return [law](double x, double y) { return law(std::array{x, y}); };
}

plate::EdgeSupport edge(const Arguments& from, std::string part, std::vector<mesh::Facet> facets) {
  return {std::move(part), std::move(facets), edge_law(from, "deflection"), edge_law(from, "rotation")};
}

/// Edges that a part of the mesh has, or that `where` chooses.
std::vector<mesh::Facet> facets(const mesh::Mesh& mesh, const std::string& part, const Arguments& from) {
  if (from.has("where")) {
    const Function where = from.function("where");
    auto chosen = mesh::select(mesh, [&](const mesh::Point& x, const mesh::Point& n) { return where.truth(std::vector<double>{x[0], x[1], n[0], n[1]}); });
    if (chosen.empty()) throw InputError(text("edges: where of '", part, "' chooses no edge of the boundary"));
    return chosen;
  }
  const auto found = mesh.parts.find(part);
  if (found != mesh.parts.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, facets] : mesh.parts) names.push_back(name);
  throw InputError("edges: " + unknown_name("part", part, names) + "; or give a new part its edges: where = function(x, y, nx, ny)");
}

void take_edges(Call& call, Plate& plate) {
  if (call.has("edge")) plate.edges.push_back(edge(call.table("edge"), "edge", mesh::boundary(*plate.mesh)));
  if (!call.has("edges")) return;
  if (call.has("edge")) throw InputError("give edge, for all of the boundary, or edges, part by part; not both");
  const Key where = key::function("where", "f(x, y, nx, ny) of edge middles and normals → which edges are this part");
  const Key table = key::table("", joined(edge_keys(), {where}), "");
  lua_State* L = call.state();
  const auto require_table = [L](int index, const std::string& what, const char* expected) {
    if (lua_type(L, index) != LUA_TTABLE) throw InputError(text(what, ": expected ", expected, ", got ", describe_value(L, index)));
  };
  require_table(call.slot("edges"), "edges", "{ part = { rotation = law, deflection = law }, … }");
  std::vector<std::string> parts;
  for (lua_pushnil(L); lua_next(L, call.slot("edges")); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING) throw InputError("edges: expected { part = { rotation = law, deflection = law }, … }");
    parts.push_back(lua_tostring(L, -2));
  }
  std::sort(parts.begin(), parts.end());  // Lua's own order changes from run to run
  for (const std::string& part : parts) {
    lua_getfield(L, call.slot("edges"), part.c_str());
    require_table(lua_gettop(L), "edges." + part, "{ rotation = law, deflection = law }");
    const Arguments from(L, lua_gettop(L), table, "plate", "edges." + part + ": ");
    plate.edges.push_back(edge(from, part, facets(*plate.mesh, part, from)));
  }
}

void take_points(Call& call, Plate& plate) {
  for (const Arguments& s : call.tables("supports")) plate.supports.push_back({s.number("x"), s.number("y"), law(s, "deflection")});
  for (const Arguments& load : call.tables("loads")) plate.point_loads.push_back(load.filled<plate::PointLoad>());
  for (const Arguments& line : call.tables("lines")) {
    const auto from = line.vector("from"), to = line.vector("to");
    plate.line_loads.push_back({{from[0], from[1]}, {to[0], to[1]}, line.number("force")});
  }
}

std::shared_ptr<plate::Model> make_plate(Call& call) {
  Plate plate;
  plate.mesh = std::make_shared<const mesh::Mesh>(*call.object<MeshHandle>("mesh")->mesh);
  call.fill(plate);
  take_field(call, "D", plate.D, plate.D_of, in_the_plane);
  take_field(call, "load", plate.f, plate.f_of, in_the_plane);
  if (call.has("obstacle")) plate.obstacle = in_the_plane(call.field("obstacle"));
  require_valid(plate);
  take_edges(call, plate);
  take_points(call, plate);
  return std::make_shared<plate::Model>(plate::build(std::move(plate)));
}

std::string plate_text(const plate::Model& m) {
  const Plate& p = m.plate;
  std::string out = text("plate: ", plate::element_name(p.element), ", ", p.mesh->cell_count(), " triangles, ", m.problem.unknowns(), " unknowns, ", m.problem.rows(), " rows");
  const auto& motions = m.problem.blocks.front().motions;
  if (motions.empty()) out += "\n  held by its supports";
  for (const Motion& motion : motions) out += "\n  free but for one-sided laws and friction: " + motion.text();
  for (const problem::RowGroup& group : m.problem.groups) out += text("\n  ", group.name, ": ", group.law->name(), ", ", group.count, group.count == 1 ? " row" : " rows");
  try {
    const std::string note = plate::require_solvable(m).note;
    out += "\n  has a solution" + (note.empty() ? "" : ", " + note);
  } catch (const InputError& error) {
    out += std::string("\n  ") + error.what();
  }
  return out;
}

Key point_key(const char* name) { return key::number(name, "where").unit("length").required(); }

}  // namespace

int find_edge(const Plate& plate, const std::string& part) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plate.edges.size(); ++i) {
    if (plate.edges[i].part == part) return static_cast<int>(i);
    names.push_back(plate.edges[i].part);
  }
  if (names.empty()) throw InputError("no part of this plate's edge has laws");
  throw InputError(unknown_name("part", part, names));
}

void bind_plate(Library& library) {
  library.function(
      {.name = "dotyk.plate",
       .help = "A thin elastic plate (Kirchhoff's hypothesis) on a mesh of triangles, with laws for the deflection and the rotation of its edge, supports at "
               "points, and perhaps an obstacle under it. Solved by dotyk.solve or a solver. Deflection and loads are positive upwards; laws of an edge are per "
               "length; one-sided ones keep the deflection up and the outward slope down. Functions are called when the plate is made.",
       .example = "local p = dotyk.plate{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {16,16} }, load = -1,\n"
                  "  edge = { deflection = dotyk.law.signorini() } }\n"
                  "print(dotyk.solve(p):deflection(0.5, 0.5))",
       .arguments = {key::table(
           {key::object<MeshHandle>("mesh", "triangles in the plane").required(),
            key::choice<plate::Element>("element", {{"morley", plate::Element::morley}, {"hct", plate::Element::hct}},
                                        "morley: the lowest order, nonconforming, for nu from -0.8 to 0.8; hct: cubic on thirds of a triangle, conforming").into(&Plate::element),
            key::field("D", "bending stiffness E h³/12(1 - nu²), positive: a number or a function of x, y").unit("force·length").otherwise("1"),
            key::number("nu", "Poisson's ratio; beyond 0.8 and -0.8 with hct alone").above(-1).below(1).into(&Plate::nu),
            key::field("load", "per area, upwards: a number or a function of x, y").unit("force/area").otherwise("0"),
            key::list("loads", key::table("", {point_key("x").into(&plate::PointLoad::x), point_key("y").into(&plate::PointLoad::y), key::number("force", "upwards").unit("force").required().into(&plate::PointLoad::force)}, ""), "at points"),
            key::list("lines", key::table("", {key::vector("from", "one end").unit("length").count(2).required(), key::vector("to", "the other").unit("length").count(2).required(),
                                               key::number("force", "per length, upwards").unit("force/length").required()}, ""), "along lines"),
            key::table("edge", edge_keys(), "laws of the whole edge"),
            key::any("edges", "laws part by part: { left = { rotation = law, deflection = law }, … }; a part that the mesh does not have is chosen by where = function(x, y, nx, ny)"),
            key::list("supports", key::table("", {point_key("x"), point_key("y"), law_key("deflection", "a law of dotyk.law but breaking")}, ""), "at points"),
            key::field("obstacle", "height of what lies under the plate: a number or a function of x, y").unit("length").otherwise("none")})},
       .run = make_plate});
  library.type<plate::Model>("A plate with its supports and loads.")
      .field("unknowns", "free deflections and slopes", [](const plate::Model& m) { return m.problem.unknowns(); })
      .field("rows", "conditions of laws, point supports and the obstacle", [](const plate::Model& m) { return m.problem.rows(); })
      .text(plate_text);
  bind_plate_solution(library);
}

}  // namespace dotyk::script

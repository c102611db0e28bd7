#include <cmath>

#include "base/memory.hpp"
#include "elasticity/refined.hpp"
#include "mesh/generators.hpp"
#include "mesh/decomposition.hpp"
#include "meshfile/load.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

Key element_key() {
  using mesh::Family;
  return key::choice<Family>("element", {{"P1", Family::p1}, {"Q1", Family::q1}, {"P2", Family::p2}, {"Q2", Family::q2}},
                             "P1: triangles or tetrahedra; Q1: quadrilaterals or hexahedra; P2, Q2: the same of second order").fallback(Family::p1);
}

Key grading_key(std::size_t axes) {
  const auto axis = [](const char* name) { return key::function(name, "maps [0, 1] onto [0, 1], increasing: where the grid lines go"); };
  std::vector<Key> keys{axis("x"), axis("y")};
  if (axes == 3) keys.push_back(axis("z"));
  return key::table("grading", keys, "uneven spacing, axis by axis").otherwise("even");
}

Key cells_key(std::size_t axes) {
  return key::list("cells", key::integer("", ""), "number of cells along each axis").count(axes).required();
}

mesh::Family chosen_family(const Call& call) { return call.choice<mesh::Family>("element"); }

/// The gradings given; they call back into Lua while the mesh is made.
std::array<mesh::Grading, 3> gradings(const Call& call) {
  std::array<mesh::Grading, 3> result;
  if (!call.has("grading")) return result;
  const Arguments given = call.table("grading");
  static const char* axis[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < call.integers("cells").size(); ++i)
    if (given.has(axis[i]))
      result[i] = [f = given.function(axis[i])](double s) { return f.number({&s, 1}); };
  return result;
}

/// Refuses what cannot be numbered or held, before any of it is made. `count` cells before simplices cut them.
void require_room(double count, int dimension, mesh::Family family) {
  const bool plane = dimension == 2, simplex = mesh::simplices(family), second = family == mesh::Family::p2 || family == mesh::Family::q2;
  const double refined = second ? (plane ? 4 : 8) : 1;  // nodes
  if (refined * count > 2e8)
    throw InputError(text(count, " cells are more than this program can number; use at most 2e8", second ? " nodes" : ""));
  const double entries = second ? (plane ? (simplex ? 12 : 9) : (simplex ? 60 : 27)) : plane ? (simplex ? 6 : 4) : (simplex ? 24 : 8);
  const double making = second ? 24 * (plane ? 5 : 19) : 0;  // to tell which nodes cells share
  require_memory(count * (8.0 * dimension * refined + 4 * entries + making), text("a mesh of ", count, " cells"));
}

std::array<int, 3> cells(const Call& call) {
  std::array<int, 3> result{1, 1, 1};
  const auto given = call.integers("cells");
  double product = 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] < 1 || given[i] > 1'000'000)
      throw InputError(text("cells along ", "xyz"[i], " is ", given[i], "; it must be from 1 to 1000000"));
    result[i] = static_cast<int>(given[i]);
    product *= result[i];
  }
  require_room(product, static_cast<int>(given.size()), chosen_family(call));
  return result;
}

std::shared_ptr<MeshHandle> handle_of(mesh::Mesh mesh, std::vector<std::string> regions = {}, std::vector<std::string> notes = {}) {
  return std::make_shared<MeshHandle>(MeshHandle{std::make_shared<mesh::Mesh>(std::move(mesh)), std::move(regions), std::move(notes)});
}

std::shared_ptr<MeshHandle> handle_of(meshfile::Loaded of) { return handle_of(std::move(of.mesh), std::move(of.regions), std::move(of.notes)); }

template <auto make>
std::shared_ptr<MeshHandle> grid(Call& call) {
  const auto from = call.vector("from"), to = call.vector("to");
  return handle_of(make(from.data(), to.data(), cells(call).data(), chosen_family(call), gradings(call).data()));
}

std::shared_ptr<MeshHandle> disc(Call& call) {
  const auto center = call.vector("center");
  const auto count = call.integer("cells");
  if (count < 1 || count > 10'000) throw InputError(text("cells is ", count, "; it must be from 1 to 10000"));
  require_room(3.0 * static_cast<double>(count * count), 2, chosen_family(call));
  return handle_of(mesh::disc(center.data(), call.number("radius"), static_cast<int>(count), chosen_family(call)));
}

std::vector<std::string> mesh_part_names(const MeshHandle& m) {
  std::vector<std::string> names;
  for (const auto& [name, facets] : m.mesh->parts) names.push_back(name);
  return names;
}

/// " a b c", no more than a dozen.
std::string shown(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 12); ++i) out += names[i].find(' ') == std::string::npos ? " " + names[i] : " '" + names[i] + "'";
  return names.size() > 12 ? text(out, " and ", names.size() - 12, " more") : out;
}

Self transform(Call& call) {
  MeshHandle& handle = *call.self<MeshHandle>();
  auto moved = std::make_shared<mesh::Mesh>(*handle.mesh);
  std::vector<char> flagged;
  if (call.has("part")) {
    const auto part = moved->parts.find(call.text("part"));
    if (part == moved->parts.end()) throw InputError("the mesh has no part '" + call.text("part") + "'; it has" + (moved->parts.empty() ? " none" : shown(mesh_part_names(handle))));
    flagged = mesh::flag_nodes(*moved, part->second);
  }
  mesh::transform(*moved, point_map(call.function("map"), moved->dimension()), flagged);
  handle.mesh = std::move(moved);
  return call.give_self();
}

int pieces(Call& call) {
  std::vector<std::shared_ptr<MeshHandle>> handles;
  for (mesh::Mesh& piece : mesh::split(*call.self<MeshHandle>()->mesh)) handles.push_back(handle_of(std::move(piece)));
  return call.give(handles);
}

std::shared_ptr<MeshHandle> keep(Call& call) {
  const auto whole = call.self<MeshHandle>()->mesh;  // this one, though the function may transform the handle's
  const Function chosen = call.function("chosen");
  const auto dimension = static_cast<std::size_t>(whole->dimension());
  return handle_of(mesh::keep(*whole, [&](const mesh::Point& x) { return chosen.truth({x.data(), dimension}); }, call.text("part")));
}

std::shared_ptr<MeshHandle> refined(Call& call) {
  auto mesh = call.self<MeshHandle>()->mesh;
  const auto times = call.integer("times");
  require_room_to_refine(*mesh, times);
  Watch watch(call.state(), "refining");
  for (std::int64_t k = 0; k < times; ++k) mesh = std::make_shared<mesh::Mesh>(elasticity::refined(*mesh, &watch));
  return std::make_shared<MeshHandle>(MeshHandle{mesh});
}

std::string mesh_text(const MeshHandle& m) {
  const std::string parts = shown(mesh_part_names(m));
  std::string more = m.regions.empty() ? "" : ", regions" + shown(m.regions);
  for (std::size_t i = 0; i < std::min<std::size_t>(m.notes.size(), 3); ++i) more += "\n  " + m.notes[i];
  if (m.notes.size() > 3) more += text("\n  and ", m.notes.size() - 3, " more notes: mesh.notes");
  return text("mesh: ", m.mesh->topology().name, " ", m.mesh->topology().shapes, ", ", m.mesh->node_count(),
              " nodes, ", m.mesh->cell_count(), " cells, parts", parts.empty() ? " none" : parts, more);
}

Key region_key() {
  return key::either("region", {key::string("", ""), key::list("", key::string("", ""), "")},
                     "the physical group of cells to take, or a list of them")
      .otherwise("all cells");
}

Key order_key(const char* second) {
  return key::integer("order", std::string("of the cells: 1, with straight sides between their corners, or 2: ") + second).within(1, 2).otherwise("1").into(&meshfile::Choice::order);
}

meshfile::Choice loading_choice(const Arguments& given) {
  auto result = given.filled<meshfile::Choice>();
  if (given.has("region")) result.regions = given.is("region", LUA_TTABLE) ? given.texts("region") : std::vector<std::string>{given.text("region")};
  return result;
}

std::shared_ptr<MeshHandle> load_mesh_file(Call& call) {
  Watch watch(call.state(), "reading");
  const auto wanted = call.has("options") ? loading_choice(call.table("options")) : meshfile::Choice();
  return handle_of(meshfile::load(call.text("file"), wanted, watch));
}

std::shared_ptr<MeshHandle> gmsh(Call& call) {
  if (Library::of(call.state()).folder) throw ArgumentError("not for scripts run with --safe: a geometry can read any file");
  if (call.has("file") && call.has("text")) throw ArgumentError("'file' and 'text' are both given; give the geometry by one of them");
  if (!call.has("file") && !call.has("text")) throw ArgumentError("one of 'file' and 'text' is needed");
  const auto meshing = call.filled<meshfile::Meshing>();
  Watch watch(call.state(), "meshing");
  if (call.has("file")) return handle_of(meshfile::mesh_geometry(call.text("file"), meshing, loading_choice(call), watch));
  const std::string text = call.is("text", LUA_TFUNCTION) ? call.function("text").text() : call.text("text");
  return handle_of(meshfile::mesh_text(text, meshing, loading_choice(call), watch));
}

void bind_mesh_file(Library& library) {
  library.function(
      {.name = "dotyk.mesh.load",
       .help = "Reads a mesh of triangles, quadrilaterals, tetrahedra or hexahedra: .msh (Gmsh 2 and 4, text or binary), "
               ".mesh (MFEM mesh v1.0, straight or with continuous nodes of order 2) or .vtu (VTK; cell data \"region\", or \"body\" as s:write has it, tell regions apart). Physical "
               "groups of cells are its regions, those of one dimension less its boundary parts; a group without a name "
               "goes by its number. Facets of a part that lie between cells are left out, elements of higher order are reduced to their "
               "corners: mesh.notes says so. With order = 2 elements of second order give cells P2 or Q2 with the "
               "file's nodes (curved sides stay curved; centres that quadrilaterals of 8 and hexahedra of 20 nodes lack are added "
               "without a change of shape), and those of first order get nodes in the middle of their sides. A file of several bodies: one load for each region, or "
               "mesh:pieces().",
       .setup = setup::solved_block(),
       .example = "s:write \"block.vtu\"\nprint(dotyk.mesh.load \"block.vtu\")\nprint(dotyk.mesh.load(\"block.vtu\", { region = \"block\" }))",
       .arguments = {key::file("file", "ends in .msh, .mesh or .vtu").required(), key::table("options", {region_key(), order_key("second order, P2 or Q2")}, "what of it").otherwise("all of it, by the corners")},
       .run = load_mesh_file});
  library.function(
      {.name = "dotyk.mesh.gmsh",
       .help = "Has Gmsh mesh a geometry: a file of its own language (.geo) or from a CAD program (.step, .stp, .brep, "
               ".iges, .igs), or a text in that language, which a function may make. A file name or such a function alone may stand in place of the table. Physical groups become regions and boundary parts as in "
               "dotyk.mesh.load; nodes of curved boundaries lie on them, with order = 2 those between corners, too, so that "
               "sides are parabolas there, not chords. A .geo file is a program that can read any file, but "
               "start no other program and write none. In a text, files to be included need full paths.",
       .example = "local m = dotyk.mesh.gmsh{ size = 0.1, text = [[\n"
                  "  SetFactory(\"OpenCASCADE\");\n"
                  "  Rectangle(1) = {-1, -1, 0, 2, 2};\n"
                  "  Disk(2) = {0, 0, 0, 0.4};\n"
                  "  BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };\n"
                  "  Physical Surface(\"plate\") = {3}; Physical Curve(\"hole\") = {5};\n"
                  "]] }",
       .arguments = {key::table({key::file("file", "the geometry; or text"), key::either("text", {key::string("", ""), key::function("", "")}, "the geometry, in Gmsh's language, or a function that returns it; or file"),
                                 key::positive("size", "greatest length of an edge").unit("length").otherwise("as the geometry says").into(&meshfile::Meshing::size),
                                 key::integer("dimension", "of the cells").within(2, 3).otherwise("3 where there is a volume, else 2").into(&meshfile::Meshing::dimension),
                                 order_key("second order, with curved boundaries"), region_key()})},
       .run = gmsh});
}

}  // namespace

void require_room_to_refine(const mesh::Mesh& mesh, std::int64_t times) {
  const double pieces = std::pow(mesh.dimension() == 2 ? 4 : 8, static_cast<double>(times));
  const bool simplex = mesh.topology().corners == mesh.dimension() + 1, second = mesh.topology().order == 2;
  using mesh::Family;
  require_room(mesh.cell_count() * pieces / (simplex && mesh.dimension() == 3 ? 6 : simplex ? 2 : 1), mesh.dimension(),
               simplex ? (second ? Family::p2 : Family::p1) : second ? Family::q2 : Family::q1);
  constexpr double kMostNodes = 12e6;  // more than solvers of one machine take
  if (const double nodes = mesh.node_count() * pieces; nodes > kMostNodes)
    throw InputError(text("refined ", times, times == 1 ? " time" : " times", " the mesh would have about ", nodes, " nodes; at most ", kMostNodes, " are made"));
}

void bind_mesh(Library& library) {
  library.module("dotyk.mesh", "Meshes: made here or by Gmsh, read from files, moved by mesh:transform.");
  library.function({.name = "dotyk.mesh.rectangle",
                    .help = "A rectangle of cells; with P1 and P2 each is cut from its lower left to its upper right "
                            "corner. Parts: left right bottom top.",
                    .example = "local m = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {64,32} }",
                    .arguments = {key::table({key::vector("from", "lower left corner").count(2).unit("length").required(),
                                              key::vector("to", "upper right corner").count(2).unit("length").required(),
                                              cells_key(2), element_key(), grading_key(2)})},
                    .run = grid<mesh::rectangle>});
  library.function({.name = "dotyk.mesh.box",
                    .help = "A box of cells; with P1 and P2 each is cut into the six tetrahedra along the edge paths from "
                            "its least to its greatest corner. Parts: left right (x), front back (y), bottom top (z).",
                    .example = "local b = dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {8,8,8} }",
                    .arguments = {key::table({key::vector("from", "least corner").count(3).unit("length").required(),
                                              key::vector("to", "greatest corner").count(3).unit("length").required(),
                                              cells_key(3), element_key(), grading_key(3)})},
                    .run = grid<mesh::box>});
  library.function({.name = "dotyk.mesh.disc",
                    .help = "A disc. P1 and P2: concentric rings of triangles; Q1 and Q2: a square core and four blocks about it. "
                            "P2 and Q2: outer edges are curved. Part: boundary.",
                    .example = "local d = dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 16 }",
                    .arguments = {key::table({key::vector("center", "centre").count(2).unit("length").required(),
                                              key::positive("radius", "radius").unit("length").required(),
                                              key::integer("cells", "cells along the radius").required(),
                                              element_key()})},
                    .run = disc});
  library.type<MeshHandle>("A mesh of one kind of cell, with named boundary parts.")
      .setup(setup::mesh())
      .field("dimension", "2 or 3", [](const MeshHandle& m) { return m.mesh->dimension(); })
      .field("node_count", "number of nodes", [](const MeshHandle& m) { return m.mesh->node_count(); })
      .field("cell_count", "number of cells", [](const MeshHandle& m) { return m.mesh->cell_count(); })
      .field("element", "\"P1\", \"Q1\", \"P2\" or \"Q2\"", [](const MeshHandle& m) { return std::string(m.mesh->topology().name); })
      .field("parts", "names of the boundary parts", mesh_part_names)
      .field("regions", "of a mesh from a file: names of the regions that its cells are of", &MeshHandle::regions)
      .field("notes", "of a mesh from a file: what the file has and the mesh has not, sentences", &MeshHandle::notes)
      .method({.name = "mesh:transform",
               .help = "Moves every node, or those of a boundary part, to map(x, y[, z]). Bodies made before keep the mesh as it was. A map that "
                       "inverts a cell is an error and changes nothing. Multigrid keeps the coarser meshes of mesh:refined.",
               .example = "m:transform(function(x, y) return x, y + 0.1 * x^2 end)",
               .arguments = {key::function("map", "coordinates to new coordinates").required(),
                             key::string("part", "the boundary part whose nodes move, for instance onto the curve or surface that it approximates").otherwise("all nodes")},
               .run = transform})
      .method({.name = "mesh:refined",
               .help = "A new mesh with each cell cut into 4 in the plane, 8 in space, so many times, its parts with it. Curved sides of order 2 stay the "
                       "same curves; in meshes of order 1 new nodes lie on the chords, and mesh:transform can move them onto the curve. The coarser meshes are remembered: dotyk.solver.multigrid has its levels from them.",
               .example = "local fine = m:refined(2)",
               .arguments = {key::integer("times", "how often").within(0, 20).fallback(1.0)},
               .run = refined})
      .method({.name = "mesh:keep",
               .help = "A new mesh of the cells whose centre chosen(x, y[, z]) accepts, with what is left of the parts; the "
                       "facets laid bare become a part of their own.",
               .example = "local frame = m:keep(function(x, y) return math.max(math.abs(x), math.abs(y - 0.5)) > 0.25 end, \"hole\")",
               .arguments = {key::function("chosen", "coordinates of a cell's centre to true or false").required(),
                             key::string("part", "name of the facets laid bare").fallback("cut")},
               .run = keep})
      .method({.name = "mesh:pieces",
               .help = "The pieces that are connected through facets (edges in the plane), each a mesh of its own with "
                       "its share of the boundary parts: the bodies of a file that holds several.",
               .example = "for _, piece in ipairs(m:pieces()) do print(piece) end",
               .returns = "list of meshes",
               .run = pieces})
      .text(mesh_text);
  bind_mesh_file(library);
}

}  // namespace dotyk::script

#include "base/memory.hpp"
#include "mesh/generators.hpp"
#include "mesh/submesh.hpp"
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
  const auto axis = [](const char* name) {
    return key::function(name, "maps [0, 1] onto [0, 1], increasing: where the grid lines go");
  };
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

std::shared_ptr<MeshHandle> handle_of(mesh::Mesh mesh) {
  return std::make_shared<MeshHandle>(MeshHandle{std::make_shared<mesh::Mesh>(std::move(mesh))});
}

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

Self transform(Call& call) {
  MeshHandle& handle = *call.self<MeshHandle>();
  const Function map = call.function("map");
  auto moved = std::make_shared<mesh::Mesh>(*handle.mesh);
  mesh::transform(*moved, point_map(map, moved->dimension()));
  handle.mesh = std::move(moved);
  return call.give_self();
}

int pieces(Call& call) {
  std::vector<std::shared_ptr<MeshHandle>> handles;
  for (mesh::Mesh& piece : mesh::split(*call.self<MeshHandle>()->mesh))
    handles.push_back(handle_of(std::move(piece)));
  return call.give(handles);
}

std::shared_ptr<MeshHandle> keep(Call& call) {
  const auto whole = call.self<MeshHandle>()->mesh;  // this one, though the function may transform the handle's
  const Function chosen = call.function("chosen");
  const auto dimension = static_cast<std::size_t>(whole->dimension());
  return handle_of(mesh::keep(*whole, [&](const mesh::Point& x) { return chosen.truth({x.data(), dimension}); },
                               call.text("part")));
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

std::string mesh_text(const MeshHandle& m) {
  const std::string parts = shown(mesh_part_names(m));
  std::string more = m.regions.empty() ? "" : ", regions" + shown(m.regions);
  for (std::size_t i = 0; i < std::min<std::size_t>(m.notes.size(), 3); ++i) more += "\n  " + m.notes[i];
  if (m.notes.size() > 3) more += text("\n  and ", m.notes.size() - 3, " more notes: mesh.notes");
  return text("mesh: ", m.mesh->topology().name, " ", m.mesh->topology().shapes, ", ", m.mesh->node_count(),
              " nodes, ", m.mesh->cell_count(), " cells, parts", parts.empty() ? " none" : parts, more);
}

}  // namespace

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
      .field("regions", "of a mesh from a file: names of the regions that its cells are of", [](const MeshHandle& m) { return m.regions; })
      .field("notes", "of a mesh from a file: what the file has and the mesh has not, sentences", [](const MeshHandle& m) { return m.notes; })
      .method({.name = "mesh:transform",
               .help = "Moves every node to map(x, y[, z]). Bodies made before keep the mesh as it was. A map that "
                       "inverts a cell is an error and changes nothing.",
               .example = "m:transform(function(x, y) return x, y + 0.1 * x^2 end)",
               .arguments = {key::function("map", "coordinates to new coordinates").required()},
               .run = transform})
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
}

}  // namespace dotyk::script

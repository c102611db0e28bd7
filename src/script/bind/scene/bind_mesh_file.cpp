#include "meshfile/load.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {
namespace {

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

std::shared_ptr<MeshHandle> handle_of(meshfile::Loaded loaded) {
  return std::make_shared<MeshHandle>(
      MeshHandle{std::make_shared<mesh::Mesh>(std::move(loaded.mesh)), std::move(loaded.regions), std::move(loaded.notes)});
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

}  // namespace

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

}  // namespace dotyk::script

#include "scene/solve/adaptive.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {

template <> struct Wrapped<scene::Adaptive> : Called<"refinement"> {};

namespace {

using scene::Adaptive;

std::shared_ptr<Adaptive> make_refinement(Call& call) {
  std::vector<std::shared_ptr<const mesh::Mesh>> meshes;
  for (const auto& handle : call.items<MeshHandle>()) meshes.push_back(handle->mesh);
  return std::make_shared<Adaptive>(meshes);
}

std::vector<std::shared_ptr<MeshHandle>> meshes(const Adaptive& refinement) {
  std::vector<std::shared_ptr<MeshHandle>> handles;
  // mesh:transform moves a copy: what bodies and this object hold stays as it is.
  for (int m = 0; m < refinement.count(); ++m)
    handles.push_back(std::make_shared<MeshHandle>(MeshHandle{std::const_pointer_cast<mesh::Mesh>(refinement.mesh(m))}));
  return handles;
}

Self refine(Call& call) {
  const auto refinement = call.self<Adaptive>();
  Watch watch(call.state(), "refining");
  if (!call.has("where")) {
    refinement->refine(watch);
  } else if (call.holds<scene::Solution>("where")) {
    refinement->refine(*call.object<scene::Solution>("where"), call.number("share"), watch);
  } else {
    std::vector<std::vector<int>> cells;
    for (const auto& list : call.matrix("where")) {
      cells.emplace_back();
      for (const double cell : list) {
        if (cell != std::floor(cell) || !(std::abs(cell) < 2e9)) throw InputError(text("cell ", cell, " is not a number of a cell"));
        cells.back().push_back(static_cast<int>(cell) - 1);
      }
    }
    refinement->refine(cells, watch);
  }
  return call.give_self();
}

std::vector<std::string> refinement_part_names(const Adaptive& refinement) {
  std::vector<std::string> names;
  for (int m = 0; m < refinement.count(); ++m)
    for (const auto& [name, facets] : refinement.mesh(m)->parts) names.push_back(name);
  return names;
}

Self project(Call& call) {
  const auto refinement = call.self<Adaptive>();
  refinement->project(call.text("part"), point_map(call.function("map"), refinement->mesh(0)->dimension()));
  return call.give_self();
}

}  // namespace

void bind_refinement(Library& library) {
  library.function({.name = "dotyk.refinement",
                    .help = "Meshes of triangles or tetrahedra (P1) to be refined by bisection, locally and again and again, without "
                            "hanging nodes and without cells getting flat: newest vertex bisection in the plane, marked "
                            "tetrahedra (Arnold, Mukherjee, Pouly 2000) in space. Boundary parts keep their names, old nodes their "
                            "numbers. The meshes given stay as they are; take the refined ones from the field meshes. "
                            "dotyk.adapt does all of it.",
                    .example = "local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {4,4} }\n"
                               "local r = dotyk.refinement{ m }\nprint(r:refine().meshes[1])",
                    .arguments = {key::table({}).with(key::object<MeshHandle>("meshes", "the meshes to begin with"))},
                    .run = make_refinement});
  library.type<Adaptive>("Meshes that are refined together by bisection.")
      .field("meshes", "the meshes as they are now, in the order they were given", meshes)
      .method({.name = "refinement:refine",
               .help = "Refines once: cells marked are bisected as often as the mesh has dimensions, so that their extent halves, "
                       "neighbours as conformity needs. With a solution on these meshes: the fewest cells whose squared error "
                       "estimates are a share of the sum (Dörfler); surfaces in contact or glued go on matching. With lists of "
                       "numbers of cells, one list a mesh: these. Without: all cells. Bodies made before keep their mesh.",
               .example = "local r = dotyk.refinement{ dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 4 } }\nr:refine{ { 1, 2, 3 } }",
               .arguments = {key::either("where", {key::object<scene::Solution>("", ""), key::matrix("", "")}, "what to refine by").otherwise("everywhere"),
                             key::number("share", "of the squared error, of the cells refined; with a solution").fallback(0.5)},
               .run = refine})
      .method({.name = "refinement:project",
               .help = "Moves the nodes that the last round made on a boundary part to map(x, y[, z]): onto the curve or surface that the part "
                       "stands for, from the chords where bisection puts them.",
               .example = "local r = dotyk.refinement{ dotyk.mesh.disc{ center = {0,0}, radius = 1, cells = 4 } }\n"
                          "r:refine():project(\"boundary\", function(x, y) local d = math.sqrt(x^2 + y^2) return x / d, y / d end)",
               .arguments = {key::string("part", "name of the part").required().of<Adaptive>(refinement_part_names),
                             key::function("map", "coordinates to new coordinates").required()},
               .run = project})
      .text([](const Adaptive& r) {
        std::string out = "refinement:";
        for (int m = 0; m < r.count(); ++m)
          out += text(m ? "; " : " ", r.mesh(m)->node_count(), " nodes, ", r.mesh(m)->cell_count(), " cells");
        return out;
      });
}

}  // namespace dotyk::script

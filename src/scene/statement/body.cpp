#include "scene/statement/body.hpp"

#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/listed.hpp"
#include "elasticity/refined.hpp"
#include "mesh/decomposition.hpp"
#include "multigrid/multigrid.hpp"

namespace dotyk::scene {

std::vector<elasticity::FacetSpring> Body::facet_springs() const {
  std::vector<elasticity::FacetSpring> result;
  for (const SpringPatch& patch : springs) result.push_back(patch.spring);
  return result;
}

namespace {

/// How many nodes lie at the place of one before them, but for rounding.
int nodes_twice(const mesh::Mesh& mesh) {
  std::set<std::array<long long, 3>> places;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const mesh::Point x = mesh::times(1e9 / mesh.size(), mesh.point(n));
    places.insert({std::llround(x[0]), std::llround(x[1]), std::llround(x[2])});
  }
  return mesh.node_count() - static_cast<int>(places.size());
}

/// Pieces hinged at nodes, or apart, have more rigid motions than a body has.
void require_one_piece(const mesh::Mesh& mesh, const std::string& name) {
  if (mesh.one_piece()) return;
  const mesh::Pieces pieces = mesh::pieces_of(mesh);
  if (pieces.count == 1) return;
  std::vector<std::string> all;
  for (const auto& cells : pieces.cells()) {
    mesh::Point middle{0, 0, 0};
    for (const int c : cells) middle = mesh::plus(middle, mesh::times(1.0 / static_cast<double>(cells.size()), mesh.cell_centre(c)));
    all.push_back(text(cells.size(), cells.size() == 1 ? " cell" : " cells", " around ", point_text(middle.data(), mesh.dimension())));
  }
  const int twice = nodes_twice(mesh);
  const std::string merge = text("; ", twice, " of its ", mesh.node_count(), " nodes lie where another one does: cells that hang together ",
                                 "share nodes, so merge them in the program that made the mesh (Gmsh: Coherence Mesh; ParaView: Clean to Grid)");
  throw InputError(text("the mesh of '", name, "' is in ", all.size(), " pieces that share no ", mesh.dimension() == 2 ? "edge" : "face", ": ",
                        listed(all, 4), twice > 0 ? merge : "", twice > 0 ? "; of pieces that are apart, " : "; ",
                        "make each a body of its own (mesh:keep takes cells by their centres), in contact or glued"));
}

/// Throws where these cannot make a body.
void require_sound(const mesh::Mesh& mesh, const elasticity::MaterialField& material, const std::string& name) {
  mesh::check(mesh, "body '" + name + "'");
  if (mesh.cell_count() == 0) throw InputError("the mesh of '" + name + "' has no cells");
  require_one_piece(mesh, name);
  if (material.at(0).dimension != mesh.dimension())
    throw InputError(text("the material of '", name, "' is for ", material.at(0).dimension, "-D, its mesh is ", mesh.dimension(), "-D"));
}

}  // namespace

std::shared_ptr<Body> make_body(std::string name, std::shared_ptr<const mesh::Mesh> mesh,
                                elasticity::MaterialField material,
                                const elasticity::VectorField& force) {
  require_sound(*mesh, material, name);
  auto body = std::make_shared<Body>();
  body->name = std::move(name);
  body->mesh = std::move(mesh);
  body->material = std::move(material);
  if (force) load_volume(*body, force);
  return body;
}

std::shared_ptr<Body> make_refined_body(std::string name, std::shared_ptr<const mesh::Mesh> mesh, elasticity::MaterialField material, int times,
                                        const elasticity::VectorField& force, Monitor& monitor) {
  require_sound(*mesh, material, name);
  elasticity::LinearForce linear = force ? elasticity::LinearForce(*mesh, force) : elasticity::LinearForce();
  std::shared_ptr<Body> body;
  if (multigrid::count_ranks() == 1) {
    for (int k = 0; k < times; ++k) {
      const auto finer = std::make_shared<const mesh::Mesh>(elasticity::refined(*mesh, &monitor));
      material = elasticity::of_pieces(material, *mesh, *finer), linear = elasticity::of_pieces(linear, *mesh, *finer);
      mesh = finer;
    }
    body = make_body(std::move(name), std::move(mesh), std::move(material), {});
  } else {
    body = std::make_shared<Body>();
    body->name = std::move(name);
    elasticity::NearBoundary near = elasticity::refined_near_boundary(*mesh, times, &monitor);
    mesh::check(near.mesh, "body '" + body->name + "'");
    body->mesh = std::make_shared<const mesh::Mesh>(std::move(near.mesh));
    body->material = material.of(near.parent);
    body->unrefined = std::make_shared<const Unrefined>(Unrefined{mesh, material, linear, times, std::move(near.between)});
    linear = linear.of(near.parent);
  }
  if (linear.any()) load_volume(*body, [&](const elasticity::CellPoint& p) { return linear.at(p.cell, p.x); });
  return body;
}

void require_whole(const Body& body, const std::string& what) {
  if (body.unrefined)
    throw InputError(text("'", body.name, "' was given refine = ", body.unrefined->times, ", so that on ", multigrid::count_ranks(), " ranks its inner cells are not in one place; ",
                          what, " needs them: give the refined mesh (mesh:refined), or run on one rank"));
}

PartMark Part::mark() const {
  std::size_t hash = facets.size();
  for (const mesh::Facet f : facets) hash = hash * 1000003u + 6 * static_cast<std::size_t>(f.cell) + f.local;
  return {name, hash};
}

std::vector<std::string> part_names(const Body& body) {
  std::vector<std::string> names;
  for (const auto& [name, facets] : body.mesh->parts) names.push_back(name);
  return names;
}

Part named_part(const std::shared_ptr<Body>& body, const std::string& name) {
  const auto found = body->mesh->parts.find(name);
  if (found == body->mesh->parts.end()) {
    const std::string all = listed(part_names(*body));
    throw InputError(text("'", body->name, "' has no part '", name, "'; it has ", all.empty() ? "none" : all));
  }
  if (found->second.empty()) throw InputError(text("part '", name, "' of '", body->name, "' has no facets"));
  return {body, name, found->second};
}

Part chosen_part(const std::shared_ptr<Body>& body, const std::string& name,
                 const std::function<bool(const mesh::Point&, const mesh::Point&)>& chosen) {
  Part part{body, name, mesh::select(*body->mesh, chosen)};
  if (part.facets.empty())
    throw InputError(text("part '", name, "' of '", body->name,
                          "' is empty: its function accepts none of the boundary's facets (it is asked "
                          "with facet centres and outward normals)"));
  return part;
}

}  // namespace dotyk::scene

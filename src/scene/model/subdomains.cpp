#include "scene/model/subdomains.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "elasticity/rigid_modes.hpp"
#include "mesh/decomposition.hpp"

namespace dotyk::scene {
namespace {

using problem::Subdomain;

/// Some cells of a body with all that their stiffness is made of.
struct Piece {
  int body = 0;
  mesh::Submesh part;
  elasticity::MaterialField material;            ///< of its own cells
  std::vector<elasticity::FacetSpring> springs;  ///< on facets of its own cells, in its matrix
  std::vector<elasticity::FacetSpring> row_springs;  ///< the same where supports are rows
  /// Of its own components: all unknown where supports are rows, else as the body's; values are in the body's alone.
  elasticity::Numbering numbering;
};

std::vector<mesh::Pieces> decompose(const std::vector<Body>& bodies, const problem::Decomposition& decomposition) {
  std::vector<mesh::Pieces> result;
  if (decomposition.count == 0) {
    for (const Body& body : bodies) result.push_back(mesh::decompose(*body.mesh, decomposition.boxes));
    return result;
  }
  std::vector<int> cells;
  for (const Body& body : bodies) cells.push_back(body.mesh->cell_count());
  const std::vector<int> share = mesh::share_out(decomposition.count, cells);
  for (std::size_t b = 0; b < bodies.size(); ++b) result.push_back(mesh::decompose(*bodies[b].mesh, share[b]));
  return result;
}

/// The piece's own components, numbered.
elasticity::Numbering number(const mesh::Submesh& part, const elasticity::Numbering& whole, bool support_rows) {
  const int dim = part.mesh.dimension();
  std::vector<char> held(part.mesh.coordinates.size(), 0);
  for (std::size_t k = 0; k < held.size() && !support_rows; ++k)
    held[k] = whole.unknown[static_cast<std::size_t>(part.node[k / dim]) * dim + k % dim] < 0;
  return elasticity::number(part.mesh, held, {});
}

/// Gives every spring to the piece that its facet's cell is in. `first`: the body's first piece.
void share_springs(const Body& body, const mesh::Pieces& of, bool support_rows, std::vector<Piece>& all, std::size_t first) {
  if (body.springs.empty()) return;
  std::vector<int> own(of.of_cell.size());
  for (int p = 0; p < of.count; ++p) {
    const std::vector<int>& cells = all[first + p].part.cell;
    for (std::size_t k = 0; k < cells.size(); ++k) own[cells[k]] = static_cast<int>(k);
  }
  for (const SpringPatch& patch : body.springs) {
    elasticity::FacetSpring spring = patch.spring;
    const int cell = spring.facet.cell;
    spring.facet.cell = own[cell];
    Piece& piece = all[first + of.of_cell[cell]];
    (support_rows ? piece.row_springs : piece.springs).push_back(std::move(spring));
  }
}

/// The pieces of all bodies of the model, body by body, each connected through facets; pieces without an unknown are
/// left out. None where the decomposition changes nothing: one piece a body, supports in the matrices.
std::vector<Piece> pieces(const Model& model, const problem::Decomposition& decomposition) {
  const std::vector<mesh::Pieces> of = decompose(model.bodies, decomposition);
  std::vector<Piece> all;
  std::vector<std::vector<int>> cells;
  for (std::size_t b = 0; b < of.size(); ++b)
    for (auto& one : of[b].cells()) {
      all.emplace_back().body = static_cast<int>(b);
      cells.push_back(std::move(one));
    }
  if (!decomposition.support_rows && all.size() == model.bodies.size()) return {};
  parallel_for(static_cast<int>(all.size()), [&](int k) {
    Piece& piece = all[k];
    const Body& body = model.bodies[piece.body];
    piece.part = mesh::submesh(*body.mesh, std::move(cells[k]));
    piece.material = body.material.of(piece.part.cell);
    piece.numbering = number(piece.part, model.numbering[piece.body], decomposition.support_rows);
  });
  std::size_t first = 0;
  for (std::size_t b = 0; b < of.size(); first += of[b++].count) share_springs(model.bodies[b], of[b], decomposition.support_rows, all, first);
  std::erase_if(all, [](const Piece& piece) { return piece.numbering.count() == 0; });
  return all;
}

/// Of all cells: least Jacobian by the greatest extent, seen from the first node, to the power of one dimension less.
double least_height(const mesh::Mesh& mesh) {
  const int dim = mesh.dimension(), nodes = mesh.topology().nodes;
  double least = INFINITY;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double extent = 0;
    for (int k = 1; k < nodes; ++k)
      for (int i = 0; i < dim; ++i)
        extent = std::max(extent, std::abs(mesh.node(mesh.cell(c)[k])[i] - mesh.node(mesh.cell(c)[0])[i]));
    least = std::min(least, mesh::least_jacobian(mesh, c) / std::pow(extent, dim - 1));
  }
  return least;
}

bool translated(const mesh::Mesh& a, const mesh::Mesh& b, double tolerance) {
  const int dim = a.dimension();
  for (std::size_t k = 0; k < a.coordinates.size(); ++k) {
    const double of_a = a.coordinates[k] - a.coordinates[k % dim], of_b = b.coordinates[k] - b.coordinates[k % dim];
    if (!(std::abs(of_a - of_b) <= tolerance)) return false;
  }
  return true;
}

/// Of equal matrix; what tells most pieces apart is asked first.
bool alike(const Piece& a, const Piece& b, double tolerance) {
  return a.part.mesh.element == b.part.mesh.element && a.part.mesh.coordinates.size() == b.part.mesh.coordinates.size() &&
         a.springs.empty() && b.springs.empty() && translated(a.part.mesh, b.part.mesh, tolerance) &&
         a.part.mesh.cells == b.part.mesh.cells && a.numbering.unknown == b.numbering.unknown && a.material == b.material;
}

/// Equal for pieces that are alike.
std::size_t hash(const Piece& piece) {
  std::size_t h = piece.numbering.node.size();
  for (const int n : piece.part.mesh.cells) h = h * 1000003u + static_cast<std::size_t>(n);
  return h;
}

/// For each piece the first one, or itself, of which it is a translate: the same cells on the same numbers of nodes,
/// the same material cell by cell, the same components held, no springs in the matrix, and nodes whose places relative to the
/// first node agree within 1e-12 of the least height of their cells. The matrix of one then serves for the other: its
/// entries are off by no more than some 1e-12 of the diagonal. What is off in truth is the rounding of coordinates:
/// some 1e-16 X/h for coordinates up to X and cells of size h, which the matrix has from them anyway. Where X/h is
/// beyond some thousands, translates may go unnoticed.
std::vector<int> congruent(const std::vector<Piece>& pieces) {
  std::vector<double> tolerance(pieces.size());
  parallel_for(static_cast<int>(pieces.size()), [&](int k) { tolerance[k] = 1e-12 * least_height(pieces[k].part.mesh); });
  std::vector<int> result(pieces.size());
  std::unordered_map<std::size_t, std::vector<int>> first;  // those that are no translates of earlier ones, by hash
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    std::vector<int>& known = first[hash(pieces[k])];
    const auto same = std::find_if(known.begin(), known.end(), [&](int j) {
      return alike(pieces[j], pieces[k], std::min(tolerance[j], tolerance[k]));
    });
    result[k] = same == known.end() ? static_cast<int>(k) : *same;
    if (same == known.end()) known.push_back(static_cast<int>(k));
  }
  return result;
}

/// Which of the blocks' unknowns the piece's own ones are; with its springs apart.
Subdomain numbered(const Piece& piece, const Model& model) {
  const problem::Block& block = model.problem.blocks[piece.body];
  const std::vector<int>& whole = model.numbering[piece.body].unknown;
  const int dim = piece.part.mesh.dimension();
  Subdomain s;
  s.block = piece.body;
  s.f.resize(piece.numbering.count());
  s.value.resize(piece.numbering.count());
  for (std::size_t k = 0; k < piece.numbering.unknown.size(); ++k) {
    if (piece.numbering.unknown[k] < 0) continue;
    const int node = piece.part.node[k / dim], unknown = whole[static_cast<std::size_t>(node) * dim + k % dim];
    s.node.push_back(node);
    s.unknown.push_back(unknown < 0 ? -1 : block.first + unknown);
  }
  elasticity::SpringRows springs = elasticity::spring_rows(piece.part.mesh, piece.row_springs, piece.numbering);
  s.S = std::move(springs.S);
  s.spring = std::move(springs.stiffness);
  return s;
}

problem::Stiffness assemble(const Piece& piece, const std::string& body) {
  const mesh::Mesh& mesh = piece.part.mesh;
  problem::Stiffness s{elasticity::assemble(mesh, piece.material, piece.springs, piece.numbering), {}};
  auto rigid = elasticity::rigid_modes(mesh, piece.numbering, piece.springs);
  problem::require_kernel(s.K, rigid.modes, "a subdomain of '" + body + "'", rigid.motions);
  s.kernel = std::move(rigid.modes);
  return s;
}

}  // namespace

void cut(const problem::Decomposition& decomposition, Model& model, Monitor& monitor) {
  monitor.phase("cutting bodies into subdomains");
  model.decomposition = decomposition;
  const std::vector<Piece> all = pieces(model, decomposition);
  const int count = static_cast<int>(all.size());
  const std::vector<int> first = congruent(all);
  double bytes = 0;
  for (int k = 0; k < count; ++k)
    if (first[k] == k) bytes += elasticity::matrix_bytes(all[k].part.mesh);
  require_memory(bytes, text("the stiffness of ", count, " subdomains"));
  monitor.check();
  monitor.phase(text("assembling ", count, " subdomains"));
  std::vector<Subdomain>& subdomains = model.problem.subdomains;
  subdomains.resize(count);
  parallel_for(count, [&](int k) {
    subdomains[k] = numbered(all[k], model);
    if (first[k] == k)
      subdomains[k].stiffness = std::make_shared<const problem::Stiffness>(assemble(all[k], model.bodies[all[k].body].name));
  });
  for (int k = 0; k < count; ++k) subdomains[k].stiffness = subdomains[first[k]].stiffness;
  load_subdomains(model);
}

void load_subdomains(Model& model) {
  if (model.problem.subdomains.empty()) return;
  const bool support_rows = model.decomposition->support_rows;
  // Supports as rows: the nodal loads of all components; else the block's load, of its unknowns alone.
  const auto load_of = [&](const Subdomain& s, int i) -> std::size_t {
    const std::size_t dim = model.bodies[s.block].dimension();  // all components of a node then come one by one
    return support_rows ? s.node[i] * dim + i % dim : s.unknown[i] - model.problem.blocks[s.block].first;
  };
  std::vector<std::vector<int>> copies;
  for (const Body& body : model.bodies) copies.emplace_back(body.mesh->coordinates.size(), 0);
  for (const Subdomain& s : model.problem.subdomains)
    for (int i = 0; i < s.size(); ++i) ++copies[s.block][load_of(s, i)];
  for (Subdomain& s : model.problem.subdomains)
    for (int i = 0; i < s.size(); ++i) {
      const std::size_t k = load_of(s, i);
      s.f[i] = (support_rows ? model.bodies[s.block].force_at(k) : model.problem.blocks[s.block].f[k]) / copies[s.block][k];
      s.value[i] = support_rows ? model.numbering[s.block].value(k) : 0;
    }
}

}  // namespace dotyk::scene

#include "scene/model/pieces.hpp"

#include "base/parallel.hpp"
#include "mesh/decomposition.hpp"

namespace dotyk::scene {
namespace {

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
  std::vector<double> none(held.size(), 0.0);
  return elasticity::number(part.mesh, held, std::move(none));
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

}  // namespace

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

}  // namespace dotyk::scene

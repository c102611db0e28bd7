#include "scene/model/subdomains.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "elasticity/rigid_modes.hpp"
#include "scene/model/congruent.hpp"
#include "scene/model/pieces.hpp"

namespace dotyk::scene {
namespace {

using problem::Subdomain;

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
  problem::Stiffness s{elasticity::assemble(mesh, piece.material, piece.springs, {}, piece.numbering).K, {}};
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
      s.f[i] = (support_rows ? model.bodies[s.block].force[k] : model.problem.blocks[s.block].f[k]) / copies[s.block][k];
      s.value[i] = support_rows ? model.numbering[s.block].prescribed[k] : 0;
    }
}

}  // namespace dotyk::scene

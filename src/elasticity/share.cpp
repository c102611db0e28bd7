#include "elasticity/share.hpp"

#include <algorithm>
#include <iterator>

#include "algebra/congruent.hpp"
#include "base/memory.hpp"
#include "elasticity/refined.hpp"
#include "mesh/decomposition.hpp"

namespace dotyk::elasticity {

namespace {

// The places of the lists. The first ones are the material's.
enum Whole { kElement = MaterialField::kWholeLists, kCells, kFixed, kForceKind };
enum Real { kCoordinates = MaterialField::kRealLists, kForce };

/// The cells that have a flagged node, and `layers` − 1 more layers of their neighbours.
std::vector<int> cells_about(const mesh::Mesh& mesh, std::vector<char> flagged, int layers) {
  std::vector<int> cells = mesh::cells_at(mesh, flagged);
  for (; layers > 1; --layers) {
    for (const int c : cells)
      for (int k = 0; k < mesh::nodes_of(mesh.element); ++k) flagged[mesh.cell(c)[k]] = 1;
    cells = mesh::cells_at(mesh, flagged);
  }
  return cells;
}

/// From the lists of joined(), body by body.
std::vector<ShareCells> cells_of(Lists lists) {
  std::vector<ShareCells> all;
  auto whole = lists.whole.begin() + 1;
  auto real = lists.real.begin();
  const std::vector<int> sizes = std::move(lists.whole[0]);
  for (std::size_t k = 0; k < sizes.size(); k += 2) {
    Lists body;
    std::move(whole, whole + sizes[k], std::back_inserter(body.whole)), whole += sizes[k];
    std::move(real, real + sizes[k + 1], std::back_inserter(body.real)), real += sizes[k + 1];
    ShareCells& cells = all.emplace_back();
    cells.body = body.whole[kElement][1];
    cells.material = MaterialField(body);
    cells.mesh.element = static_cast<mesh::Element>(body.whole[kElement][0]);
    cells.mesh.coordinates.swap(body.real[kCoordinates]), cells.mesh.cells.swap(body.whole[kCells]);
    cells.fixed.assign(body.whole[kFixed].begin(), body.whole[kFixed].end());
    cells.force = {body.whole[kForceKind], std::move(body.real[kForce])};
  }
  return all;
}

/// The meshes are gone then.
algebra::StoredMatrix assembled(std::vector<ShareCells> bodies) {
  std::vector<algebra::StoredMatrix> blocks;
  for (ShareCells& body : bodies) {
    require_memory(2 * matrix_bytes(body.mesh), "a share of the stiffness");
    blocks.push_back(assemble(body.mesh, body.material, {}, number(body.mesh, body.fixed, {})));
    body = {};
  }
  if (blocks.size() == 1) return std::move(blocks[0]);
  if (blocks.empty()) return {};
  std::vector<const algebra::SparseMatrix*> all;
  double entries = 0;
  for (const auto& block : blocks) all.push_back(&block), entries += static_cast<double>(block.nonZeros());
  if (entries > 2e9) throw InputError("a process would have more than 2e9 entries of the stiffness; use more processes, or coarser meshes");
  require_memory(12 * entries, "the stiffness of several bodies");
  algebra::StoredMatrix joined;
  joined = algebra::block_diagonal(all);
  return joined;
}

}  // namespace

Share share(const mesh::Mesh& mesh, const MaterialField& material, const LinearForce& force, const Numbering& numbering, const std::vector<char>& own, int body, int layers) {
  std::vector<char> near(static_cast<std::size_t>(mesh.node_count()), 0);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i]) near[numbering.node[i]] = 1;
  mesh::Submesh part = mesh::submesh(mesh, cells_about(mesh, std::move(near), layers));
  Share out;
  std::vector<int> fixed;
  for (const int node : part.node)
    for (int i = 0, dim = mesh.dimension(); i < dim; ++i) {
      const int unknown = numbering.unknown[static_cast<std::size_t>(node) * dim + i];
      fixed.push_back(unknown < 0);
      if (unknown >= 0) out.unknowns.push_back(unknown);
    }
  out.lists = material.of(part.cell).lists();
  Lists of_force = force.of(part.cell).lists();
  const auto add = [](auto& to, auto&&... lists) { (to.push_back(std::move(lists)), ...); };
  add(out.lists.whole, std::vector{static_cast<int>(mesh.element), body}, std::move(part.mesh.cells), std::move(fixed), std::move(of_force.whole[0]));
  add(out.lists.real, std::move(part.mesh.coordinates), std::move(of_force.real[0]));
  return out;
}

Share joined(std::vector<Share> of_bodies) {
  Share all;
  std::vector<int> sizes;  // how many lists each body has
  for (const Share& share : of_bodies) sizes.insert(sizes.end(), {static_cast<int>(share.lists.whole.size()), static_cast<int>(share.lists.real.size())});
  all.lists.whole.push_back(std::move(sizes));
  for (Share& share : of_bodies) {
    std::ranges::move(share.lists.whole, std::back_inserter(all.lists.whole));
    std::ranges::move(share.lists.real, std::back_inserter(all.lists.real));
    all.unknowns.insert(all.unknowns.end(), share.unknowns.begin(), share.unknowns.end());
  }
  return all;
}

Buckets RefinableShare::refine() {
  std::vector<int> coarse(bodies_.size());
  int nodes = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    ShareCells& body = bodies_[b];
    require_memory(refining_bytes(body.mesh), "a share of the refined mesh");
    mesh::Mesh finer = refined(body.mesh);
    body.material = of_pieces(body.material, body.mesh, finer), body.force = of_pieces(body.force, body.mesh, finer);
    coarse[b] = body.mesh.node_count(), nodes += finer.node_count();
    body.mesh = std::move(finer);
  }
  Buckets means(nodes, [&](auto&& put) {
    int node = 0, first = 0;
    for (std::size_t b = 0; b < bodies_.size(); first += coarse[b], ++b)
      for (int i = 0; i < bodies_[b].mesh.node_count(); ++i, ++node)
        for (const int p : bodies_[b].mesh.coarser->means[i]) put(node, first + p);
  });
  for (ShareCells& body : bodies_) body.mesh.coarser = nullptr;
  return means;
}

std::vector<int> RefinableShare::keep(const std::vector<char>& flagged, int layers) {
  std::vector<int> before;
  auto first = flagged.begin();
  for (ShareCells& body : bodies_) {
    const auto end = first + body.mesh.node_count();
    mesh::Submesh left = mesh::submesh(body.mesh, cells_about(body.mesh, {first, end}, layers));
    body.mesh = std::move(left.mesh), body.material = body.material.of(left.cell), body.force = body.force.of(left.cell);
    for (const int node : left.node) before.push_back(static_cast<int>(first - flagged.begin()) + node);
    first = end;
  }
  return before;
}

algebra::Refinable::Assembled RefinableShare::assemble(const std::vector<char>& fixed) {
  auto first = fixed.begin();
  for (ShareCells& body : bodies_) {
    const auto end = first + std::ssize(body.mesh.coordinates);
    body.fixed.assign(first, end), first = end;
  }
  std::vector<double> load = this->load();
  return {assembled(std::move(bodies_)), std::move(load)};
}

std::vector<double> RefinableShare::load() const {
  std::vector<double> all;
  if (std::ranges::none_of(bodies_, [](const ShareCells& body) { return body.force.any(); })) return all;
  for (const ShareCells& body : bodies_) {
    std::vector<double> nodal(body.mesh.coordinates.size(), 0.0);
    if (body.force.any()) add_body_force(body.mesh, [&](const CellPoint& p) { return body.force.at(p.cell, p.x); }, nodal);
    for (std::size_t k = 0; k < nodal.size(); ++k)
      if (!body.fixed[k]) all.push_back(nodal[k]);
  }
  return all;
}

algebra::StoredMatrix assemble_share(Lists lists) { return assembled(cells_of(std::move(lists))); }

std::unique_ptr<algebra::Refinable> refinable_share(Lists lists) { return std::make_unique<RefinableShare>(cells_of(std::move(lists))); }

}  // namespace dotyk::elasticity

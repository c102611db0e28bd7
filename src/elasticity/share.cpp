#include "elasticity/share.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "algebra/congruent.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "mesh/submesh.hpp"

namespace dotyk::elasticity {

namespace {

// The places of the lists. The first ones are the material's.
enum Whole { kElement = MaterialField::kWholeLists, kCells, kFixed, kSpringFacets };
enum Real { kCoordinates = MaterialField::kRealLists, kSprings };

}  // namespace

Share share(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering,
            const std::vector<char>& own) {
  std::vector<char> near(static_cast<std::size_t>(mesh.node_count()), 0);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i]) near[numbering.node[i]] = 1;
  const int per_cell = mesh::nodes_of(mesh.element), dim = mesh.dimension();
  std::vector<int> cells, place(static_cast<std::size_t>(springs.empty() ? 0 : mesh.cell_count()), -1);
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (std::any_of(mesh.cell(c), mesh.cell(c) + per_cell, [&](int node) { return near[node]; })) {
      if (!place.empty()) place[c] = static_cast<int>(cells.size());
      cells.push_back(c);
    }
  mesh::Submesh part = mesh::submesh(mesh, std::move(cells));
  Share out;
  std::vector<int> fixed, facets;
  std::vector<double> stiffness;
  for (const int node : part.node)
    for (int i = 0; i < dim; ++i) {
      const int unknown = numbering.unknown[static_cast<std::size_t>(node) * dim + i];
      fixed.push_back(unknown < 0);
      if (unknown >= 0) out.unknowns.push_back(unknown);
    }
  for (const FacetSpring& spring : springs)
    if (const int cell = place[spring.facet.cell]; cell >= 0) {
      facets.insert(facets.end(), {cell, spring.facet.local});
      for (const auto& at : spring.stiffness) stiffness.insert(stiffness.end(), at.begin(), at.end());
    }
  out.lists = material.of(part.cell).lists();
  const auto add = [](auto& to, auto&&... lists) { (to.push_back(std::move(lists)), ...); };
  add(out.lists.whole, std::vector{static_cast<int>(mesh.element)}, std::move(part.mesh.cells), std::move(fixed), std::move(facets));
  add(out.lists.real, std::move(part.mesh.coordinates), std::move(stiffness));
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

namespace {

algebra::StoredMatrix assemble_body(Lists lists) {
  mesh::Mesh mesh;
  mesh.element = static_cast<mesh::Element>(lists.whole[kElement][0]);
  mesh.coordinates.swap(lists.real[kCoordinates]), mesh.cells.swap(lists.whole[kCells]);
  require_memory(2 * matrix_bytes(mesh), "a share of the stiffness");
  const std::vector<int>& facets = lists.whole[kSpringFacets];
  std::vector<FacetSpring> springs;
  for (std::size_t k = 0; k < facets.size(); k += 2) {
    FacetSpring& spring = springs.emplace_back(FacetSpring{{facets[k], facets[k + 1]}, {}});
    const std::size_t points = static_cast<std::size_t>(facet_points(mesh));
    for (std::size_t q = 0; q < points; ++q) {
      const double* at = lists.real[kSprings].data() + (k / 2 * points + q) * 3;
      spring.stiffness.push_back({at[0], at[1], at[2]});
    }
  }
  const std::vector<int>& fixed = lists.whole[kFixed];
  return assemble(mesh, MaterialField(lists), springs, number(mesh, {fixed.begin(), fixed.end()}, {}));
}

}  // namespace

algebra::StoredMatrix assemble_share(Lists lists) {
  std::vector<algebra::StoredMatrix> blocks;
  auto whole = lists.whole.begin() + 1;
  auto real = lists.real.begin();
  const std::vector<int> sizes = std::move(lists.whole[0]);
  for (std::size_t k = 0; k < sizes.size(); k += 2) {
    Lists body;
    std::move(whole, whole + sizes[k], std::back_inserter(body.whole)), whole += sizes[k];
    std::move(real, real + sizes[k + 1], std::back_inserter(body.real)), real += sizes[k + 1];
    blocks.push_back(assemble_body(std::move(body)));
  }
  if (blocks.size() == 1) return std::move(blocks[0]);
  std::vector<const algebra::SparseMatrix*> all;
  double entries = 0;
  for (const auto& block : blocks) all.push_back(&block), entries += static_cast<double>(block.nonZeros());
  if (entries > 2e9) throw InputError("a process would have more than 2e9 entries of the stiffness; use more processes, or coarser meshes");
  require_memory(12 * entries, "the stiffness of several bodies");
  algebra::StoredMatrix joined;
  joined = algebra::block_diagonal(all);
  return joined;
}

}  // namespace dotyk::elasticity

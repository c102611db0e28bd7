#include "elasticity/pattern.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace dotyk::elasticity {

Pattern::Pattern(const mesh::Mesh& mesh, const Numbering& numbering) {
  std::vector<int> unknowns_of(mesh.node_count(), 0);
  for (int n : numbering.node) ++unknowns_of[n];
  const std::size_t entries = find_neighbours(mesh, unknowns_of);
  if (entries > 2'000'000'000)
    throw InputError("the stiffness matrix would have more than 2e9 entries; use a coarser mesh");
  matrix_.resize(numbering.count(), numbering.count());
  matrix_.resizeNonZeros(static_cast<Eigen::Index>(entries));
  std::fill_n(matrix_.valuePtr(), entries, 0.0);
  number_entries(numbering, unknowns_of);
}

std::size_t Pattern::find_neighbours(const mesh::Mesh& mesh, const std::vector<int>& unknowns_of) {
  const int nodes = mesh.node_count(), dim = mesh.dimension(), per_cell = mesh.topology().nodes;
  const mesh::Buckets around = mesh::cells_of_nodes(mesh);
  std::vector<int> mark(nodes, -1);
  start_.assign(nodes + 1, 0);
  neighbour_.reserve(static_cast<std::size_t>(nodes) * (dim == 2 ? 4 : 14));
  std::size_t entries = 0;
  for (int b = 0; b < nodes; ++b) {
    const int first = static_cast<int>(neighbour_.size());
    start_[b] = first;
    neighbour_.push_back(b);
    mark[b] = b;
    for (const int c : around[b])
      for (int l = 0; l < per_cell; ++l) {
        const int a = mesh.cell(c)[l];
        if (a > b && mark[a] != b) {
          mark[a] = b;
          neighbour_.push_back(a);
        }
      }
    std::sort(neighbour_.begin() + first + 1, neighbour_.end());
    int rows = 0;
    for (std::size_t k = first; k < neighbour_.size(); ++k) rows += unknowns_of[neighbour_[k]];
    const int m = unknowns_of[b];
    entries += static_cast<std::size_t>(rows) * m - m * (m - 1) / 2;
  }
  start_[nodes] = static_cast<int>(neighbour_.size());
  return entries;
}

void Pattern::number_entries(const Numbering& numbering, const std::vector<int>& unknowns_of) {
  const int nodes = static_cast<int>(unknowns_of.size());
  offset_.resize(neighbour_.size());
  std::vector<int> first_unknown(nodes, 0);
  for (int u = numbering.count() - 1; u >= 0; --u) first_unknown[numbering.node[u]] = u;
  int* outer = matrix_.outerIndexPtr();
  int* inner = matrix_.innerIndexPtr();
  int at = 0;
  for (int b = 0; b < nodes; ++b) {
    int offset = 0;
    for (int k = start_[b]; k < start_[b + 1]; ++k) {
      offset_[k] = offset;
      offset += unknowns_of[neighbour_[k]];
    }
    for (int rank = 0; rank < unknowns_of[b]; ++rank) {
      outer[first_unknown[b] + rank] = at;
      for (int k = start_[b]; k < start_[b + 1]; ++k) {
        const int a = neighbour_[k];
        for (int r = a == b ? rank : 0; r < unknowns_of[a]; ++r) inner[at++] = first_unknown[a] + r;
      }
    }
  }
  outer[numbering.count()] = at;
}

}  // namespace dotyk::elasticity

#include "elasticity/coarse_functions.hpp"

#include <numeric>
#include <utility>

namespace dotyk::elasticity {

std::vector<algebra::CoarseFunctions> coarse_functions(const mesh::Mesh& mesh, SharedList<int> unknown, int unknowns, int levels) {
  const int d = mesh.dimension();
  std::vector<algebra::CoarseFunctions> all;
  std::shared_ptr<const mesh::Coarser> coarser = mesh.coarser;
  for (int level = 0; level < levels; ++level) {
    algebra::CoarseFunctions functions{d, coarser ? std::shared_ptr<const Buckets>(coarser, &coarser->means) : nullptr, unknown, {}, unknowns, 0};
    const int coarse = coarser ? coarser->node_count : functions.nodes();
    std::vector<int> column(static_cast<std::size_t>(d) * coarse);
    std::iota(column.begin(), column.end(), 0);
    for (int node = 0; node < functions.nodes(); ++node)
      if (const int p = functions.same(node); p >= 0)
        for (int k = 0; k < d; ++k)
          if (functions.row[d * node + k] < 0) column[d * p + k] = -1;
    unknown = functions.column = std::move(column);
    unknowns = functions.columns = d * coarse;
    all.push_back(std::move(functions));
    if (coarser) coarser = coarser->next;
  }
  return all;
}

}  // namespace dotyk::elasticity

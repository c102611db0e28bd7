#include "elasticity/coarse_functions.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/parallel.hpp"

namespace dotyk::elasticity {

std::vector<algebra::SparseRows> coarse_functions(const mesh::Mesh& mesh, const std::vector<int>& unknown, int unknowns, int levels) {
  const auto d = static_cast<std::size_t>(mesh.dimension());
  std::vector<algebra::SparseRows> all;  // Eigen's matrices have no move: each is made where it stays
  all.reserve(static_cast<std::size_t>(levels));
  std::vector<int> row = unknown;  // of each component of the finer mesh, or -1
  const mesh::Coarser* coarser = mesh.coarser.get();
  for (int level = 0; level < levels; ++level, coarser = coarser ? coarser->next.get() : nullptr) {
    const int nodes = static_cast<int>(row.size() / d);
    const auto means = [&](const int& node) { return coarser ? coarser->means[node] : std::span(&node, 1); };
    std::vector<int> column(d * (coarser ? coarser->node_count : nodes), -1);
    const auto each_node = [&](const auto& work) {
      constexpr int kFew = 50'000;
      parallel_ranges(nodes, threads_for(nodes, kFew), [&](int, int first, int end) {
        for (int i = first; i < end; ++i) work(i);
      });
    };
    each_node([&](int i) {
      if (const auto of = means(i); of.size() == 1)
        for (std::size_t k = 0; k < d; ++k)
          if (const auto at = d * of[0] + k; row[d * i + k] >= 0) column[at] = static_cast<int>(at);
    });
    algebra::SparseRows& functions = all.emplace_back(all.empty() ? unknowns : static_cast<int>(row.size()), static_cast<int>(column.size()));
    int* starts = functions.outerIndexPtr();
    each_node([&](int i) {
      for (std::size_t k = 0; k < d; ++k)
        if (const int r = row[d * i + k]; r >= 0) starts[r + 1] = static_cast<int>(std::ranges::count_if(means(i), [&](int p) { return column[d * p + k] >= 0; }));
    });
    std::partial_sum(starts, starts + functions.rows() + 1, starts);
    functions.resizeNonZeros(starts[functions.rows()]);
    each_node([&](int i) {
      std::array<int, 8> sorted{};
      const auto of = means(i);
      const auto end = std::ranges::copy(of, sorted.begin()).out;
      std::sort(sorted.begin(), end);
      for (std::size_t k = 0; k < d; ++k) {
        if (row[d * i + k] < 0) continue;
        int at = starts[row[d * i + k]];
        for (auto p = sorted.begin(); p != end; ++p)
          if (const int c = column[d * *p + k]; c >= 0) functions.innerIndexPtr()[at] = c, functions.valuePtr()[at++] = 1.0 / static_cast<double>(of.size());
      }
    });
    row = std::move(column);
  }
  return all;
}

}  // namespace dotyk::elasticity

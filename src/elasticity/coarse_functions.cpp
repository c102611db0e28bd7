#include "elasticity/coarse_functions.hpp"

#include <algorithm>
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
    Eigen::VectorXi counts = Eigen::VectorXi::Zero(functions.rows());
    const auto each = [&](auto&& work) {
      each_node([&](int i) {
        for (std::size_t k = 0; k < d; ++k)
          for (const int p : means(i))
            if (row[d * i + k] >= 0 && column[d * p + k] >= 0) work(i, row[d * i + k], column[d * p + k]);
      });
    };
    each([&](int, int r, int) { ++counts[r]; });
    int* starts = functions.outerIndexPtr();
    std::partial_sum(counts.begin(), counts.end(), starts + 1);
    functions.resizeNonZeros(starts[functions.rows()]);
    std::vector<int> next(starts, starts + functions.rows());
    each([&](int i, int r, int c) {
      functions.innerIndexPtr()[next[r]] = c;
      functions.valuePtr()[next[r]++] = 1.0 / static_cast<double>(means(i).size());
    });
    each_node([&](int i) {
      for (std::size_t k = 0; k < d; ++k)
        if (const int r = row[d * i + k]; r >= 0) std::sort(functions.innerIndexPtr() + starts[r], functions.innerIndexPtr() + starts[r + 1]);  // the numbers of a row are equal
    });
    row = std::move(column);
  }
  return all;
}

}  // namespace dotyk::elasticity

#include "multigrid/shares/functions.hpp"

namespace dotyk::multigrid {

namespace {

/// The rank's rows of the functions that give what a displacement of level + 1 is on `level`.
OwnFunctions own_functions(const algebra::CoarseFunctions& functions, const Numbering& numbering, int level, int rank) {
  const std::vector<int>&number = level == 0 ? numbering.slot() : numbering.functions(level), &coarse_number = numbering.functions(level + 1);
  const int first = numbering.first(level)[rank], count = numbering.first(level)[rank + 1] - first, d = functions.dimension, block = level == 0 ? numbering.block() : d;
  OwnFunctions own;
  own.component.assign(static_cast<std::size_t>(count), -1);
  std::vector<int> node_of(static_cast<std::size_t>(count / block), -1);
  for (std::size_t at = 0; at < functions.row.size(); ++at) {
    const int row = functions.row[at] < 0 ? -1 : number[functions.row[at]] - first;
    if (row < 0 || row >= count) continue;
    own.component[row] = static_cast<int>(at) % d, node_of[row / block] = static_cast<int>(at) / d;
  }
  std::size_t means = 0;
  for (const int& node : node_of) means += node >= 0 ? functions.of(node).size() : 0;
  own.starts.reserve(node_of.size() + 1), own.means.reserve(means);
  for (const int& node : node_of) {
    if (node >= 0)
      for (const int p : functions.of(node)) {
        int bits = 0;
        for (int k = 0; k < d; ++k) bits |= (functions.column[d * p + k] >= 0) << k;
        own.means.push_back(coarse_number[d * p] / d * OwnFunctions::kComponents + bits);
      }
    own.starts.push_back(counted(own.means.size()));
  }
  return own;
}

}  // namespace

AllOwnFunctions own_functions(const std::vector<algebra::CoarseFunctions>& functions, const Numbering& numbering, int rank) {
  auto all = std::make_shared<std::vector<OwnFunctions>>();
  for (std::size_t l = 0; l < functions.size(); ++l) all->push_back(own_functions(functions[l], numbering, static_cast<int>(l), rank));
  return all;
}

}  // namespace dotyk::multigrid

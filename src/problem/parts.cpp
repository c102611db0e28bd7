#include "problem/parts.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::problem {
namespace {

int root_of(std::vector<int>& parent, int b) {
  while (parent[b] != b) b = parent[b] = parent[parent[b]];
  return b;
}

}  // namespace

std::vector<double> Parts::greatest(const algebra::Vector& v) const {
  std::vector<double> most(count, 0);
  for (Eigen::Index r = 0; r < v.size(); ++r) most[of_row[r]] = std::max(most[of_row[r]], std::abs(v[r]));
  return most;
}

std::vector<double> least_beside_others(const std::vector<double>& of_part, bool loaded) {
  const double of_others = loaded ? 1e-4 : 1;
  const auto most = std::max_element(of_part.begin(), of_part.end());
  double second = 0;
  for (auto it = of_part.begin(); it != of_part.end(); ++it)
    if (it != most) second = std::max(second, *it);
  std::vector<double> least(of_part.size(), of_others * *most);
  least[static_cast<std::size_t>(most - of_part.begin())] = of_others * second;
  return least;
}

Parts parts(const Problem& problem) {
  const int blocks = static_cast<int>(problem.blocks.size());
  std::vector<int> parent(blocks), first(problem.rows(), 0);
  for (int b = 0; b < blocks; ++b) parent[b] = b;
  for (int r = 0; r < problem.rows(); ++r) {
    int joined = -1;
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it) {
      if (it.value() == 0) continue;
      const int b = root_of(parent, static_cast<int>(problem.block_of(it.col())));
      if (joined >= 0) parent[b] = joined;
      else joined = b;
    }
    if (joined >= 0) first[r] = joined;
  }
  Parts result;
  std::vector<int> number(blocks, -1);
  for (int b = 0; b < blocks; ++b) {
    int& part = number[root_of(parent, b)];
    if (part < 0) part = result.count++;
    result.of_block.push_back(part);
  }
  for (const int b : first) result.of_row.push_back(blocks > 0 ? result.of_block[b] : 0);
  result.count = std::max(result.count, 1);
  return result;
}

}  // namespace dotyk::problem

#pragma once

#include "random.hpp"
#include "scene/model/model.hpp"
#include "scenes.hpp"

namespace dotyk::test {

inline problem::Decomposition by_count(int count, bool support_rows) { return {count, {1, 1, 1}, support_rows}; }
inline problem::Decomposition by_boxes(std::array<int, 3> boxes, bool support_rows) { return {0, boxes, support_rows}; }

inline scene::Model cut(const scene::Scene& scene, const problem::Decomposition& decomposition,
                        const scene::Loading& loading = {}) {
  Monitor quiet;
  problem::Clock clock;
  return scene::build(scene, clock, quiet, loading, decomposition);
}

struct SubdomainCounts {
  int least = 0, greatest = 0;  ///< own unknowns of one
  int gluing = 0;               ///< equations between copies: one less than an unknown has, summed
  int held = 0;                 ///< own unknowns with `unknown` -1: equations of supports
};

inline SubdomainCounts counts(const std::vector<problem::Subdomain>& subdomains) {
  SubdomainCounts result{.least = subdomains.front().size()};
  std::vector<char> seen;
  for (const problem::Subdomain& s : subdomains) {
    result.least = std::min(result.least, s.size());
    result.greatest = std::max(result.greatest, s.size());
    for (const int u : s.unknown) {
      if (u < 0) {
        ++result.held;
        continue;
      }
      if (u >= static_cast<int>(seen.size())) seen.resize(u + 1, 0);
      result.gluing += seen[u];
      seen[u] = 1;
    }
  }
  return result;
}

/// What all subdomains make of the blocks' K and f when copies are one and held components have their values.
struct Glued {
  algebra::DenseMatrix K;
  algebra::Vector f;
};

inline Glued glued(const problem::Problem& p) {
  Glued sum{algebra::DenseMatrix::Zero(p.unknowns(), p.unknowns()), algebra::Vector::Zero(p.unknowns())};
  for (const problem::Subdomain& s : p.subdomains) {
    algebra::DenseMatrix K = full(s.K());
    if (s.spring.size() > 0) K += s.S.transpose() * s.spring.asDiagonal() * algebra::DenseMatrix(s.S);
    const algebra::Vector f = s.f - K * s.value;
    for (int i = 0; i < s.size(); ++i) {
      if (s.unknown[i] < 0) continue;
      sum.f[s.unknown[i]] += f[i];
      for (int j = 0; j < s.size(); ++j)
        if (s.unknown[j] >= 0) sum.K(s.unknown[i], s.unknown[j]) += K(i, j);
    }
  }
  return sum;
}

inline Glued whole(const problem::Problem& p) {
  Glued all{algebra::DenseMatrix::Zero(p.unknowns(), p.unknowns()), algebra::Vector::Zero(p.unknowns())};
  for (const problem::Block& b : p.blocks) {
    all.K.block(b.first, b.first, b.size(), b.size()) = full(b.K);
    all.f.segment(b.first, b.size()) = b.f;
  }
  return all;
}

}  // namespace dotyk::test

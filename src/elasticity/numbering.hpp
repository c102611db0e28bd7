#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// Which displacement components of a body are unknown, and the values of the rest.
struct Numbering {
  std::vector<int> unknown;        ///< node × dimension + component → unknown, or -1 where prescribed
  std::vector<double> prescribed;  ///< the same index → value (0 where unknown)
  std::vector<int> node;           ///< unknown → node; ascending
  int count() const { return static_cast<int>(node.size()); }
};

/// Numbers the components not marked in `fixed` (node × dimension flags), node by node.
inline Numbering number(const mesh::Mesh& mesh, const std::vector<char>& fixed,
                        std::vector<double> prescribed) {
  Numbering n;
  n.unknown.assign(fixed.size(), -1);
  n.prescribed = std::move(prescribed);
  const int dim = mesh.dimension();
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) {
      n.unknown[i] = static_cast<int>(n.node.size());
      n.node.push_back(static_cast<int>(i) / dim);
    }
  return n;
}

}  // namespace dotyk::elasticity

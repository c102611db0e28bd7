#pragma once

// Rigid motions by coefficients. Used inside this room only.

#include "algebra/types.hpp"
#include "base/motion.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::elasticity {

/// A rigid motion t + ω × (x − centre)/size, as coefficients: (tx, ty, ω) or (tx, ty, tz, ωx, ωy, ωz).
struct RigidFrame {
  int dimension;
  mesh::Point centre{0, 0, 0};  ///< mean of the nodes
  double size;

  explicit RigidFrame(const mesh::Mesh& mesh);
  int count() const { return dimension == 2 ? 3 : 6; }
  /// Component i of every motion at x.
  Eigen::RowVectorXd row(const double* x, int i) const;
  /// What motion that is; coefficients below `noise` of the motion, and places below `noise` of the size, are
  /// taken as nothing.
  Motion motion(const algebra::Vector& coefficients, double noise = 1e-9) const;
};

}  // namespace dotyk::elasticity

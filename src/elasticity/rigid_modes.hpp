#pragma once

#include <vector>

#include "algebra/types.hpp"
#include "base/motion.hpp"
#include "elasticity/assembly.hpp"
#include "elasticity/load.hpp"

namespace dotyk::elasticity {

/// A rigid motion t + ω × (x − centre)/size, as coefficients: (tx, ty, ω) or (tx, ty, tz, ωx, ωy, ωz).
struct RigidFrame {
  int dimension;
  mesh::Point centre{0, 0, 0};  ///< mean of the nodes
  double size;

  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 6>;

  explicit RigidFrame(const mesh::Mesh& mesh);
  int count() const { return dimension == 2 ? 3 : 6; }
  /// Component i of every motion at x, d the dimension; component k of all (node × dimension) of a mesh.
  template <int d>
  Eigen::Matrix<double, 1, d == 2 ? 3 : 6> row(const double* x, int i) const {
    Eigen::Matrix<double, 1, d == 2 ? 3 : 6> r = r.Zero();
    const auto from_centre = [&](int k) { return (x[k] - centre[k]) / size; };
    r[i] = 1;
    if constexpr (d == 2) {
      r[2] = i == 0 ? -from_centre(1) : from_centre(0);
    } else {  // (ω × d)_i = ω_j d_k − ω_k d_j
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      r[3 + j] = from_centre(k);
      r[3 + k] = -from_centre(j);
    }
    return r;
  }
  Row row(const double* x, int i) const {
    if (dimension == 2) return row<2>(x, i);
    return row<3>(x, i);
  }
  Row row(const mesh::Mesh& mesh, std::size_t k) const {
    return row(mesh.node(static_cast<int>(k) / dimension), static_cast<int>(k) % dimension);
  }
  /// What motion that is; coefficients below `noise` of the motion, and places below `noise` of the size, are
  /// taken as nothing. `sense`: the sense of a rotation matters, else it is named by the axis of positive direction.
  Motion motion(const algebra::Vector& coefficients, double noise = 1e-9, bool sense = false) const;
};

/// The rigid motions that a body's supports leave free.
struct RigidModes {
  algebra::DenseMatrix modes;   ///< unknowns × count; greatest nodal component of each is 1
  std::vector<Motion> motions;  ///< what they are
  RigidFrame frame;
  algebra::DenseMatrix coefficients;  ///< in the frame, its motions × count: a row of `modes` is frame.row() times these
};

/// From geometry and supports alone, exactly: the motions that vanish on every prescribed
/// component and wherever a spring acts. `sprung`: the mesh whose facets the springs are on; null: `mesh`.
RigidModes rigid_modes(const mesh::Mesh& mesh, const Numbering& numbering, const std::vector<FacetSpring>& springs, const mesh::Mesh* sprung = nullptr);

/// What modes make of a load: Rᵀf, and |R|ᵀ|f|, the same without signs.
struct Resultants {
  algebra::Vector e, gross;
};
/// Of the load that a force gives on the mesh refined `times` times, which is made a few cells at a time, where rules of quadrature tell it from the mesh as it is.
Resultants resultants(const mesh::Mesh& mesh, int times, const LinearForce& force, const RigidModes& modes);

/// All rigid motions, 3 or 6, on `count` unknowns, whatever holds the body. `unknown`: as in Numbering. An unknown of no node has a zero row.
algebra::DenseMatrix all_rigid_motions(const mesh::Mesh& mesh, const std::vector<int>& unknown, int count);

}  // namespace dotyk::elasticity

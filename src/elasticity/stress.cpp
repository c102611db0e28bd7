#include "elasticity/stress.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

using mesh::Mesh;

/// Cells that a patch needs for a safe linear fit: what an interior node of a regular mesh has, about.
int enough_cells(mesh::Element element) {
  switch (element) {
    case mesh::Element::triangle_p1: return 5;
    case mesh::Element::quadrilateral_q1: return 4;
    case mesh::Element::tetrahedron_p1: return 12;
    case mesh::Element::hexahedron_q1:
    case mesh::Element::triangle_p2:
    case mesh::Element::quadrilateral_q2:
    case mesh::Element::tetrahedron_p2:
    case mesh::Element::hexahedron_q2: break;
  }
  return 8;
}

/// The cells about a node; if they are too few, also those about its neighbours.
void patch_of(const Mesh& mesh, const Buckets& around, int node, std::vector<int>& patch) {
  patch.assign(around[node].begin(), around[node].end());
  if (static_cast<int>(patch.size()) >= enough_cells(mesh.element)) return;
  const std::vector<int> own = patch;
  for (int c : own)
    for (int k = 0; k < mesh::nodes_of(mesh.element); ++k) {
      const auto here = around[mesh.cell(c)[k]];
      patch.insert(patch.end(), here.begin(), here.end());
    }
  std::sort(patch.begin(), patch.end());
  patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
}

/// Value at the origin of the least-squares linear fit to the samples; their mean where they
/// do not determine one.
template <int Terms>
Stress fit(const std::vector<int>& patch, const std::vector<std::array<double, 3>>& offset,
           const std::vector<Stress>& value) {
  Eigen::Matrix<double, Terms, Terms> A = Eigen::Matrix<double, Terms, Terms>::Zero();
  Eigen::Matrix<double, Terms, 6> b = Eigen::Matrix<double, Terms, 6>::Zero();
  std::array<double, 3> scale{0, 0, 0};  // an axis each: cells may be slender
  for (const auto& x : offset)
    for (int i = 0; i + 1 < Terms; ++i) scale[i] = std::max(scale[i], std::abs(x[i]));
  for (double& s : scale)
    if (s == 0) s = 1;
  for (std::size_t k = 0; k < patch.size(); ++k) {
    Eigen::Matrix<double, Terms, 1> p;
    p[0] = 1;
    for (int i = 0; i + 1 < Terms; ++i) p[i + 1] = offset[k][i] / scale[i];
    A += p * p.transpose();
    b += p * Eigen::Map<const Eigen::Matrix<double, 1, 6>>(value[patch[k]].data());
  }
  const Eigen::LLT<Eigen::Matrix<double, Terms, Terms>> llt(A);
  // Samples on one line (plane) leave a pivot near zero: no fit then.
  const auto pivots = llt.matrixLLT().diagonal();
  const bool fits = llt.info() == Eigen::Success && pivots.minCoeff() > 0.03 * pivots.maxCoeff();
  Stress s;
  Eigen::Map<Eigen::Matrix<double, 1, 6>>(s.data()) = (fits ? llt.solve(b).eval() : (b / A(0, 0)).eval()).row(0);
  return s;
}

/// Of cells of order 2: the mean of the stresses that a node's cells have there, by their Jacobians.
std::vector<Stress> mean_stress(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u) {
  std::vector<Stress> sum(mesh.node_count(), Stress{});
  std::vector<double> weight(mesh.node_count(), 0);
  dispatch(mesh.element, [&]<class E>() {
    if constexpr (E::order == 2)
      for_each_cell<E>(mesh, material, [&](int c, const auto& x, const Hooke& hooke) {
        for (int a = 0; a < E::nodes; ++a) {
          double measure;
          const Stress s = stress_at<E>(mesh, hooke, u, c, x, E::node(a), &measure);
          const int n = mesh.cell(c)[a];
          weight[n] += measure;
          for (int v = 0; v < 6; ++v) sum[n][v] += measure * s[v];
        }
      });
  });
  for (int n = 0; n < mesh.node_count(); ++n)
    for (double& v : sum[n]) v /= weight[n];
  return sum;
}

}  // namespace

double von_mises(const Stress& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  const double q = 0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
  if (q > 1e-280 && q < 1e280) return std::sqrt(q);
  // Far from 1 the squares leave the range of numbers: once more relative to the greatest component.
  double largest = 0;
  for (const double v : s) largest = std::max(largest, std::abs(v));
  if (!(largest > 0) || !std::isfinite(largest) || (largest > 1e-130 && largest < 1e130)) return std::sqrt(q);
  Stress scaled = s;
  for (double& v : scaled) v /= largest;
  return largest * von_mises(scaled);
}

std::array<double, 3> principal(const Stress& s) {
  Eigen::Matrix3d m;
  m << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  const Eigen::Vector3d e = algebra::eigenvalues3(m);
  return {e[2], e[1], e[0]};
}

std::vector<Stress> cell_stress(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u) {
  std::vector<Stress> result(mesh.cell_count());
  dispatch(mesh.element, [&]<class E>() {
    for_each_cell<E>(mesh, material, [&](int c, const auto& x, const Hooke& hooke) {
      double measure;
      result[c] = stress_at<E>(mesh, hooke, u, c, x, E::centre(), &measure);
    });
  });
  return result;
}

std::vector<CellDeformation> cell_deformation(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u) {
  std::vector<CellDeformation> result(mesh.cell_count());
  dispatch(mesh.element, [&]<class E>() {
    for_each_cell<E>(mesh, material, [&](int c, const auto& x, const Hooke& hooke) {
      constexpr int d = E::dim;
      double g[E::nodes][d];
      const double measure = physical_gradient<E>(x, E::centre(), g);
      const auto gradient = gradient_of<d>(mesh, c, u, g);
      Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
      strain.topLeftCorner<d, d>() = (gradient + gradient.transpose()) / 2;
      const Eigen::Vector3d principal = algebra::eigenvalues3(strain);
      const double energy = 0.5 * measure * stress_of<d>(hooke, gradient).cwiseProduct(gradient).sum();
      result[c] = {principal.cwiseAbs().maxCoeff(), (gradient - gradient.transpose()).norm() / std::sqrt(8), measure, energy};
    });
  });
  return result;
}

std::vector<Stress> nodal_stress(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u) {
  return mesh.topology().order == 2 ? mean_stress(mesh, material, u) : recover_stress(mesh, cell_stress(mesh, material, u));
}

std::vector<Stress> recover_stress(const Mesh& mesh, const std::vector<Stress>& at_centres) {
  const Buckets around = mesh::cells_of_nodes(mesh);
  std::vector<mesh::Point> centre(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) centre[c] = mesh.cell_centre(c);
  std::vector<Stress> result(mesh.node_count());
  std::vector<int> patch;
  std::vector<std::array<double, 3>> offset;
  for (int n = 0; n < mesh.node_count(); ++n) {
    patch_of(mesh, around, n, patch);
    if (patch.empty()) continue;
    const mesh::Point x = mesh.point(n);
    offset.resize(patch.size());
    for (std::size_t k = 0; k < patch.size(); ++k)
      for (int i = 0; i < 3; ++i) offset[k][i] = centre[patch[k]][i] - x[i];
    result[n] = mesh.dimension() == 2 ? fit<3>(patch, offset, at_centres)
                                      : fit<4>(patch, offset, at_centres);
  }
  return result;
}

}  // namespace dotyk::elasticity

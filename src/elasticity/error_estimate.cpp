#include "elasticity/error_estimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/dense/decompositions.hpp"
#include "elasticity/kernel.hpp"
#include "mesh/decomposition.hpp"

namespace dotyk::elasticity {
namespace {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::dot;
using mesh::length;
using mesh::minus;

/// The inverse of Hooke's law in Voigt form (engineering shear), over the components of the dimension.
Eigen::MatrixXd compliance(const Hooke& h) {
  const std::vector<int> component = voigt_components(h.dimension);
  const auto n = static_cast<int>(component.size());
  Eigen::MatrixXd c(n, n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const auto& [i, j] = kVoigt[component[a]];
      const auto& [k, l] = kVoigt[component[b]];
      c(a, b) = h.c[i][j][k][l];
    }
  return algebra::Lu(c).solve_transposed(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)));  // c is symmetric
}

/// xx yy xy or xx yy zz yz xz xy.
Eigen::VectorXd voigt(const Stress& s, int dimension) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(s.data())(voigt_components(dimension));
}

/// Greatest difference of two tensors of Hooke, relative to the greater one's greatest entry.
double difference(const Hooke& a, const Hooke& b) {
  double most = 0, apart = 0;
  const double *x = &a.c[0][0][0][0], *y = &b.c[0][0][0][0];
  for (int k = 0; k < 81; ++k) {
    most = std::max({most, std::abs(x[k]), std::abs(y[k])});
    apart = std::max(apart, std::abs(x[k] - y[k]));
  }
  return most > 0 ? apart / most : 0;
}

/// Cells that hang together by facets across which the material hardly changes, numbered from 0.
struct Regions {
  std::vector<int> of_cell;
  int count = 1;
  std::vector<std::pair<Facet, int>> interfaces;  ///< facets of the lesser cell, and the cell beyond
};

Regions regions(const Mesh& mesh, const MaterialField& material) {
  Regions result{std::vector<int>(mesh.cell_count(), 0), 1, {}};
  if (!material.varies()) return result;
  const auto neighbour = mesh::facet_neighbours(mesh);
  const int facets = mesh.topology().facets;
  std::fill(result.of_cell.begin(), result.of_cell.end(), -1);
  result.count = 0;
  std::vector<int> stack;
  for (int seed = 0; seed < mesh.cell_count(); ++seed) {
    if (result.of_cell[seed] >= 0) continue;
    result.of_cell[seed] = result.count;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const int c = stack.back();
      stack.pop_back();
      const Hooke own = material.at(c);
      for (int l = 0; l < facets; ++l) {
        const int other = neighbour[static_cast<std::size_t>(c) * facets + l];
        if (other < 0 || result.of_cell[other] >= 0 || difference(own, material.at(other)) > 0.2) continue;
        result.of_cell[other] = result.count;
        stack.push_back(other);
      }
    }
    ++result.count;
  }
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int l = 0; l < facets; ++l) {
      const int other = neighbour[static_cast<std::size_t>(c) * facets + l];
      if (other > c && result.of_cell[other] != result.of_cell[c]) result.interfaces.push_back({{c, l}, other});
    }
  return result;
}

/// Recovered stresses of one region at its nodes.
struct Recovered {
  mesh::Submesh piece;         ///< empty where the region is the whole mesh
  std::vector<Stress> nodal;
  const Stress& at(int node) const {
    if (piece.node.empty()) return nodal[node];
    return nodal[std::lower_bound(piece.node.begin(), piece.node.end(), node) - piece.node.begin()];
  }
};

std::vector<Recovered> recover(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                               const Regions& regions, const std::vector<Stress>* whole) {
  std::vector<Recovered> result(regions.count);
  if (regions.count == 1 && whole) {
    result[0].nodal = *whole;
    return result;
  }
  const std::vector<Stress> raw = cell_stress(mesh, material, u);
  if (regions.count == 1) {
    result[0].nodal = recover_stress(mesh, raw);
    return result;
  }
  std::vector<std::vector<int>> cells(regions.count);
  for (int c = 0; c < mesh.cell_count(); ++c) cells[regions.of_cell[c]].push_back(c);
  for (int r = 0; r < regions.count; ++r) {
    result[r].piece = mesh::submesh(mesh, std::move(cells[r]));
    std::vector<Stress> own;
    for (const int c : result[r].piece.cell) own.push_back(raw[c]);
    result[r].nodal = recover_stress(result[r].piece.mesh, own);
  }
  return result;
}

double longest_edge(const Mesh& mesh, int c) {
  double longest = 0;
  const mesh::ElementTopology& t = mesh.topology();
  for (int l = 0; l < t.facets; ++l)
    for (int k = 0; k < t.nodes_per_facet; ++k) {
      const Point p = mesh.point(mesh.facet_node({c, l}, k)), q = mesh.point(mesh.facet_node({c, l}, (k + 1) % t.nodes_per_facet));
      longest = std::max(longest, length(minus(p, q)));
    }
  return longest;
}

/// tr Q(n)/d, the mean over the axes n.
double wave_stiffness(const Hooke& h) {
  double sum = 0;
  for (int n = 0; n < h.dimension; ++n)
    for (int i = 0; i < h.dimension; ++i) sum += h.c[i][n][i][n];
  return sum / (h.dimension * h.dimension);
}

/// recovery and bulk of every cell, and the norm of the solution.
template <class E>
void inside(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
            const std::vector<Point>& force, const Regions& regions, const std::vector<Recovered>& recovered,
            ErrorEstimate& estimate) {
  double measure, g[E::nodes][E::dim];
  Eigen::MatrixXd inverse = compliance(material.at(0));
  for_each_cell<E>(mesh, material, [&](int c, const auto& x, const Hooke& hooke) {
    if (material.varies()) inverse = compliance(hooke);
    std::array<Stress, E::nodes> corner;
    for (int a = 0; a < E::nodes; ++a) corner[a] = recovered[regions.of_cell[c]].at(mesh.cell(c)[a]);
    const double reach = longest_edge(mesh, c) / std::numbers::pi, weight = reach * reach / wave_stiffness(hooke);
    for (int q = 0; q < E::load_points; ++q) {
      const auto xi = E::load_point(q);
      const Eigen::VectorXd raw = voigt(stress_at<E>(mesh, hooke, u, c, x, xi, &measure), E::dim);
      physical_gradient<E>(x, xi, g);
      Stress smooth{};
      const auto shape = E::shape(xi);
      double lacking[3] = {0, 0, 0};
      if (!force.empty()) std::copy_n(force[c].begin(), 3, lacking);
      for (int a = 0; a < E::nodes; ++a)
        for (int v = 0; v < 6; ++v) {
          smooth[v] += shape[a] * corner[a][v];
          const auto& [i, j] = kVoigt[v];
          if (i >= E::dim || j >= E::dim) continue;
          lacking[i] += g[a][j] * corner[a][v];
          if (i != j) lacking[j] += g[a][i] * corner[a][v];
        }
      const Eigen::VectorXd error = voigt(smooth, E::dim) - raw;
      const double w = measure * E::load_weight(q);
      estimate.cells[c].recovery += w * error.dot(inverse * error);
      for (int i = 0; i < E::dim; ++i) estimate.cells[c].bulk += w * weight * lacking[i] * lacking[i];
      estimate.solution[c] += w * raw.dot(inverse * raw);
    }
  });
}

Point traction_of(const Stress& s, const Point& n) {
  return {s[0] * n[0] + s[5] * n[1] + s[4] * n[2], s[5] * n[0] + s[1] * n[1] + s[3] * n[2],
          s[4] * n[0] + s[3] * n[1] + s[2] * n[2]};
}

/// depth · ∫ r·Q⁻¹r, split into what r's normal part and the rest give.
struct Mismatch {
  double normal = 0, tangential = 0;
};

/// `residual(corner, normal)`: r at a corner of the facet.
template <class Residual>
Mismatch mismatch(const Mesh& mesh, const TractionWeight& weight, Facet facet, Residual&& residual) {
  Mismatch sum;
  for_each_facet_point(mesh, facet, [&](const FacetPoint& p) {
    Point r{0, 0, 0};
    for (int a = 0; a < p.nodes; ++a) {
      const Point at = residual(a, p.normal);
      for (int i = 0; i < mesh.dimension(); ++i) r[i] += p.shape[a] * at[i];
    }
    const double along = dot(r, p.normal);
    double normal = 0, whole = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        whole += r[i] * weight.inverse[i][k] * r[k];
        normal += along * along * p.normal[i] * weight.inverse[i][k] * p.normal[k];
      }
    sum.normal += weight.depth * p.measure * normal;
    sum.tangential += weight.depth * p.measure * std::max(0.0, whole - normal);
  });
  return sum;
}

void on_boundary(const Mesh& mesh, const MaterialField& material, const FacetTraction& given, const Recovered& recovered,
                 ErrorParts& parts) {
  const auto lacking = [&](int corner, const Point& n) {
    const Point own = traction_of(recovered.at(mesh.facet_node(given.facet, corner)), n);
    Point r{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) r[i] += given.known[i][k] * (given.traction[corner][k] - own[k]);
    return r;
  };
  const Mismatch m = mismatch(mesh, traction_weight(mesh, material.at(given.facet.cell), given.facet), given.facet, lacking);
  if (given.contact) {
    parts.contact_pressure += m.normal;
    parts.friction += m.tangential;
  } else {
    parts.boundary += m.normal + m.tangential;
  }
}

void across(const Mesh& mesh, const MaterialField& material, Facet facet, const Recovered& near, const Recovered& far,
            ErrorParts& parts) {
  const auto jump = [&](int corner, const Point& n) {
    const int node = mesh.facet_node(facet, corner);
    return minus(traction_of(near.at(node), n), traction_of(far.at(node), n));
  };
  const Mismatch m = mismatch(mesh, traction_weight(mesh, material.at(facet.cell), facet), facet, jump);
  parts.jump += m.normal + m.tangential;
}

}  // namespace

ErrorParts& ErrorParts::operator+=(const ErrorParts& other) {
  recovery += other.recovery;
  bulk += other.bulk;
  jump += other.jump;
  boundary += other.boundary;
  contact_pressure += other.contact_pressure;
  complementarity += other.complementarity;
  friction += other.friction;
  laws += other.laws;
  return *this;
}

void FacetTraction::forget(const Point& direction) {
  Point d{0, 0, 0};  // what of it is still known
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) d[i] += known[i][k] * direction[k];
  const double square = dot(d, d);
  if (square < 1e-6) return;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) known[i][k] -= d[i] * d[k] / square;
}

TractionWeight traction_weight(const Mesh& mesh, const Hooke& hooke, Facet facet) {
  const int dim = mesh.dimension();
  const Point v = mesh.facet_area_vector(facet);
  const double area = length(v);
  Eigen::Matrix3d q = Eigen::Matrix3d::Identity();
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) {
      q(i, k) = 0;
      for (int j = 0; j < dim; ++j)
        for (int l = 0; l < dim; ++l) q(i, k) += hooke.c[i][j][k][l] * v[j] * v[l] / (area * area);
    }
  const Eigen::Matrix3d inverse = q.inverse();
  // The cell's greatest height over the facet.
  double height = 0;
  const Point foot = mesh.facet_centre(facet);
  for (int a = 0; a < mesh.topology().nodes; ++a) {
    const Point x = mesh.point(mesh.cell(facet.cell)[a]);
    double below = 0;
    for (int i = 0; i < 3; ++i) below += (foot[i] - x[i]) * v[i] / area;
    height = std::max(height, below);
  }
  TractionWeight weight{height / 3, {}};
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) weight.inverse[i][k] = inverse(i, k);
  return weight;
}

ErrorEstimate estimate_error(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                             const std::vector<Point>& force, const std::vector<FacetTraction>& boundary,
                             const std::vector<Stress>* whole) {
  const Regions regions = elasticity::regions(mesh, material);
  const std::vector<Recovered> recovered = recover(mesh, material, u, regions, whole);
  ErrorEstimate estimate{std::vector<ErrorParts>(mesh.cell_count()), std::vector<double>(mesh.cell_count(), 0.0)};
  dispatch(mesh.element, [&]<class E>() { inside<E>(mesh, material, u, force, regions, recovered, estimate); });
  for (const FacetTraction& given : boundary) {
    const int c = given.facet.cell;
    on_boundary(mesh, material, given, recovered[regions.of_cell[c]], estimate.cells[c]);
  }
  for (const auto& [facet, beyond] : regions.interfaces)
    across(mesh, material, facet, recovered[regions.of_cell[facet.cell]], recovered[regions.of_cell[beyond]], estimate.cells[facet.cell]);
  return estimate;
}

}  // namespace dotyk::elasticity

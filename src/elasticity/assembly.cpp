#include "elasticity/assembly.hpp"

#include <stdexcept>

#include "elasticity/kernel.hpp"
#include "elasticity/load.hpp"
#include "elasticity/pattern.hpp"

namespace dotyk::elasticity {
namespace {

using algebra::Vector;
using mesh::Mesh;

/// Adds dense blocks between nodes into the system, eliminating prescribed components.
class Scatter {
 public:
  Scatter(const Mesh& mesh, const Numbering& numbering, Pattern& pattern, System& system)
      : dim_(mesh.dimension()), numbering_(numbering), pattern_(pattern), system_(system),
        values_(system.K.valuePtr()), outer_(system.K.outerIndexPtr()),
        whole_(mesh.node_count()), pulls_(mesh.node_count()) {
    for (int n = 0; n < mesh.node_count(); ++n) {
      whole_[n] = true;
      for (int i = 0; i < dim_; ++i) {
        const std::size_t k = static_cast<std::size_t>(n) * dim_ + i;
        whole_[n] = whole_[n] && numbering.unknown[k] >= 0;
        pulls_[n] = pulls_[n] || numbering.prescribed[k] != 0;
      }
    }
  }

  /// block(i, j) couples component i of node a to component j of node b; for a ≠ b it stands
  /// for both triangles, for a = b it is a full symmetric block.
  template <class Block>
  void add(int a, int b, Block&& block) {
    if (whole_[a] && whole_[b]) {
      if (a >= b)
        add_whole(a, b, [&](int i, int j) { return block(i, j); });
      else
        add_whole(b, a, [&](int i, int j) { return block(j, i); });
    } else {
      add_reduced(a, b, block);
    }
    if (pulls_[a] || pulls_[b]) add_prescribed(a, b, block);
  }

 private:
  int unknown(int node, int i) const { return numbering_.unknown[static_cast<std::size_t>(node) * dim_ + i]; }
  double prescribed(int node, int i) const { return numbering_.prescribed[static_cast<std::size_t>(node) * dim_ + i]; }

  template <class Block>
  void add_whole(int a, int b, Block&& block) {
    const int place = pattern_.find(a, b);
    for (int j = 0; j < dim_; ++j) {
      const int start = outer_[unknown(b, 0) + j];
      for (int i = a == b ? j : 0; i < dim_; ++i)
        values_[pattern_.position(place, i, j, start)] += block(i, j);
    }
  }

  template <class Block>
  void add_reduced(int a, int b, Block&& block) {
    const int row = a >= b ? a : b, column = a >= b ? b : a;
    const int place = pattern_.find(row, column);
    int column_rank = 0;
    for (int j = 0; j < dim_; ++j) {
      if (unknown(column, j) < 0) continue;
      const int start = outer_[unknown(column, j)];
      int row_rank = 0;
      for (int i = 0; i < dim_; ++i) {
        if (unknown(row, i) < 0) continue;
        if (a != b || i >= j)
          values_[pattern_.position(place, row_rank, column_rank, start)] +=
              a >= b ? block(i, j) : block(j, i);
        ++row_rank;
      }
      ++column_rank;
    }
  }

  /// f −= K_fp u_p and offset += ½ u_p K_pp u_p.
  template <class Block>
  void add_prescribed(int a, int b, Block&& block) {
    for (int i = 0; i < dim_; ++i)
      for (int j = 0; j < dim_; ++j) {
        const double k = block(i, j);
        if (unknown(a, i) >= 0) system_.f[unknown(a, i)] -= k * prescribed(b, j);
        if (a != b && unknown(b, j) >= 0) system_.f[unknown(b, j)] -= k * prescribed(a, i);
        system_.offset += (a == b ? 0.5 : 1.0) * prescribed(a, i) * k * prescribed(b, j);
      }
  }

  int dim_;
  const Numbering& numbering_;
  const Pattern& pattern_;
  System& system_;
  double* values_;
  const int* outer_;
  std::vector<char> whole_;  ///< all components unknown
  std::vector<char> pulls_;  ///< some component prescribed and not zero
};

/// Calls visit(nodes of the cell, k) for every cell; k[a][b][i][j] couples component i of its node a
/// to component j of its node b ≤ a.
template <class E, class Visit>
void for_each_stiffness(const Mesh& mesh, const MaterialField& material, Visit&& visit) {
  double x[E::nodes][E::dim], k[E::nodes][E::nodes][E::dim][E::dim];
  Hooke hooke = material.at(0);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (material.varies()) hooke = material.at(c);
    cell_coordinates<E>(mesh, c, x);
    stiffness<E>(x, hooke, k);
    visit(mesh.cell(c), k);
  }
}

template <class E>
void add_cells(const Mesh& mesh, const MaterialField& material, Scatter& scatter) {
  for_each_stiffness<E>(mesh, material, [&](const int* n, const auto& k) {
    for (int a = 0; a < E::nodes; ++a)
      for (int b = 0; b <= a; ++b)
        scatter.add(n[a], n[b], [&](int i, int j) { return k[a][b][i][j]; });
  });
}

void add_springs(const Mesh& mesh, const std::vector<FacetSpring>& springs, Scatter& scatter) {
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      const auto& k = spring.stiffness[p.index];
      for (int a = 0; a < p.nodes; ++a)
        for (int b = 0; b <= a; ++b)
          scatter.add(mesh.facet_node(spring.facet, a), mesh.facet_node(spring.facet, b),
                      [&](int i, int j) { return i == j ? k[i] * p.shape[a] * p.shape[b] * p.measure : 0.0; });
    });
}

}  // namespace

double matrix_bytes(const Mesh& mesh) {
  const auto neighbours = [&] {  // of a node, itself too, in the mean over a regular mesh
    switch (mesh.element) {
      case mesh::Element::triangle_p1: return 7.0;
      case mesh::Element::quadrilateral_q1: return 9.0;
      case mesh::Element::tetrahedron_p1: return 15.0;
      case mesh::Element::hexahedron_q1: return 27.0;
      case mesh::Element::triangle_p2: return 11.5;
      case mesh::Element::quadrilateral_q2: return 16.0;
      case mesh::Element::tetrahedron_p2: return 29.0;
      case mesh::Element::hexahedron_q2: break;
    }
    return 64.0;
  };
  const double dim = mesh.dimension();
  return 12 * 0.5 * mesh.node_count() * dim * (dim * neighbours() + 1);
}

System assemble(const Mesh& mesh, const MaterialField& material,
                const std::vector<FacetSpring>& springs, const std::vector<double>& force,
                const Numbering& numbering) {
  System system;
  Pattern pattern(mesh, numbering);
  system.K = pattern.take_matrix();
  system.f = Vector::Zero(numbering.count());
  for (std::size_t k = 0; k < force.size(); ++k) {
    if (numbering.unknown[k] >= 0)
      system.f[numbering.unknown[k]] += force[k];
    else
      system.offset -= force[k] * numbering.prescribed[k];
  }
  Scatter scatter(mesh, numbering, pattern, system);
  dispatch(mesh.element, [&]<class E>() { add_cells<E>(mesh, material, scatter); });
  add_springs(mesh, springs, scatter);
  return system;
}

SpringRows spring_rows(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering) {
  const int dim = mesh.dimension();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> stiffness;
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < dim; ++i) {
        const double k = spring.stiffness[p.index][i] * p.measure;
        if (!(k > 0)) continue;
        for (int a = 0; a < p.nodes; ++a) {
          const int v = numbering.unknown[static_cast<std::size_t>(mesh.facet_node(spring.facet, a)) * dim + i];
          if (v < 0) throw std::logic_error("springs as rows act on unknowns alone");
          entries.emplace_back(static_cast<int>(stiffness.size()), v, p.shape[a]);
        }
        stiffness.push_back(k);
      }
    });
  SpringRows rows{algebra::SparseRows(static_cast<Eigen::Index>(stiffness.size()), numbering.count()),
                  Eigen::Map<const algebra::Vector>(stiffness.data(), static_cast<Eigen::Index>(stiffness.size()))};
  rows.S.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

std::vector<double> internal_force(const Mesh& mesh, const MaterialField& material,
                                   const std::vector<FacetSpring>& springs,
                                   const std::vector<double>& u) {
  std::vector<double> force(u.size(), 0.0);
  const int dim = mesh.dimension();
  dispatch(mesh.element, [&]<class E>() {
    for_each_stiffness<E>(mesh, material, [&](const int* n, const auto& k) {
      for (int a = 0; a < E::nodes; ++a)
        for (int b = 0; b < E::nodes; ++b)
          for (int i = 0; i < E::dim; ++i)
            for (int j = 0; j < E::dim; ++j)
              force[static_cast<std::size_t>(n[a]) * dim + i] +=
                  (a >= b ? k[a][b][i][j] : k[b][a][j][i]) * u[static_cast<std::size_t>(n[b]) * dim + j];
    });
  });
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < dim; ++i) {
        double value = 0;
        for (int b = 0; b < p.nodes; ++b)
          value += p.shape[b] * u[static_cast<std::size_t>(mesh.facet_node(spring.facet, b)) * dim + i];
        for (int a = 0; a < p.nodes; ++a)
          force[static_cast<std::size_t>(mesh.facet_node(spring.facet, a)) * dim + i] +=
              spring.stiffness[p.index][i] * value * p.shape[a] * p.measure;
      }
    });
  return force;
}

}  // namespace dotyk::elasticity

#include "elasticity/assembly.hpp"

#include <cstdint>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

using algebra::Vector;
using mesh::Mesh;

/// Adds dense blocks between nodes into a matrix whose pattern is made first, from the mesh; prescribed components are left out.
class Assembly {
 public:
  Assembly(const Mesh& mesh, const Numbering& numbering)
      : dim_(mesh.dimension()), threads_(threads_for(mesh.cell_count(), kFewCells)), numbering_(numbering), first_(mesh.node_count(), 0), count_(mesh.node_count(), 0) {
    for (int u = numbering.count() - 1; u >= 0; --u) first_[numbering.node[u]] = u, ++count_[numbering.node[u]];
    find_neighbours(mesh);
    make_pattern();
  }

  int threads() const { return threads_; }

  /// block(i, j) couples component i of node a to component j of node b; for a ≠ b it stands
  /// for both triangles, for a = b it is a full symmetric block.
  template <class Block>
  void add(int a, int b, Block&& block) {
    const int high = std::max(a, b), low = std::min(a, b);
    int place = start_[low];
    while (neighbour_[place] != high) ++place;
    if (free(high) && free(low)) {  // the rows of a column follow one another
      for (int j = 0; j < dim_; ++j) {
        double* column = K.valuePtr() + K.outerIndexPtr()[first_[low] + j] + offset_[place] - j;
        for (int i = a == b ? j : 0; i < dim_; ++i) column[i] += a >= b ? block(i, j) : block(j, i);
      }
      return;
    }
    for (int i = 0; i < dim_; ++i)
      for (int j = 0; j < dim_; ++j) {
        const double k = block(i, j);
        const int r = unknown(a, i), c = unknown(b, j);
        if (r < 0 || c < 0 || (a == b && i < j)) continue;
        const int row = std::max(r, c), column = std::min(r, c);
        const int rank = row - first_[high] - (column - first_[low]);
        K.valuePtr()[K.outerIndexPtr()[column] + offset_[place] + rank] += k;
      }
  }

  algebra::StoredMatrix K;

 private:
  /// Are all components of the node unknown?
  bool free(int node) const { return count_[node] == dim_; }
  int unknown(int node, int i) const { return numbering_.unknown[static_cast<std::size_t>(node) * dim_ + i]; }

  void find_neighbours(const Mesh& mesh) {
    const int nodes = mesh.node_count(), per_cell = mesh::nodes_of(mesh.element);
    const Buckets around = mesh::cells_of_nodes(mesh);
    start_.assign(static_cast<std::size_t>(nodes) + 1, 0);
    std::vector<std::vector<int>> found(static_cast<std::size_t>(threads_));
    parallel_ranges(nodes, threads_, [&](int k, int first, int end) {
      std::vector<int> mark(static_cast<std::size_t>(nodes), -1), &own = found[k];
      own.reserve(static_cast<std::size_t>(end - first) * (dim_ == 2 ? 4 : 8));
      for (int b = first; b < end; ++b) {
        const auto before = static_cast<std::ptrdiff_t>(own.size());
        own.push_back(b);
        for (const int c : around[b])
          for (int l = 0; l < per_cell; ++l) {
            const int a = mesh.cell(c)[l];
            if (a > b && mark[a] != b) mark[a] = b, own.push_back(a);
          }
        std::sort(own.begin() + before + 1, own.end());
        start_[b + 1] = static_cast<int>(own.size() - before);
      }
    });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    for (std::vector<int>& own : found) neighbour_.insert(neighbour_.end(), own.begin(), own.end()), own = {};
  }

  /// Allocates K with the pattern of the mesh. All entries are 0.
  void make_pattern() {
    const int nodes = static_cast<int>(count_.size());
    std::vector<std::int64_t> entries{0};  // before those of a node's columns
    for (int b = 0; b < nodes; ++b) {
      int rows = 0;
      for (int k = start_[b]; k < start_[b + 1]; ++k) offset_.push_back(rows), rows += count_[neighbour_[k]];
      entries.push_back(entries.back() + static_cast<std::int64_t>(rows) * count_[b] - count_[b] * (count_[b] - 1) / 2);
    }
    if (entries.back() > 2'000'000'000) throw InputError("the stiffness matrix would have more than 2e9 entries; use a coarser mesh");
    K.resize(numbering_.count(), numbering_.count());
    K.resizeNonZeros(static_cast<Eigen::Index>(entries.back()));
    int *outer = K.outerIndexPtr(), *inner = K.innerIndexPtr();
    double* values = K.valuePtr();
    outer[numbering_.count()] = static_cast<int>(entries.back());
    parallel_ranges(nodes, threads_, [&](int, int first, int end) {
      int at = static_cast<int>(entries[first]);
      for (int b = first; b < end; ++b)
        for (int rank = 0; rank < count_[b]; ++rank) {
          outer[first_[b] + rank] = at;
          for (int k = start_[b]; k < start_[b + 1]; ++k)
            for (int a = neighbour_[k], r = k == start_[b] ? rank : 0; r < count_[a]; ++r) inner[at] = first_[a] + r, values[at++] = 0;
        }
    });
  }

  static constexpr int kFewCells = 10'000;  ///< for a thread
  int dim_;
  const int threads_;
  const Numbering& numbering_;
  std::vector<int> first_, count_;      ///< of a node's unknowns
  std::vector<int> start_, neighbour_;  ///< node → its neighbours ≥ itself, ascending, itself first
  std::vector<int> offset_;             ///< unknowns of the neighbours before
};

/// Calls visit(nodes of the cell, k) for every cell with at least one node that is `wanted`. k[a][b][i][j] couples component i of the cell's node a
/// to component j of its node b ≤ a.
template <class E, class Wanted, class Visit>
void for_each_stiffness(const Mesh& mesh, const MaterialField& material, Wanted&& wanted, Visit&& visit) {
  double k[E::nodes][E::nodes][E::dim][E::dim];
  const auto has_one = [&](int c) { return std::any_of(mesh.cell(c), mesh.cell(c) + E::nodes, wanted); };
  for_each_cell<E>(mesh, material, has_one, [&](int c, const auto& x, const Hooke& hooke) {
    stiffness<E>(x, hooke, k);
    visit(mesh.cell(c), k);
  });
}

/// Adds the stiffness of all cells. Each thread fills the columns of its own range of nodes. It takes cells in their order, so that the result does not depend
/// on the number of threads.
template <class E>
void add_stiffness(const Mesh& mesh, const MaterialField& material, Assembly& assembly) {
  parallel_ranges(mesh.node_count(), assembly.threads(), [&](int, int first, int end) {
    const auto inside = [&](int node) { return node >= first && node < end; };
    for_each_stiffness<E>(mesh, material, inside, [&](const int* n, const auto& k) {
      for (int a = 0; a < E::nodes; ++a)
        for (int b = 0; b <= a; ++b)
          if (inside(std::min(n[a], n[b]))) assembly.add(n[a], n[b], [&](int i, int j) { return k[a][b][i][j]; });
    });
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

algebra::StoredMatrix assemble(const Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering) {
  Assembly assembly(mesh, numbering);
  dispatch(mesh.element, [&]<class E>() {
    add_stiffness<E>(mesh, material, assembly);
  });
  for (const auto& entry : spring_stiffness(mesh, springs, numbering)) assembly.K.coeffRef(entry.row(), entry.col()) += entry.value();
  return std::move(assembly.K);
}

algebra::Triplets spring_stiffness(const Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering) {
  algebra::Triplets entries;
  const int dim = mesh.dimension();
  for (const FacetSpring& spring : springs) {
    double k[mesh::kMostFacetNodes][mesh::kMostFacetNodes][3] = {};
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int a = 0; a < p.nodes; ++a)
        for (int b = 0; b <= a; ++b)
          for (int i = 0; i < dim; ++i) k[a][b][i] += spring.stiffness[p.index][i] * p.shape[a] * p.shape[b] * p.measure;
    });
    for (int a = 0; a < mesh.topology().nodes_per_facet; ++a)
      for (int b = 0; b <= a; ++b)
        for (int i = 0; i < dim; ++i) {
          const auto unknown = [&](int node) { return numbering.unknown[static_cast<std::size_t>(mesh.facet_node(spring.facet, node)) * dim + i]; };
          const int row = std::max(unknown(a), unknown(b)), column = std::min(unknown(a), unknown(b));
          if (column >= 0 && k[a][b][i] != 0) entries.emplace_back(row, column, k[a][b][i]);
        }
  }
  return entries;
}

Load load(const Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const std::vector<double>& force,
          const Numbering& numbering) {
  Load load{Vector::Zero(numbering.count())};
  const std::vector<double> held = numbering.prescribed.empty() ? std::vector<double>() : internal_force(mesh, material, springs, numbering.prescribed);
  if (force.empty() && held.empty()) return load;
  for (std::size_t k = 0; k < numbering.unknown.size(); ++k) {
    const double given = force.empty() ? 0 : force[k], pulled = held.empty() ? 0 : held[k];
    if (numbering.unknown[k] >= 0) load.f[numbering.unknown[k]] = given - pulled;
    else load.offset += numbering.value(k) * (0.5 * pulled - given);
  }
  return load;
}

algebra::SparseMatrix h1_gram(const Mesh& mesh, const Numbering& numbering, double length) {
  Assembly assembly(mesh, numbering);
  dispatch(mesh.element, [&]<class E>() {
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto& shape, const auto& g) {
      const int* n = mesh.cell(p.cell);
      for (int a = 0; a < E::nodes; ++a)
        for (int b = 0; b <= a; ++b) {
          double k = shape[a] * shape[b] / (length * length);
          for (int i = 0; i < E::dim; ++i) k += g[a][i] * g[b][i];
          assembly.add(n[a], n[b], [&](int i, int j) { return i == j ? w * k : 0.0; });
        }
    });
  });
  return assembly.K.pruned();  // components are not coupled
}

SpringRows spring_rows(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering) {
  const int dim = mesh.dimension();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> stiffness, c;
  double offset = 0;
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < dim; ++i) {
        const double k = spring.stiffness[p.index][i] * p.measure;
        const std::size_t before = entries.size();
        double given = 0;
        for (int a = 0; k > 0 && a < p.nodes; ++a) {
          const std::size_t at = static_cast<std::size_t>(mesh.facet_node(spring.facet, a)) * dim + i;
          if (const int v = numbering.unknown[at]; v >= 0) entries.emplace_back(static_cast<int>(c.size()), v, p.shape[a]);
          else given += p.shape[a] * numbering.value(at);
        }
        if (entries.size() > before) stiffness.push_back(k), c.push_back(-given);
        else offset += 0.5 * k * given * given;
      }
    });
  const auto rows = static_cast<Eigen::Index>(c.size());
  SpringRows all{algebra::SparseRows(rows, numbering.count()), Eigen::Map<const algebra::Vector>(stiffness.data(), rows),
                 Eigen::Map<const algebra::Vector>(c.data(), rows), offset};
  all.S.setFromTriplets(entries.begin(), entries.end());
  return all;
}

std::vector<double> internal_force(const Mesh& mesh, const MaterialField& material,
                                   const std::vector<FacetSpring>& springs,
                                   const std::vector<double>& u) {
  std::vector<double> force(u.size(), 0.0);
  if (std::all_of(u.begin(), u.end(), [](double x) { return x == 0; })) return force;
  const int dim = mesh.dimension();
  dispatch(mesh.element, [&]<class E>() {
    const auto moves = [&](int node) { return std::any_of(u.begin() + node * dim, u.begin() + (node + 1) * dim, [](double x) { return x != 0; }); };
    for_each_stiffness<E>(mesh, material, moves, [&](const int* n, const auto& k) {
      for (int a = 0; a < E::nodes; ++a)
        for (int b = 0; b < E::nodes; ++b)
          for (int i = 0; i < E::dim; ++i)
            for (int j = 0; j < E::dim; ++j)
              force[static_cast<std::size_t>(n[a]) * dim + i] +=
                  (a >= b ? k[a][b][i][j] : k[b][a][j][i]) * u[static_cast<std::size_t>(n[b]) * dim + j];
    });
  });
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) { add_at(mesh, spring.facet, p, spring_force(mesh, spring, p, u), force); });
  return force;
}

mesh::Point spring_force(const Mesh& mesh, const FacetSpring& spring, const FacetPoint& p, const std::vector<double>& u) {
  mesh::Point force{0, 0, 0};
  for (int a = 0; a < p.nodes; ++a) {
    const mesh::Point at = mesh::at_node(u, mesh.facet_node(spring.facet, a), mesh.dimension());
    for (int i = 0; i < mesh.dimension(); ++i) force[i] += spring.stiffness[p.index][i] * p.shape[a] * at[i];
  }
  return force;
}

}  // namespace dotyk::elasticity

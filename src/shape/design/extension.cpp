#include "shape/design/extension.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "algebra/congruent.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/cholesky.hpp"
#include "base/error.hpp"
#include "elasticity/assembly.hpp"
#include "mesh/facet_table.hpp"

namespace dotyk::shape {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using mesh::Point;
using Quadrilateral = std::array<int, 4>;  ///< anticlockwise

constexpr double kStraight = 1e-6;  ///< sine of the angle between normals that count as one

/// What is left free at a node: the projection onto it.
struct Free {
  Eigen::Matrix3d P = Eigen::Matrix3d::Identity();

  void hold(const Point& normal) {
    const Eigen::Vector3d n = Eigen::Vector3d(normal.data()), e = P * (P * n);
    if (e.norm() > kStraight) P -= e * e.transpose() / e.squaredNorm();
  }

  /// Orthonormal, exactly along the axes where these are free.
  std::vector<Eigen::Vector3d> directions() const {
    std::vector<Eigen::Vector3d> out;
    const algebra::Eigenpairs3 eigen = P.isDiagonal(0) ? algebra::Eigenpairs3{P.diagonal(), Eigen::Matrix3d::Identity()} : algebra::eigenpairs3(P);
    for (int i = 0; i < 3; ++i)
      if (eigen.values[i] > 0.5) out.push_back(eigen.vectors.col(i));
    return out;
  }
};

/// Flags of the nodes of parts.
std::vector<char> nodes_of(const mesh::Mesh& mesh, const std::vector<scene::Part>& parts) {
  std::vector<mesh::Facet> facets;
  for (const scene::Part& part : parts) facets.insert(facets.end(), part.facets.begin(), part.facets.end());
  return mesh::flag_nodes(mesh, facets);
}

/// What is free of each node of a body: in the plane none of its boundary, in space not what would lead off its sides.
std::vector<Free> free_directions(const BoundaryMotion& motion) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  std::vector<Free> out(mesh.node_count());
  std::vector<char> moves(static_cast<std::size_t>(mesh.cell_count()) * mesh.topology().facets, 0);
  const auto at = [&](mesh::Facet f) -> char& { return moves[static_cast<std::size_t>(f.cell) * mesh.topology().facets + f.local]; };
  for (const mesh::Facet f : motion.part.facets) at(f) = 1;
  for (const mesh::Facet f : mesh::boundary(mesh)) {
    if (at(f)) continue;
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) {
      Free& node = out[mesh.facet_node(f, k)];
      if (mesh.dimension() == 2) node.P.setZero();
      else node.hold(mesh::unit(mesh.facet_area_vector(f)));
    }
  }
  for (const int node : motion.nodes) out[node].P.setZero();
  return out;
}

/// The unknown directions of all nodes: components × unknowns, orthonormal columns, and the node of each.
struct Directions {
  SparseMatrix Q;
  std::vector<int> node;
};

Directions directions(const BoundaryMotion& motion, const std::vector<char>& fixed) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  const int dim = mesh.dimension();
  const std::vector<Free> sides = free_directions(motion);
  std::vector<Eigen::Triplet<double>> entries;
  Directions out;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (fixed[node]) continue;
    for (const Eigen::Vector3d& d : sides[node].directions()) {
      if (dim == 2 && d[2] != 0) continue;
      for (int i = 0; i < dim; ++i)
        if (d[i] != 0) entries.emplace_back(node * dim + i, static_cast<int>(out.node.size()), d[i]);
      out.node.push_back(node);
    }
  }
  out.Q.resize(static_cast<Eigen::Index>(mesh.coordinates.size()), static_cast<Eigen::Index>(out.node.size()));
  out.Q.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// The stiffness for the energy density 2 ε:ε − (div V)² = |∇V|² + ∇V:∇Vᵀ − (div V)²: Hooke's law with λ = −μ.
SparseMatrix stiffness(const mesh::Mesh& mesh) {
  const std::vector<double> zero(mesh.coordinates.size(), 0.0);
  const elasticity::MaterialField material(elasticity::by_lame(-1, 1, mesh.dimension()));
  return elasticity::assemble(mesh, material, {}, elasticity::number(mesh, std::vector<char>(zero.size(), 0), zero));
}

constexpr double kCorner = 0.86602540378443864676;  ///< cos 30°

using Way = std::map<int, int>;  ///< boundary node → the next one

bool turns(const mesh::Mesh& mesh, int a, int b, int c) {
  const double *x = mesh.node(a), *y = mesh.node(b), *z = mesh.node(c);
  const double along = (y[0] - x[0]) * (z[0] - y[0]) + (y[1] - x[1]) * (z[1] - y[1]);
  return along < kCorner * plane_distance(x, y) * plane_distance(y, z);
}

/// The nodes of the side that begins at the end of the part: up to its corner, or a node that holds.
std::vector<int> side(const mesh::Mesh& mesh, const Way& way, int end, const std::vector<char>& holds) {
  std::vector<int> nodes{end};
  for (auto to = way.find(end); to != way.end() && to->second != end; to = way.find(nodes.back())) {
    if (nodes.size() > 1 && (holds[nodes.back()] || turns(mesh, nodes[nodes.size() - 2], nodes.back(), to->second))) break;
    nodes.push_back(to->second);
  }
  return nodes;
}

void interpolate(const mesh::Mesh& mesh, const std::vector<int>& nodes, DenseMatrix& V) {
  std::vector<double> length{0};
  for (std::size_t k = 1; k < nodes.size(); ++k) length.push_back(length.back() + plane_distance(mesh.node(nodes[k - 1]), mesh.node(nodes[k])));
  const DenseMatrix from = V.middleRows(2 * nodes.front(), 2), to = V.middleRows(2 * nodes.back(), 2);
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const double t = length[k] / length.back();
    V.middleRows(2 * nodes[k], 2) = (1 - t) * from + t * to;
  }
}

/// Of a plane body: the sides that go on where the moving part ends take the velocity of its end with them, less and less
/// by length, to nothing at their own next corner, at a node that is `fixed` (flags) or to the
/// velocity of the part's other end. Written to V (components × variables), which has the part's velocities.
void move_sides(const BoundaryMotion& motion, const std::vector<char>& fixed, DenseMatrix& V) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  std::vector<char> holds = fixed;
  for (const int node : motion.nodes) holds[node] = 1;
  std::map<int, int> moving;
  for (const mesh::Facet f : motion.part.facets) moving[mesh.facet_node(f, 0)] = mesh.facet_node(f, 1);
  Way forward, backward;  // over the rest of the boundary
  for (const mesh::Facet f : mesh::boundary(mesh)) {
    const int a = mesh.facet_node(f, 0), b = mesh.facet_node(f, 1);
    if (const auto part = moving.find(a); part == moving.end() || part->second != b) forward[a] = b, backward[b] = a;
  }
  for (const int node : motion.nodes)
    for (const Way* way : {&forward, &backward})
      if (way->count(node)) interpolate(mesh, side(mesh, *way, node, holds), V);
}

/// All velocities (components × variables).
DenseMatrix harmonic(const BoundaryMotion& motion, const std::vector<char>& fixed) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  const int dim = mesh.dimension();
  DenseMatrix V = DenseMatrix::Zero(static_cast<Eigen::Index>(mesh.coordinates.size()), motion.variables());
  for (std::size_t a = 0; a < motion.nodes.size(); ++a)
    for (int v = 0; v < motion.variables(); ++v)
      for (int i = 0; i < dim; ++i) V(motion.nodes[a] * dim + i, v) = motion.velocity(a, v)[i];
  if (dim == 2) move_sides(motion, fixed, V);
  const Directions d = directions(motion, fixed);
  if (d.node.empty()) return V;
  const SparseMatrix K = stiffness(mesh), reduced = algebra::congruent(K, d.Q);
  algebra::Cholesky factor(reduced, d.node, {});
  if (!factor.factor(reduced)) throw InputError(text("the mesh of '", motion.part.body->name, "' is too distorted to follow ", motion.part.label()));
  V -= d.Q * factor.solve(d.Q.transpose() * DenseMatrix(K.selfadjointView<Eigen::Lower>() * V));
  return V;
}

/// Throws where a fixed part has a node with a velocity.
void check_fixed(const BoundaryMotion& motion, const std::vector<scene::Part>& fixed, const std::vector<std::vector<double>>& V) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  const int dim = mesh.dimension();
  for (const scene::Part& part : fixed)
    for (const mesh::Facet f : part.facets)
      for (int k = 0; k < mesh.topology().nodes_per_facet; ++k)
        for (std::size_t v = 0; v < V.size(); ++v)
          for (int i = 0; i < dim; ++i) {
            const int node = mesh.facet_node(f, k);
            if (V[v][static_cast<std::size_t>(node) * dim + i] != 0)
              throw InputError(text(part.label(), " is to stay, but variable ", v + 1, " of ", motion.part.label(), " moves its node ",
                                    point_text(mesh.node(node), dim)));
          }
}

[[noreturn]] void no_grid(const scene::Part& part, const std::string& why) {
  throw InputError(text("the mesh of '", part.body->name, "' is no grid mapped from ", part.label(), " to the opposite side (", why,
                        "); the harmonic extension takes every mesh"));
}

/// Two triangles with two nodes in common, as one cell.
Quadrilateral joined(const scene::Part& part, const int* a, const int* b) {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (a[(k + 1) % 3] == b[(l + 2) % 3] && a[(k + 2) % 3] == b[(l + 1) % 3]) return {a[k], a[(k + 1) % 3], b[l], a[(k + 2) % 3]};
  no_grid(part, "its triangles are not pairs");
}

std::vector<Quadrilateral> quadrilaterals(const scene::Part& part) {
  const mesh::Mesh& mesh = *part.body->mesh;
  std::vector<Quadrilateral> out;
  if (mesh.element == mesh::Element::quadrilateral_q1) {
    for (int c = 0; c < mesh.cell_count(); ++c) out.push_back({mesh.cell(c)[0], mesh.cell(c)[1], mesh.cell(c)[2], mesh.cell(c)[3]});
  } else if (mesh.element == mesh::Element::triangle_p1) {
    if (mesh.cell_count() % 2 != 0) no_grid(part, "its triangles are not pairs");
    for (int c = 0; c < mesh.cell_count(); c += 2) out.push_back(joined(part, mesh.cell(c), mesh.cell(c + 1)));
  } else {
    no_grid(part, "it is in space");
  }
  return out;
}

/// Which quadrilaterals have an edge, and as which side.
struct EdgeUse {
  int cell[2] = {-1, -1}, side[2] = {-1, -1};
};

class Lines {
 public:
  explicit Lines(const scene::Part& part) : part_(part), cells_(quadrilaterals(part)), seen_(cells_.size(), 0), next_(part.body->mesh->node_count(), -1) {
    for (int c = 0; c < static_cast<int>(cells_.size()); ++c)
      for (int s = 0; s < 4; ++s) {
        EdgeUse& use = edges_[mesh::edge_key(cells_[c][s], cells_[c][(s + 1) % 4])];
        const int k = use.cell[0] < 0 ? 0 : 1;
        use.cell[k] = c;
        use.side[k] = s;
      }
    for (const mesh::Facet f : part.facets) follow(part.body->mesh->facet_node(f, 0), part.body->mesh->facet_node(f, 1));
    if (std::find(seen_.begin(), seen_.end(), 0) != seen_.end()) no_grid(part, "not all cells lie on its lines");
  }

  /// The next node of the line of a node, away from the part; -1 at its end.
  int next(int node) const { return next_[node]; }

 private:
  /// Across the column of cells that stands on an edge of the part.
  void follow(int a, int b) {
    for (int from = -1;;) {
      const auto found = edges_.find(mesh::edge_key(a, b));
      if (found == edges_.end()) no_grid(part_, "its triangles are not pairs");
      const EdgeUse& use = found->second;
      const int k = use.cell[0] == from ? 1 : 0;
      if (use.cell[k] < 0) return;
      from = use.cell[k];
      if (seen_[from]++) no_grid(part_, "its lines cross");
      const Quadrilateral& q = cells_[from];
      const int s = use.side[k];
      join(q[s], q[(s + 3) % 4]);
      join(q[(s + 1) % 4], q[(s + 2) % 4]);
      a = q[(s + 2) % 4];
      b = q[(s + 3) % 4];
    }
  }

  void join(int node, int further) {
    if (next_[node] >= 0 && next_[node] != further) no_grid(part_, "its lines branch");
    next_[node] = further;
  }

  const scene::Part& part_;
  std::vector<Quadrilateral> cells_;
  std::vector<char> seen_;
  std::vector<int> next_;
  std::unordered_map<std::uint64_t, EdgeUse> edges_;
};

}  // namespace

std::vector<std::vector<double>> extend(const BoundaryMotion& motion, const std::vector<scene::Part>& fixed, Extension kind) {
  for (const scene::Part& part : fixed)
    if (part.body != motion.part.body) throw InputError(text(part.label(), " is of another body than ", motion.part.label(), "; nothing there moves"));
  std::vector<std::vector<double>> velocities;
  if (kind == Extension::structured) {
    velocities = extend_along_lines(motion);
  } else {
    const DenseMatrix V = harmonic(motion, nodes_of(*motion.part.body->mesh, fixed));
    for (Eigen::Index v = 0; v < V.cols(); ++v) velocities.emplace_back(V.col(v).begin(), V.col(v).end());
  }
  check_fixed(motion, fixed, velocities);
  return velocities;
}

std::vector<std::vector<double>> extend_along_lines(const BoundaryMotion& motion) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  const Lines lines(motion.part);
  std::vector<std::vector<double>> velocities(motion.variables(), std::vector<double>(mesh.coordinates.size(), 0.0));
  for (std::size_t a = 0; a < motion.nodes.size(); ++a) {
    std::vector<int> line{motion.nodes[a]};
    std::vector<double> length{0};
    for (int to = lines.next(line.back()); to >= 0; to = lines.next(to)) {
      length.push_back(length.back() + std::hypot(mesh.node(to)[0] - mesh.node(line.back())[0], mesh.node(to)[1] - mesh.node(line.back())[1]));
      line.push_back(to);
    }
    for (std::size_t k = 0; k < line.size(); ++k)
      for (int v = 0; v < motion.variables(); ++v)
        for (int i = 0; i < 2; ++i)
          velocities[v][static_cast<std::size_t>(line[k]) * 2 + i] = motion.velocity(a, v)[i] * (1 - length[k] / length.back());
  }
  return velocities;
}

}  // namespace dotyk::shape

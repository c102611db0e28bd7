#include "contact/trace_norm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "algebra/direct/cholesky.hpp"
#include "base/error.hpp"

namespace dotyk::contact {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using mesh::Point;
using mesh::dot;
using mesh::minus;

/// A segment or triangle of the refined surface.
struct Simplex {
  int facet;
  int node[3];             ///< -1 where traces vanish
  double shape[3][4];      ///< the facet's own hats at its nodes
  double measure;
  double stiffness[3][3];  ///< ∫ ∇φ·∇φ
};

class Refined {
 public:
  Refined(const Surface& surface, const std::vector<char>& moves) : surface_(surface), moves_(moves) {
    for (std::size_t f = 0; f < surface.facets.size(); ++f) cut(static_cast<int>(f));
  }
  int nodes() const { return count_; }
  const std::vector<Simplex>& simplices() const { return simplices_; }

 private:
  using Place = std::array<int, 2>;  ///< steps along the facet's first two edges

  /// Whole-numbered weights of the corners at a place; they sum to kCuts, for quadrilaterals to its square.
  std::array<int, 4> weights(int corners, Place at) const {
    const int n = kCuts, i = at[0], j = at[1];
    if (corners == 2) return {n - i, i, 0, 0};
    if (corners == 3) return {n - i - j, i, j, 0};
    return {(n - i) * (n - j), i * (n - j), i * j, (n - i) * j};
  }

  /// The node there; -1 where all corners with a weight stay.
  int node(const SurfaceFacet& f, const std::array<int, 4>& weight) {
    std::vector<std::pair<int, int>> key;
    bool moves = false;
    for (int a = 0; a < f.corners; ++a) {
      if (weight[a] == 0) continue;
      key.emplace_back(f.row[a], weight[a]);
      moves = moves || (f.row[a] >= 0 && moves_[f.row[a]]);
    }
    if (!moves) return -1;
    std::sort(key.begin(), key.end());
    const auto [place, fresh] = number_.emplace(std::move(key), count_);
    count_ += fresh;
    return place->second;
  }

  void add(int facet, const std::vector<Place>& places) {
    const SurfaceFacet& f = surface_.facets[facet];
    Simplex s{};
    s.facet = facet;
    Point x[3];
    for (std::size_t v = 0; v < places.size(); ++v) {
      const auto weight = weights(f.corners, places[v]);
      s.node[v] = node(f, weight);
      x[v] = {0, 0, 0};
      for (int a = 0; a < f.corners; ++a) {
        s.shape[v][a] = static_cast<double>(weight[a]) / (f.corners == 4 ? kCuts * kCuts : kCuts);
        const Point corner = surface_.mesh.point(surface_.mesh.facet_node(f.facet, a));
        for (int i = 0; i < 3; ++i) x[v][i] += s.shape[v][a] * corner[i];
      }
    }
    measure(x, static_cast<int>(places.size()) - 1, s);
    simplices_.push_back(s);
  }

  /// With the edges E from its first node: measure² = det EᵀE/(d!)², ∇φ_a·∇φ_b the entries of (EᵀE)⁻¹; ∇φ_0 = −Σ of the others.
  static void measure(const Point x[3], int d, Simplex& s) {
    const Point e = minus(x[1], x[0]), f = d == 2 ? minus(x[2], x[0]) : Point{};
    const double ee = dot(e, e), ef = dot(e, f), ff = d == 2 ? dot(f, f) : 1, determinant = ee * ff - ef * ef;
    s.measure = std::sqrt(determinant) / d;
    const double inverse[2][2] = {{ff / determinant, -ef / determinant}, {-ef / determinant, ee / determinant}};
    for (int a = 1; a <= d; ++a)
      for (int b = 1; b <= d; ++b) {
        const double k = s.measure * inverse[a - 1][b - 1];
        s.stiffness[a][b] += k, s.stiffness[0][b] -= k, s.stiffness[a][0] -= k, s.stiffness[0][0] += k;
      }
  }

  void cut(int facet) {
    const int corners = surface_.facets[facet].corners;
    for (int i = 0; i < kCuts; ++i) {
      if (corners == 2) {
        add(facet, {{i, 0}, {i + 1, 0}});
        continue;
      }
      for (int j = 0; j < (corners == 3 ? kCuts - i : kCuts); ++j) {
        add(facet, {{i, j}, {i + 1, j}, {i, j + 1}});
        if (corners == 4 || i + j < kCuts - 1) add(facet, {{i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
      }
    }
  }

  const Surface& surface_;
  const std::vector<char>& moves_;
  std::map<std::vector<std::pair<int, int>>, int> number_;
  int count_ = 0;
  std::vector<Simplex> simplices_;
};

/// ∫φ_aφ_b over a simplex: measure/6 or /12, twice that for a = b.
double mass(const Simplex& s, int vertices, int a, int b) {
  return s.measure * (a == b ? 2 : 1) / (vertices == 2 ? 6 : 12);
}

struct Matrices {
  SparseMatrix A, M;  ///< lower triangles of one pattern
};

Matrices matrices(const Refined& refined, int vertices, double length) {
  std::vector<Eigen::Triplet<double>> a_entries, m_entries;
  for (const Simplex& s : refined.simplices())
    for (int a = 0; a < vertices; ++a)
      for (int b = 0; b < vertices; ++b) {
        if (s.node[b] < 0 || s.node[a] < s.node[b]) continue;
        const double m = mass(s, vertices, a, b);
        m_entries.emplace_back(s.node[a], s.node[b], m);
        a_entries.emplace_back(s.node[a], s.node[b], s.stiffness[a][b] + m / (length * length));
      }
  Matrices result{SparseMatrix(refined.nodes(), refined.nodes()), SparseMatrix(refined.nodes(), refined.nodes())};
  result.A.setFromTriplets(a_entries.begin(), a_entries.end());
  result.M.setFromTriplets(m_entries.begin(), m_entries.end());
  return result;
}

/// Is the simplex in the half of its edge next to that corner?
bool in_half(const Simplex& s, int corner) { return s.shape[0][corner] + s.shape[1][corner] > 1; }

/// m_i = ∫ μ φ_i, a column a density.
DenseMatrix moments(const Refined& refined, int vertices, int facets, const std::vector<Density>& densities) {
  std::vector<std::vector<const Simplex*>> of_facet(facets);
  for (const Simplex& s : refined.simplices()) of_facet[s.facet].push_back(&s);
  DenseMatrix m = DenseMatrix::Zero(refined.nodes(), static_cast<Eigen::Index>(densities.size()));
  for (std::size_t d = 0; d < densities.size(); ++d)
    for (const DensityPiece& piece : densities[d])
      for (const Simplex* s : of_facet[piece.facet]) {
        if (piece.half >= 0 && !in_half(*s, piece.half)) continue;
        for (int b = 0; b < vertices; ++b) {
          double value = 0;
          for (int a = 0; a < 4; ++a) value += s->shape[b][a] * piece.corner[a];
          for (int a = 0; a < vertices; ++a)
            if (s->node[a] >= 0) m(s->node[a], static_cast<Eigen::Index>(d)) += mass(*s, vertices, a, b) * value;
        }
      }
  return m;
}

}  // namespace

DenseMatrix trace_gram(const Surface& surface, const std::vector<char>& moves, const std::vector<Density>& densities,
                       double length, Monitor& monitor) {
  const auto count = static_cast<Eigen::Index>(densities.size());
  const Refined refined(surface, moves);
  if (refined.nodes() == 0 || count == 0) return DenseMatrix::Zero(count, count);
  const int vertices = surface.mesh.dimension();
  const Matrices matrix = matrices(refined, vertices, length);
  const DenseMatrix m = moments(refined, vertices, static_cast<int>(surface.facets.size()), densities);
  // The eigenvalues of M⁻¹A lie between 1/ℓ² and 12 (36 in space) times the greatest 1/height².
  double steepest = 0;
  for (const Simplex& s : refined.simplices())
    for (int a = 0; a < vertices; ++a) steepest = std::max(steepest, s.stiffness[a][a] / s.measure);
  constexpr double kTail = 9, kStep = 0.9;  // e⁻⁹ of the integral cut off; e^(−π²/0.9) by the rule
  const double from = std::log(1 / length) - kTail;
  const double to = 0.5 * std::log(36 * steepest + 1 / (length * length)) + kTail;
  const int steps = static_cast<int>(std::ceil((to - from) / kStep));
  std::vector<int> node(refined.nodes());
  for (int i = 0; i < refined.nodes(); ++i) node[i] = i;
  algebra::Cholesky factor(matrix.A, node, {});
  DenseMatrix gram = DenseMatrix::Zero(count, count);
  for (int k = 0; k <= steps; ++k) {
    monitor.check();
    const double t = std::exp(from + k * kStep);
    SparseMatrix shifted = matrix.A;
    Eigen::Map<Eigen::VectorXd>(shifted.valuePtr(), shifted.nonZeros()) +=
        t * t * Eigen::Map<const Eigen::VectorXd>(matrix.M.valuePtr(), matrix.M.nonZeros());
    if (!factor.factor(shifted)) throw InputError("the trace norm's matrix is singular: facets are nearly flat");
    gram += 2 / std::numbers::pi * kStep * t * (m.transpose() * factor.solve(m));
  }
  return 0.5 * (gram + gram.transpose());
}

}  // namespace dotyk::contact

#include "algebra/dense/polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::algebra {
namespace {

constexpr std::size_t kMostRays = 100000;

/// The cone {z : H z ≥ 0}, row by row of H.
class Cone {
 public:
  Cone(Eigen::Index size, double tolerance) : tolerance_(tolerance) {
    for (Eigen::Index k = 0; k < size; ++k) lines_.push_back(Vector::Unit(size, k));
  }

  void cut(const Vector& h) {
    if (!cut_line(h)) cut_rays(h);
    rows_.push_back(h);
  }

  const std::vector<Vector>& lines() const { return lines_; }
  const std::vector<Vector>& rays() const { return rays_; }

 private:
  /// A line that leaves the half-space becomes a ray; the others are turned into its boundary.
  bool cut_line(const Vector& h) {
    const auto most = std::max_element(lines_.begin(), lines_.end(), [&](const Vector& a, const Vector& b) { return std::abs(h.dot(a)) < std::abs(h.dot(b)); });
    if (most == lines_.end() || std::abs(h.dot(*most)) <= tolerance_) return false;
    const Vector line = *most / h.dot(*most);
    lines_.erase(most);
    for (Vector& other : lines_) other = (other - h.dot(other) * line).normalized();
    for (Vector& ray : rays_) ray = (ray - h.dot(ray) * line).normalized();
    rays_.push_back(line.normalized());
    return true;
  }

  void cut_rays(const Vector& h) {
    std::vector<Vector> kept;
    std::vector<std::size_t> inside, outside;
    for (std::size_t k = 0; k < rays_.size(); ++k) {
      const double side = h.dot(rays_[k]);
      if (side >= -tolerance_) kept.push_back(rays_[k]);
      if (side > tolerance_) inside.push_back(k);
      if (side < -tolerance_) outside.push_back(k);
    }
    if (outside.empty()) return;
    const auto tight = tight_rows();
    for (const std::size_t i : inside)
      for (const std::size_t o : outside)
        if (adjacent(tight, i, o)) kept.push_back((h.dot(rays_[i]) * rays_[o] - h.dot(rays_[o]) * rays_[i]).normalized());
    rays_ = std::move(kept);
    if (rays_.size() > kMostRays) throw std::runtime_error("a polyhedron has too many vertices");
  }

  /// For each ray which of the rows so far it lies on.
  std::vector<std::vector<char>> tight_rows() const {
    std::vector<std::vector<char>> tight(rays_.size(), std::vector<char>(rows_.size()));
    for (std::size_t k = 0; k < rays_.size(); ++k)
      for (std::size_t r = 0; r < rows_.size(); ++r) tight[k][r] = std::abs(rows_[r].dot(rays_[k])) <= tolerance_;
    return tight;
  }

  /// Two rays span a face exactly where no third lies on all rows that both lie on.
  bool adjacent(const std::vector<std::vector<char>>& tight, std::size_t i, std::size_t j) const {
    for (std::size_t k = 0; k < rays_.size(); ++k) {
      if (k == i || k == j) continue;
      bool on_all = true;
      for (std::size_t r = 0; on_all && r < rows_.size(); ++r) on_all = !tight[i][r] || !tight[j][r] || tight[k][r];
      if (on_all) return false;
    }
    return true;
  }

  double tolerance_;
  std::vector<Vector> rows_, lines_, rays_;
};

DenseMatrix columns(const std::vector<Vector>& all, Eigen::Index size) {
  DenseMatrix out(size, static_cast<Eigen::Index>(all.size()));
  for (Eigen::Index k = 0; k < out.cols(); ++k) out.col(k) = all[static_cast<std::size_t>(k)];
  return out;
}

}  // namespace

int Polyhedron::dimension(double tolerance) const {
  if (empty()) return -1;
  DenseMatrix directions(vertices.rows(), vertices.cols() - 1 + rays.cols() + lines.cols());
  directions << vertices.rightCols(vertices.cols() - 1).colwise() - vertices.col(0), rays, lines;
  if (directions.size() == 0) return 0;
  int rank = 0;
  const Vector pivots = pivoted_factors(directions).diagonal;
  while (rank < pivots.size() && std::abs(pivots[rank]) > tolerance) ++rank;
  return rank;
}

Polyhedron polyhedron(const DenseMatrix& A, const Vector& b, double tolerance) {
  const Eigen::Index n = A.cols();
  Polyhedron p{DenseMatrix(n, 0), DenseMatrix(n, 0), DenseMatrix(n, 0)};
  Cone cone(n + 1, tolerance);
  cone.cut(Vector::Unit(n + 1, n));
  for (Eigen::Index r = 0; r < A.rows(); ++r) {
    const double length = A.row(r).norm();
    if (length <= tolerance * tolerance) {  // 0 ≤ b
      if (b[r] < -tolerance) return p;
      continue;
    }
    Vector h(n + 1);
    h << -A.row(r).transpose() / length, b[r] / length;
    cone.cut(h / std::max(1.0, h.norm()));
  }
  std::vector<Vector> vertices, rays, lines;
  for (const Vector& ray : cone.rays()) {
    if (ray[n] > tolerance)
      vertices.push_back(ray.head(n) / ray[n]);
    else if (ray.head(n).norm() > 0.5)
      rays.push_back(ray.head(n).normalized());
  }
  for (const Vector& line : cone.lines()) lines.push_back(line.head(n).normalized());
  if (vertices.empty()) return p;
  return {columns(vertices, n), columns(rays, n), columns(lines, n)};
}

}  // namespace dotyk::algebra

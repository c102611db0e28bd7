#include "contact/frame.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "algebra/dense/decompositions.hpp"
#include "contact/contact_row.hpp"

namespace dotyk::contact {
namespace {

using mesh::Point;
using mesh::dot;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;  ///< in the tangents of a plane (line)

constexpr double kFaces = 0.1;      ///< cosine of normals that look at each other
constexpr double kOpposed = 1e-12;  ///< normals that differ by rounding

Eigen::Map<const Eigen::Vector3d> vector(const Point& p) { return Eigen::Map<const Eigen::Vector3d>(p.data()); }

/// The unit tangents, one a column.
Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2> basis(const Point& normal, int dimension) {
  const std::vector<Point> t = tangents(normal, dimension);
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 2> columns(3, static_cast<Eigen::Index>(t.size()));
  for (std::size_t i = 0; i < t.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = vector(t[i]);
  return columns;
}

/// f of a symmetric matrix' eigenvalues.
Small of_eigenvalues(const Small& symmetric, const std::function<double(double)>& f) {
  const auto [values, V] = algebra::eigenpairs(symmetric);
  return V * values.unaryExpr(f).asDiagonal() * V.transpose();
}

/// Where a part has been looked at, and its normal there.
struct Sample {
  Point x, normal;
  double measure;
};

std::vector<Sample> samples(const mesh::Mesh& mesh, mesh::Facet facet) {
  std::vector<Sample> list;
  if (mesh.topology().order == 1) {
    const Point area = mesh.facet_area_vector(facet);
    list.push_back({mesh.facet_centre(facet), mesh::unit(area), mesh::length(area)});
  } else {
    elasticity::for_each_facet_point(mesh, facet, [&](const elasticity::FacetPoint& p) { list.push_back({p.x, p.normal, p.measure}); });
  }
  return list;
}

/// |K| by least squares, 3 × 3; along directions in which there is one sample 0.
Eigen::Matrix3d fitted(const std::vector<Sample>& list, int dimension) {
  Point x{0, 0, 0}, n{0, 0, 0};
  double sum = 0;
  for (const Sample& s : list) {
    x = mesh::plus(x, mesh::times(s.measure, s.x)), n = mesh::plus(n, mesh::times(s.measure, s.normal));
    sum += s.measure;
  }
  x = mesh::times(1 / sum, x), n = mesh::times(1 / sum, n);
  const auto T = basis(mesh::unit(n), dimension);
  Small places = Small::Zero(dimension - 1, dimension - 1), turns = places;
  for (const Sample& s : list) {
    const auto place = (T.transpose() * vector(mesh::minus(s.x, x))).eval(), turn = (T.transpose() * vector(mesh::minus(s.normal, n))).eval();
    places += s.measure * place * place.transpose();
    turns += s.measure * turn * place.transpose();
  }
  const double least = 1e-10 * places.trace();
  const Small K = turns * of_eigenvalues(places, [&](double v) { return v > least ? 1 / v : 0; });
  return T * of_eigenvalues((K + K.transpose()) / 2, [](double v) { return std::abs(v); }) * T.transpose();
}

Point apply(const std::array<Point, 3>& m, const Point& d) { return {dot(m[0], d), dot(m[1], d), dot(m[2], d)}; }

/// With singular values of at most 1. Where directions of curvature differ by a small angle φ, (K₂ − K₁)(K₁ + K₂)⁻¹ has entries of
/// 1/φ: the point where normals agree lies far outside of what curvatures tell. So limited, n is no farther from the mean than n₁ and −n₂.
Small shortening(const Small& m) {
  return m * of_eigenvalues(m.transpose() * m, [](double v) { return v > 1 ? 1 / std::sqrt(v) : 1; });
}

}  // namespace

Curvatures::Curvatures(const Face& face) {
  const double smooth = std::cos(kCornerAngle * std::numbers::pi / 180);
  const mesh::Mesh& mesh = face.mesh;
  std::unordered_map<int, std::vector<std::size_t>> around;
  std::vector<std::vector<Sample>> of_facet;
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    of_facet.push_back(samples(mesh, face.facets[f]));
    double radius = 0;
    for (int a = 0; a < mesh.topology().facet_corners; ++a) {
      const int node = mesh.facet_node(face.facets[f], a);
      around[node].push_back(f);
      radius = std::max(radius, mesh::length(mesh::minus(mesh.point(node), mesh.facet_centre(face.facets[f]))));
    }
    width_.push_back(2 * radius);
  }
  for (std::size_t f = 0; f < face.facets.size(); ++f) {
    std::vector<std::size_t> near;
    for (int a = 0; a < mesh.topology().facet_corners; ++a)
      for (const std::size_t g : around[mesh.facet_node(face.facets[f], a)]) near.push_back(g);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    const Point normal = mesh::unit(mesh.facet_area_vector(face.facets[f]));
    std::vector<Sample> list;
    for (const std::size_t g : near)
      if (g == f || dot(normal, mesh::unit(mesh.facet_area_vector(face.facets[g]))) > smooth)
        list.insert(list.end(), of_facet[g].begin(), of_facet[g].end());
    of_facet_.push_back(fitted(list, mesh.dimension()));
    for (int a = 0; a < mesh.topology().nodes_per_facet; ++a) {
      double& most = greatest_[mesh.facet_node(face.facets[f], a)];
      most = std::max(most, of_facet_.back().norm());
    }
  }
}

Eigen::Matrix3d Curvatures::at(const NodeSide& side) const {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const int f : side.facets) mean += of_facet_[static_cast<std::size_t>(f)] / static_cast<double>(side.facets.size());
  return mean;
}

double Curvatures::width(const NodeSide& side) const {
  double most = 0;
  for (const int f : side.facets) most = std::max(most, width_[static_cast<std::size_t>(f)]);
  return most;
}

std::unordered_map<int, NodeSide> smooth_sides(const Face& face) {
  const std::vector<NodeSide> all = sides(face.mesh, face.facets);  // by node
  std::unordered_map<int, NodeSide> result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const int node = all[k].node;
    const bool sole = (k == 0 || all[k - 1].node != node) && (k + 1 == all.size() || all[k + 1].node != node);
    if (sole) result.emplace(node, all[k]);
  }
  return result;
}

const NodeSide* side_across(const Point& n1, int partner, const std::unordered_map<int, NodeSide>& second) {
  const auto side = second.find(partner);
  return side == second.end() || dot(n1, side->second.normal) > -kFaces ? nullptr : &side->second;
}

Point inward_across(const Point& n1, const std::vector<NodeWeight>& partners, const std::unordered_map<int, NodeSide>& second) {
  if (partners.size() == 1) {
    const NodeSide* side = side_across(n1, partners.front().node, second);
    return side ? mesh::times(-1, side->normal) : n1;
  }
  Point sum{0, 0, 0};
  for (const NodeWeight& p : partners) {
    const NodeSide* side = side_across(n1, p.node, second);
    sum = mesh::plus(sum, side ? mesh::times(-p.weight, side->normal) : mesh::times(p.weight, n1));
  }
  return mesh::unit(sum);
}

Point unit_derivative(const Point& v, const Point& dv) {
  const Point n = mesh::unit(v);
  return mesh::times(1 / mesh::length(v), mesh::minus(dv, mesh::times(dot(n, dv), n)));
}

Point mixed_normal(const Point& n1, const Point& inward, const std::array<Point, 3>& mix) {
  if (mix == kFirstDecides) return n1;
  if (mix == kSecondDecides) return inward;
  if (mesh::length(mesh::minus(n1, inward)) <= kOpposed) return n1;
  const Point mean = mesh::unit(mesh::plus(n1, inward));
  const Point d = mesh::minus(mesh::times(1 / dot(n1, mean), n1), mean);
  return mesh::unit(mesh::plus(mean, apply(mix, d)));
}

std::array<Point, 3> mix_of_moving(const ContactRow& row, bool first_rests, bool second_rests) {
  if (row.turn > kFlat || row.mix != std::array<Point, 3>{} || first_rests == second_rests) return row.mix;
  return first_rests ? kFirstDecides : kSecondDecides;
}

Point mixed_normal_derivative(const Point& n1, const Point& d1, const Point& inward, const Point& d2, const std::array<Point, 3>& mix) {
  if (mix == kFirstDecides) return d1;
  if (mix == kSecondDecides) return d2;
  const Point sum = mesh::plus(n1, inward), mean = mesh::unit(sum), dmean = unit_derivative(sum, mesh::plus(d1, d2));
  const double c = dot(n1, mean), dc = dot(d1, mean) + dot(n1, dmean);
  const Point d = mesh::minus(mesh::times(1 / c, n1), mean);
  const Point dd = mesh::minus(mesh::minus(mesh::times(1 / c, d1), mesh::times(dc / (c * c), n1)), dmean);
  return unit_derivative(mesh::plus(mean, apply(mix, d)), mesh::plus(dmean, apply(mix, dd)));
}

Frame frame_between(const Point& n1, const Eigen::Matrix3d& K1, const Point& inward, const Eigen::Matrix3d& K2, double flat, int dimension) {
  const auto T = basis(mesh::unit(mesh::plus(n1, inward)), dimension);
  const auto sized = [&](const Eigen::Matrix3d& K) {
    return of_eigenvalues(T.transpose() * K * T, [&](double v) { return v < flat ? 0 : v; });
  };
  const Small a = sized(K1), b = sized(K2);
  Frame frame;
  if (a.isZero(0) != b.isZero(0)) {  // not by M, which the directions of a fitted K turn a little askew
    frame.mix = a.isZero(0) ? kFirstDecides : kSecondDecides;
  } else {
    const Eigen::Matrix3d M = T * shortening((b - a) * of_eigenvalues(a + b, [&](double v) { return v < flat ? 0 : 1 / v; })) * T.transpose();
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) frame.mix[i][k] = M(i, k);
  }
  frame.normal = mixed_normal(n1, inward, frame.mix);
  return frame;
}

Frames::Frames(const Face& one, const Face& two)
    : first(one), second(two), here(one), across(two), second_sides_(smooth_sides(two)), flat_(kFlat / (one.mesh.size() + two.mesh.size())) {}

Frame Frames::of(const NodeSide& side, const std::vector<NodeWeight>& partners) const {
  const Point inward = inward_across(side.normal, partners, second_sides_);
  const Eigen::Matrix3d K1 = here.at(side);
  Eigen::Matrix3d K2 = Eigen::Matrix3d::Zero();
  double width = 0, sum = 0;
  for (const NodeWeight& p : partners)
    if (const NodeSide* other = side_across(side.normal, p.node, second_sides_)) {
      K2 += std::abs(p.weight) * across.at(*other);
      sum += std::abs(p.weight);
      width = std::max(width, across.width(*other));
    }
  if (sum > 0) K2 /= sum;
  Frame frame = frame_between(side.normal, K1, inward, K2, flat_, first.mesh.dimension());
  frame.turn = std::max(K1.norm() * here.width(side), K2.norm() * width);
  return frame;
}

}  // namespace dotyk::contact

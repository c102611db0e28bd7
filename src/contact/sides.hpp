#pragma once

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

#include "algebra/dense/decompositions.hpp"
#include "contact/contact_row.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// A node of a boundary part as seen from one side of the part's (possibly broken) line or surface.
struct NodeSide {
  int node;
  mesh::Point normal;  ///< unit, outward: of the side's facets, weighted by their measure
  double weight;       ///< ∫ φ over the side's facets: length (2-D) or area; of corners of order 2 ∫ of the linear hat
  std::vector<int> facets;  ///< the side's facets at the node, as indices into the part's
  std::vector<NodeWeight> own;  ///< the nodes whose mean the side stands for, `node` first: itself alone, but see corner_sides()
};

/// Facets whose normals differ by more than this meet in an edge; below it the surface is taken
/// as smooth. Between what a coarse polygon of a circle has (12 edges: 30°) and real corners.
inline constexpr double kCornerAngle = 35.0;  // degrees

/// One entry a node and adjoining side, by node: at a vertex of a broken contact line (2-D) or where
/// several faces meet (3-D) there are several (TR965 (1.23)).
std::vector<NodeSide> sides(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// One entry a node, with all its facets' measure; the normal is their mean.
std::vector<NodeSide> nodes(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// sides() of a part whose nodes have moved from the mesh `before` to `after`. Throws InputError, naming the part and the place,
/// where they are not, one for one, of the facets they were of: a corner has appeared, or gone.
std::vector<NodeSide> moved_sides(const mesh::Mesh& before, const mesh::Mesh& after, const std::vector<mesh::Facet>& facets,
                                  const std::string& part);

/// The sides that have multipliers. Order 1: sides() and nodes(). Order 2: those at the facets' corners, each standing for the mean
/// with the corner's dual hat, see ContactRow and DualHats, over those facets of the part that are `used` (one flag each; none
/// given: all); their weight is ∫ψ there, and corners of no such facet are left out.
std::vector<NodeSide> corner_sides(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<char>& used = {});
std::vector<NodeSide> corner_nodes(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets);

/// The linear (bilinear) hat of a corner at a facet's point; of order 1 the shape function itself.
double linear_hat(const mesh::ElementTopology& topology, const elasticity::FacetPoint& point, int corner);

/// Moments of functions with the dual hats ψ of a facet's corners: those combinations of the corners' (bi)linear hats χ with
///   ∫ψ_k χ_l = δ_kl ∫χ_k     (ψ = D G⁻¹ χ, G_kl = ∫χ_kχ_l, D = diag ∫χ_k;  Σψ_k = 1, ∫ψ_k = ∫χ_k),
/// over what quadrature points cover of the facet.
class DualHats {
 public:
  explicit DualHats(int corners) : gram_(Eigen::MatrixXd::Zero(corners, corners)), at_(corners) {}

  /// The next point of the quadrature, and the hats there.
  void point(const double* hats, double measure) {
    at_ = measure * Eigen::Map<const Eigen::VectorXd>(hats, at_.size());
    gram_ += at_ * Eigen::Map<const Eigen::VectorXd>(hats, at_.size()).transpose();
  }
  /// The value there of the function with this number.
  void value(int function, double value) {
    moments_.try_emplace(function, Eigen::VectorXd::Zero(at_.size())).first->second += value * at_;
  }
  /// ∫ψ_k, corner by corner: Σχ = 1, so that rows of the Gram matrix sum to ∫χ.
  Eigen::VectorXd weights() const { return gram_.rowwise().sum(); }
  /// ∫ψ_k f, a function each. Scaled: a narrow strip along an edge has small hats.
  std::map<int, Eigen::VectorXd> moments() const {
    const Eigen::VectorXd weight = weights(), scale = gram_.diagonal().cwiseSqrt().cwiseInverse();
    const algebra::Ldlt factor(scale.asDiagonal() * gram_ * scale.asDiagonal());
    std::map<int, Eigen::VectorXd> dual;
    for (const auto& [function, moment] : moments_)
      dual[function] = weight.asDiagonal() * (scale.asDiagonal() * factor.solve(Eigen::VectorXd(scale.asDiagonal() * moment)));
    return dual;
  }

 private:
  Eigen::MatrixXd gram_;
  Eigen::VectorXd at_;
  std::map<int, Eigen::VectorXd> moments_;
};

}  // namespace dotyk::contact

#include "scene/study/inf_sup.hpp"

#include <cmath>
#include <random>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "base/error.hpp"
#include "contact/trace_norm.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {
namespace {

using algebra::DenseMatrix;
using contact::Density;
using mesh::Point;

/// Rows of B with the scalar density and the direction of each one's multiplier.
struct Basis {
  std::vector<int> rows;
  std::vector<Density> densities;
  std::vector<Point> directions;
};

/// A continuous piecewise linear density from values at contact rows.
Density hats(const contact::Surface& surface, const std::vector<contact::Term>& values, double scale) {
  std::vector<double> at(surface.rows, 0);
  for (const contact::Term& t : values) at[t.row] += scale * t.weight;
  Density density;
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    contact::DensityPiece piece{static_cast<int>(f), -1, {0, 0, 0, 0}};
    bool any = false;
    for (int a = 0; a < surface.facets[f].corners; ++a)
      if (surface.facets[f].row[a] >= 0) {
        piece.corner[a] = at[surface.facets[f].row[a]];
        any = any || piece.corner[a] != 0;
      }
    if (any) density.push_back(piece);
  }
  return density;
}

Basis normal_basis(const Contact& contact, const contact::Surface& surface, const Model& model) {
  Basis basis;
  for (std::size_t j = 0; j < model.normal[0].size(); ++j) {
    if (model.contact_row[0][j] < 0) continue;
    basis.rows.push_back(model.contact_row[0][j]);
    basis.densities.push_back(hats(surface, model.normal[0][j].values, 1 / model.normal[0][j].measure));
    basis.directions.push_back(contact.rows[j].normal);
  }
  return basis;
}

/// The shear of a unit force on a cell: g_h/∫g_h on it, 1/measure where the bound is infinite; nodal cells: hats. `own`: the multiplier μ
/// of that shear, 1/∫g_h.
Density cell_density(const Contact& contact, const contact::Surface& surface, const contact::FrictionCell& cell, bool own) {
  if (cell.pieces.empty()) return hats(surface, cell.nodes, 1 / (own && std::isfinite(cell.bound) ? cell.bound : cell.measure));
  Density density;
  for (const contact::CellPiece& piece : cell.pieces) {
    const contact::SurfaceFacet& f = surface.facets[piece.facet];
    contact::DensityPiece d{piece.facet, piece.half, {0, 0, 0, 0}};
    for (int a = 0; a < f.corners; ++a) {
      const double g = f.row[a] >= 0 ? contact.tangential[f.row[a]].numbers[0] : INFINITY;
      d.corner[a] = std::isfinite(g) ? (own ? 1 : g) / cell.bound : 1 / cell.measure;
    }
    density.push_back(d);
  }
  return density;
}

Basis tangential_basis(const Contact& contact, const contact::Surface& surface, const Model& model, bool own) {
  Basis basis;
  for (const FrictionRows& rows : model.friction[0])
    for (int i = 0; i < rows.count; ++i) {
      basis.rows.push_back(rows.row[i]);
      basis.densities.push_back(cell_density(contact, surface, rows.cell, own));
      basis.directions.push_back(rows.direction[i]);
    }
  return basis;
}

/// Nodes of the contact where a normal (tangential) jump is possible.
std::vector<char> moving(const Scene& scene, const Contact& contact, const Model& model, bool normal) {
  const int dim = scene.dimension(), first = scene.index_of(contact.first.body.get()),
            second = scene.index_of(contact.second.body.get());
  const auto moves = [&](int body, int node, const Point& n) {
    for (int i = 0; i < dim; ++i) {
      const bool free = model.numbering[body].unknown[static_cast<std::size_t>(node) * dim + i] >= 0;
      if (free && (normal ? n[i] != 0 : std::abs(n[i]) < 1 - 1e-9)) return true;
    }
    return false;
  };
  std::vector<char> result;
  for (const contact::ContactRow& row : contact.rows)
    result.push_back(std::any_of(row.own.begin(), row.own.end(), [&](const contact::NodeWeight& own) { return moves(first, own.node, row.normal); }) ||
                     std::any_of(row.partners.begin(), row.partners.end(),
                                 [&](const contact::NodeWeight& partner) { return moves(second, partner.node, row.normal); }));
  return result;
}

DenseMatrix gram(const Basis& basis, const contact::Surface& surface, const std::vector<char>& moves, double length, Monitor& monitor) {
  DenseMatrix N = contact::trace_gram(surface, moves, basis.densities, length, monitor);
  for (Eigen::Index j = 0; j < N.cols(); ++j)
    for (Eigen::Index i = 0; i < N.rows(); ++i) N(i, j) *= mesh::dot(basis.directions[i], basis.directions[j]);
  return N;
}

/// B A₁⁻¹ Bᵀ on the rows picked; oblique sliding supports (the bilateral rows behind the contact's) hold.
DenseMatrix compliance(Model& model, const std::vector<int>& picked, double length, Monitor& monitor) {
  for (std::size_t b = 0; b < model.problem.blocks.size(); ++b) {
    problem::Block& block = model.problem.blocks[b];
    block.K = elasticity::h1_gram(*model.bodies[b].mesh, model.numbering[b], length);
    block.kernel.resize(block.size(), 0);
    block.motions.clear();
  }
  problem::Clock clock;
  const problem::CondensedProblem condensed(model.problem, problem::rigid_motions(model.problem),
                                            algebra::Ordering::automatic, clock, monitor);
  std::vector<int> held;
  for (const auto& slides : model.slide_row)
    for (const int r : slides)
      if (r >= 0) held.push_back(r);
  DenseMatrix W = condensed.W()(picked, picked);
  if (held.empty()) return W;
  const DenseMatrix cross = condensed.W()(held, picked), own = condensed.W()(held, held);
  return W - cross.transpose() * algebra::Ldlt(own).solve(cross);
}

/// The diagonal of the box around the contact's nodes.
double diagonal(const Contact& contact) {
  mesh::Box box;
  for (const contact::ContactRow& row : contact.rows) box.add(contact.first.body->mesh->point(row.node));
  return mesh::length(mesh::minus(box.high, box.low));
}

/// Square roots of the eigenvalues of W μ = β² N μ, ascending.
algebra::Vector constants(const DenseMatrix& W, const DenseMatrix& N) {
  DenseMatrix factor = N, scaled = W;
  if (!algebra::cholesky(factor)) throw InputError("the multipliers of this contact are linearly dependent as functions on it");
  for (int side = 0; side < 2; ++side) {
    algebra::solve_lower(factor, scaled);
    scaled.transposeInPlace();
  }
  return algebra::eigenvalues(0.5 * (scaled + scaled.transpose())).cwiseMax(0).cwiseSqrt();
}

/// Goes down from here; the quotient at the end.
double descend(const DenseMatrix& W, const DenseMatrix& N, const algebra::Ldlt& factor, Eigen::Index unilateral, algebra::Vector mu) {
  constexpr int kSteps = 300;
  const auto quotient = [&](const algebra::Vector& v) {
    const double size = v.dot(N * v);
    return size > 0 ? v.dot(W * v) / size : INFINITY;
  };
  double least = quotient(mu), step = 1;
  for (int k = 0; k < kSteps && step > 1e-10; ++k) {
    mu /= std::sqrt(mu.dot(N * mu));
    const algebra::Vector down = factor.solve(algebra::Vector(W * mu - least * (N * mu))) / std::max(least, 1e-300);
    for (step *= 4; step > 1e-10; step /= 2) {
      algebra::Vector next = mu - step * down;
      next.head(unilateral) = next.head(unilateral).cwiseMax(0);
      const double there = quotient(next);
      if (!(there < least)) continue;
      mu = std::move(next), least = there;
      break;
    }
  }
  return least;
}

/// The least √(μᵀWμ / μᵀNμ) found over the cone of μ whose first `unilateral` entries are not negative, the others any: TR965 (3.16) over
/// M_hn × M_Ht, whose multiples it is. W positive semidefinite, N positive definite. The quotient has many minima on the cone: steps of
/// projected gradients from each hat and from random points, so that the least may be a little less. Throws Interrupted.
double cone_constant(const DenseMatrix& W, const DenseMatrix& N, Eigen::Index unilateral, Monitor& monitor) {
  constexpr int kRandomStarts = 10;
  const algebra::Ldlt factor(N);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(0, 1);
  double least = INFINITY;
  for (Eigen::Index start = 0; start < N.cols() + kRandomStarts; ++start) {
    monitor.check();
    algebra::Vector mu = algebra::Vector::Zero(N.cols());
    if (start < N.cols()) mu[start] = 1;
    else
      for (double& m : mu) m = entry(random);
    least = std::min(least, descend(W, N, factor, unilateral, std::move(mu)));
  }
  return std::sqrt(std::max(least, 0.0));
}

Basis join(Basis a, const Basis& b) {
  a.rows.insert(a.rows.end(), b.rows.begin(), b.rows.end());
  return a;
}

}  // namespace

InfSup inf_sup(const Contact& given, const InfSupSettings& settings, Monitor& monitor) {
  const MultiplierPart part = settings.part;
  if (given.kind == Contact::Kind::glue) throw InputError(given.name + " is a glue; only contacts have multipliers");
  if (given.pairing != contact::Pairing::matching)
    throw InputError(given.name + " has nodes that do not match; inf-sup constants are computed for matching nodes");
  Contact contact = given;
  contact.discretisation.share_fixed = settings.share_fixed;
  Scene scene;
  scene.bodies.push_back(contact.first.body);
  if (contact.second.body && contact.second.body != contact.first.body) scene.bodies.push_back(contact.second.body);
  scene.contacts.push_back(std::make_shared<const Contact>(contact));
  problem::Clock clock;
  Model model = build(scene, clock, monitor);
  contact = *model.contacts.front();
  const contact::Surface surface = surface_of(contact);
  const Basis none, normal = part == MultiplierPart::tangential ? none : normal_basis(contact, surface, model),
                    tangential = part == MultiplierPart::normal ? none : tangential_basis(contact, surface, model, settings.own_norm);
  const Basis all = join(normal, tangential);
  if (all.rows.empty() || (part != MultiplierPart::normal && tangential.rows.empty()))
    throw InputError(given.name + (part == MultiplierPart::normal ? " has no multipliers" : " has no friction, so no "
                                   "tangential multipliers; give it a friction law or ask for part = \"normal\""));
  const double length = diagonal(contact);
  const auto n = static_cast<Eigen::Index>(normal.rows.size()), t = static_cast<Eigen::Index>(tangential.rows.size());
  DenseMatrix N = DenseMatrix::Zero(n + t, n + t);
  if (n > 0) N.topLeftCorner(n, n) = gram(normal, surface, moving(scene, contact, model, true), length, monitor);
  if (t > 0) N.bottomRightCorner(t, t) = gram(tangential, surface, moving(scene, contact, model, false), length, monitor);
  const DenseMatrix W = compliance(model, all.rows, length, monitor);
  const algebra::Vector beta = constants(W, N);
  InfSup result;
  if (settings.cone) result.cone = cone_constant(W, N, n, monitor);
  // β² of a kernel is rounding, 1e-12 of the greatest at most; β itself then 1e-6.
  while (result.kernel < beta.size() && beta[result.kernel] < 1e-5 * beta[beta.size() - 1]) ++result.kernel;
  result.constant = result.kernel > 0 ? 0 : beta[0];
  result.above_kernel = result.kernel < beta.size() ? beta[result.kernel] : 0;
  result.multipliers = static_cast<int>(beta.size());
  result.h = contact::facet_width(surface);
  const double size = contact.discretisation.friction_size;
  result.H = size > 0 ? size : (surface.mesh.dimension() == 3 ? contact::kCellWidth : 1) * result.h;
  return result;
}

}  // namespace dotyk::scene

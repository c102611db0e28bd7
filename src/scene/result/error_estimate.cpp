#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "base/error.hpp"
#include "base/moderate.hpp"
#include "scene/result/boundary_tractions.hpp"
#include "scene/result/energy_norm.hpp"
#include "scene/result/inner_cells.hpp"

namespace dotyk::scene {
namespace {

using elasticity::ErrorParts;
using elasticity::FacetTraction;
using mesh::Facet;
using mesh::Point;
using mesh::dot;

/// Glued facets: nothing is known of the traction.
void forget_glued(const mesh::Mesh& mesh, const std::vector<Facet>& facets, std::vector<int> nodes, Boundary& boundary) {
  std::sort(nodes.begin(), nodes.end());
  for (const Facet f : facets) {
    FacetTraction* at = boundary.find(f);
    for (int a = 0; at && a < mesh.topology().nodes_per_facet; ++a)
      if (!std::binary_search(nodes.begin(), nodes.end(), mesh.facet_node(f, a))) at = nullptr;
    if (at) at->known = {};
  }
}

/// Reactions of a support by laws.
void add_laws(const mesh::Mesh& mesh, const LawSupport& support, const SupportResult& result, Boundary& boundary) {
  std::map<int, std::vector<const SupportNode*>> at_node;
  for (const SupportNode& node : result.nodes) at_node[node.node].push_back(&node);
  for (const Facet f : support.facets) {
    FacetTraction* at = boundary.find(f);
    if (!at) continue;
    const Point n = mesh.facet_area_vector(f);
    for (int a = 0; a < mesh.topology().nodes_per_facet; ++a) {
      const auto found = at_node.find(mesh.facet_node(f, a));
      if (found == at_node.end()) continue;
      const SupportNode& node = **std::max_element(found->second.begin(), found->second.end(), [&](const auto* i, const auto* j) {
        return dot(i->normal, n) < dot(j->normal, n);
      });
      for (int i = 0; i < 3; ++i) at->traction[a][i] += node.shear[i] - node.pressure * node.normal[i];
    }
  }
}

/// ∫ of the product of two linear (bilinear) functions on a facet.
double product(const contact::Gram& gram, int corners, const double* x, const double* y) {
  double sum = 0;
  for (int a = 0; a < corners; ++a)
    for (int b = 0; b < corners; ++b) sum += gram[a][b] * x[a] * y[b];
  return sum;
}

/// 2∫ pressure·gap on the facet, as nodal values interpolate them; or, if less, the error of a traction
/// without that pressure: both are admissible.
double complementarity(const contact::SurfaceFacet& f, const contact::Gram& gram, const ContactResult& result,
                       const elasticity::TractionWeight& weight) {
  double pressure[4] = {}, gap[4] = {}, stiffness = 0;
  for (int a = 0; a < f.corners; ++a) {
    if (f.row[a] < 0) continue;
    const ContactNode& node = result.nodes[f.row[a]];
    pressure[a] = std::abs(node.pressure);
    gap[a] = std::abs(node.gap);
    double along = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) along += node.normal[i] * weight.inverse[i][k] * node.normal[k];
    stiffness = std::max(stiffness, along);
  }
  return std::min(2 * product(gram, f.corners, pressure, gap),
                  weight.depth * stiffness * product(gram, f.corners, pressure, pressure));
}

/// 2∫ (bound ‖slip‖ + shear·slip) on the facet, or, if less, the error of a traction without that shear.
double slip_law(const Contact& contact, const contact::SurfaceFacet& f, const contact::Gram& gram, const ContactResult& result,
                const elasticity::TractionWeight& weight) {
  double bound[4] = {}, slip[4] = {}, size[4] = {}, work = 0, stiffness = 0;
  for (int a = 0; a < f.corners; ++a) {
    if (f.row[a] < 0) continue;
    const ContactNode& node = result.nodes[f.row[a]];
    const double value = contact.tangential[f.row[a]].numbers[0];
    bound[a] = contact.tangential->tresca() ? value : value * std::max(0.0, node.pressure);
    slip[a] = std::sqrt(dot(node.slip, node.slip));
    size[a] = std::sqrt(dot(node.shear, node.shear));
    for (int i = 0; i < 3; ++i) stiffness = std::max(stiffness, weight.inverse[i][i]);
    for (int b = 0; b < f.corners; ++b)
      if (f.row[b] >= 0) work += gram[a][b] * dot(node.shear, result.nodes[f.row[b]].slip);
  }
  const double lost = 2 * (product(gram, f.corners, bound, slip) + work);
  const double without = weight.depth * stiffness * product(gram, f.corners, size, size);
  return std::isfinite(lost) ? std::min(std::max(0.0, lost), without) : 0;
}

/// Throws where squares of stresses or stiffnesses leave the range of numbers: to nan or, no better, to 0.
void require_squares(const elasticity::MaterialField& material, int cells, const std::vector<elasticity::Stress>& stress) {
  constexpr double kMost = 1e140;
  double peak = 0;
  for (const elasticity::Stress& at : stress)
    for (const double s : at) peak = std::max(peak, std::abs(s));
  bool lost = !moderate(peak, kMost);
  for (int c = 0; !lost && c < (material.varies() ? cells : 1); ++c) lost = !moderate(material.at(c).c[0][0][0][0], kMost);
  if (lost)
    throw InputError("the error estimate has values beyond the range of numbers: squares of stresses or stiffnesses are too large or too "
                     "small; choose units in which they are moderate");
}

}  // namespace

const ErrorEstimate& Solution::error_estimate() const {
  if (!error_estimate_) error_estimate_ = make_error_estimate();
  return *error_estimate_;
}

ErrorEstimate Solution::make_error_estimate() const {
  if (!result_.converged)
    throw InputError("the solution has not converged, so that the error estimate, which is of a solution, does not apply (" + result_.reason + ")");
  for (const auto& body : scene_->bodies)
    if (body->mesh->topology().order == 2)
      throw InputError(text("'", body->name, "' is of ", body->mesh->topology().name, "; errors are estimated for cells of order 1, whose stresses have "
                            "points of superconvergence to recover better ones from: compare with a finer mesh (solution:distance)"));
  const auto count = static_cast<int>(scene_->bodies.size());
  std::vector<Boundary> boundary;
  for (int b = 0; b < count; ++b) boundary.emplace_back(body(b), model_.numbering[b], displacement(b));
  std::vector<std::optional<ContactResult>> results;
  for (const auto& contact : scene_->contacts) {
    const int first = scene_->index_of(contact->first.body.get()), second = scene_->index_of(contact->second.body.get());
    results.emplace_back();
    if (contact->kind == Contact::Kind::contact) {
      results.back() = this->contact(*contact);
      add_first(surface_of(*contact), *results.back(), boundary[first]);
      if (second >= 0) add_second(*contact, *results.back(), boundary[second]);
      continue;
    }
    std::vector<int> ours, theirs;
    for (const auto& tie : contact->glued) {
      ours.push_back(tie.node);
      for (const contact::NodeWeight& partner : tie.partners) theirs.push_back(partner.node);
    }
    forget_glued(*contact->first.body->mesh, contact->first.facets, ours, boundary[first]);
    forget_glued(*contact->second.body->mesh, contact->second.facets, theirs, boundary[second]);
  }
  ErrorEstimate estimate;
  double solution = 0;
  std::optional<InnerEstimate> inner;  // of all cells that ranks have refined
  if (model_.problem.hides()) inner = inner_estimate(*this);
  for (int b = 0; b < count; ++b) {
    const Body& own = body(b);
    require_squares(own.material, own.mesh->cell_count(), stress(b));
    for (const LawSupport& on : own.laws)
      add_laws(*own.mesh, on, support({scene_->bodies[b], on.part.name, on.facets}), boundary[b]);
    auto of_body = elasticity::estimate_error(*own.mesh, own.material, displacement(b), cell_forces(own), boundary[b].all(),
                                              own.material.varies() ? nullptr : &stress(b));
    estimate.cells.push_back(std::move(of_body.cells));
    solution += squared_energy_norm(*this, b, displacement(b));
    if (inner) solution += inner->solution[b] - std::reduce(of_body.solution.begin(), of_body.solution.end());
  }
  for (std::size_t c = 0; c < results.size(); ++c) {
    if (!results[c]) continue;
    const Contact& contact = *scene_->contacts[c];
    const Body& own = body(scene_->index_of(contact.first.body.get()));
    auto& cells = estimate.cells[scene_->index_of(contact.first.body.get())];
    for (const contact::SurfaceFacet& f : surface_of(contact).facets) {
      const contact::Gram gram = contact::gram(*own.mesh, f.facet);
      const auto weight = elasticity::traction_weight(*own.mesh, own.material.at(f.facet.cell), f.facet);
      if (contact.normal->stop()) cells[f.facet.cell].complementarity += complementarity(f, gram, *results[c], weight);
      // Slip is counted from the beginning: in a history only its first step's is the increment.
      if (contact.tangential->rubs() && past_.slip.size() == 0)
        cells[f.facet.cell].friction += slip_law(contact, f, gram, *results[c], weight);
    }
  }
  const auto lumping = lumping_of_laws(*this);
  for (std::size_t b = 0; b < lumping.size(); ++b)
    for (std::size_t c = 0; c < lumping[b].size(); ++c) estimate.cells[b][c].laws += lumping[b][c];
  for (const auto& cells : estimate.cells)
    for (const ErrorParts& parts : cells) estimate.parts += parts;
  if (inner) estimate.parts.recovery = inner->parts.recovery, estimate.parts.bulk = inner->parts.bulk, estimate.parts.jump = inner->parts.jump;
  const double square = estimate.parts.sum(), whole = square + solution;
  estimate.absolute = std::sqrt(square);
  estimate.relative = whole > 0 ? std::sqrt(square / whole) : 0;
  return estimate;
}

}  // namespace dotyk::scene

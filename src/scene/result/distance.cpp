#include "scene/result/distance.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "elasticity/load.hpp"
#include "scene/result/energy_norm.hpp"
#include "scene/result/locate.hpp"

namespace dotyk::scene {
namespace {

using mesh::Mesh;
using mesh::Point;

double square(double x) { return x * x; }

double squared_distance(const Point& a, const Point& b) {
  const Point off = mesh::minus(a, b);
  return mesh::dot(off, off);
}

/// Places of points in a mesh, and beside it by the nearest cell.
class Places {
 public:
  Places(const Mesh& mesh, const std::string& body) : mesh_(mesh), body_(body), locator_(mesh), cells_(mesh::cells_of_nodes(mesh)) {}

  Place find(const Point& x) const {
    if (const auto inside = locator_.find(x)) return *inside;
    int nearest = 0;
    for (int n = 1; n < mesh_.node_count(); ++n)
      if (squared_distance(mesh_.point(n), x) < squared_distance(mesh_.point(nearest), x)) nearest = n;
    for (const double slack : {0.02, 0.1, 0.5, 1.0})  // in reference coordinates: less than a cell away
      for (const int c : cells_[nearest]) {
        Place place{c, {}};
        if (elasticity::shape_at(mesh_, c, x, slack, place.shape)) return place;
      }
    throw InputError(text("'", body_, "' has another shape in the reference: ", point_text(x.data(), mesh_.dimension()),
                          " lies far outside it"));
  }

 private:
  const Mesh& mesh_;
  const std::string& body_;
  Locator locator_;
  Buckets cells_;  ///< node → its cells
};

/// The displacement of a body (node × dimension) at the nodes of another mesh of it.
std::vector<double> carried(const Body& body, const std::vector<double>& u, const Mesh& to) {
  const Mesh& from = *body.mesh;
  const int dim = from.dimension();
  const Places places(from, body.name);
  std::vector<double> out(to.coordinates.size(), 0);
  for (int n = 0; n < to.node_count(); ++n) {
    const Place at = places.find(to.point(n));
    for (int a = 0; a < from.topology().nodes; ++a)
      for (int i = 0; i < dim; ++i)
        out[static_cast<std::size_t>(n) * dim + i] += at.shape[a] * u[static_cast<std::size_t>(from.cell(at.cell)[a]) * dim + i];
  }
  return out;
}

/// Squares of norms: of a difference, and of what it is measured by.
struct Squares {
  double difference = 0, whole = 0;
  double ratio(const char* what) const {
    if (!(whole > 0)) throw InputError(text("the reference's ", what, " is zero: nothing to measure by"));
    return std::sqrt(std::max(0.0, difference) / whole);
  }
};

void add_body(const Solution& s, const Solution& reference, int index, Squares& energy, Squares& volume) {
  const Body& body = reference.body(index);
  const Mesh& mesh = *body.mesh;
  const std::vector<double>& exact = reference.displacement(index);
  std::vector<double> off = carried(s.body(index), s.displacement(index), mesh);
  for (std::size_t k = 0; k < off.size(); ++k) off[k] -= exact[k];
  energy.difference += squared_energy_norm(reference, index, off);
  energy.whole += squared_energy_norm(reference, index, exact);
  std::vector<double> share(off.size(), 0);
  elasticity::add_body_force(mesh, [](const Point&) { return Point{1, 1, 1}; }, share);
  for (std::size_t k = 0; k < off.size(); ++k) {
    volume.difference += share[k] * square(off[k]);
    volume.whole += share[k] * square(exact[k]);
  }
}

/// The pressure of these nodes at another node, from those that look the same way; 0 where there are none.
double pressure_at(const std::vector<ContactNode>& nodes, const ContactNode& at, int dimension) {
  std::vector<std::pair<double, const ContactNode*>> near;
  for (const ContactNode& n : nodes)
    if (mesh::dot(n.normal, at.normal) > 0.5) near.emplace_back(squared_distance(n.x, at.x), &n);
  if (near.empty()) return 0;
  const auto keep = near.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(dimension == 2 ? 8 : 4, near.size()));
  std::partial_sort(near.begin(), keep, near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  near.erase(keep, near.end());
  const ContactNode& first = *near[0].second;
  if (near[0].first <= 1e-20 * near.back().first || near.size() == 1) return first.pressure;
  if (dimension == 3) {
    double sum = 0, weights = 0;
    for (const auto& [squared, n] : near) sum += n->pressure / squared, weights += 1 / squared;
    return sum / weights;
  }
  for (const auto& [squared, n] : near) {
    if (mesh::dot(mesh::minus(first.x, at.x), mesh::minus(n->x, at.x)) >= 0) continue;
    const double da = std::sqrt(near[0].first), db = std::sqrt(squared);
    return (first.pressure * db + n->pressure * da) / (da + db);
  }
  return first.pressure;
}

void add_contacts(const Solution& s, const Solution& reference, Distance& out) {
  Squares pressure;
  double peak = 0, exact_peak = 0;
  bool any = false;
  for (std::size_t c = 0; c < s.scene().contacts.size(); ++c) {
    if (s.scene().contacts[c]->kind != Contact::Kind::contact) continue;
    any = true;
    const ContactResult found = s.contact(*s.scene().contacts[c]), exact = reference.contact(*reference.scene().contacts[c]);
    peak = std::max(peak, found.max_pressure), exact_peak = std::max(exact_peak, exact.max_pressure);
    for (const ContactNode& node : found.nodes) {
      const double p = pressure_at(exact.nodes, node, s.scene().dimension());
      pressure.difference += node.weight * square(node.pressure - p);
      pressure.whole += node.weight * square(p);
    }
  }
  if (!any || !(pressure.whole > 0)) return;
  out.pressure = pressure.ratio("contact pressure");
  out.peak_pressure = std::abs(peak / exact_peak - 1);
}

void require_alike(const Scene& a, const Scene& b) {
  const auto differ = [](const auto&... what) { throw InputError(text("the reference is of another scene: ", what...)); };
  if (a.dimension() != b.dimension()) differ("it is ", b.dimension(), "-D, the solution ", a.dimension(), "-D");
  if (a.bodies.size() != b.bodies.size()) differ("it has ", b.bodies.size(), " bodies, the solution ", a.bodies.size());
  if (a.contacts.size() != b.contacts.size()) differ("it has ", b.contacts.size(), " contacts, the solution ", a.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k)
    if (a.contacts[k]->kind != b.contacts[k]->kind) differ("one glues what the other has in contact");
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    const double size = a.bodies[k]->mesh->size(), other = b.bodies[k]->mesh->size();
    if (std::abs(size - other) > 0.2 * other) differ("its '", b.bodies[k]->name, "' is ", other, " long, the solution's ", size);
  }
}

}  // namespace

Distance distance(const Solution& solution, const Solution& reference) {
  for (const Solution* s : {&solution, &reference}) require_whole(s->scene(), "a distance of solutions");
  require_alike(solution.scene(), reference.scene());
  Distance out;
  Squares energy, volume;
  for (std::size_t b = 0; b < solution.scene().bodies.size(); ++b)
    add_body(solution, reference, static_cast<int>(b), energy, volume);
  out.energy = energy.ratio("strain energy");
  out.displacement = volume.ratio("displacement");
  add_contacts(solution, reference, out);
  return out;
}

}  // namespace dotyk::scene

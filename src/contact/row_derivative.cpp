#include "contact/row_derivative.hpp"

#include <array>
#include <map>

#include "base/error.hpp"
#include "contact/frame.hpp"
#include "contact/contact_row.hpp"
#include "elasticity/shape_derivative.hpp"

namespace dotyk::contact {
namespace {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::cross;
using mesh::dot;
using mesh::minus;

Point velocity(const Mesh& mesh, const std::vector<double>& V, int node) {
  return V.empty() ? Point{0, 0, 0} : mesh::at_node(V, node, mesh.dimension());
}

/// What a facet gives to the sides at its nodes, and how that changes.
struct MovingShare {
  Point normal, dnormal;  ///< unit
  std::array<double, 4> weight{}, dweight{};
};

MovingShare share(const Mesh& mesh, Facet f, const std::vector<double>& V) {
  MovingShare s;
  const Point area = mesh.facet_area_vector(f);
  s.normal = mesh::unit(area);
  s.dnormal = unit_derivative(area, mesh::facet_area_derivative(mesh, V, f));
  elasticity::for_each_facet_point(mesh, f, [&](const elasticity::FacetPoint& p) {
    for (int a = 0; a < p.nodes; ++a) s.weight[a] += p.measure * p.shape[a];
  });
  s.dweight = elasticity::facet_weights_derivative(mesh, f, V);
  return s;
}

/// A part that moves, as its sides see it.
class Turning {
 public:
  Turning(const Mesh& mesh, const std::vector<Facet>& facets, const std::vector<double>& V) : mesh_(mesh), facets_(facets) {
    if (V.empty()) return;
    for (const Facet f : facets) shares_.push_back(share(mesh, f, V));
  }
  /// Mean normal and weight of the side of these facets at a node; the gap is left 0.
  RowDerivative at(int node, const std::vector<int>& side) const {
    RowDerivative out;
    if (shares_.empty()) return out;
    Point m{0, 0, 0}, dm{0, 0, 0};
    for (const int k : side) {
      const MovingShare& s = shares_[static_cast<std::size_t>(k)];
      for (int a = 0; a < mesh_.topology().nodes_per_facet; ++a) {
        if (mesh_.facet_node(facets_[static_cast<std::size_t>(k)], a) != node) continue;
        out.weight += s.dweight[a];
        for (int i = 0; i < 3; ++i) {
          m[i] += s.weight[a] * s.normal[i];
          dm[i] += s.dweight[a] * s.normal[i] + s.weight[a] * s.dnormal[i];
        }
      }
    }
    out.normal = unit_derivative(m, dm);
    return out;
  }

 private:
  const Mesh& mesh_;
  const std::vector<Facet>& facets_;
  std::vector<MovingShare> shares_;
};

/// A row's node, which moves; n1: the part's normal there, which turns.
struct Moving {
  Point x, v, n1, dn1;
};

/// d/dt of (normal, gap); the weight is left as it is.
void set_distance(const RigidGap&, const ContactRow&, const Moving& at, RowDerivative& out) {
  if (at.v != Point{})
    throw InputError(text("the node at ", point_text(at.x.data(), 3), " moves before a rigid obstacle that is given by a gap function, whose "
                          "slope is not known; take a rigid plane or ball"));
  out.normal = {0, 0, 0};
}

void set_distance(const RigidPlane&, const ContactRow& row, const Moving& at, RowDerivative& out) {
  out.normal = {0, 0, 0};
  out.gap = -dot(at.v, row.normal);
}

void set_distance(const RigidBall& shape, const ContactRow& row, const Moving& at, RowDerivative& out) {
  const Point way = minus(shape.center, at.x), inward = mesh::unit(way);
  out.normal = mixed_normal_derivative(at.n1, at.dn1, inward, unit_derivative(way, mesh::times(-1, at.v)), row.mix);
  out.gap = row.mix == kSecondDecides ? -dot(at.v, row.normal) : ball_gap_derivative(shape, at.x, row.normal, at.v, out.normal);
}

}  // namespace

std::vector<RowDerivative> row_derivatives(const Face& first, const std::vector<ContactRow>& rows, const std::vector<double>& V,
                                           const Face& second, const std::vector<double>& W) {
  const Turning here(first.mesh, first.facets, V), there(second.mesh, second.facets, W);
  std::map<std::pair<int, std::vector<int>>, Point> normal;
  for (const NodeSide& side : sides(first.mesh, first.facets)) normal[{side.node, side.facets}] = side.normal;
  const auto across = smooth_sides(second);
  std::vector<RowDerivative> out;
  for (const ContactRow& row : rows) {
    const int partner = row.partners.front().node;
    const Point n1 = normal.at({row.node, row.facets}), inward = inward_across(n1, row.partners, across);
    RowDerivative d = here.at(row.node, row.facets);
    const NodeSide* side = side_across(n1, partner, across);
    const Point dinward = side ? mesh::times(-1, there.at(partner, side->facets).normal) : d.normal;
    d.normal = mixed_normal_derivative(n1, d.normal, inward, dinward, mix_of_moving(row, V.empty(), W.empty()));
    const Point apart = minus(second.mesh.point(partner), first.mesh.point(row.node));
    const Point moving = minus(velocity(second.mesh, W, partner), velocity(first.mesh, V, row.node));
    d.gap = dot(moving, row.normal) + dot(apart, d.normal);
    out.push_back(d);
  }
  return out;
}

std::vector<RowDerivative> row_derivatives(const Mesh& mesh, const std::vector<Facet>& facets, const std::vector<ContactRow>& rows,
                                           const RigidShape& shape, const std::vector<double>& V) {
  const Turning part(mesh, facets, V);
  std::map<int, Point> normal;
  for (const NodeSide& side : nodes(mesh, facets)) normal[side.node] = side.normal;
  std::vector<RowDerivative> out;
  for (const ContactRow& row : rows) {
    RowDerivative d = part.at(row.node, row.facets);
    const Moving at{mesh.point(row.node), velocity(mesh, V, row.node), normal.at(row.node), d.normal};
    std::visit([&](const auto& s) { set_distance(s, row, at, d); }, shape);
    out.push_back(d);
  }
  return out;
}

std::vector<double> measure_derivatives(const Surface& surface, const std::vector<double>& V) {
  std::vector<double> sum(surface.rows, 0);
  if (V.empty()) return sum;
  for (const SurfaceFacet& f : surface.facets) {
    const auto weights = elasticity::facet_weights_derivative(surface.mesh, f.facet, V);
    for (int a = 0; a < f.corners; ++a)
      if (f.row[a] >= 0) sum[f.row[a]] += weights[a];
  }
  return sum;
}

std::vector<Point> tangent_derivatives(const Point& n, const Point& dn, int dimension) {
  if (dimension == 2) return {{-dn[1], dn[0], 0}};
  const Point t = tangents(n, dimension).front();  // w/|w|, w = e − n (n·e) with e along the axis
  const int axis = tangent_axis(n);
  Point w = mesh::times(-n[axis], n);
  w[axis] += 1;
  const Point dw = minus(mesh::times(-dn[axis], n), mesh::times(n[axis], dn));
  const Point first = unit_derivative(w, dw);
  return {first, mesh::plus(cross(dn, t), cross(n, first))};
}

}  // namespace dotyk::contact

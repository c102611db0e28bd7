#include "shape/derivative/boundary_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "shape/design/bspline.hpp"

namespace dotyk::shape {
namespace {

using algebra::DenseMatrix;
using mesh::Point;
using mesh::length;

[[noreturn]] void not_one(const scene::Part& part, const std::string& why) {
  throw InputError(text(part.label(), " ", why, "; a part that B-splines move must be one chain of edges"));
}

constexpr int kMostPoints = 4096;

std::vector<int> nodes_of(const scene::Part& part) {
  require_first_order(*part.body);
  const mesh::Mesh& mesh = *part.body->mesh;
  std::vector<int> nodes;
  for (const mesh::Facet f : part.facets)
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) nodes.push_back(mesh.facet_node(f, k));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::size_t place(const std::vector<int>& nodes, int node) {
  return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
}

std::vector<Point> normals(const scene::Part& part, const std::vector<int>& nodes) {
  const mesh::Mesh& mesh = *part.body->mesh;
  std::vector<Point> sum(nodes.size(), Point{0, 0, 0});
  std::vector<double> size(nodes.size(), 0.0);
  for (const mesh::Facet f : part.facets) {
    const Point n = mesh.facet_area_vector(f);
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) {
      const std::size_t at = place(nodes, mesh.facet_node(f, k));
      for (int i = 0; i < 3; ++i) sum[at][i] += n[i];
      size[at] += length(n);
    }
  }
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double total = length(sum[a]);
    if (!(total > 1e-6 * size[a]))
      throw InputError(text(part.label(), " has no normal at ", point_text(mesh.node(nodes[a]), mesh.dimension()), "; give a direction"));
    for (double& x : sum[a]) x /= total;
  }
  return sum;
}

DenseMatrix along_chain(const scene::Part& part, const std::vector<int>& nodes, const ControlPoints& points) {
  const Chain chain = chain_of(part);
  const BSplines splines(points.degree, points.count[0], chain.closed ? BSplines::Ends::periodic : BSplines::Ends::open);
  DenseMatrix weight(nodes.size(), splines.count());
  for (std::size_t k = 0; k < chain.nodes.size(); ++k)
    weight.row(static_cast<Eigen::Index>(place(nodes, chain.nodes[k]))) = splines.values(chain.length[k] / chain.total).transpose();
  return weight;
}

DenseMatrix over_surface(const scene::Part& part, const std::vector<int>& nodes, const ControlPoints& points) {
  const mesh::Mesh& mesh = *part.body->mesh;
  mesh::Box box;
  for (const int node : nodes) box.add(mesh.point(node));
  int axis[3] = {0, 1, 2};
  std::stable_sort(axis, axis + 3, [&](int i, int j) { return box.extent(i) > box.extent(j); });
  const BSplines first(points.degree, points.count[0]), second(points.degree, points.count[1]);
  DenseMatrix weight(nodes.size(), first.count() * second.count());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double* x = mesh.node(nodes[a]);
    const auto values = [&](const BSplines& along, int i) { return along.values((x[i] - box.low[i]) / box.extent(i)); };
    const DenseMatrix product = values(first, axis[0]) * values(second, axis[1]).transpose();
    weight.row(static_cast<Eigen::Index>(a)) = Eigen::Map<const Eigen::RowVectorXd>(product.data(), product.size());
  }
  return weight;
}

}  // namespace

Chain chain_of(const scene::Part& part) {
  const mesh::Mesh& mesh = *part.body->mesh;
  if (mesh.dimension() != 2) throw InputError(text(part.label(), " is a surface in space, not a chain of edges"));
  std::map<int, int> next, previous;
  for (const mesh::Facet f : part.facets) {
    const int a = mesh.facet_node(f, 0), b = mesh.facet_node(f, 1);
    if (!next.emplace(a, b).second || !previous.emplace(b, a).second)
      not_one(part, text("branches at ", point_text(mesh.node(next.count(a) ? a : b), 2)));
  }
  int first = mesh.facet_node(part.facets.front(), 0), begins = 0;
  for (const auto& [a, b] : next)
    if (!previous.count(a)) first = a, ++begins;
  if (begins > 1) not_one(part, text("falls into ", begins, " pieces"));
  Chain chain{{first}, {0.0}, 0, begins == 0};
  for (int at = first; next.count(at);) {
    const int to = next[at];
    chain.total += plane_distance(mesh.node(at), mesh.node(to));
    if (to == first) break;
    chain.nodes.push_back(to);
    chain.length.push_back(chain.total);
    at = to;
  }
  if (chain.nodes.size() + (chain.closed ? 0 : std::size_t(-1)) != next.size()) not_one(part, "falls into pieces");
  return chain;
}

void require_first_order(const scene::Body& body) {
  if (body.mesh->topology().order == 2)
    throw InputError(text("'", body.name, "' is of ", body.mesh->topology().name, "; designs are of bodies of P1 or Q1"));
}

Point BoundaryMotion::velocity(std::size_t node, int variable) const {
  Point v = direction[node];
  for (double& x : v) x *= weight(static_cast<Eigen::Index>(node), variable);
  return v;
}

BoundaryMotion bspline_motion(const scene::Part& part, const ControlPoints& points) {
  BoundaryMotion motion{part, nodes_of(part), {}, {}};
  const int dimension = part.body->dimension();
  const long long asked = points.count[0] * (dimension == 2 ? 1LL : points.count[1]);
  if (asked > kMostPoints) throw InputError(text(asked, " control points of ", part.label(), "; at most ", kMostPoints, " are taken"));
  motion.weight = dimension == 2 ? along_chain(part, motion.nodes, points) : over_surface(part, motion.nodes, points);
  for (Eigen::Index j = 0; j < motion.weight.cols(); ++j)
    if ((motion.weight.col(j).array() == 0).all())
      throw InputError(text("control point ", j + 1, " of ", asked, " moves none of the ", motion.nodes.size(), " nodes of ", part.label(), "; take fewer, or a finer mesh"));
  if (!points.direction) {
    motion.direction = normals(part, motion.nodes);
    return motion;
  }
  const Point d = *points.direction;
  if (!std::isfinite(length(d)) || length(d) == 0 || (dimension == 2 && d[2] != 0))
    throw InputError(text("the direction in which control points of ", part.label(), " move is ", point_text(d.data(), dimension), "; it must be a vector of the ",
                          dimension == 2 ? "plane" : "space", " other than zero"));
  motion.direction.assign(motion.nodes.size(), d);
  return motion;
}

BoundaryMotion combined(BoundaryMotion motion, const DenseMatrix& T) {
  if (T.rows() != motion.weight.cols() || T.cols() == 0)
    throw InputError(text("variables made of ", T.rows(), " control points; ", motion.part.label(), " has ", motion.weight.cols()));
  motion.weight = DenseMatrix(motion.weight * T);
  return motion;
}

}  // namespace dotyk::shape

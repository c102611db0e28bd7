#include "figure/compose/compose_plate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "figure/canvas/plane.hpp"
#include "plate/reaction.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::figure {

using problem::LawChoice;

namespace {

PlateSupport support_of(const problem::LawTraits& law) {
  if (!law.acts() || law.load || law.follows) return PlateSupport::free;
  if (law.yields()) return PlateSupport::friction;
  return law.one_sided() ? PlateSupport::one_sided : law.rigid ? PlateSupport::held : PlateSupport::elastic;
}

// Of supports that hold without condition there is none to tell.
std::optional<Status> told(PlateSupport support, problem::Status status) {
  if (support != PlateSupport::one_sided && support != PlateSupport::friction) return std::nullopt;
  return static_cast<Status>(static_cast<int>(status));
}

using Ends = std::pair<int, int>;  // vertices of an edge of the mesh, counter-clockwise about the plate

// Those that the law can give, where it has a row.
problem::Interval reactions(const LawChoice& law) {
  const auto row = problem::row_law(law);
  return row ? row->multipliers(0) : problem::Interval{-INFINITY, INFINITY};
}

// A corner's own force stands for itself: beside it the strip goes on as between the next two points, as corner_forces() has it,
// as far as the law allows.
EdgeSample sample(const std::vector<plate::EdgePoint>& piece, std::size_t i, std::ptrdiff_t inwards) {
  const plate::EdgePoint& at = piece[i];
  EdgeSample out;
  out.deflection = at.deflection, out.reaction = at.per_length();
  const auto second = static_cast<std::ptrdiff_t>(i) + 2 * inwards;
  const bool known = second >= 0 && second < static_cast<std::ptrdiff_t>(piece.size());
  if (!at.corner || at.status == problem::Status::open || !known) return out;
  const plate::EdgePoint &after = piece[static_cast<std::size_t>(second)], &next = piece[static_cast<std::size_t>(second - inwards)];
  const double share = (next.at - at.at) / (after.at - next.at);
  const auto [low, high] = reactions(at.deflection_law);
  out.reaction = std::clamp(next.per_length() + share * (next.per_length() - after.per_length()), low, high);
  out.extrapolated = true;
  return out;
}

// What holds a point beside an edge with friction has no status that friction has.
std::optional<Status> status_at(const plate::EdgePoint& at, const plate::EdgePoint& next, PlateSupport support) {
  const bool foreign = support == PlateSupport::friction && at.status == problem::Status::closed;
  return told(support, (foreign ? next : at).status);
}

PlateEdge edge_of(const std::vector<plate::EdgePoint>& piece, std::size_t i) {
  const plate::EdgePoint &a = piece[i], &b = piece[i + 1];
  PlateEdge edge;
  edge.support = support_of(a.deflection_law.spec->traits);
  edge.clamped = a.rotation_law->prescribes;
  edge.samples = {sample(piece, i, 1), sample(piece, i + 1, -1)};
  edge.samples[0].status = status_at(a, b, edge.support), edge.samples[1].status = status_at(b, a, edge.support);
  edge.samples[1].share = 1;
  return edge;
}

std::map<Ends, PlateEdge> supported_edges(const plate::Solution& s) {
  std::map<Ends, PlateEdge> out;
  for (std::size_t k = 0; k < s.plate().edges.size(); ++k)
    for (const auto& piece : plate::reaction(s, static_cast<int>(k)).pieces)
      for (std::size_t i = 0; i + 1 < piece.size(); ++i) out[{piece[i].vertex, piece[i + 1].vertex}] = edge_of(piece, i);
  return out;
}

// Loops of the boundary, one after the other.
std::vector<Ends> boundary_loops(const plate::Edges& edges) {
  std::multimap<int, int> next;
  for (const plate::Edge& e : edges.edges)
    if (e.boundary) next.emplace(e.node[0], e.node[1]);
  std::vector<Ends> out;
  while (!next.empty())
    for (auto at = next.begin(); at != next.end(); at = next.find(out.back().second)) {
      out.push_back(*at);
      next.erase(at);
    }
  return out;
}

void add_boundary(PlatePicture& picture, const plate::Solution& s) {
  std::map<Ends, PlateEdge> supported = supported_edges(s);
  const mesh::Mesh& mesh = *s.plate().mesh;
  for (const Ends& ends : boundary_loops(s.model().space.edges)) {
    PlateEdge edge = supported[ends];
    if (edge.samples.empty()) edge.samples = {{0, s.vertex_deflection(ends.first), 0, {}}, {1, s.vertex_deflection(ends.second), 0, {}}};
    edge.from = {mesh.node(ends.first)[0], mesh.node(ends.first)[1]};
    edge.to = {mesh.node(ends.second)[0], mesh.node(ends.second)[1]};
    picture.boundary.push_back(std::move(edge));
  }
}

// A thousandth of what edges and points carry altogether: less is what the mesh leaves of zero.
void add_forces(PlatePicture& picture, const plate::Solution& s) {
  const plate::Plate& plate = s.plate();
  double carried = 0;
  for (std::size_t k = 0; k < plate.edges.size(); ++k)
    for (const auto& piece : plate::reaction(s, static_cast<int>(k)).pieces)
      for (const plate::EdgePoint& p : piece) carried += std::abs(p.force);
  for (std::size_t k = 0; k < plate.supports.size(); ++k) {
    const auto& [x, y, law] = plate.supports[k];
    if (!law->acts() || law->load) continue;
    const double force = plate::point_reaction(s, static_cast<int>(k));
    carried += std::abs(force);
    picture.forces.push_back({x, y, force});
    const PlateSupport support = support_of(law.spec->traits);
    const bool follows = support == PlateSupport::one_sided ? force > 0 : std::abs(force) < (1 - 1e-9) * reactions(law).high;
    picture.supports.push_back({x, y, s.deflection(x, y), support, told(support, problem::status_of(law.spec->traits, follows, force != 0))});
  }
  for (const plate::CornerForce& corner : plate::corner_forces(s)) picture.forces.push_back({corner.x, corner.y, corner.force});
  std::erase_if(picture.forces, [&](const PlateForce& f) { return std::abs(f.force) <= 1e-3 * carried; });
}

// At vertices that have a row of their own: x = −u + height. The zone that bears has also those that touch without a force, and is
// smoothed: twice half of a vertex' own and half the mean of those about it.
void add_obstacle(PlatePicture& picture, const plate::Solution& s) {
  const std::vector<int>& rows = s.model().obstacle_row;
  const algebra::Vector &lambda = s.result().state.lambda, &c = s.model().problem.c;
  if (rows.empty() || lambda.size() == 0) return;
  const double noise = 1e-9 * lambda.lpNorm<Eigen::Infinity>();
  const auto [low, high] = std::minmax_element(picture.deflection.begin(), picture.deflection.end());
  const double floor = *low - 0.5 * (*high - *low);  // what is far below the plate is drawn a little below it
  for (std::size_t i = 0; i < rows.size(); ++i) {
    picture.obstacle.push_back(rows[i] < 0 ? NAN : std::max(floor, -c[rows[i]]));
    if (rows[i] >= 0 && lambda[rows[i]] > noise) picture.bearing.push_back(static_cast<int>(i));
  }
  std::vector<double>& bears = picture.bears;
  bears.assign(rows.size(), 0);
  if (picture.bearing.empty()) return;
  for (std::size_t i = 0; i < rows.size(); ++i) bears[i] = rows[i] >= 0 && picture.deflection[i] + c[rows[i]] < 1e-4 * (*high - *low);
  for (const int i : picture.bearing) bears[i] = 1;
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> sum(rows.size(), 0), count = sum;
    for (const plate::Edge& e : s.model().space.edges.edges)
      for (const int end : {0, 1}) sum[e.node[end]] += bears[e.node[1 - end]], ++count[e.node[end]];
    for (std::size_t i = 0; i < rows.size(); ++i) bears[i] = 0.5 * bears[i] + 0.5 * sum[i] / count[i];
  }
}

// Cuts each triangle into four. The deflection at the middle of a side is that of the element, the mean where its two cells differ; what
// else there is is linear.
void refine(PlatePicture& picture, const plate::Solution& s) {
  const plate::Edges& edges = s.model().space.edges;
  const mesh::Mesh& mesh = *s.plate().mesh;
  const int vertices = mesh.node_count();
  const auto halve = [&](std::vector<double>& values, std::size_t each) {
    for (const plate::Edge& e : edges.edges)
      for (std::size_t c = 0; c < each && !values.empty(); ++c) values.push_back((values[each * e.node[0] + c] + values[each * e.node[1] + c]) / 2);
  };
  for (std::vector<double>* values : {&picture.obstacle, &picture.bears}) halve(*values, 1);
  halve(picture.points, 2);
  std::vector<double> sum(edges.edges.size(), 0), count = sum;
  picture.triangles.clear();
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const int* v = mesh.cell(c);
    std::array<int, 3> m;
    for (int k = 0; k < 3; ++k) {
      const int edge = edges.of_cell[c][k];
      plate::Barycentric b = plate::Barycentric::Constant(0.5);
      b[(k + 2) % 3] = 0;
      sum[edge] += s.deflection({c, b}), ++count[edge];
      m[k] = vertices + edge;
    }
    for (int k = 0; k < 3; ++k) picture.triangles.insert(picture.triangles.end(), {v[k], m[k], m[(k + 2) % 3]});
    picture.triangles.insert(picture.triangles.end(), m.begin(), m.end());
  }
  for (std::size_t e = 0; e < sum.size(); ++e) {
    const int middle = vertices + static_cast<int>(e);
    picture.deflection.push_back(sum[e] / count[e]);
    picture.mesh_edges.insert(picture.mesh_edges.end(), {edges.edges[e].node[0], middle, middle, edges.edges[e].node[1]});
  }
}

// Half the sum of the principal moments, and half their difference.
double mean(const plate::Moment& m) { return (m.xx + m.yy) / 2; }
double radius(const plate::Moment& m) { return std::hypot((m.xx - m.yy) / 2, m.xy); }

// What a field is called, and its value of the moment at a point.
struct PlateValue {
  const char* label;
  double (*value)(const plate::Moment& m);
};

const PlateValue& field_of(PlateField choice) {
  using M = plate::Moment;
  static const PlateValue fields[] = {{"", nullptr}, {"deflection u", nullptr}, {"moment Mxx", [](const M& m) { return m.xx; }},
                                 {"moment Myy", [](const M& m) { return m.yy; }}, {"moment Mxy", [](const M& m) { return m.xy; }},
                                 {"greatest principal moment", [](const M& m) { return mean(m) + radius(m); }},
                                 {"least principal moment", [](const M& m) { return mean(m) - radius(m); }},
                                 {"von Mises moment", [](const M& m) { return std::sqrt(mean(m) * mean(m) + 3 * radius(m) * radius(m)); }}};
  return fields[static_cast<int>(choice)];
}

void add_field(PlatePicture& picture, const plate::Solution& s, const PlateOptions& options) {
  const PlateValue& field = field_of(options.field);
  picture.field_label = field.label, picture.field_signed = options.field != PlateField::von_mises;
  picture.field_unit = options.field == PlateField::deflection ? options.units.length : options.units.force;  // force·length per length
  if (options.field == PlateField::deflection) picture.values = picture.deflection;
  if (!field.value) return;
  const std::vector<plate::Moment>& m = s.vertex_moments();
  for (const plate::Moment& at : m) picture.values.push_back(field.value(at));
  for (const plate::Edge& e : s.model().space.edges.edges) {
    const plate::Moment &p = m[e.node[0]], &q = m[e.node[1]];
    picture.values.push_back(field.value({(p.xx + q.xx) / 2, (p.yy + q.yy) / 2, (p.xy + q.xy) / 2}));
  }
}

}  // namespace

double visible_deflection(const plate::Solution& s) {
  double greatest = 0;
  for (int i = 0; i < s.plate().mesh->node_count(); ++i) greatest = std::max(greatest, std::abs(s.vertex_deflection(i)));
  const double most = 0.2 * s.plate().mesh->size() / greatest;
  return greatest > 0 && std::isfinite(most) ? round_number_below(most) : 1;
}

PlatePicture compose(const plate::Solution& s, const PlateOptions& options) {
  PlatePicture picture;
  picture.caption = solver::doubt(s.result());
  const mesh::Mesh& mesh = *s.plate().mesh;
  picture.view = options.view;
  picture.points = mesh.coordinates, picture.triangles = mesh.cells;
  for (int i = 0; i < mesh.node_count(); ++i) picture.deflection.push_back(s.vertex_deflection(i));
  picture.deformation = options.deform.value_or(visible_deflection(s));
  picture.force_unit = options.units.force, picture.length_unit = options.units.length;
  picture.reaction_unit = options.units.force.empty() || options.units.length.empty() ? "" : options.units.force + "/" + options.units.length;
  add_boundary(picture, s);
  add_forces(picture, s);
  add_obstacle(picture, s);
  refine(picture, s);
  add_field(picture, s, options);
  return picture;
}

}  // namespace dotyk::figure

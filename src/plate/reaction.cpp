#include "plate/reaction.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "algebra/dense/decompositions.hpp"
#include "plate/model.hpp"

namespace dotyk::plate {

using algebra::Vector;
using Eigen::Vector2d;
using problem::LawChoice;
using problem::Status;

namespace {

struct AtVertex {
  double force = 0, moment = 0, length = 0;
  Vector2d couple = {0, 0};  ///< HCT: what holds the gradient there
  const Sample* deflection = nullptr;
  const Sample* rotation = nullptr;
  int row = -1;  ///< of the deflection
};

/// What laws of one edge do, at its vertices; of the middle of an edge half at either end.
class ReactionCollector {
 public:
  ReactionCollector(const Solution& s, int support) : s_(s), model_(s.model()), support_(support) {
    if (std::find(model_.held.is.begin(), model_.held.is.end(), 1) != model_.held.is.end()) find_holding_forces();
    for (const Sample& sample : model_.deflections)
      if (sample.held) shares_[sample.place] += sample.share;
    for (const mesh::Facet f : s.plate().edges[support].facets) {
      const Edge& edge = model_.space.edges.edges[model_.space.edges.of_cell[f.cell][f.local]];
      for (const int n : edge.node) at[n].length += edge.length / 2;
    }
    for (const Sample& sample : model_.deflections)
      if (sample.support == support) add_deflection(sample);
    for (const Sample& sample : model_.rotations)
      if (sample.support == support) add_rotation(sample);
  }

  std::map<int, AtVertex> at;

 private:
  const Vector& lambda() const { return s_.result().state.lambda; }

  /// What holds the held freedoms, less what rows of laws and of point supports beside them do to them.
  void find_holding_forces() {
    holding_ = holding_forces(model_.D, s_.plate().nu, model_.space, model_.held, model_.load, s_.freedoms());
    const auto take_off = [&](const Functional& v, double force) {
      for (const Term& term : v)
        if (model_.held.is[term.freedom]) holding_[term.freedom] -= force * term.factor;
    };
    for (const Sample& d : model_.deflections)
      if (d.row >= 0) take_off(plate::deflection(model_.space, d), lambda()[d.row] * d.part_of_row);
    for (const Sample& r : model_.rotations)
      if (r.row >= 0) take_off(plate::rotation(model_.space, r), (r.law->directed() ? -1 : 1) * lambda()[r.row] * r.part_of_row * model_.space.unit);
    const Finder finder(model_.space);
    for (std::size_t k = 0; k < model_.point_row.size(); ++k) {
      if (model_.point_row[k] < 0) continue;
      const PointSupport& support = s_.plate().supports[k];
      const Place place = finder.find({support.x, support.y}, "a support:");
      take_off(model_.space.deflection_at(place.cell, place.at), lambda()[model_.point_row[k]]);
    }
  }

  void add_deflection(const Sample& sample) {
    double force = 0;
    if (sample.held) force = holding_[model_.space.of_vertex(sample.place)] * sample.share / shares_[sample.place];
    if (sample.row >= 0) force = lambda()[sample.row] * sample.part_of_row;
    if (sample.law->load) force = sample.law.force() * sample.share;
    AtVertex& vertex = at[sample.place];
    vertex.force += force;
    if (sample.held && !model_.space.frame.empty()) vertex.couple = couple(sample.place);
    vertex.deflection = &sample;
    vertex.row = sample.row;
  }

  void add_rotation(const Sample& sample) {
    double moment = 0;
    const double turn = sample.law->directed() ? -1 : 1;
    if (sample.held && !sample.at_vertex) moment = holding_[model_.space.of_edge(sample.place)] * model_.space.unit;
    if (sample.held && sample.at_vertex) moment = held_moment(sample);
    if (sample.row >= 0) moment = turn * lambda()[sample.row] * sample.part_of_row * model_.space.unit;
    if (sample.law->load) moment = sample.law.force() * sample.share;
    const auto add = [&](int vertex, double part) {
      at[vertex].moment += part * moment;
      if (!at[vertex].rotation) at[vertex].rotation = &sample;
    };
    if (sample.at_vertex) return add(sample.place, 1);
    for (const int n : model_.space.edges.edges[sample.place].node) add(n, 0.5);
  }

  Vector2d couple(int vertex) const {
    const int first = model_.space.of_vertex(vertex) + 1;
    const Vector2d a = model_.space.frame[vertex], b(-a[1], a[0]);
    return (holding_[first] * a + holding_[first + 1] * b) * model_.space.unit;
  }

  /// HCT: what this law has of the couple that holds a vertex's gradient, the least that laws can share it as.
  double held_moment(const Sample& sample) const {
    return slope_direction(model_.space, sample).dot(algebra::MinimumNorm(model_.held.directions.at(sample.place)).solve(algebra::Vector(couple(sample.place))));
  }

  const Solution& s_;
  const Model& model_;
  int support_;
  Vector holding_;                    ///< of every freedom
  std::map<int, double> shares_;      ///< lengths that held vertices stand for
};

/// By the multiplier of the vertex's own row; HCT: open where the halves of its edges bear nothing either.
Status status(const Solution& s, const std::vector<const problem::RowGroup*>& groups, const AtVertex& at) {
  if (!at.deflection || !at.deflection->law->acts() || at.deflection->law->load) return Status::open;
  if (at.row < 0) return Status::closed;
  const Vector& lambda = s.result().state.lambda;
  const double noise = 1e-9 * lambda.lpNorm<Eigen::Infinity>(), force = lambda[at.row];
  const auto [low, high] = groups[at.row]->law->multipliers(at.row - groups[at.row]->first);
  if (low == 0 && at.force <= noise) return Status::open;
  const bool limited = std::isfinite(high) || (std::isfinite(low) && low < 0);
  if (!limited) return Status::closed;
  return force >= high - noise || (low < 0 && force <= low + noise) ? Status::slip : Status::stick;
}

double distance(const EdgePoint& a, const EdgePoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// What holds the slope along a smooth edge at a vertex acts as two forces on the vertices beside it.
void add_couples(std::vector<EdgePoint>& piece, const std::map<int, AtVertex>& at) {
  const bool closed = piece.front().vertex == piece.back().vertex;
  for (std::size_t i = closed ? 0 : 1; i + 1 < piece.size(); ++i) {
    if (piece[i].corner) continue;
    const std::size_t before = i > 0 ? i - 1 : piece.size() - 2, after = i + 1;
    const Vector2d along(piece[after].x - piece[before].x, piece[after].y - piece[before].y);
    const double force = at.at(piece[i].vertex).couple.dot(along) / along.squaredNorm();
    piece[before].force -= force, piece[after].force += force;
    if (closed && before == 0) piece.back().force -= force;
    if (closed && after + 1 == piece.size()) piece.front().force += force;
  }
}

/// What half of the first edge carries, by the reaction per length of the next two nodes, taken to be linear.
double carried(const EdgePoint& corner, const EdgePoint& next, const EdgePoint& after) {
  const double h = distance(corner, next), slope = (after.per_length() - next.per_length()) / distance(next, after);
  return h / 2 * (next.per_length() - slope * h * 3 / 4);
}

}  // namespace

EdgeReaction reaction(const Solution& s, int support) {
  const Model& model = s.model();
  const ReactionCollector collected(s, support);
  const auto groups = model.problem.group_of_rows();
  EdgeReaction out;
  for (const auto& [vertex, at] : collected.at) {
    out.force += at.force;
    out.length += at.length;
    if (status(s, groups, at) == Status::open) out.open += at.length;
  }
  for (const auto& nodes : node_chains(model, support)) {
    std::vector<EdgePoint> piece;
    for (const int n : nodes) {
      const AtVertex& at = collected.at.at(n);
      EdgePoint point{n, s.plate().mesh->node(n)[0], s.plate().mesh->node(n)[1], 0, at.length, s.vertex_deflection(n), 0, at.force, at.moment,
                      at.deflection ? at.deflection->law : LawChoice{}, at.rotation ? at.rotation->law : LawChoice{}, status(s, groups, at), !model.space.boundary[n].smooth};
      for (const int e : model.space.boundary[n].edges)
        point.slope += s.freedoms()[model.space.of_edge(e)] / model.space.unit / static_cast<double>(model.space.boundary[n].edges.size());
      if (!piece.empty()) point.at = piece.back().at + distance(piece.back(), point);
      piece.push_back(point);
    }
    add_couples(piece, collected.at);
    out.pieces.push_back(std::move(piece));
  }
  return out;
}

double point_reaction(const Solution& s, int support) {
  const LawChoice& law = s.plate().supports[support].deflection;
  if (law->load) return law.force();
  const int row = s.model().point_row[support];
  return row < 0 ? 0 : s.result().state.lambda[row];
}

std::vector<CornerForce> corner_forces(const Solution& s) {
  std::map<int, CornerForce> at;
  for (std::size_t e = 0; e < s.plate().edges.size(); ++e)
    for (const auto& piece : reaction(s, static_cast<int>(e)).pieces)
      for (std::size_t i = 0; i < piece.size(); ++i) {
        if (!piece[i].corner || piece[i].status == Status::open || piece.size() < 4 || (i + 1 == piece.size() && piece[i].vertex == piece[0].vertex)) continue;
        CornerForce& corner = at.emplace(piece[i].vertex, CornerForce{piece[i].vertex, piece[i].x, piece[i].y, 0}).first->second;
        corner.force += piece[i].force;
        const bool closed = piece.front().vertex == piece.back().vertex;
        if (i + 2 < piece.size()) corner.force -= carried(piece[i], piece[i + 1], piece[i + 2]);
        if (i > 1) corner.force -= carried(piece[i], piece[i - 1], piece[i - 2]);
        else if (closed) corner.force -= carried(piece[i], piece[piece.size() - 2], piece[piece.size() - 3]);
      }
  std::vector<CornerForce> out;
  for (const auto& [vertex, corner] : at) out.push_back(corner);
  return out;
}

}  // namespace dotyk::plate

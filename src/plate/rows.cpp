#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "plate/loads.hpp"
#include "plate/model.hpp"
#include "problem/rows.hpp"

namespace dotyk::plate {
namespace {

using problem::LawChoice;

/// The edges of a place in Plate::edges, line by line.
std::vector<std::vector<int>> edge_chains(const Model& model, int number) {
  const Edges& edges = model.space.edges;
  std::map<int, int> next;   // node → edge that begins there
  std::map<int, int> ends;
  for (const mesh::Facet f : model.plate.edges[number].facets) {
    const int e = edges.of_cell[f.cell][f.local];
    next[edges.edges[e].node[0]] = e;
    ++ends[edges.edges[e].node[1]];
  }
  std::vector<std::vector<int>> out;
  while (!next.empty()) {
    auto start = std::find_if(next.begin(), next.end(), [&](const auto& n) { return ends.find(n.first) == ends.end(); });
    if (start == next.end())  // only closed lines are left: begin at a corner where there is one
      start = std::find_if(next.begin(), next.end(), [&](const auto& n) { return !model.space.boundary[n.first].smooth; });
    if (start == next.end()) start = next.begin();
    std::vector<int>& line = out.emplace_back();
    ends.erase(start->first);
    for (auto at = start; at != next.end(); at = next.find(edges.edges[line.back()].node[1])) {
      line.push_back(at->second);
      ends.erase(edges.edges[at->second].node[1]);
      next.erase(at);
    }
  }
  return out;
}

/// Which of the laws that hold a point rigidly prevails: the greater.
int rigidity(const problem::LawTraits& law) { return law.rigid ? 1 + law.pulls + 2 * !law.bounded : 0; }

/// What laws of edges are about.
struct About {
  bool rotation;
  const char* name;
  Functional (*functional)(const Space&, const Sample&);
  double unit;  ///< its rows are of v·unit
};

class RowMaker {
 public:
  RowMaker(const Plate& plate, Model& model) : plate_(plate), model_(model), rows_(model.problem) {}

  void operator()() {
    if (plate_.obstacle) find_obstacle();
    add_edges(model_.deflections, {false, "deflection", deflection, 1});
    add_edges(model_.rotations, {true, "rotation", rotation, model_.space.unit});
    add_points();
    if (plate_.obstacle) add_obstacle();
    rows_.finish([places = std::move(places_)](int row) { return places[row]; });
  }

 private:
  void find_obstacle() {
    const mesh::Mesh& mesh = *plate_.mesh;
    height_.resize(mesh.node_count());
    model_.obstacle_row.assign(mesh.node_count(), -1);
    minded_.assign(mesh.node_count(), 0);
    for (int n = 0; n < mesh.node_count(); ++n) height_[n] = height(mesh.node(n)[0], mesh.node(n)[1]);
  }

  double height(double x, double y) const {
    const double h = plate_.obstacle(x, y);
    if (std::isnan(h) || h == INFINITY) throw InputError(text("the obstacle is ", h, " at (", x, ", ", y, "); it must be a number"));
    return h;
  }

  /// The samples of one point together.
  void add_edges(std::vector<Sample>& samples, const About& about) {
    std::map<std::array<int, 3>, std::vector<Sample*>> at;
    std::vector<std::array<int, 3>> order;
    for (Sample& s : samples) {
      if (s.held) {
        if (!about.rotation && plate_.obstacle) require_above(s.place, s.law.displacement(), s.x);
        continue;
      }
      if (!s.law->acts() || s.law->load) continue;
      const bool of_edge = !s.at_vertex || (about.rotation && !s.along_node);
      const bool of_part = !about.rotation && model_.space.element == Element::hct;  // the mean about a corner, along one part's edge
      const std::array<int, 3> key{s.at_vertex, s.place, of_edge ? s.edges[0] : of_part ? s.edges[0] : -1};
      auto& list = at[key];
      if (list.empty()) order.push_back(key);
      list.push_back(&s);
    }
    for (const auto& key : order) add_point(at[key], about, about.functional(model_.space, *at[key].front()));
  }

  /// A row for each kind of law that acts at one point.
  void add_point(std::vector<Sample*>& samples, const About& about, const Functional& v) {
    const Reduced reduced = reduce(v, model_.held);
    int most = 0;
    for (const Sample* s : samples) most = std::max(most, rigidity(s->law.spec->traits));
    std::vector<char> done(samples.size(), 0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const LawChoice& law = samples[i]->law;
      const int own = rigidity(law.spec->traits);
      if (done[i] || (own > 0 && own < most) || (most == 4 && !law->prescribes)) continue;
      std::vector<Sample*> alike;
      for (std::size_t j = i; j < samples.size(); ++j)
        if (samples[j]->law.is(*law.spec)) alike.push_back(samples[j]), done[j] = 1;
      add_alike(alike, about, reduced);
    }
  }

  void add_alike(const std::vector<Sample*>& samples, const About& about, const Reduced& v) {
    double share = 0;
    for (const Sample* s : samples) share += s->share;
    LawChoice law = samples.front()->law;
    if (samples.size() > 1 && !law->prescribes) {
      law.numbers.fill(0);
      for (const Sample* s : samples)
        for (std::size_t i = 0; i < law.numbers.size(); ++i) law.numbers[i] += s->law.numbers[i] * s->share / share;
    }
    const Sample& first = *samples.front();
    const double floor = !about.rotation && law->stop() && plate_.obstacle ? mind_obstacle(first) : 0;
    const double turn = about.rotation && law->directed() ? -1 : 1;
    if (v.on_free.empty()) return require_obeyed(law, turn * v.held, floor, first);
    const double target = law->prescribes ? law.displacement() : floor;
    const int row = add(law, text("edge '", plate_.edges[first.support].part, "' ", about.name), v, turn * about.unit, -target * about.unit, about.unit, share,
                        text(about.name, " of the edge at (", first.x[0], ", ", first.x[1], ")"));
    for (Sample* s : samples) s->row = row, s->part_of_row = s->share / share;
  }

  /// The obstacle's height where it is above 0, at a point that may not go below 0.
  double mind_obstacle(const Sample& s) {
    minded_[s.place] = 1;
    return std::max(0.0, height_[s.place]);
  }

  void require_above(int vertex, double held, const Eigen::Vector2d& x) {
    minded_[vertex] = 1;
    if (held < height_[vertex] - 1e-12 * model_.space.unit)
      throw InputError(text("contradictory supports: at (", x[0], ", ", x[1], ") the deflection is held at ", held, ", below the obstacle's ", height_[vertex]));
  }

  void require_obeyed(const LawChoice& law, double v, double floor, const Sample& s) const {
    const double rounding = 1e-12 * model_.space.unit;
    if ((law->stop() && v < floor - rounding) || (law->prescribes && std::abs(v - law.displacement()) > rounding))
      throw InputError(text("contradictory supports: at (", s.x[0], ", ", s.x[1], ") the ", law.spec->words, " law of edge '",
                            plate_.edges[s.support].part, "' and what other parts of the edge hold differ by ", std::abs(v - (law->stop() ? floor : law.displacement()))));
  }

  /// x = −factor·v − c. The law is about v; consecutive rows of equal laws make a group.
  int add(const LawChoice& law, const std::string& group, const Reduced& v, double factor, double c, double unit, double share, std::string place) {
    if (!rows_.is_open(group, law)) rows_.open_group(group, law, unit);
    for (const Term& term : v.on_free) rows_.entry(model_.unknown[term.freedom], -factor * term.factor);
    places_.push_back(std::move(place));
    return rows_.add(c + factor * v.held, share);
  }

  void add_points() {
    if (plate_.supports.empty()) return;
    const Finder finder(model_.space);
    for (const PointSupport& s : plate_.supports) {
      const Place place = finder.find({s.x, s.y}, "a support:");
      model_.point_row.push_back(-1);
      if (!s.deflection->acts() || s.deflection->load) continue;
      const Reduced v = reduce(model_.space.deflection_at(place.cell, place.at), model_.held);
      if (v.on_free.empty()) throw InputError(text("a support: at (", s.x, ", ", s.y, ") the edge is held already"));
      model_.point_row.back() = add(s.deflection, text("support at (", s.x, ", ", s.y, ")"), v, 1, -s.deflection.displacement(), 1, 1,
                                    text("the support at (", s.x, ", ", s.y, ")"));
    }
  }

  void add_obstacle() {
    for (int n = 0; n < plate_.mesh->node_count(); ++n) {
      if (minded_[n] || !std::isfinite(height_[n])) continue;
      const Reduced v = reduce(model_.space.deflection_of_vertex(n), model_.held);
      if (v.on_free.empty()) continue;
      model_.obstacle_row[n] = add({&problem::laws::signorini}, "obstacle", v, 1, -height_[n], 1, 1,
                                   text("the obstacle at (", plate_.mesh->node(n)[0], ", ", plate_.mesh->node(n)[1], ")"));
    }
  }

  const Plate& plate_;
  Model& model_;
  std::vector<double> height_;   ///< of the obstacle at vertices
  std::vector<char> minded_;     ///< vertices where an edge's law or what is held keeps the plate above it
  problem::Rows rows_;
  std::vector<std::string> places_;
};

}  // namespace

std::vector<std::vector<int>> node_chains(const Model& model, int number) {
  std::vector<std::vector<int>> out;
  for (const std::vector<int>& line : edge_chains(model, number)) {
    std::vector<int>& nodes = out.emplace_back(1, model.space.edges.edges[line.front()].node[0]);
    for (const int e : line) nodes.push_back(model.space.edges.edges[e].node[1]);
  }
  return out;
}

std::vector<std::vector<int>> row_chains(const Model& model, const std::vector<Sample>& samples) {
  std::map<std::pair<int, int>, int> at_vertex, at_middle;  // of support and place
  for (const Sample& s : samples)
    if (s.row >= 0) (s.at_vertex ? at_vertex : at_middle)[{s.support, s.place}] = s.row;
  std::vector<std::vector<int>> out;
  for (int support = 0; support < static_cast<int>(model.plate.edges.size()); ++support)
    for (const std::vector<int>& line : edge_chains(model, support)) {
      std::vector<int> rows;
      const auto add = [&](const auto& of, int place) {
        const auto found = of.find({support, place});
        if (found != of.end() && (rows.empty() || (rows.back() != found->second && rows.front() != found->second))) rows.push_back(found->second);
      };
      add(at_vertex, model.space.edges.edges[line.front()].node[0]);
      for (const int e : line) add(at_middle, e), add(at_vertex, model.space.edges.edges[e].node[1]);
      if (rows.size() > 1) out.push_back(std::move(rows));
    }
  return out;
}

void add_rows(const Plate& plate, Model& model) { RowMaker(plate, model)(); }

std::vector<char> touched_by_rows(const problem::Problem& problem) {
  std::vector<char> touched(problem.unknowns(), 0);
  for (int r = 0; r < problem.rows(); ++r)
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it) touched[it.col()] = 1;
  return touched;
}

}  // namespace dotyk::plate

// Trajectories of the principal stresses: lines along their directions, evenly spaced (after Jobard, Lefer: Creating evenly-spaced
// streamlines of arbitrary density, 1997). Lines of equal values of the field of a scene in the plane, with their values.
#include <map>

#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {
namespace {

using Tensor = std::array<double, 3>;  // xx yy xy

constexpr double spacing = 1.6, step = 0.2, nearest = 0.6;  // em; the last a share of `spacing` at which a line ends beside another one
constexpr double kIsotropic = 1e-3;                         // of the greatest stress: the difference of the principal ones, below which directions are arbitrary

// The stress of a body at pixels, linear on triangles.
class StressAt {
public:
  StressAt(const Stage& stage, const BodyPicture& body) : bin_(stage.em), frame_(stage.frame.grown(stage.em)) {
    for (std::size_t i = 0; i < body.stress.size() / 3; ++i) {
      at_.push_back(stage.at(body, static_cast<int>(i), stage.picture.deformation));
      stress_.push_back({body.stress[3 * i], body.stress[3 * i + 1], body.stress[3 * i + 2]});
      for (const double s : stress_.back()) greatest_ = std::max(greatest_, std::abs(s));
    }
    each_polygon({body.cells, nodes_per_cell(body.shape, 1)}, [&](std::span<const int> cell) {
      for (std::size_t k = 2; k < cell.size(); ++k) add({cell[0], cell[k - 1], cell[k]});
    });
  }

  // The direction of a principal stress, of unit length; none off the body, and where both are one.
  std::optional<Point> direction(Point p, bool greater) const {
    const std::optional<Tensor> s = stress(p);
    if (!s) return std::nullopt;
    const double difference = (*s)[0] - (*s)[1], twice = 2 * (*s)[2];
    if (!(std::hypot(difference, twice) > kIsotropic * greatest_)) return std::nullopt;
    const double angle = std::atan2(twice, difference) / 2;
    return greater ? Point{std::cos(angle), std::sin(angle)} : Point{-std::sin(angle), std::cos(angle)};
  }

private:
  using Bin = std::array<int, 2>;
  Bin bin(Point p) const { return {static_cast<int>(std::floor(p.x / bin_)), static_cast<int>(std::floor(p.y / bin_))}; }

  void add(const std::array<int, 3>& triangle) {
    std::vector<Point> corners;
    for (const int i : triangle) corners.push_back(at_[i]);
    Bounds bounds;  // of what is seen of it
    for (const Point& p : cropped(std::move(corners), frame_)) bounds.add(p);
    if (bounds.empty()) return;
    const Bin low = bin({bounds.left, bounds.bottom}), high = bin({bounds.right, bounds.top});
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y) bins_[{x, y}].push_back(triangle);
  }

  std::optional<Tensor> stress(Point p) const {
    const auto found = bins_.find(bin(p));
    if (found == bins_.end()) return std::nullopt;
    const auto doubled = [](Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
    for (const auto& [a, b, c] : found->second) {
      const double whole = doubled(at_[a], at_[b], at_[c]);
      const double u = doubled(p, at_[b], at_[c]) / whole, v = doubled(at_[a], p, at_[c]) / whole, w = 1 - u - v;
      if (!(std::min({u, v, w}) > -1e-9)) continue;
      Tensor out{};
      for (std::size_t k = 0; k < 3; ++k) out[k] = u * stress_[a][k] + v * stress_[b][k] + w * stress_[c][k];
      return out;
    }
    return std::nullopt;
  }

  double bin_, greatest_ = 0;
  Box frame_;
  std::vector<Point> at_;
  std::vector<Tensor> stress_;
  std::map<Bin, std::vector<std::array<int, 3>>> bins_;
};

// Lines of one family that keep apart.
class Family {
public:
  Family(const StressAt& field, bool greater, double em) : field_(field), greater_(greater), apart_(spacing * em), step_(step * em) {}

  void add(Point seed, std::vector<std::vector<Point>>& lines) {
    if (near(seed, apart_)) return;
    std::vector<Point> line = traced(seed, 1), back = traced(seed, -1);
    std::ranges::reverse(back);
    if (!back.empty()) back.pop_back();
    back.insert(back.end(), line.begin(), line.end());
    if (static_cast<double>(back.size()) * step_ < apart_) return;
    for (const Point& p : back) taken_[bin(p)].push_back(p);
    lines.push_back(std::move(back));
  }

private:
  std::array<int, 2> bin(Point p) const { return {static_cast<int>(std::floor(p.x / apart_)), static_cast<int>(std::floor(p.y / apart_))}; }

  bool near(Point p, double distance) const {
    const auto [x, y] = bin(p);
    for (int i = x - 1; i <= x + 1; ++i)
      for (int j = y - 1; j <= y + 1; ++j)
        if (const auto found = taken_.find({i, j}); found != taken_.end())
          if (std::ranges::any_of(found->second, [&](Point q) { return length(p - q) < (1 - 1e-9) * distance; })) return true;
    return false;
  }

  // By the midpoint rule, each direction turned to go on as the one before it.
  std::vector<Point> traced(Point p, double sense) const {
    std::vector<Point> out;
    std::optional<Point> before;
    const auto direction = [&](Point at) {
      std::optional<Point> d = field_.direction(at, greater_);
      if (d && !before) d = sense * *d;
      if (d && before && d->x * before->x + d->y * before->y < 0) d = -1.0 * *d;
      return d;
    };
    constexpr int kMost = 5000;
    for (int k = 0; k < kMost; ++k) {
      const std::optional<Point> d = direction(p);
      if (!d || near(p, nearest * apart_)) break;
      out.push_back(p);
      before = d;
      const std::optional<Point> half = direction(p + step_ / 2 * *d);
      if (!half) break;
      p = p + step_ * *half;
      before = half;
      if (k > 8 && length(p - out.front()) < 0.7 * step_) break;  // closed
    }
    return out;
  }

  const StressAt& field_;
  bool greater_;
  double apart_, step_;
  std::map<std::array<int, 2>, std::vector<Point>> taken_;
};

constexpr double line_width = 15;  // em over this
std::array<double, 2> dash(double em) { return {0.4 * em, 0.25 * em}; }

void draw_trajectories(Stage& stage, vtkRenderer*) {
  if (!stage.picture.trajectories) return;
  const double em = stage.em;
  const auto dashes = dash(em);
  for (const BodyPicture& body : stage.picture.bodies) {
    if (body.stress.empty()) continue;
    const StressAt field(stage, body);
    for (const bool greater : {true, false}) {
      Family family(field, greater, em);
      std::vector<std::vector<Point>> lines;
      for (double y = stage.frame.bottom + 0.4 * em; y < stage.frame.top; y += 0.8 * em)
        for (double x = stage.frame.left + 0.4 * em; x < stage.frame.right; x += 0.8 * em) family.add({x, y}, lines);
      for (const std::vector<Point>& line : lines) stage.over.polyline(line, std::max(1.2, em / line_width), axes_ink, greater ? std::span<const double>() : std::span<const double>(dashes));
    }
  }
}

void trajectory_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  if (!stage.picture.trajectories) return;
  for (const bool greater : {true, false})
    out.push_back({greater ? "greater principal stress" : "lesser principal stress", [em = stage.em, greater](Canvas& c, const Box& b) {
                     const auto dashes = dash(em);
                     c.polyline(b.midline(), std::max(1.2, em / line_width), axes_ink, greater ? std::span<const double>() : std::span<const double>(dashes));
                   }});
}

// The cells of a body in the plane as triangles, a quadrilateral as four about its centre.
struct Triangles {
  std::vector<Point> at;
  std::vector<double> values;
  std::vector<std::array<int, 3>> nodes;
};

Triangles triangles_of(const Stage& stage, const BodyPicture& body) {
  Triangles out;
  for (std::size_t i = 0; i < body.values.size(); ++i) out.at.push_back(stage.at(body, static_cast<int>(i), stage.picture.deformation));
  out.values = body.values;
  each_polygon({body.cells, nodes_per_cell(body.shape, 1)}, [&](std::span<const int> cell) {
    if (!std::ranges::all_of(cell, [&](int i) { return std::isfinite(body.values[i]); })) return;
    if (cell.size() == 3) return out.nodes.push_back({cell[0], cell[1], cell[2]});
    const int centre = static_cast<int>(out.at.size());
    out.at.push_back(0.25 * (out.at[cell[0]] + out.at[cell[1]] + out.at[cell[2]] + out.at[cell[3]]));
    out.values.push_back((out.values[cell[0]] + out.values[cell[1]] + out.values[cell[2]] + out.values[cell[3]]) / 4);
    for (std::size_t k = 0; k < 4; ++k) out.nodes.push_back({cell[k], cell[(k + 1) % 4], centre});
  });
  return out;
}

// Where the field, linear on each triangle, has this value; closed lines end in their first point.
std::vector<std::vector<Point>> contour(const Triangles& t, double value) {
  std::map<std::pair<int, int>, int> numbers;  // of crossings, by the sides of triangles that they are on
  std::vector<Point> points;
  std::vector<int> edges;
  for (const std::array<int, 3>& nodes : t.nodes) {
    std::vector<int> ends;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [i, j] = std::minmax(nodes[c], nodes[(c + 1) % 3]);
      if ((t.values[i] > value) == (t.values[j] > value)) continue;
      const auto [found, fresh] = numbers.try_emplace({i, j}, static_cast<int>(points.size()));
      if (fresh) points.push_back(part_way(t.at[i], t.at[j], (value - t.values[i]) / (t.values[j] - t.values[i])));
      ends.push_back(found->second);
    }
    if (ends.size() == 2 && ends[0] != ends[1]) edges.insert(edges.end(), ends.begin(), ends.end());
  }
  std::vector<std::vector<Point>> out;
  for (const std::vector<int>& chain : chains(edges)) {
    out.emplace_back();
    for (const int i : chain) out.back().push_back(points[i]);
  }
  return out;
}

// Labels in places on their lines that are free, and clear of each other.
class Labels {
public:
  Labels(Stage& stage, const std::function<bool(const Box&)>& free) : stage_(stage), free_(free) {}

  void add(const std::vector<Point>& line, const std::string& text) {
    std::vector<double> way{0};
    for (std::size_t i = 1; i < line.size(); ++i) way.push_back(way.back() + length(line[i] - line[i - 1]));
    const double em = stage_.em, size = small_text * em;
    const Point extent = text_extent(text, size);
    if (way.back() < 2.5 * extent.x + 2 * em) return;
    for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9}) {
      const std::size_t i = std::lower_bound(way.begin(), way.end(), share * way.back()) - way.begin();
      const Point at = line[std::min(i, line.size() - 1)];
      const Box box = Box::about(at, extent).grown(0.35 * em);
      if (!stage_.shows(at, 0.5 * extent.x) || !free_(box) || std::ranges::any_of(taken_, [&](const Box& other) { return box.overlaps(other); })) continue;
      taken_.push_back(box);
      return stage_.over.text(at, text, {.size = size, .across = Align::middle, .up = Align::middle, .halo = true});
    }
  }

private:
  Stage& stage_;
  const std::function<bool(const Box&)>& free_;
  std::vector<Box> taken_;
};

double brightness(Colour c) { return (0.3 * c.r + 0.59 * c.g + 0.11 * c.b) / 255; }

// Clear of the outlines of bodies.
bool clear_of_outlines(const Stage& stage, const Box& box) {
  for (const BodyPicture& body : stage.picture.bodies)
    for (const auto& [a, b] : pairs(outline_edges(body)))
      if (Point p = stage.at(body, a, stage.picture.deformation), q = stage.at(body, b, stage.picture.deformation); crop(p, q, box)) return false;
  return true;
}

}  // namespace

Layer trajectory_layer() { return {2.5, draw_trajectories, trajectory_legend}; }

void draw_isolines(Stage& stage, const std::function<bool(const Box&)>& free) {
  if (!stage.scale.shown) return;
  Labels labels(stage, free);
  for (const BodyPicture& body : stage.picture.bodies) {
    if (body.values.empty()) continue;
    const Triangles triangles = triangles_of(stage, body);
    Bounds bounds;
    for (const Point& p : triangles.at) bounds.add(p);
    const std::vector<Tick> ticks = bar_ticks(stage.scale).ticks;
    // So many from the rim to the middle leave no colour between them.
    const bool fuse = 0.5 * std::min(bounds.width(), bounds.height()) < 0.3 * stage.em * static_cast<double>(ticks.size());
    for (const Tick& tick : ticks) {
      if (fuse && tick.label.empty()) continue;
      if (tick.value <= stage.scale.least || tick.value >= stage.scale.greatest) continue;  // a field ends there, it does not pass
      const Colour colour = brightness(stage.scale.at(tick.value)) < 0.35 ? Colour{225, 225, 225} : Colour{55, 55, 55};
      for (const std::vector<Point>& line : contour(triangles, tick.value)) {
        stage.over.polyline(line, std::max(0.8, stage.em / (tick.label.empty() ? 40 : 22)), colour);
        if (!tick.label.empty()) labels.add(line, tick.label);
      }
    }
  }
}

Layer isoline_layer() {
  return {2, [](Stage& stage, vtkRenderer*) {
            if (stage.picture.isolines) draw_isolines(stage, [&](const Box& box) { return clear_of_outlines(stage, box); });
          }};
}

}  // namespace dotyk::figure

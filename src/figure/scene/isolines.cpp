// Lines of equal values of the field of a scene in the plane, with their values.
#include <map>

#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

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

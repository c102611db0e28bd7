#include "figure/canvas/canvas.hpp"

#include <numbers>

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLPolyDataMapper2D.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

namespace dotyk::figure {

namespace {

// Paints in order, whatever has been painted there: the mapper of VTK tests
// depth, and of triangles in one plane keeps the first.
class PaintingMapper : public vtkOpenGLPolyDataMapper2D {
public:
  static PaintingMapper* New();
  vtkTypeMacro(PaintingMapper, vtkOpenGLPolyDataMapper2D);
  void RenderOverlay(vtkViewport* viewport, vtkActor2D* actor) override {
    constexpr unsigned int depth_test = 0x0B71;  // GL_DEPTH_TEST
    auto* window = static_cast<vtkOpenGLRenderWindow*>(viewport->GetVTKWindow());
    window->GetState()->vtkglDisable(depth_test);
    vtkOpenGLPolyDataMapper2D::RenderOverlay(viewport, actor);
    window->GetState()->vtkglEnable(depth_test);
  }
};
vtkStandardNewMacro(PaintingMapper);

}  // namespace

Canvas::Canvas(const Sheet& sheet) {
  const double pixels = static_cast<double>(sheet.width) * sheet.height;
  const int side = std::max(sheet.width, sheet.height);
  factor_ = pixels <= 2e6 && side <= 5000 ? 3 : pixels <= 16e6 && side <= 8000 ? 2 : 1;
}

void Canvas::emit(Point p, Colour c, double opacity) {
  const auto alpha = static_cast<unsigned char>(std::lround(255 * std::clamp(opacity, 0.0, 1.0)));
  vertices_.push_back({static_cast<float>((origin_.x + p.x) * factor_), static_cast<float>((origin_.y + p.y) * factor_), {c.r, c.g, c.b, alpha}});
}

void Canvas::fan(std::span<const Point> corners, Colour colour, double opacity) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    emit(corners[0], colour, opacity);
    emit(corners[i - 1], colour, opacity);
    emit(corners[i], colour, opacity);
  }
}

void Canvas::convex(std::span<const Point> corners, Colour colour, double opacity) {
  for (const Point& p : corners)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
  const bool inside = !clipped_ || std::all_of(corners.begin(), corners.end(), [&](Point p) { return clip_.holds(p); });
  if (inside) return fan(corners, colour, opacity);
  const auto rest = cropped(std::vector<Point>(corners.begin(), corners.end()), clip_);
  if (rest.size() > 2) fan(rest, colour, opacity);
}

void Canvas::box(const Box& b, Colour colour, double opacity) { convex(b.corners(), colour, opacity); }

void Canvas::outline(const Box& b, double width, Colour colour) { polyline(b.corners(), width, colour, {}, true); }

void Canvas::line(Point p, Point q, double width, Colour colour, double opacity) {
  const double size = length(q - p);
  if (!(size > 0)) return;
  const Point n{-(q.y - p.y) / size * width / 2, (q.x - p.x) / size * width / 2};
  convex(std::array{p + n, p - n, q - n, q + n}, colour, opacity);
}

void Canvas::polyline(std::span<const Point> points, double width, Colour colour, std::span<const double> dash, bool closed) {
  // Points closer than a quarter of a pixel do not show.
  std::vector<Point> path;
  for (const Point& p : points)
    if (path.empty() || length(p - path.back()) > 0.25) path.push_back(p);
  if (!points.empty() && path.size() > 1) path.back() = points.back();
  if (closed && path.size() > 2) path.push_back(path.front());

  std::size_t turn_of = 0;
  double left = dash.empty() ? 0 : dash[0];
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Point p = path[i], q = path[i + 1];
    // What lies outside is neither drawn nor dashed: it may be very long.
    if (clipped_ && !crop(p, q, clip_.grown(width))) continue;
    if (dash.empty()) {
      line(p, q, width, colour);
      if (width > 1.2 && (i > 0 || closed)) disc(p, width / 2, colour);
      continue;
    }
    double rest = length(q - p);
    while (rest > 0) {
      const double step = std::min(left, rest);
      const Point end = part_way(p, q, step / rest);
      if (turn_of % 2 == 0) line(p, end, width, colour);
      p = end, rest -= step, left -= step;
      if (left <= 0) left = dash[++turn_of % dash.size()];
    }
  }
}

void Canvas::disc(Point centre, double radius, Colour colour) {
  const int n = std::clamp(static_cast<int>(4 * radius) + 6, 8, 64);
  std::vector<Point> corners;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    corners.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  convex(corners, colour);
}

void Canvas::marker(Marker kind, Point c, double size, Colour colour) {
  const Colour white{255, 255, 255};
  const double rim = std::max(0.8, size / 12), r = size / 2;
  const auto at = [&](double x, double y, double s) { return Point{c.x + s * x, c.y + s * y}; };
  const auto shape = [&](std::initializer_list<Point> corners, double grow) {
    for (const auto& [s, paint] : {std::pair{r * grow + rim * 1.3, white}, std::pair{r * grow, colour}}) {
      std::vector<Point> moved;
      for (const Point& p : corners) moved.push_back(at(p.x, p.y, s));
      convex(moved, paint);
    }
  };
  switch (kind) {
    case Marker::disc:
      disc(c, r + rim, white);
      disc(c, r, colour);
      break;
    case Marker::ring:
      disc(c, r + rim, white);
      disc(c, r, colour);
      disc(c, r - std::max(1.2, size / 5), white);
      break;
    case Marker::square: shape({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.88); break;
    case Marker::triangle: shape({{-0.95, -0.6}, {0.95, -0.6}, {0, 1.05}}, 1.12); break;
    case Marker::down_triangle: shape({{0, -1.05}, {0.95, 0.6}, {-0.95, 0.6}}, 1.12); break;
    case Marker::diamond: shape({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}, 1.2); break;
    case Marker::plus:
    case Marker::cross: {
      const double d = kind == Marker::plus ? 0 : std::numbers::pi / 4;
      for (const auto& [w, paint, l] : {std::tuple{size / 3.2 + 2 * rim, white, r * 1.1 + rim}, std::tuple{size / 3.2, colour, r * 1.1}})
        for (const double a : {d, d + std::numbers::pi / 2})
          line({c.x - l * std::cos(a), c.y - l * std::sin(a)}, {c.x + l * std::cos(a), c.y + l * std::sin(a)}, w, paint);
      break;
    }
  }
}

Marker status_marker(Status status) {
  switch (status) {
    case Status::open: return Marker::ring;
    case Status::closed: return Marker::disc;
    case Status::stick: return Marker::square;
    case Status::slip: return Marker::triangle;
  }
  return Marker::disc;
}

void Canvas::crossed_marker(Marker kind, Point c, double size, Colour colour) {
  const auto pale = [](unsigned char value) { return static_cast<unsigned char>(255 - (255 - value) / 3); };
  marker(kind, c, 1.2 * size, {pale(colour.r), pale(colour.g), pale(colour.b)});
  const double arm = 0.55 * size;
  for (const double side : {-1.0, 1.0}) line({c.x - arm, c.y - side * arm}, {c.x + arm, c.y + side * arm}, 0.16 * size, colour);
}

void Canvas::arrow(Point tail, Point head, double width, double head_length, Colour colour, double rim) {
  const double size = length(head - tail);
  if (!(size > 0)) return;
  const double tip = std::min(head_length, 0.7 * size), half = 0.38 * tip;
  const Point d{(head.x - tail.x) / size, (head.y - tail.y) / size}, across{-d.y, d.x}, neck = head - tip * d;
  if (rim > 0) {
    const Colour white{255, 255, 255};
    const double grown = (half + rim) / half * half;
    line(tail - rim * d, neck, width + 2 * rim, white);
    convex(std::array{neck - rim * d + grown * across, neck - rim * d - grown * across, head + 2 * rim * d}, white);
  }
  line(tail, head - 0.9 * tip * d, width, colour);
  convex(std::array{neck + half * across, neck - half * across, head}, colour);
}

void Canvas::add_to(vtkRenderer* renderer) const {
  if (vertices_.empty()) return;
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colours;
  vtkNew<vtkCellArray> triangles;
  colours->SetNumberOfComponents(4);
  for (const Vertex& v : vertices_) {
    const vtkIdType i = points->InsertNextPoint(v.x, v.y, 0);
    colours->InsertNextTypedTuple(v.rgba);
    if (i % 3 == 2) triangles->InsertNextCell({i - 2, i - 1, i});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  data->GetPointData()->SetScalars(colours);
  vtkNew<PaintingMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer->AddViewProp(actor);
}

void write_canvas(const Canvas& canvas, const Sheet& sheet) {
  vtkNew<vtkRenderer> renderer;
  canvas.add_to(renderer);
  write_picture(sheet, std::array{renderer.Get()}, canvas);
}

}  // namespace dotyk::figure

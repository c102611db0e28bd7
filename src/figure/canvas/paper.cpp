// Canvases on paper by cairo.
#include "figure/canvas/paper.hpp"

#include <cairo-pdf.h>

#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "figure/canvas/font.hpp"

namespace dotyk::figure {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Surface owned(cairo_surface_t* surface) { return {surface, cairo_surface_destroy}; }

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status, const Sheet& sheet) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error("cannot draw " + sheet.file + ": " + cairo_status_to_string(status));
}

// In the pixels of the sheet, y downwards from here on.
class Painter {
public:
  // Of pixels horizontal and vertical lines are moved so that they cover whole ones.
  Painter(cairo_t* cr, const Sheet& sheet) : cr_(cr), height_(sheet.height), least_(least_letters * letters(sheet)), crisp_(!vector_graphics(sheet)) {}

  void paint(const Canvas& canvas) {
    for (const Mark& mark : canvas.marks()) paint(mark);
    for (const PlacedText& text : canvas.texts()) paint(text);
  }

private:
  void ink(Colour c, double opacity) { cairo_set_source_rgba(cr_, c.r / 255.0, c.g / 255.0, c.b / 255.0, opacity); }

  void paint(const Mark& mark) {
    ink(mark.colour, mark.opacity);
    cairo_new_path(cr_);
    if (mark.kind == Mark::Kind::disc) {
      cairo_arc(cr_, mark.points[0].x, height_ - mark.points[0].y, mark.width, 0, 2 * std::numbers::pi);
      return cairo_fill(cr_);
    }
    const bool snapped = crisp_ && mark.kind == Mark::Kind::line && along_axes(mark.points);
    const double width = snapped ? std::max(1.0, std::round(mark.width)) : mark.width;
    const auto place = [&](double pixel) { return snapped ? std::round(pixel - width / 2) + width / 2 : pixel; };
    for (const Point& p : mark.points) cairo_line_to(cr_, place(p.x), place(height_ - p.y));
    if (mark.kind == Mark::Kind::polygon || mark.closed) cairo_close_path(cr_);
    if (mark.kind == Mark::Kind::polygon) return cairo_fill(cr_);
    cairo_set_line_width(cr_, width);
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cr_, mark.dash.data(), static_cast<int>(mark.dash.size()), 0);
    cairo_stroke(cr_);
  }

  static bool along_axes(const std::vector<Point>& points) {
    return std::adjacent_find(points.begin(), points.end(), [](Point p, Point q) { return p.x != q.x && p.y != q.y; }) == points.end();
  }

  void paint(const PlacedText& text) {
    const TextStyle& style = text.style;
    cairo_save(cr_);
    const Point start = baseline(text);
    cairo_translate(cr_, start.x, height_ - start.y);
    if (style.upright) cairo_rotate(cr_, -std::numbers::pi / 2);
    const std::vector<TextRun> runs = text_runs(text.text, style.size, style.bold, least_);
    const auto each = [&](auto put) {
      for (const TextRun& run : runs) {
        set_font(cr_, run.size, style.bold);
        cairo_move_to(cr_, run.start.x, -run.start.y);
        put(cr_, run.text.c_str());
      }
    };
    if (style.halo) {
      each(cairo_text_path);
      ink({255, 255, 255}, 1);
      cairo_set_line_width(cr_, 2 * halo_width(style.size));
      cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
      cairo_set_dash(cr_, nullptr, 0, 0);
      cairo_stroke(cr_);
    }
    ink(style.colour, 1);
    each(cairo_show_text);
    cairo_restore(cr_);
  }

  cairo_t* cr_;
  double height_, least_;  // of letters
  bool crisp_;
};

// Cairo's pixels: blue, green, red, opacity.
Surface surface_of(Image& image) {
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) std::swap(image.rgba[i], image.rgba[i + 2]);
  return owned(cairo_image_surface_create_for_data(image.rgba.data(), CAIRO_FORMAT_ARGB32, image.width, image.height, 4 * image.width));
}

std::string png(cairo_surface_t* surface, const Sheet& sheet) {
  std::string bytes;
  require(cairo_surface_write_to_png_stream(surface, append, &bytes), sheet);
  return bytes;
}

// The mean of each block of pixels that is one of the sheet, where it covers so many of these across.
Image reduced(const Image& fine, int width) {
  const int factor = fine.width / width, height = fine.height / factor;
  if (factor == 1) return fine;
  const auto n = static_cast<std::size_t>(width);
  Image out{width, height, std::vector<unsigned char>(4 * n * height)};
  std::vector<unsigned> sums(4 * n);
  const unsigned count = factor * factor;
  for (int y = 0; y < height; ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    for (int dy = 0; dy < factor; ++dy) {
      const unsigned char* row = &fine.rgba[4 * n * factor * (static_cast<std::size_t>(y) * factor + dy)];
      for (std::size_t x = 0; x < n; ++x)
        for (int dx = 0; dx < factor; ++dx, row += 4)
          for (int c = 0; c < 4; ++c) sums[4 * x + c] += row[c];
    }
    for (std::size_t k = 0; k < 4 * n; ++k) out.rgba[4 * n * y + k] = static_cast<unsigned char>((sums[k] + count / 2) / count);
  }
  return out;
}

void paint(cairo_t* cr, const Sheet& sheet, const std::vector<Painted>& parts) {
  const bool pixels = !vector_graphics(sheet);
  Painter painter(cr, sheet);
  for (const Painted& part : parts) {
    painter.paint(part.under);
    if (!part.image.rgba.empty()) {
      Image image = pixels ? reduced(part.image, static_cast<int>(part.place.width())) : part.image;
      const double shrunk = part.place.width() / image.width;
      const Surface source = surface_of(image);
      cairo_save(cr);
      cairo_translate(cr, part.place.left, sheet.height - part.place.top);
      cairo_scale(cr, shrunk, shrunk);
      cairo_set_source_surface(cr, source.get(), 0, 0);
      cairo_paint(cr);
      cairo_restore(cr);
    }
    painter.paint(part.over);
  }
}

std::string as_png(const Sheet& sheet, const std::vector<Painted>& parts) {
  const Surface surface = owned(cairo_image_surface_create(CAIRO_FORMAT_RGB24, sheet.width, sheet.height));
  const Context cr(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(cr.get(), 1, 1, 1);
  cairo_paint(cr.get());
  paint(cr.get(), sheet, parts);
  require(cairo_status(cr.get()), sheet);
  return png(surface.get(), sheet);
}

std::string as_pdf(const Sheet& sheet, const std::vector<Painted>& parts) {
  std::string bytes;
  {
    const double shrunk = points_per_pixel(sheet);
    const Surface surface = owned(cairo_pdf_surface_create_for_stream(append, &bytes, shrunk * sheet.width, shrunk * sheet.height));
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00");  // equal pictures give equal bytes
    const Context cr(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(cr.get(), shrunk, shrunk);
    paint(cr.get(), sheet, parts);
    cairo_show_page(cr.get());
    require(cairo_status(cr.get()), sheet);
    cairo_surface_finish(surface.get());
    require(cairo_surface_status(surface.get()), sheet);
  }
  return bytes;
}

std::string as_svg(const Sheet& sheet, const std::vector<Painted>& parts) {
  return svg(sheet, parts, [&](Image image) { return png(surface_of(image).get(), sheet); });
}

// SVG is written here: cairo would make outlines of its texts. XML has no control characters.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) c == '&' ? out += "&amp;" : c == '<' ? out += "&lt;" : out += c >= 0 && c < ' ' ? ' ' : c;
  return out;
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < there ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) out += k <= there ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

class Svg {
public:
  explicit Svg(const Sheet& sheet) : height_(sheet.height), least_(least_letters * letters(sheet)) {
    const double points = points_per_pixel(sheet);
    out_.precision(7);
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << points * sheet.width << "pt\" height=\""
         << points * sheet.height << "pt\" viewBox=\"0 0 " << sheet.width << ' ' << sheet.height << "\" font-family=\"" << font_family << "\">\n";
  }

  void draw(const Canvas& canvas) {
    for (const Mark& mark : canvas.marks()) draw(mark);
    for (const PlacedText& text : canvas.texts()) draw(text);
  }
  void draw(const Box& place, const std::string& png) {
    out_ << "<image x=\"" << place.left << "\" y=\"" << height_ - place.top << "\" width=\"" << place.width() << "\" height=\"" << place.height()
         << "\" href=\"data:image/png;base64," << base64(png) << "\"/>\n";
  }
  std::string finish() {
    out_ << "</svg>\n";
    return out_.str();
  }

private:
  static std::string name(Colour c) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", c.r, c.g, c.b);
    return text;
  }
  // A number as text, rounded to a hundredth of a pixel.
  static std::string number(double value) { return text(std::round(100 * value) / 100); }

  void draw(const Mark& mark) {
    const std::string opacity = mark.opacity < 1 ? "-opacity=\"" + number(mark.opacity) + "\"" : "";
    if (mark.kind == Mark::Kind::disc) {
      out_ << "<circle cx=\"" << number(mark.points[0].x) << "\" cy=\"" << number(height_ - mark.points[0].y) << "\" r=\"" << number(mark.width) << "\" fill=\""
           << name(mark.colour) << "\"/>\n";
      return;
    }
    const bool filled = mark.kind == Mark::Kind::polygon;
    out_ << (filled || mark.closed ? "<polygon points=\"" : "<polyline points=\"");
    for (const Point& p : mark.points) out_ << number(p.x) << ',' << number(height_ - p.y) << ' ';
    out_ << "\" fill=\"" << (filled ? name(mark.colour) : "none") << '"';
    if (!opacity.empty()) out_ << (filled ? " fill" : " stroke") << opacity;
    if (!filled) out_ << " stroke=\"" << name(mark.colour) << "\" stroke-width=\"" << number(mark.width) << "\" stroke-linejoin=\"round\"";
    if (!mark.dash.empty()) {
      out_ << " stroke-dasharray=\"";
      for (const double d : mark.dash) out_ << number(d) << ' ';
      out_ << '"';
    }
    out_ << "/>\n";
  }

  void draw(const PlacedText& text) {
    const Point at = baseline(text);
    const TextStyle& style = text.style;
    out_ << "<text transform=\"translate(" << number(at.x) << ' ' << number(height_ - at.y) << ')' << (style.upright ? " rotate(-90)" : "") << "\" font-size=\""
         << number(style.size) << "\" fill=\"" << name(style.colour) << "\" xml:space=\"preserve\"";
    if (style.bold) out_ << " font-weight=\"bold\"";
    if (style.halo) out_ << " stroke=\"#ffffff\" stroke-width=\"" << number(2 * halo_width(style.size)) << "\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
    out_ << '>';
    for (const TextRun& run : text_runs(text.text, style.size, style.bold, least_))
      out_ << "<tspan x=\"" << number(run.start.x) << "\" y=\"" << number(0 - run.start.y) << "\" font-size=\"" << number(run.size) << "\">" << escaped(run.text) << "</tspan>";
    out_ << "</text>\n";
  }

  std::ostringstream out_;
  double height_, least_;  // of letters
};

}  // namespace

int image_factor(const Sheet& sheet) {
  const double pixels = static_cast<double>(sheet.width) * sheet.height;
  const int side = std::max(sheet.width, sheet.height), most = pixels <= 2e6 && side <= 5000 ? 3 : pixels <= 16e6 && side <= 8000 ? 2 : 1;
  if (!vector_graphics(sheet)) return most;
  constexpr double kDots = 600, kInch = 72;
  return std::clamp(static_cast<int>(std::ceil(kDots / kInch * points_per_pixel(sheet) - 0.05)), 1, most);
}

void write_picture(const Sheet& sheet, const std::vector<Painted>& parts) {
  write_whole_file(sheet.file, sheet.file.ends_with(".pdf") ? as_pdf(sheet, parts) : sheet.file.ends_with(".svg") ? as_svg(sheet, parts) : as_png(sheet, parts));
}

void write_canvas(Canvas canvas, const Sheet& sheet) { write_picture(sheet, {{{}, {}, {}, std::move(canvas)}}); }

std::string svg(const Sheet& sheet, const std::vector<Painted>& parts, const std::function<std::string(const Image&)>& png) {
  Svg out(sheet);
  for (const Painted& part : parts) {
    out.draw(part.under);
    if (!part.image.rgba.empty()) out.draw(part.place, png(part.image));
    out.draw(part.over);
  }
  return out.finish();
}

}  // namespace dotyk::figure

// SVG. Cairo would make outlines of its texts.
#include <sstream>

#include "base/text.hpp"
#include "figure/canvas/font.hpp"
#include "figure/canvas/paper.hpp"

namespace dotyk::figure {

namespace {

// XML has no control characters.
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

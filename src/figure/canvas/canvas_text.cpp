// Texts of a Canvas: FreeType by way of VTK, blended onto the finished image
// at its own resolution, which keeps small letters sharp.
#include <unistd.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

namespace {

constexpr int dots_per_inch = 72;  // a font size is then in pixels

// DejaVu has the Greek letters and signs of mechanics; VTK's own Arial is
// the fallback.
const char* font_file(bool bold) {
  static const char* const regular = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  static const char* const heavy = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  const char* file = bold ? heavy : regular;
  return access(file, R_OK) == 0 ? file : nullptr;
}

vtkSmartPointer<vtkTextProperty> property(double size, bool bold, bool upright) {
  auto p = vtkSmartPointer<vtkTextProperty>::New();
  if (const char* file = font_file(bold)) {
    p->SetFontFamily(VTK_FONT_FILE);
    p->SetFontFile(file);
  } else {
    p->SetFontFamilyToArial();
    p->SetBold(bold);
  }
  p->SetFontSize(std::max(4, static_cast<int>(std::lround(size))));
  p->SetColor(1, 1, 1);
  p->SetOrientation(upright ? 90 : 0);
  return p;
}

struct Mask {
  int width = 0, height = 0;
  std::vector<unsigned char> alpha;
};

Mask render(const std::string& text, const TextStyle& style) {
  const vtkSmartPointer<vtkTextProperty> p = property(style.size, style.bold, style.upright);
  vtkNew<vtkImageData> data;
  int extent[2] = {0, 0};
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (!renderer) return {};
  renderer->SetScaleToPowerOfTwo(false);
  if (!renderer->RenderString(p.Get(), vtkStdString(text), data.Get(), extent, dots_per_inch, vtkTextRenderer::FreeType)) return {};
  int dims[3];
  data->GetDimensions(dims);
  Mask mask{dims[0], dims[1], {}};
  const auto* pixels = static_cast<const unsigned char*>(data->GetScalarPointer());
  const int components = data->GetNumberOfScalarComponents();
  mask.alpha.resize(static_cast<std::size_t>(dims[0]) * dims[1]);
  for (std::size_t i = 0; i < mask.alpha.size(); ++i) mask.alpha[i] = pixels[components * i + components - 1];
  return mask;
}

void blend(Image& image, const Mask& mask, int left, int bottom, Colour colour) {
  for (int y = std::max(0, -bottom); y < mask.height && bottom + y < image.height; ++y)
    for (int x = std::max(0, -left); x < mask.width && left + x < image.width; ++x) {
      const int a = mask.alpha[static_cast<std::size_t>(y) * mask.width + x];
      if (a == 0) continue;
      unsigned char* pixel = &image.rgb[3 * (static_cast<std::size_t>(bottom + y) * image.width + left + x)];
      const int c[3] = {colour.r, colour.g, colour.b};
      for (int k = 0; k < 3; ++k) pixel[k] = static_cast<unsigned char>((c[k] * a + pixel[k] * (255 - a) + 127) / 255);
    }
}

// The mask grown by `radius` pixels each way.
Mask grown(const Mask& mask, int radius) {
  Mask out{mask.width + 2 * radius, mask.height + 2 * radius, {}};
  out.alpha.resize(static_cast<std::size_t>(out.width) * out.height);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      const unsigned char a = mask.alpha[static_cast<std::size_t>(y) * mask.width + x];
      if (a == 0) continue;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
          if (dx * dx + dy * dy > radius * radius) continue;
          unsigned char& to = out.alpha[static_cast<std::size_t>(y + radius + dy) * out.width + x + radius + dx];
          to = std::max(to, a);
        }
    }
  return out;
}

double shift(Align align, int size) {
  return align == Align::low ? 0 : align == Align::middle ? -size / 2.0 : -size;
}

constexpr double line_height = 1.25;  // of the letters

// Where characters begin, and the end.
std::vector<std::size_t> boundaries(const std::string& text) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) out.push_back(i);
  out.push_back(text.size());
  return out;
}

// The longest beginning, of whole characters, that fits with `end` after it.
std::string beginning(const std::string& text, const std::string& end, double size, double pixels, bool bold) {
  const std::vector<std::size_t> at = boundaries(text);
  std::size_t fits = 0, over = at.size();
  while (over - fits > 1) {
    const std::size_t middle = (fits + over) / 2;
    (text_extent(text.substr(0, at[middle]) + end, size, bold).x <= pixels ? fits : over) = middle;
  }
  return text.substr(0, at[fits]);
}

}  // namespace

Point text_extent(const std::string& text, double size, bool bold) {
  if (text.empty()) return {0, 0};
  const vtkSmartPointer<vtkTextProperty> p = property(size, bold, false);
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  int box[4] = {0, 0, 0, 0};
  if (!renderer || !renderer->GetBoundingBox(p.Get(), vtkStdString(text), box, dots_per_inch, vtkTextRenderer::FreeType)) return {0, size};
  return {static_cast<double>(box[1] - box[0] + 1), static_cast<double>(box[3] - box[2] + 1)};
}

double fitting_size(const std::string& text, double size, double pixels, bool bold) {
  const double width = text_extent(text, size, bold).x;
  return width > pixels ? std::max(0.5 * size, size * pixels / width) : size;
}

std::string shortened(const std::string& text, double size, double pixels, bool bold) {
  if (text_extent(text, size, bold).x <= pixels) return text;
  std::string out = beginning(text, "…", size, pixels, bold);
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out + "…";
}

FittedText fitted(const std::string& text, double size, double pixels, bool bold, const std::string& end) {
  const double smaller = fitting_size(text + end, size, pixels, bold);
  // Letters are of whole pixels, so the smaller text may be a little wider; its place has a margin.
  if (text_extent(text + end, smaller, bold).x <= pixels + 0.5 * size) return {smaller, {text + end}};
  std::string first = beginning(text, "", smaller, pixels, bold);
  const std::size_t space = text.find_last_of(" \n", first.size());
  if (space != std::string::npos && space > 0) first.resize(space);
  const std::size_t rest = std::min(text.find_first_not_of(" \n", first.size()), text.size());
  return {smaller, {first, shortened(text.substr(rest), smaller, pixels - text_extent(end, smaller, bold).x, bold) + end}};
}

TextStyle title_style() { return {.across = Align::middle, .up = Align::high, .bold = true}; }

double FittedText::depth() const { return static_cast<double>(lines.size() - 1) * line_height * size; }

void Canvas::text(Point at, const std::string& text, const TextStyle& style) {
  if (!text.empty()) texts_.push_back({{origin_.x + at.x, origin_.y + at.y}, text, style});
}

void Canvas::text(Point first, const FittedText& lines, TextStyle style) {
  style.size = lines.size;
  for (const std::string& line : lines.lines) {
    text(first, line, style);
    (style.upright ? first.x : first.y) += (style.upright ? 1 : -1) * line_height * lines.size;
  }
}

void Canvas::set_texts(Image& image) const {
  for (const Text& t : texts_) {
    const Mask mask = render(t.text, t.style);
    // Along an upright text "across" and "up" are those of the page.
    const int left = static_cast<int>(std::lround(t.at.x + shift(t.style.across, mask.width)));
    const int bottom = static_cast<int>(std::lround(t.at.y + shift(t.style.up, mask.height)));
    if (t.style.halo) {
      const int radius = std::max(1, static_cast<int>(std::lround(t.style.size / 9)));
      blend(image, grown(mask, radius), left - radius, bottom - radius, {255, 255, 255});
    }
    blend(image, mask, left, bottom, t.style.colour);
  }
}

}  // namespace dotyk::figure

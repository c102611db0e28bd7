#include "pixels.hpp"

#include <png.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

using dotyk::figure::Colour;

Colour Pixels::at(int x, int y) const {
  if (x < 0 || y < 0 || x >= width || y >= height) return {255, 255, 255};
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

int Pixels::count(Colour c, int tolerance) const {
  int n = 0;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    n += std::abs(rgb[i] - c.r) <= tolerance && std::abs(rgb[i + 1] - c.g) <= tolerance && std::abs(rgb[i + 2] - c.b) <= tolerance;
  return n;
}

Pixels read_png(const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, file.c_str())) throw std::runtime_error(file + ": " + image.message);
  image.format = PNG_FORMAT_RGB;
  Pixels out{static_cast<int>(image.width), static_cast<int>(image.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
  if (!png_image_finish_read(&image, nullptr, out.rgb.data(), 0, nullptr)) throw std::runtime_error(file + ": " + image.message);
  return out;
}

Difference greatest_difference(const Pixels& a, const Pixels& b) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("pictures of different sizes");
  constexpr int n = Difference::kWindow;
  const auto row = 3 * static_cast<std::size_t>(a.width);
  Difference greatest;
  std::vector<int> of_rows(row, 0);  // the differences, summed over the window's rows
  const auto add = [&](int y, int sign) {
    for (std::size_t k = 0, i = static_cast<std::size_t>(y) * row; k < row; ++k, ++i) of_rows[k] += sign * (a.rgb[i] - b.rgb[i]);
  };
  for (int y = 0; y < a.height; ++y) {
    add(y, 1);
    if (y >= n) add(y - n, -1);
    for (std::size_t colour = 0; y >= n - 1 && colour < 3; ++colour) {
      int sum = 0;
      for (int x = 0; x < a.width; ++x) {
        sum += of_rows[3 * static_cast<std::size_t>(x) + colour];
        if (x >= n) sum -= of_rows[3 * static_cast<std::size_t>(x - n) + colour];
        const double levels = std::abs(sum) / static_cast<double>(n * n);
        if (x >= n - 1 && levels > greatest.levels) greatest = {levels, x - n + 1, y - n + 1};
      }
    }
  }
  return greatest;
}

bool exists(const std::string& file) { return std::ifstream(file).good(); }

bool near(Colour a, Colour b, int tolerance) {
  return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance && std::abs(a.b - b.b) <= tolerance;
}

bool drawn_at(const Pixels& p, const Frame& f, double x, double y, Colour colour) {
  const int px = static_cast<int>(std::lround(f.left + x * (f.right - f.left))), py = static_cast<int>(std::lround(f.bottom - y * (f.bottom - f.top)));
  for (int dy = -3; dy <= 3; ++dy)
    for (int dx = -3; dx <= 3; ++dx)
      if (near(p.at(px + dx, py + dy), colour)) return true;
  return false;
}

bool white_rim(const Pixels& p) {
  const Colour white{255, 255, 255};
  const int right = p.width - 1, bottom = p.height - 1;
  return p.at(0, 0) == white && p.at(right, 0) == white && p.at(0, bottom) == white && p.at(right, bottom) == white &&
         p.at(0, bottom / 2) == white && p.at(right, bottom / 2) == white;
}

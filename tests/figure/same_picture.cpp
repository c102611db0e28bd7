// same_picture A.png B.png: ends with 0 where the pictures show the same, else says how they differ and ends with 1.
//
// Rasterisers differ along edges, by a part of what an edge's pixel covers: pixels that differ by more than kLevels of 255 in
// a colour count, and at most one in kShare may. A number, a marker or an arrow that is not the same makes more.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "pixels.hpp"

constexpr int kLevels = 100;
constexpr std::size_t kShare = 10000;

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: same_picture A.png B.png\n"), 2;
  const Pixels a = read_png(argv[1]), b = read_png(argv[2]);
  if (a.width != b.width || a.height != b.height)
    return std::printf("%s: %d x %d pixels, %s: %d x %d\n", argv[1], a.width, a.height, argv[2], b.width, b.height), 1;
  std::size_t differ = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    bool far = false;
    for (std::size_t k = i; k < i + 3; ++k) far = far || std::abs(a.rgb[k] - b.rgb[k]) > kLevels;
    differ += far;
  }
  const std::size_t all = a.rgb.size() / 3;
  if (differ * kShare <= all) return 0;
  std::printf("%s and %s: %zu of %zu pixels differ by more than %d levels\n", argv[1], argv[2], differ, all, kLevels);
  return 1;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "same_picture: %s\n", e.what()), 2;
}

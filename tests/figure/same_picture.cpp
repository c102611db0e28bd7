// same_picture A.png B.png: ends with 0 where the pictures show the same, else says where they differ and ends with 1.
#include <cstdio>
#include <exception>

#include "pixels.hpp"

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: same_picture A.png B.png\n"), 2;
  const Pixels a = read_png(argv[1]), b = read_png(argv[2]);
  if (a.width != b.width || a.height != b.height)
    return std::printf("%s: %d x %d pixels, %s: %d x %d\n", argv[1], a.width, a.height, argv[2], b.width, b.height), 1;
  const Difference d = greatest_difference(a, b);
  if (d.levels <= Difference::kSame) return 0;
  std::printf("%s and %s: from pixel (%d, %d) the mean colour of %d x %d pixels differs by %.1f of 255 levels\n", argv[1], argv[2], d.x, d.y,
              Difference::kWindow, Difference::kWindow, d.levels);
  return 1;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "same_picture: %s\n", e.what()), 2;
}

// Pixels, and how they become a file.
#pragma once

#include <string>
#include <vector>

namespace dotyk::figure {

struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // 3 width height, lowest row first
};

// How many times finer than the picture to render, for smooth edges; less for
// very large pictures.
int oversampling(int width, int height);

// The mean of each `factor` x `factor` block of an image that is `factor`
// times too large each way.
Image reduce(const std::vector<unsigned char>& fine, int width, int height, int factor);

// Writes a PNG, whole or not at all: beside the target first, then renamed.
// Throws std::runtime_error with path and reason.
void write_png(const Image& image, const std::string& file);

}  // namespace dotyk::figure

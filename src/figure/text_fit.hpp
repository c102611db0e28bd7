// Texts that are longer than their place.
#pragma once

#include <string>
#include <vector>

namespace dotyk::figure {

// The text, or its beginning and "…", no wider than so many pixels.
std::string shortened(const std::string& text, double size, double pixels, bool bold = false);

struct FittedText {
  double size = 20;  // of the letters, pixels
  std::vector<std::string> lines;
};

// In one line of letters down to half of `size`; else in two lines of these, broken between words, the second
// shortened where that does not suffice either. `end` stays whatever is left out before it.
FittedText fitted(const std::string& text, double size, double pixels, bool bold = false, const std::string& end = "");

}  // namespace dotyk::figure

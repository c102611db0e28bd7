#pragma once

#include <sstream>
#include <string>

namespace dotyk {

/// The arguments written one after the other, numbers with six digits; for messages.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

/// "(0.5, 1)" or "(0.5, 1, 0)": a point in a message.
inline std::string point_text(const double* x, int dimension) {
  std::string out = "(";
  for (int i = 0; i < dimension; ++i) out += (i ? ", " : "") + text(x[i]);
  return out + ")";
}

}  // namespace dotyk

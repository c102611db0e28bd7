// What the checks of several kinds of pictures share.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "base/text.hpp"
#include "figure/door/picture.hpp"

namespace dotyk::figure {

template <class... Parts>
void require(bool holds, const Parts&... message) {
  if (!holds) throw std::runtime_error(text(message...));
}

inline bool finite(double value) { return std::isfinite(value); }
inline bool finite(std::span<const double> values) { return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }); }
template <class First, class... Rest>
bool finite(const First& first, const Rest&... rest) requires(sizeof...(Rest) > 0) { return finite(first) && (finite(rest) && ...); }

// Of every text that is drawn; `key` is what scripts call it.
void check_text(const std::string& key, const std::string& words);
void check_sheet(const Sheet& sheet);

}  // namespace dotyk::figure

#pragma once

#include <string>
#include <string_view>

namespace dotyk {

/// A word of a file for a message: its first 40 bytes, those that are no printable ASCII as '?'.
inline std::string in_quotes(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + "'";
}

}  // namespace dotyk

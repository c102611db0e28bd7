#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace dotyk {

/// A word of a file for a message: its first 40 bytes, those that are no printable ASCII as '?'.
inline std::string in_quotes(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + "'";
}

/// "a, b and 2 more": the words one after the other, of more than `most` only the first ones.
inline std::string listed(const std::vector<std::string>& words, std::size_t most = std::string::npos) {
  std::string out;
  for (std::size_t k = 0; k < words.size() && k < most; ++k) out += (k ? ", " : "") + words[k];
  return words.size() > most ? text(out, " and ", words.size() - most, " more") : out;
}

}  // namespace dotyk

#include "script/help/nearest.hpp"

#include <algorithm>
#include <cctype>

namespace dotyk::script {
namespace {

bool same(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool begins(std::string_view whole, std::string_view start) {
  return start.size() >= 2 && start.size() <= whole.size() &&
         std::equal(start.begin(), start.end(), whole.begin(), same);
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const auto n = b.size() + 1;
  std::vector<int> before(n), last(n), row(n);
  for (std::size_t j = 0; j < n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < n; ++j) {
      const int replace = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({replace, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  int best_slips = 1 << 20;
  for (const auto& candidate : candidates) {
    const int slips = edit_distance(name, candidate);
    const int allowed = std::max(1, static_cast<int>(std::min(name.size(), candidate.size())) / 3);
    const bool single = name.size() < 2 || candidate.size() < 2;
    const bool near =
        (slips <= allowed && (!single || slips == 0)) || begins(candidate, name) || begins(name, candidate);
    if (near && slips < best_slips) {
      best = candidate;
      best_slips = slips;
    }
  }
  return best;
}

std::string join(const std::vector<std::string>& names, std::string_view last, std::string_view quote) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " " + std::string(last) + " " : ", ";
    text.append(quote).append(names[i]).append(quote);
  }
  return text;
}

std::string unknown_name(std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates) {
  auto text = "unknown " + std::string(what) + " '" + std::string(name) + "'";
  const auto near = nearest(name, candidates);
  if (!near.empty()) return text + ", did you mean '" + near + "'?";
  if (candidates.empty() || candidates.size() > 40) return text;
  return text + ", expected " + join(candidates);
}

}  // namespace dotyk::script

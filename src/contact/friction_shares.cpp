#include "contact/multipliers.hpp"

#include <algorithm>
#include <map>

namespace dotyk::contact {

std::vector<std::vector<int>> neighbours(const std::vector<ContactRow>& rows) {
  std::map<int, std::vector<int>> of_facet;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const int facet : rows[k].facets) of_facet[facet].push_back(static_cast<int>(k));
  std::vector<std::vector<int>> result(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (const int facet : rows[k].facets)
      for (const int other : of_facet[facet])
        if (other != static_cast<int>(k)) result[k].push_back(other);
    std::sort(result[k].begin(), result[k].end());
    result[k].erase(std::unique(result[k].begin(), result[k].end()), result[k].end());
  }
  return result;
}

std::vector<char> at_corners(const std::vector<ContactRow>& rows) {
  std::map<int, int> sides;
  for (const ContactRow& row : rows) ++sides[row.node];
  std::vector<char> result;
  for (const ContactRow& row : rows) result.push_back(sides[row.node] > 1);
  return result;
}

std::vector<char> at_ends(const std::vector<ContactRow>& rows) {
  std::vector<char> result;
  for (const ContactRow& row : rows) result.push_back(row.facets.size() == 1);
  return result;
}

std::vector<std::vector<Term>> friction_shares(const std::vector<ContactRow>& rows, const std::vector<char>& aside, const std::vector<char>& slides) {
  std::vector<std::vector<Term>> result(rows.size());
  std::vector<std::map<int, double>> bearers(rows.size());  // of each row, with their shares
  std::vector<int> open;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (aside[k]) open.push_back(static_cast<int>(k));
    else if (slides[k]) bearers[k] = {{static_cast<int>(k), 1}};
  const std::vector<std::vector<int>> next = open.empty() ? std::vector<std::vector<int>>() : neighbours(rows);
  while (!open.empty()) {  // outwards from the rows that bear, a ring of facets at a time
    std::map<int, std::map<int, double>> found;
    for (const int k : open) {
      const auto known = std::count_if(next[k].begin(), next[k].end(), [&](int j) { return !bearers[j].empty(); });
      for (const int j : next[k])
        for (const auto& [row, share] : bearers[j]) found[k][row] += share / static_cast<double>(known);
    }
    if (found.empty()) break;
    for (auto& [k, shares] : found) bearers[k] = std::move(shares);
    std::erase_if(open, [&](int k) { return !bearers[k].empty(); });
  }
  for (const int k : open) bearers[k] = {{k, 1}};
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!aside[k]) result[k].push_back({static_cast<int>(k), 1});
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const auto& [row, share] : bearers[k])
      if (aside[k]) result[row].push_back({static_cast<int>(k), share});
  return result;
}

}  // namespace dotyk::contact

#include "problem/subdomain.hpp"

#include <algorithm>

namespace dotyk::problem {

SubdomainCounts counts(const std::vector<Subdomain>& subdomains) {
  SubdomainCounts result;
  result.subdomains = static_cast<int>(subdomains.size());
  std::vector<char> seen;
  for (const Subdomain& s : subdomains) {
    result.least = &s == &subdomains.front() ? s.size() : std::min(result.least, s.size());
    result.greatest = std::max(result.greatest, s.size());
    for (const int u : s.unknown) {
      if (u < 0) {
        ++result.held;
        continue;
      }
      if (u >= static_cast<int>(seen.size())) seen.resize(u + 1, 0);
      result.gluing += seen[u];
      seen[u] = 1;
    }
  }
  return result;
}

}  // namespace dotyk::problem

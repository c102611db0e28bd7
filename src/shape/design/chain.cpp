#include "shape/design/chain.hpp"

#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::shape {
namespace {

[[noreturn]] void not_one(const scene::Part& part, const std::string& why) {
  throw InputError(text(part.label(), " ", why, "; a part that B-splines move must be one chain of edges"));
}

}  // namespace

Chain chain_of(const scene::Part& part) {
  const mesh::Mesh& mesh = *part.body->mesh;
  if (mesh.dimension() != 2) throw InputError(text(part.label(), " is a surface in space, not a chain of edges"));
  std::map<int, int> next, previous;
  for (const mesh::Facet f : part.facets) {
    const int a = mesh.facet_node(f, 0), b = mesh.facet_node(f, 1);
    if (!next.emplace(a, b).second || !previous.emplace(b, a).second)
      not_one(part, text("branches at ", point_text(mesh.node(next.count(a) ? a : b), 2)));
  }
  int first = mesh.facet_node(part.facets.front(), 0), begins = 0;
  for (const auto& [a, b] : next)
    if (!previous.count(a)) first = a, ++begins;
  if (begins > 1) not_one(part, text("falls into ", begins, " pieces"));
  Chain chain{{first}, {0.0}, 0, begins == 0};
  for (int at = first; next.count(at);) {
    const int to = next[at];
    chain.total += plane_distance(mesh.node(at), mesh.node(to));
    if (to == first) break;
    chain.nodes.push_back(to);
    chain.length.push_back(chain.total);
    at = to;
  }
  if (chain.nodes.size() + (chain.closed ? 0 : std::size_t(-1)) != next.size()) not_one(part, "falls into pieces");
  return chain;
}

}  // namespace dotyk::shape

#include "plate/chains.hpp"

#include <algorithm>
#include <map>

namespace dotyk::plate {

std::vector<std::vector<int>> node_chains(const Model& model, int number) {
  const Edges& edges = model.space.edges;
  std::map<int, int> next;   // node → edge that begins there
  std::map<int, int> ends;
  for (const mesh::Facet f : model.plate.edges[number].facets) {
    const int e = edges.of_cell[f.cell][f.local];
    next[edges.edges[e].node[0]] = e;
    ++ends[edges.edges[e].node[1]];
  }
  std::vector<std::vector<int>> out;
  while (!next.empty()) {
    auto start = std::find_if(next.begin(), next.end(), [&](const auto& n) { return ends.find(n.first) == ends.end(); });
    if (start == next.end())  // only closed lines are left: begin at a corner where there is one
      start = std::find_if(next.begin(), next.end(), [&](const auto& n) { return !model.space.boundary[n.first].smooth; });
    if (start == next.end()) start = next.begin();
    std::vector<int> nodes{start->first};
    for (auto at = start; at != next.end(); at = next.find(nodes.back())) {
      nodes.push_back(edges.edges[at->second].node[1]);
      next.erase(at);
    }
    for (const int n : nodes) ends.erase(n);
    out.push_back(std::move(nodes));
  }
  return out;
}

std::vector<std::vector<int>> row_chains(const Model& model, const std::vector<Sample>& samples) {
  std::map<std::pair<int, int>, int> at_vertex, at_middle;  // of support and place
  for (const Sample& s : samples)
    if (s.row >= 0) (s.at_vertex ? at_vertex : at_middle)[{s.support, s.place}] = s.row;
  std::map<std::pair<int, int>, int> edge;  // of its nodes
  for (std::size_t e = 0; e < model.space.edges.edges.size(); ++e)
    if (model.space.edges.edges[e].boundary) edge[{model.space.edges.edges[e].node[0], model.space.edges.edges[e].node[1]}] = static_cast<int>(e);
  std::vector<std::vector<int>> out;
  for (int support = 0; support < static_cast<int>(model.plate.edges.size()); ++support)
    for (const auto& nodes : node_chains(model, support)) {
      std::vector<int> rows;
      const auto add = [&](const auto& of, int place) {
        const auto found = of.find({support, place});
        if (found != of.end() && (rows.empty() || (rows.back() != found->second && rows.front() != found->second))) rows.push_back(found->second);
      };
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        add(at_vertex, nodes[i]);
        if (i + 1 < nodes.size()) add(at_middle, edge.at({nodes[i], nodes[i + 1]}));
      }
      if (rows.size() > 1) out.push_back(std::move(rows));
    }
  return out;
}

}  // namespace dotyk::plate

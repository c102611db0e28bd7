#include "plate/model.hpp"

#include <algorithm>
#include <map>

namespace dotyk::plate {

namespace {

/// The edges of a place in Plate::edges, line by line.
std::vector<std::vector<int>> edge_chains(const Model& model, int number) {
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
    std::vector<int>& line = out.emplace_back();
    ends.erase(start->first);
    for (auto at = start; at != next.end(); at = next.find(edges.edges[line.back()].node[1])) {
      line.push_back(at->second);
      ends.erase(edges.edges[at->second].node[1]);
      next.erase(at);
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<int>> node_chains(const Model& model, int number) {
  std::vector<std::vector<int>> out;
  for (const std::vector<int>& line : edge_chains(model, number)) {
    std::vector<int>& nodes = out.emplace_back(1, model.space.edges.edges[line.front()].node[0]);
    for (const int e : line) nodes.push_back(model.space.edges.edges[e].node[1]);
  }
  return out;
}

std::vector<std::vector<int>> row_chains(const Model& model, const std::vector<Sample>& samples) {
  std::map<std::pair<int, int>, int> at_vertex, at_middle;  // of support and place
  for (const Sample& s : samples)
    if (s.row >= 0) (s.at_vertex ? at_vertex : at_middle)[{s.support, s.place}] = s.row;
  std::vector<std::vector<int>> out;
  for (int support = 0; support < static_cast<int>(model.plate.edges.size()); ++support)
    for (const std::vector<int>& line : edge_chains(model, support)) {
      std::vector<int> rows;
      const auto add = [&](const auto& of, int place) {
        const auto found = of.find({support, place});
        if (found != of.end() && (rows.empty() || (rows.back() != found->second && rows.front() != found->second))) rows.push_back(found->second);
      };
      add(at_vertex, model.space.edges.edges[line.front()].node[0]);
      for (const int e : line) add(at_middle, e), add(at_vertex, model.space.edges.edges[e].node[1]);
      if (rows.size() > 1) out.push_back(std::move(rows));
    }
  return out;
}

}  // namespace dotyk::plate

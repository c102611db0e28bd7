#include <algorithm>
#include <cmath>
#include <map>

#include "contact/multipliers.hpp"

namespace dotyk::contact {
namespace {

using mesh::Box;
using mesh::Point;

class Cutter {
 public:
  Cutter(const std::vector<Piece>& pieces, double size) : pieces_(pieces), size_(size), cell_(pieces.size(), -1) {}

  /// Cuts what of these pieces lies in `within`.
  void cut(const std::vector<int>& list, const Box& within) {
    const Box box = around(list, within);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (box.extent(i) > (1 + 1e-9) * box.extent(axis)) axis = i;
    const double extent = box.extent(axis);
    const int slabs = std::min(static_cast<int>(list.size()), static_cast<int>(std::ceil(extent / size_ - 1e-6)));
    if (slabs <= 1) {
      for (const int p : list) cell_[p] = count_;
      ++count_;
      return;
    }
    std::vector<std::vector<int>> slab(slabs);
    for (const int p : list) {
      const int k = static_cast<int>(std::floor((pieces_[p].centre[axis] - box.low[axis]) / extent * slabs));
      slab[std::clamp(k, 0, slabs - 1)].push_back(p);
    }
    for (int k = 0; k < slabs; ++k) {
      if (slab[k].empty()) continue;
      Box part = box;
      part.low[axis] = box.low[axis] + extent * k / slabs;
      part.high[axis] = box.low[axis] + extent * (k + 1) / slabs;
      cut(slab[k], part);
    }
  }

  std::vector<int> take() { return std::move(cell_); }

 private:
  Box around(const std::vector<int>& list, const Box& within) const {
    Box box;
    for (const int p : list) box.add(pieces_[p].box);
    for (int i = 0; i < 3; ++i) {
      box.low[i] = std::max(box.low[i], within.low[i]);
      box.high[i] = std::max(box.low[i], std::min(box.high[i], within.high[i]));
    }
    return box;
  }

  const std::vector<Piece>& pieces_;
  double size_;
  std::vector<int> cell_;
  int count_ = 0;
};

/// A facet or half an edge, and the cell it belongs to.
struct CellShare {
  const SurfaceFacet* facet;
  int index;      ///< of the facet
  Gram gram;      ///< of the facet's hats on the piece
  int corner;     ///< the corner whose surroundings it is; -1 for a whole facet
  int cell;
};

/// ∫ φ_a φ_b over the half of an edge next to corner c.
Gram half_gram(double length, int c) {
  Gram g{};
  g[c][c] = length * 7 / 24;
  g[c][1 - c] = g[1 - c][c] = length / 12;
  g[1 - c][1 - c] = length / 24;
  return g;
}

Piece around(const std::vector<Point>& points, int component) {
  Piece piece{{0, 0, 0}, {}, component};
  for (const Point& p : points) {
    for (int i = 0; i < 3; ++i) piece.centre[i] += p[i] / static_cast<double>(points.size());
    piece.box.add(p);
  }
  return piece;
}

int component_of(const SurfaceFacet& f, const std::vector<int>& component) {
  for (int a = 0; a < f.corners; ++a)
    if (f.row[a] >= 0) return component[f.row[a]];
  return -1;
}

/// Half edges, their cells named by the moving node they belong to; halves between nodes that stay, and those of bare nodes, are left out.
std::vector<CellShare> dual_shares(const Surface& surface, const std::vector<char>& moves, const std::vector<char>& bare) {
  std::vector<CellShare> shares;
  for (std::size_t k = 0; k < surface.facets.size(); ++k) {
    const SurfaceFacet& f = surface.facets[k];
    const Point v = surface.mesh.facet_area_vector(f.facet);
    for (int c = 0; c < 2; ++c) {
      int owner = f.row[c];
      if (owner >= 0 && !bare.empty() && bare[owner]) continue;
      if (owner < 0 || !moves[owner]) owner = f.row[1 - c];
      if (owner >= 0 && moves[owner]) shares.push_back({&f, static_cast<int>(k), half_gram(std::hypot(v[0], v[1]), c), c, owner});
    }
  }
  return shares;
}

/// Numbers cells from 0, joining dual cells where a size is given.
void join_dual_cells(const Surface& surface, double size, std::vector<CellShare>& shares) {
  std::map<int, std::vector<Point>> ends;  // of each dual cell
  std::map<int, int> number;
  for (const CellShare& s : shares) {
    const Point near = surface.mesh.point(surface.mesh.facet_node(s.facet->facet, s.corner));
    ends[s.cell].push_back(near);
    ends[s.cell].push_back(surface.mesh.facet_centre(s.facet->facet));
  }
  const std::vector<int> component = components(surface);
  std::vector<Piece> pieces;
  for (const auto& [owner, points] : ends) {
    number[owner] = static_cast<int>(pieces.size());
    pieces.push_back(around(points, component[owner]));
  }
  const std::vector<int> joined = size > 0 ? partition(pieces, size) : std::vector<int>();
  for (CellShare& s : shares) s.cell = size > 0 ? joined[number[s.cell]] : number[s.cell];
}

std::vector<CellShare> facet_shares(const Surface& surface, double size) {
  const std::vector<int> component = components(surface);
  std::vector<Piece> pieces;
  for (const SurfaceFacet& f : surface.facets) {
    std::vector<Point> corners;
    for (int a = 0; a < f.corners; ++a) corners.push_back(surface.mesh.point(surface.mesh.facet_node(f.facet, a)));
    pieces.push_back(around(corners, component_of(f, component)));
  }
  const std::vector<int> cell = partition(pieces, size > 0 ? size : kCellWidth * facet_width(surface));
  std::vector<CellShare> shares;
  for (std::size_t k = 0; k < surface.facets.size(); ++k)
    shares.push_back({&surface.facets[k], static_cast<int>(k), gram(surface.mesh, surface.facets[k].facet), -1, cell[k]});
  return shares;
}

/// g at a corner; a crack's tip takes the mean of the others.
double corner_bound(const SurfaceFacet& f, int corner, const std::vector<double>& g) {
  if (f.row[corner] >= 0) return g[f.row[corner]];
  double sum = 0;
  int count = 0;
  for (int a = 0; a < f.corners; ++a)
    if (f.row[a] >= 0) sum += g[f.row[a]], ++count;
  return sum / count;
}

/// Sums of one cell, contact row by contact row.
struct Sum {
  std::map<int, double> jumps, nodes;
  std::vector<CellPiece> pieces;
  double bound = 0, measure = 0;
};

void add(const CellShare& share, const std::vector<double>& g, Sum& sum) {
  const SurfaceFacet& f = *share.facet;
  sum.pieces.push_back({share.index, share.corner});
  for (int a = 0; a < f.corners; ++a) {
    double jump = 0, measure = 0;
    for (int b = 0; b < f.corners; ++b) {
      jump += share.gram[a][b] * corner_bound(f, b, g);
      measure += share.gram[a][b];
    }
    sum.bound += jump;
    sum.measure += measure;
    if (f.row[a] < 0) continue;
    sum.jumps[f.row[a]] += jump;
    if (share.corner < 0) sum.nodes[f.row[a]] += measure;
  }
  if (share.corner < 0 || f.row[share.corner] < 0) return;
  for (int a = 0; a < 2; ++a)  // half an edge surrounds one node
    for (int b = 0; b < 2; ++b) sum.nodes[f.row[share.corner]] += share.gram[a][b];
}

}  // namespace

std::vector<int> partition(const std::vector<Piece>& pieces, double size) {
  std::map<int, std::vector<int>> by_component;
  for (std::size_t p = 0; p < pieces.size(); ++p) by_component[pieces[p].component].push_back(static_cast<int>(p));
  Cutter cutter(pieces, size);
  constexpr Box kSpace{{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
  for (const auto& [component, list] : by_component) cutter.cut(list, kSpace);
  return cutter.take();
}

double facet_width(const Surface& surface) {
  double width = 0;
  for (const SurfaceFacet& f : surface.facets) {
    const double measure = mesh::length(surface.mesh.facet_area_vector(f.facet));
    width = std::max(width, f.corners == 2 ? measure : std::sqrt(f.corners == 3 ? 2 * measure : measure));
  }
  return width;
}

std::vector<FrictionCell> friction_cells(const Surface& surface, const std::vector<double>& g,
                                         const std::vector<char>& moves, double size, const std::vector<char>& bare) {
  std::vector<CellShare> shares;
  if (surface.mesh.dimension() == 2) {
    shares = dual_shares(surface, moves, bare);
    join_dual_cells(surface, size, shares);
  } else {
    shares = facet_shares(surface, size);
  }
  std::map<int, Sum> sums;
  for (const CellShare& share : shares) add(share, g, sums[share.cell]);
  std::vector<double> around(surface.rows, 0);
  for (const auto& [cell, sum] : sums)
    for (const auto& [row, measure] : sum.nodes) around[row] += measure;
  std::vector<FrictionCell> cells;
  for (const auto& [number, sum] : sums) {
    if (!(sum.bound > 0)) continue;
    FrictionCell cell{{}, {}, sum.bound, sum.measure, sum.pieces};
    for (const auto& [row, weight] : sum.jumps) cell.jumps.push_back({row, weight / sum.bound});
    for (const auto& [row, measure] : sum.nodes) cell.nodes.push_back({row, measure / around[row]});
    cells.push_back(std::move(cell));
  }
  return cells;
}

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

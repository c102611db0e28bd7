#include "mesh/second_order.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/facet_table.hpp"

namespace dotyk::mesh {
namespace {

/// The nodes between `count` corners each, 2 on an edge or 4 in a face. Node `between[k]` of cell c has the number between.size() · c + k. Cells that share
/// a node have a number each for it: these have the same corners.
class Between {
 public:
  Between(const Mesh& mesh, const ElementTopology& t, std::size_t count) : mesh_(mesh), t_(t) {
    const int each = static_cast<int>(t.between.size());
    of_least_ = Buckets(mesh.node_count(), [&](auto&& put) {
      for (int c = 0; c < mesh.cell_count(); ++c)
        for (int k = 0; k < each; ++k)
          if (t.between[static_cast<std::size_t>(k)].size() == count) put(corners_of(c * each + k)[0], c * each + k);
    });
  }

  /// Calls visit(number, is_new) for each number whose least corner is this one, ascending by their corners; `is_new`: the number visited before, if any,
  /// has other corners.
  template <class Visit>
  void with_least(int corner, const Visit& visit) {
    found_.clear();
    for (const int number : of_least_[corner]) found_.push_back({corners_of(number), number});
    std::sort(found_.begin(), found_.end());
    for (std::size_t i = 0; i < found_.size(); ++i) visit(found_[i].second, i == 0 || found_[i].first != found_[i - 1].first);
  }

 private:
  FacetTable::Corners corners_of(int number) const {
    const int* cell = mesh_.cell(number / static_cast<int>(t_.between.size()));
    int nodes[4], count = 0;
    for (const int k : t_.between[static_cast<std::size_t>(number) % t_.between.size()]) nodes[count++] = cell[k];
    return FacetTable::sorted(nodes, count);
  }

  const Mesh& mesh_;
  const ElementTopology& t_;
  Buckets of_least_;  ///< numbers by their least corner
  std::vector<std::pair<FacetTable::Corners, int>> found_;
};

/// Corners of the pieces of a cell or a facet of order 2, by its corners and dimension.
using PieceCorners = std::vector<std::vector<int>>;

PieceCorners simplex_pieces(int dimension) {
  if (dimension == 1) return {{0, 2}, {2, 1}};
  if (dimension == 2) return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  // Four at the corners; the octahedron between is cut along its diagonal from node 6 to node 8, its pieces so numbered that cutting them again and
  // again gives few shapes (Bey, Computing 55 (1995)).
  return {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}, {4, 6, 7, 8}, {5, 6, 4, 8}, {6, 7, 8, 9}, {8, 5, 6, 9}};
}

PieceCorners tensor_pieces(int dimension) {
  if (dimension == 2) return {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  return {{0, 8, 24, 11, 16, 22, 26, 20}, {8, 1, 9, 24, 22, 17, 21, 26},  {24, 9, 2, 10, 26, 21, 18, 23},
          {11, 24, 10, 3, 20, 26, 23, 19}, {16, 22, 26, 20, 4, 12, 25, 15}, {22, 17, 21, 26, 12, 5, 13, 25},
          {26, 21, 18, 23, 25, 13, 6, 14}, {20, 26, 23, 19, 15, 25, 14, 7}};
}

/// Which facet of which piece of a cell has these corners. They are local nodes of the whole cell; Facet::cell is the piece.
Facet facet_of_pieces(const ElementTopology& piece, const PieceCorners& pieces, const std::vector<int>& corners) {
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (int f = 0; f < piece.facets; ++f) {
      std::vector<int> own;
      for (int k = 0; k < piece.nodes_per_facet; ++k) own.push_back(pieces[p][static_cast<std::size_t>(piece.facet_nodes[f][k])]);
      if (std::is_permutation(own.begin(), own.end(), corners.begin(), corners.end())) return {static_cast<int>(p), f};
    }
  throw std::logic_error("no piece of a cell has this piece of its facet");
}

/// A way to cut a cell: its pieces, and for each of its facets the facets of pieces that fill it.
struct Cut {
  PieceCorners pieces;
  std::vector<std::vector<Facet>> within;
};

Cut cut_of(const ElementTopology& whole, const ElementTopology& piece, PieceCorners pieces) {
  Cut cut{std::move(pieces), std::vector<std::vector<Facet>>(static_cast<std::size_t>(whole.facets))};
  for (std::size_t l = 0; l < cut.within.size(); ++l)
    for (std::vector<int> corners : whole.dimension == 2 || whole.simplex() ? simplex_pieces(whole.dimension - 1) : tensor_pieces(2)) {
      for (int& k : corners) k = whole.facet_nodes[l][k];
      cut.within[l].push_back(facet_of_pieces(piece, cut.pieces, corners));
    }
  return cut;
}

/// The ways to cut a cell. A tetrahedron has three: along each diagonal of the octahedron in it. The second way is the first after corners 1, 2 and 3 have become
/// 2, 3 and 1. The third is that once more.
std::vector<Cut> cuts_of(const ElementTopology& whole, const ElementTopology& piece) {
  if (!whole.simplex()) return {cut_of(whole, piece, tensor_pieces(whole.dimension))};
  PieceCorners pieces = simplex_pieces(whole.dimension);
  std::vector<Cut> cuts{cut_of(whole, piece, pieces)};
  if (whole.dimension == 2) return cuts;
  for (int turn = 0; turn < 2; ++turn) {
    constexpr int kTurned[] = {0, 2, 3, 1, 6, 9, 7, 4, 5, 8};  // what corners and the nodes between them become
    for (std::vector<int>& corners : pieces)
      for (int& k : corners) k = kTurned[k];
    cuts.push_back(cut_of(whole, piece, pieces));
  }
  return cuts;
}

/// Which of the three ways cuts a tetrahedron along its shortest diagonal: its pieces degenerate least (Zhang, Houston J. Math. 21 (1995)). The first way is
/// taken unless another diagonal is clearly shorter. Then pieces have few shapes, and a bent grid is cut like a straight one. All ranks that have a cell cut it
/// in the same way, because they have the same coordinates.
std::size_t best_cut(const Mesh& whole, int cell) {
  constexpr int kDiagonals[3][2] = {{6, 8}, {7, 5}, {4, 9}};
  constexpr double kShorter = 0.9;  // its square
  const int* nodes = whole.cell(cell);
  std::size_t best = 0;
  double least = INFINITY;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point along = minus(whole.point(nodes[kDiagonals[k][0]]), whole.point(nodes[kDiagonals[k][1]]));
    if (const double square = dot(along, along); square < kShorter * least) best = k, least = square;
  }
  return best;
}

}  // namespace

Mesh second_order(Mesh first, Monitor* watch) {
  if (first.topology().order == 2) return first;
  Mesh mesh;
  mesh.element = second_order(first.element);
  mesh.coordinates = first.coordinates;
  mesh.parts = std::move(first.parts), mesh.whole = std::move(first.whole);
  const ElementTopology& t = mesh.topology();
  mesh.cells.resize(static_cast<std::size_t>(first.cell_count()) * t.nodes);
  for (int c = 0; c < first.cell_count(); ++c)
    std::copy_n(first.cell(c), t.corners, mesh.cells.begin() + static_cast<std::ptrdiff_t>(c) * t.nodes);

  const int own = first.node_count(), each = static_cast<int>(t.between.size());
  std::vector<int> made_by;  // of each new node a number, as Between counts them
  const auto place = [&](int number, bool is_new) {
    if (is_new) made_by.push_back(number);
    mesh.cells[static_cast<std::size_t>(number / each) * t.nodes + t.corners + number % each] = own + static_cast<int>(made_by.size()) - 1;
  };
  if (t.between.back().size() == 8)  // a hexahedron's centre, which no other cell shares
    for (int c = 0; c < first.cell_count(); ++c) place(c * each + each - 1, true);
  for (const std::size_t corners : {2, 4}) {
    if (corners == 4 && t.simplex()) continue;  // which has no nodes in faces
    Between between(first, t, corners);
    for (int i = 0; i < own; ++i) {
      if (watch && i % 1000 == 0) watch->check();
      between.with_least(i, place);
    }
  }

  const auto each_corner = [&](std::size_t i, const auto& visit) {
    for (const int k : t.between[static_cast<std::size_t>(made_by[i] % each)]) visit(first.cell(made_by[i] / each)[k]);
  };
  mesh.coordinates.reserve((own + made_by.size()) * static_cast<std::size_t>(t.dimension));
  for (std::size_t i = 0; i < made_by.size(); ++i) {
    int corners[8], count = 0;
    each_corner(i, [&](int corner) { corners[count++] = corner; });
    const Point x = first.mean(corners, count);
    mesh.coordinates.insert(mesh.coordinates.end(), x.begin(), x.begin() + t.dimension);
  }
  mesh.coarser = std::make_shared<Coarser>(Coarser{Buckets(mesh.node_count(), [&](auto&& put) {
    for (int i = 0; i < own; ++i) put(i, i);
    for (std::size_t i = 0; i < made_by.size(); ++i) each_corner(i, [&](int corner) { put(own + static_cast<int>(i), corner); });
  }), own, first.coarser});
  if (first.one_piece()) mesh.generated = {mesh.coordinates.size(), mesh.cells.size()};
  return mesh;
}

Mesh of_family(Mesh first, Family family) {
  if (family == Family::p2 || family == Family::q2) return second_order(std::move(first));
  return first;
}

Mesh cut_at_nodes(Mesh whole) {
  if (whole.topology().order == 1) return whole;
  const ElementTopology& t = whole.topology();
  Mesh mesh;
  mesh.element = first_order(whole.element);
  mesh.coordinates = whole.coordinates;
  mesh.coarser = whole.coarser;
  const std::vector<Cut> cuts = cuts_of(t, mesh.topology());
  const std::size_t pieces = cuts.front().pieces.size();
  const auto cut_of_cell = [&](int cell) -> const Cut& { return cuts[cuts.size() == 1 ? 0 : best_cut(whole, cell)]; };
  mesh.cells.reserve(static_cast<std::size_t>(whole.cell_count()) * pieces * static_cast<std::size_t>(t.corners));
  for (int c = 0; c < whole.cell_count(); ++c)
    for (const std::vector<int>& piece : cut_of_cell(c).pieces)
      for (const int k : piece) mesh.cells.push_back(whole.cell(c)[k]);
  if (whole.one_piece()) mesh.generated = {mesh.coordinates.size(), mesh.cells.size()};
  const auto cut = [&](const std::vector<Facet>& facets, std::vector<Facet>& to) {
    for (const Facet facet : facets)
      for (const Facet of : cut_of_cell(facet.cell).within[static_cast<std::size_t>(facet.local)])
        to.push_back({facet.cell * static_cast<int>(pieces) + of.cell, of.local});
  };
  for (const auto& [name, facets] : whole.parts) cut(facets, mesh.parts[name]);
  if (!whole.whole) return mesh;
  auto known = std::make_shared<Whole>(Whole{{}, whole.whole->nodes, whole.whole->cells * static_cast<std::int64_t>(pieces)});
  cut(whole.whole->boundary, known->boundary);
  std::ranges::sort(known->boundary);
  mesh.whole = std::move(known);
  return mesh;
}

}  // namespace dotyk::mesh

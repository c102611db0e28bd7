#include "mesh/second_order.hpp"

#include <algorithm>
#include <stdexcept>

namespace dotyk::mesh {
namespace {

/// Node k of between() of a cell, in all cells: cell · between.size() + k. Those of a kind lie between `corners` corners: 2 on an edge, 4 in a face.
/// By their least corner, ascending by the others where visited.
class Between {
 public:
  Between(const Mesh& mesh, const ElementTopology& t, std::size_t corners) : mesh_(mesh), t_(t), count_(corners) {
    of_least_ = Buckets(mesh.node_count(), [&](auto&& put) {
      for (int c = 0; c < mesh.cell_count(); ++c)
        for (std::size_t k = 0; k < t.between.size(); ++k)
          if (t.between[k].size() == corners) put(least(c, t.between[k]), c * static_cast<int>(t.between.size()) + static_cast<int>(k));
    });
  }

  /// Calls visit(number, first) for each number with this least corner; `first` where its corners are not the last one's.
  template <class Visit>
  void with_least(int corner, const Visit& visit) {
    found_.clear();
    for (const int number : of_least_[corner]) found_.push_back({corners_of(number), number});
    std::sort(found_.begin(), found_.end());
    for (std::size_t i = 0; i < found_.size(); ++i) visit(found_[i].second, i == 0 || found_[i].first != found_[i - 1].first);
  }

 private:
  int least(int cell, const std::vector<int>& corners) const {
    const int* nodes = mesh_.cell(cell);
    int result = nodes[corners[0]];
    for (const int k : corners) result = std::min(result, nodes[k]);
    return result;
  }

  std::array<int, 4> corners_of(int number) const {
    const int* nodes = mesh_.cell(number / static_cast<int>(t_.between.size()));
    const std::vector<int>& corners = t_.between[static_cast<std::size_t>(number) % t_.between.size()];
    std::array<int, 4> result{-1, -1, -1, -1};
    for (std::size_t i = 0; i < count_; ++i) result[i] = nodes[corners[i]];
    std::sort(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(count_));
    return result;
  }

  const Mesh& mesh_;
  const ElementTopology& t_;
  std::size_t count_;
  Buckets of_least_;
  std::vector<std::pair<std::array<int, 4>, int>> found_;
};

}  // namespace

Mesh second_order(Mesh first, Monitor* watch) {
  if (first.topology().order == 2) return first;
  Mesh mesh;
  mesh.element = second_order(first.element);
  mesh.coordinates = first.coordinates;
  mesh.parts = std::move(first.parts);
  const ElementTopology& t = mesh.topology();
  mesh.cells.resize(static_cast<std::size_t>(first.cell_count()) * t.nodes);
  for (int c = 0; c < first.cell_count(); ++c)
    std::copy_n(first.cell(c), t.corners, mesh.cells.begin() + static_cast<std::ptrdiff_t>(c) * t.nodes);

  const int own = first.node_count(), each = static_cast<int>(t.between.size());
  std::vector<int> made_by;  // node own + i → the first number that is it
  const auto place = [&](int number, bool is_new) {
    if (is_new) made_by.push_back(number);
    mesh.cells[static_cast<std::size_t>(number / each) * t.nodes + t.corners + number % each] = own + static_cast<int>(made_by.size()) - 1;
  };
  if (t.between.back().size() == 8)
    for (int c = 0; c < first.cell_count(); ++c) place(c * each + each - 1, true);
  for (const std::size_t corners : {2, 4}) {
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
  return mesh;
}

Mesh of_family(Mesh first, Family family) {
  return family == Family::p2 || family == Family::q2 ? second_order(std::move(first)) : first;
}

namespace {

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

/// The facet of a piece of the cell, {piece, facet}, that has these corners, nodes of the whole cell.
Facet facet_of_pieces(const ElementTopology& piece, const PieceCorners& pieces, const std::vector<int>& corners) {
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (int f = 0; f < piece.facets; ++f) {
      std::vector<int> own;
      for (int k = 0; k < piece.nodes_per_facet; ++k) own.push_back(pieces[p][static_cast<std::size_t>(piece.facet_nodes[f][k])]);
      if (std::is_permutation(own.begin(), own.end(), corners.begin(), corners.end())) return {static_cast<int>(p), f};
    }
  throw std::logic_error("no piece of a cell has this piece of its facet");
}

}  // namespace

Mesh cut_at_nodes(Mesh whole) {
  if (whole.topology().order == 1) return whole;
  const ElementTopology& t = whole.topology();
  const bool simplex = t.corners == t.dimension + 1;
  const PieceCorners pieces = simplex ? simplex_pieces(t.dimension) : tensor_pieces(t.dimension);
  const PieceCorners facet_pieces = t.dimension == 2 || simplex ? simplex_pieces(t.dimension - 1) : tensor_pieces(2);
  Mesh mesh;
  mesh.element = first_order(whole.element);
  mesh.coordinates = whole.coordinates;
  mesh.coarser = whole.coarser;
  mesh.cells.reserve(static_cast<std::size_t>(whole.cell_count()) * pieces.size() * static_cast<std::size_t>(t.corners));
  for (int c = 0; c < whole.cell_count(); ++c)
    for (const std::vector<int>& piece : pieces)
      for (const int k : piece) mesh.cells.push_back(whole.cell(c)[k]);
  std::vector<std::vector<Facet>> within(static_cast<std::size_t>(t.facets));  // facet of a cell → its pieces
  for (std::size_t l = 0; l < within.size(); ++l)
    for (std::vector<int> corners : facet_pieces) {
      for (int& k : corners) k = t.facet_nodes[l][k];
      within[l].push_back(facet_of_pieces(mesh.topology(), pieces, corners));
    }
  for (const auto& [name, facets] : whole.parts)
    for (const Facet facet : facets)
      for (const Facet of : within[static_cast<std::size_t>(facet.local)])
        mesh.parts[name].push_back({facet.cell * static_cast<int>(pieces.size()) + of.cell, of.local});
  return mesh;
}

}  // namespace dotyk::mesh

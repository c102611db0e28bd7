#include "meshfile/formats.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "meshfile/words.hpp"

namespace dotyk::meshfile {
namespace {

Shape shape(Words& words) {
  // Geometry types of mesh/geom.hpp; 0 is a point.
  static const Shape shapes[] = {Shape::segment, Shape::triangle, Shape::quadrilateral, Shape::tetrahedron, Shape::hexahedron, Shape::prism, Shape::pyramid};
  const int type = words.number<int>("an element's geometry type");
  if (type < 1 || type > 7) words.fail(text("elements of geometry type ", type, "; there are 1 to 7 (segment to pyramid)"));
  return shapes[type - 1];
}

/// The elements of a section, in blocks of one shape and attribute; `blocks` gets the block of each.
void read_elements(Words& words, Contents& contents, int dimension, std::vector<std::size_t>& blocks) {
  std::map<std::pair<int, int>, std::size_t> block_of;
  std::map<int, int> group_of;
  for (int n = words.count("the number of elements"); n > 0; --n) {
    const int attribute = words.number<int>("an attribute");
    const Shape s = shape(words);
    if (kind(s).dimension != dimension) words.fail(text(kind(s).plural, " among elements of dimension ", dimension));
    const auto [group, first] = group_of.try_emplace(attribute, static_cast<int>(contents.groups.size()));
    if (first) contents.groups.push_back({dimension, std::to_string(attribute)});
    const auto [block, fresh] = block_of.try_emplace({attribute, static_cast<int>(s)}, contents.blocks.size());
    if (fresh) contents.blocks.push_back({s, {group->second}, {}});
    blocks.push_back(block->second);
    for (int k = 0; k < kind(s).nodes; ++k) contents.blocks[block->second].nodes.push_back(words.number<int>("a vertex"));
  }
}

/// MFEM's order of edges, then faces, then the cell, by places in mesh::ElementTopology::between.
const std::map<Shape, std::vector<int>>& between_in_order() {
  static const std::map<Shape, std::vector<int>> orders{
      {Shape::triangle, {0, 1, 2}}, {Shape::quadrilateral, {0, 1, 2, 3, 4}}, {Shape::tetrahedron, {0, 2, 3, 1, 4, 5}},
      {Shape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 14, 13, 15, 12, 17, 18}}};
  return orders;
}

/// Makes the elements' order 2: after the vertices come the nodes on edges, in quadrilateral faces, then in cells, each
/// numbered as its first element comes. Returns how many nodes there are.
int number_between(Contents& contents, const std::vector<std::size_t>& elements, int vertices, const Words& words) {
  std::map<std::array<int, 4>, int> numbers[2];  // of edges and of faces, by corners
  int cells = 0;
  std::vector<std::vector<int>> of_kind(contents.blocks.size());  // of each node between corners: edge, face or cell
  std::vector<std::size_t> done(contents.blocks.size(), 0);
  for (const std::size_t b : elements) {
    Block& block = contents.blocks[b];
    const auto order = between_in_order().find(block.shape);
    if (order == between_in_order().end()) words.fail(text("nodes of ", kind(block.shape).plural, "; those of triangles, quadrilaterals, tetrahedra and hexahedra are read"));
    const auto& between = between_corners(block.shape);
    const int* corner = &block.nodes[done[b]++ * kind(block.shape).nodes];
    for (int k = 0; k < kind(block.shape).nodes; ++k)
      if (corner[k] < 0 || corner[k] >= vertices) words.fail(text("vertex ", corner[k], " of an element; there are ", vertices, ", counted from 0"));
    const std::size_t first = block.between.size();
    block.order = 2;
    block.between.resize(first + between.size());
    of_kind[b].resize(first + between.size());
    for (const int k : order->second) {
      std::array<int, 4> key{-1, -1, -1, -1};
      const bool inside = between[k].size() == 8 || (between[k].size() == 4 && block.shape == Shape::quadrilateral);
      for (std::size_t i = 0; !inside && i < between[k].size(); ++i) key[i] = corner[between[k][i]];
      std::sort(key.begin(), key.end());
      const int which = inside ? 2 : between[k].size() == 4;
      of_kind[b][first + k] = which;
      block.between[first + k] = inside ? cells++ : numbers[which].try_emplace(key, static_cast<int>(numbers[which].size())).first->second;
    }
  }
  const int edges = static_cast<int>(numbers[0].size()), faces = static_cast<int>(numbers[1].size());
  const int before[] = {vertices, vertices + edges, vertices + edges + faces};
  for (std::size_t b = 0; b < contents.blocks.size(); ++b)
    for (std::size_t i = 0; i < of_kind[b].size(); ++i) contents.blocks[b].between[i] += before[of_kind[b][i]];
  return before[2] + cells;
}

void expect(Words& words, std::string_view wanted) {
  const std::string_view word = words.next();
  if (word != wanted) words.fail(text(in_quotes(word), " where '", wanted, "' should be"));
}

/// The section nodes, which stands for the vertices' coordinates: continuous, of order 1 or 2.
void read_nodes(Words& words, Contents& contents, const std::vector<std::size_t>& elements, int vertices) {
  expect(words, "FiniteElementSpace");
  expect(words, "FiniteElementCollection:");
  const std::string_view collection = words.next();
  const bool first = collection == "Linear" || collection == "H1_2D_P1" || collection == "H1_3D_P1";
  if (!first && collection != "Quadratic" && collection != "H1_2D_P2" && collection != "H1_3D_P2")
    words.fail(text("nodes by the collection ", in_quotes(collection), "; 'Linear', 'Quadratic' and 'H1_2D_P1' to 'H1_3D_P2' are read"));
  expect(words, "VDim:");
  const int dimension = words.number<int>("the nodes' dimension");
  if (dimension != 2 && dimension != 3) words.fail(text("nodes of dimension ", dimension, "; 2 or 3 is expected"));
  expect(words, "Ordering:");
  const int ordering = words.number<int>("the nodes' ordering");
  if (ordering != 0 && ordering != 1) words.fail(text("ordering ", ordering, "; 0 or 1 is expected"));
  const int count = first ? vertices : number_between(contents, elements, vertices, words);
  contents.points.assign(3 * static_cast<std::size_t>(count), 0);
  for (long long v = 0, all = static_cast<long long>(count) * dimension; v < all; ++v) {
    const long long node = ordering == 0 ? v % count : v / dimension, component = ordering == 0 ? v / count : v % dimension;
    contents.points[static_cast<std::size_t>(3 * node + component)] = words.number<double>("a coordinate");
  }
}

void read_vertices(Words& words, Contents& contents, const std::vector<std::size_t>& elements) {
  const int n = words.count("the number of vertices");
  const std::string_view dimension = words.next();
  if (dimension == "nodes") return read_nodes(words, contents, elements, n);
  if (dimension != "2" && dimension != "3") words.fail(text("vertices of dimension ", in_quotes(dimension), "; 2 or 3 is expected"));
  contents.points.reserve(3 * static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) contents.points.push_back(k < 2 || dimension == "3" ? words.number<double>("a coordinate") : 0);
}

}  // namespace

Contents read_mfem(std::string_view all, const std::string& what) {
  Words words(all, what);
  const std::string_view first = words.line();
  if (first != "MFEM mesh v1.0") throw InputError(text(what, ": its first line is ", in_quotes(first), "; 'MFEM mesh v1.0' is expected"));
  Contents contents;
  std::vector<std::size_t> elements, boundary;  // their blocks
  int dimension = 0;
  for (std::string_view section = words.next(); !section.empty(); section = words.next()) {
    if (section == "dimension") dimension = words.number<int>("the dimension");
    else if (section == "elements") read_elements(words, contents, dimension, elements);
    else if (section == "boundary") read_elements(words, contents, dimension - 1, boundary);
    else if (section == "vertices") read_vertices(words, contents, elements);
    else words.fail(text("unknown section ", in_quotes(section), "; 'dimension', 'elements', 'boundary' or 'vertices' is expected"));
    if (dimension != 2 && dimension != 3) words.fail(text("dimension ", dimension, "; 2 or 3 is expected"));
  }
  return contents;
}

}  // namespace dotyk::meshfile

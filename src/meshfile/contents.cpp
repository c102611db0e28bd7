#include "contents.hpp"

#include <cstdint>

#include "base/error.hpp"
#include "reader/bytes.hpp"

namespace dotyk::meshfile {

const ShapeKind& kind(Shape shape) {
  using mesh::Element;
  static const ShapeKind kinds[] = {
      {"segments", 1, 2}, {"triangles", 2, 3, Element::triangle_p1}, {"quadrilaterals", 2, 4, Element::quadrilateral_q1},
      {"tetrahedra", 3, 4, Element::tetrahedron_p1}, {"hexahedra", 3, 8, Element::hexahedron_q1}, {"prisms", 3, 6}, {"pyramids", 3, 5}};
  return kinds[static_cast<int>(shape)];
}

const std::vector<std::vector<int>>& between_corners(Shape shape) {
  static const std::vector<std::vector<int>> none;
  return kind(shape).cell ? mesh::topology(mesh::second_order(*kind(shape).cell)).between : none;
}

void write(std::FILE* out, const Contents& contents) {
  using reader::put, reader::put_all;
  put_all(out, contents.points);
  put(out, static_cast<std::uint64_t>(contents.groups.size()));
  for (const Group& g : contents.groups) put(out, g.dimension), put_all(out, g.name);
  put(out, static_cast<std::uint64_t>(contents.blocks.size()));
  for (const Block& b : contents.blocks) put(out, b.shape), put_all(out, b.groups), put_all(out, b.nodes), put(out, b.order), put_all(out, b.between);
  reader::put_end(out);
}

void check(const Contents& c, const std::string& what) {
  if (c.points.size() % 3 != 0) throw InputError(what + ": its nodes are damaged");
  const auto nodes = static_cast<long long>(c.points.size() / 3);
  for (const Block& b : c.blocks) {
    if (b.shape < Shape::segment || b.shape > Shape::pyramid) throw InputError(what + ": its elements are damaged");
    if (b.nodes.size() % kind(b.shape).nodes != 0) throw InputError(text(what, ": its ", kind(b.shape).plural, " are damaged"));
    for (const int n : b.nodes)
      if (n < 0 || n >= nodes) throw InputError(text(what, ": one of its ", kind(b.shape).plural, " has a node that is not there"));
    const std::size_t between = b.order == 2 ? b.nodes.size() / kind(b.shape).nodes * between_corners(b.shape).size() : 0;
    if (b.between.size() != between) throw InputError(text(what, ": its ", kind(b.shape).plural, " are damaged"));
    for (const int n : b.between)
      if (n < -1 || n >= nodes) throw InputError(text(what, ": one of its ", kind(b.shape).plural, " has a node that is not there"));
    for (const int g : b.groups)
      if (g < 0 || g >= static_cast<int>(c.groups.size())) throw InputError(what + ": its groups are damaged");
  }
}

Contents read(std::string_view bytes) {
  reader::Answer from(bytes);
  Contents c;
  c.points = from.get_all<std::vector<double>>();
  for (auto n = from.get<std::uint64_t>(); n > 0; --n) {
    const int dimension = from.get<int>();
    c.groups.push_back({dimension, from.get_all<std::string>()});
  }
  for (auto n = from.get<std::uint64_t>(); n > 0; --n) {
    const auto shape = from.get<Shape>();
    auto groups = from.get_all<std::vector<int>>();
    auto nodes = from.get_all<std::vector<int>>();
    const int order = from.get<int>();
    c.blocks.push_back({shape, std::move(groups), std::move(nodes), order, from.get_all<std::vector<int>>()});
  }
  from.end();
  check(c, "the reader's answer");
  return c;
}

}  // namespace dotyk::meshfile

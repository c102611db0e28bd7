#include "contents.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "reader/bytes.hpp"

namespace dotyk::meshfile {

const ShapeKind& kind(Shape shape) {
  static const ShapeKind kinds[] = {{"segments", 1, 2},   {"triangles", 2, 3}, {"quadrilaterals", 2, 4}, {"tetrahedra", 3, 4},
                                    {"hexahedra", 3, 8}, {"prisms", 3, 6},    {"pyramids", 3, 5}};
  return kinds[static_cast<int>(shape)];
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

namespace {

/// Are the numbers such that they can be places? What a library made of a damaged file need not be.
bool sound(const Contents& c) {
  const auto points = static_cast<int>(c.points.size() / 3), groups = static_cast<int>(c.groups.size());
  const auto within = [](const std::vector<int>& all, int low, int high) {
    return std::all_of(all.begin(), all.end(), [&](int i) { return i >= low && i < high; });
  };
  return std::all_of(c.blocks.begin(), c.blocks.end(), [&](const Block& b) {
    return b.shape >= Shape::segment && b.shape <= Shape::pyramid && within(b.groups, 0, groups) && within(b.nodes, 0, points) &&
           within(b.between, -1, points);
  });
}

}  // namespace

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
  if (!sound(c)) throw std::runtime_error("the reader's answer has places beyond its lists");
  return c;
}

}  // namespace dotyk::meshfile

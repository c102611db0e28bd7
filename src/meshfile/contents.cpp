#include "contents.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace dotyk::meshfile {

const ShapeKind& kind(Shape shape) {
  static const ShapeKind kinds[] = {{"segments", 1, 2},   {"triangles", 2, 3}, {"quadrilaterals", 2, 4}, {"tetrahedra", 3, 4},
                                    {"hexahedra", 3, 8}, {"prisms", 3, 6},    {"pyramids", 3, 5}};
  return kinds[static_cast<int>(shape)];
}

namespace {

constexpr std::uint64_t kWhole = 0x646f74796b6d6573;  // "dotykmes", the last word

template <class T>
void put(std::FILE* out, const T& value) {
  if (std::fwrite(&value, sizeof value, 1, out) != 1) throw std::runtime_error("the mesh could not be handed over");
}

template <class Sequence>
void put_all(std::FILE* out, const Sequence& values) {
  put(out, static_cast<std::uint64_t>(values.size()));
  if (!values.empty() && std::fwrite(values.data(), sizeof values[0], values.size(), out) != values.size())
    throw std::runtime_error("the mesh could not be handed over");
}

struct Source {
  std::string_view left;

  void take(void* to, std::size_t size) {
    if (size > left.size()) throw std::runtime_error("the reader's answer is not whole");
    if (size) std::memcpy(to, left.data(), size);
    left.remove_prefix(size);
  }
  template <class T>
  T get() {
    T value;
    take(&value, sizeof value);
    return value;
  }
  template <class Sequence>
  Sequence get_all() {
    const auto count = get<std::uint64_t>();
    if (count > left.size() / sizeof(typename Sequence::value_type)) throw std::runtime_error("the reader's answer is not whole");
    Sequence values(count, typename Sequence::value_type{});
    take(values.data(), count * sizeof(typename Sequence::value_type));
    return values;
  }
};

}  // namespace

void write(std::FILE* out, const Contents& contents) {
  put_all(out, contents.points);
  put(out, static_cast<std::uint64_t>(contents.groups.size()));
  for (const Group& g : contents.groups) put(out, g.dimension), put_all(out, g.name);
  put(out, static_cast<std::uint64_t>(contents.blocks.size()));
  for (const Block& b : contents.blocks) put(out, b.shape), put_all(out, b.groups), put_all(out, b.nodes), put(out, b.order), put_all(out, b.between);
  put(out, kWhole);
  if (std::fflush(out) != 0) throw std::runtime_error("the mesh could not be handed over");
}

Contents read(std::string_view bytes) {
  Source from{bytes};
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
  if (from.get<std::uint64_t>() != kWhole) throw std::runtime_error("the reader's answer is not whole");
  return c;
}

}  // namespace dotyk::meshfile

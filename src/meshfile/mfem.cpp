#include "meshfile/mfem.hpp"

#include <charconv>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "meshfile/quoted.hpp"

namespace dotyk::meshfile {
namespace {

/// The words of a text, without comments (# to the end of the line).
class Words {
 public:
  Words(std::string_view text, std::string what) : left_(text), what_(std::move(what)) {}

  std::string_view next() {
    while (!left_.empty()) {
      if (left_.front() == '#') left_.remove_prefix(std::min(left_.find('\n'), left_.size()));
      else if (space(left_.front())) skip();
      else break;
    }
    std::size_t n = 0;
    while (n < left_.size() && !space(left_[n]) && left_[n] != '#') ++n;
    const std::string_view word = left_.substr(0, n);
    left_.remove_prefix(n);
    return word;
  }

  template <class Number>
  Number number(const char* of) {
    const std::string_view word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty()) fail(text("it ends where ", of, " should be"));
    if (error != std::errc() || end != word.data() + word.size())
      fail(text(quoted(word), " where ", of, " should be"));
    return value;
  }

  /// Of things that take two characters each at least.
  int count(const char* of) {
    const auto n = number<long long>(of);
    if (n < 0 || n > static_cast<long long>(left_.size())) fail(text(n, " as ", of, "; the file is too short for that"));
    return static_cast<int>(n);
  }

  [[noreturn]] void fail(const std::string& why) const { throw InputError(text(what_, ", line ", line_, ": ", why)); }

 private:
  static bool space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip() {
    line_ += left_.front() == '\n';
    left_.remove_prefix(1);
  }

  std::string_view left_;
  std::string what_;
  long line_ = 2;  // the first is read already
};

Shape shape(Words& words) {
  // Geometry types of mesh/geom.hpp; 0 is a point.
  static const Shape shapes[] = {Shape::segment, Shape::triangle, Shape::quadrilateral, Shape::tetrahedron, Shape::hexahedron, Shape::prism, Shape::pyramid};
  const int type = words.number<int>("an element's geometry type");
  if (type < 1 || type > 7) words.fail(text("elements of geometry type ", type, "; there are 1 to 7 (segment to pyramid)"));
  return shapes[type - 1];
}

/// The elements of a section, in blocks of one shape and attribute.
void read_elements(Words& words, Contents& contents, int dimension) {
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
    for (int k = 0; k < kind(s).nodes; ++k) contents.blocks[block->second].nodes.push_back(words.number<int>("a vertex"));
  }
}

void read_vertices(Words& words, Contents& contents) {
  const int n = words.count("the number of vertices");
  const std::string_view dimension = words.next();
  if (dimension == "nodes") words.fail("a curved mesh (section nodes); only straight ones, with vertices, are read");
  if (dimension != "2" && dimension != "3") words.fail(text("vertices of dimension ", quoted(dimension), "; 2 or 3 is expected"));
  contents.points.reserve(3 * static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) contents.points.push_back(k < 2 || dimension == "3" ? words.number<double>("a coordinate") : 0);
}

}  // namespace

Contents read_mfem(std::string_view all, const std::string& what) {
  const std::string_view first = all.substr(0, all.find_first_of("\r\n"));
  if (first != "MFEM mesh v1.0") throw InputError(text(what, ": its first line is ", quoted(first), "; 'MFEM mesh v1.0' is expected"));
  all.remove_prefix(std::min(first.size() + (all.substr(first.size(), 2) == "\r\n" ? 2 : 1), all.size()));
  Words words(all, what);
  Contents contents;
  int dimension = 0;
  for (std::string_view section = words.next(); !section.empty(); section = words.next()) {
    if (section == "dimension") dimension = words.number<int>("the dimension");
    else if (section == "elements") read_elements(words, contents, dimension);
    else if (section == "boundary") read_elements(words, contents, dimension - 1);
    else if (section == "vertices") read_vertices(words, contents);
    else if (section == "nodes") words.fail("a curved mesh (section nodes); only straight ones are read");
    else words.fail(text("unknown section ", quoted(section), "; 'dimension', 'elements', 'boundary' or 'vertices' is expected"));
    if (dimension != 2 && dimension != 3) words.fail(text("dimension ", dimension, "; 2 or 3 is expected"));
  }
  return contents;
}

}  // namespace dotyk::meshfile

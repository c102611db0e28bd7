#include "meshfile/formats.hpp"

#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <unordered_map>

#include "meshfile/words.hpp"

namespace dotyk::meshfile {
namespace {

/// One of Gmsh's element types. Its nodes are the corners, in our order, then others.
struct Type {
  std::optional<Shape> shape = {};  ///< none: a point
  int order = 1;
  int nodes = 0;  ///< 0: a type that is not known here
};

/// By Gmsh's number: points, and elements of order 1 to 5.
Type type_of(int number) {
  using enum Shape;
  static const std::map<int, Type> types{
      {1, {segment, 1, 2}}, {2, {triangle, 1, 3}}, {3, {quadrilateral, 1, 4}}, {4, {tetrahedron, 1, 4}},
      {5, {hexahedron, 1, 8}}, {6, {prism, 1, 6}}, {7, {pyramid, 1, 5}}, {8, {segment, 2, 3}}, {9, {triangle, 2, 6}},
      {10, {quadrilateral, 2, 9}}, {11, {tetrahedron, 2, 10}}, {12, {hexahedron, 2, 27}}, {13, {prism, 2, 18}},
      {14, {pyramid, 2, 14}}, {15, {{}, 0, 1}}, {16, {quadrilateral, 2, 8}}, {17, {hexahedron, 2, 20}},
      {18, {prism, 2, 15}}, {19, {pyramid, 2, 13}}, {20, {triangle, 3, 9}}, {21, {triangle, 3, 10}},
      {22, {triangle, 4, 12}}, {23, {triangle, 4, 15}}, {24, {triangle, 5, 15}}, {25, {triangle, 5, 21}},
      {26, {segment, 3, 4}}, {27, {segment, 4, 5}}, {28, {segment, 5, 6}}, {29, {tetrahedron, 3, 20}},
      {30, {tetrahedron, 4, 35}}, {31, {tetrahedron, 5, 56}}, {32, {tetrahedron, 4, 22}}, {33, {tetrahedron, 5, 28}},
      {36, {quadrilateral, 3, 16}}, {37, {quadrilateral, 4, 25}}, {38, {quadrilateral, 5, 36}},
      {39, {quadrilateral, 3, 12}}, {40, {quadrilateral, 4, 16}}, {41, {quadrilateral, 5, 20}}, {90, {prism, 3, 40}},
      {91, {prism, 4, 75}}, {92, {hexahedron, 3, 64}}, {93, {hexahedron, 4, 125}}, {94, {hexahedron, 5, 216}},
      {99, {hexahedron, 3, 32}}, {100, {hexahedron, 4, 44}}, {101, {hexahedron, 5, 56}}, {106, {prism, 5, 126}},
      {111, {prism, 3, 24}}, {112, {prism, 4, 33}}, {113, {prism, 5, 42}}, {118, {pyramid, 3, 30}},
      {119, {pyramid, 4, 55}}, {120, {pyramid, 5, 91}}, {125, {pyramid, 3, 21}}, {126, {pyramid, 4, 29}},
      {127, {pyramid, 5, 37}}, {137, {tetrahedron, 3, 16}}};
  const auto at = types.find(number);
  return at == types.end() ? Type() : at->second;
}

/// Adds an element to a block of its type; `nodes`: where they stand in Contents::points.
void add_element(const Type& type, Block& block, const int* nodes) {
  static const std::vector<int> in_order{0, 1, 2, 3, 4}, tetrahedron{0, 1, 2, 3, 5, 4},
      hexahedron{0, 3, 8, 1, 9, 2, 10, 11, 4, 7, 5, 6, 16, 14, 12, 13, 15, 17, 18};  // places in between_corners()
  const int corners = kind(block.shape).nodes;
  block.nodes.insert(block.nodes.end(), nodes, nodes + corners);
  if (type.order != 2 || !kind(block.shape).cell) return;
  const auto& places = block.shape == Shape::tetrahedron ? tetrahedron : block.shape == Shape::hexahedron ? hexahedron : in_order;
  const std::size_t first = block.between.size();
  block.between.resize(first + between_corners(block.shape).size(), -1);
  for (int k = corners; k < type.nodes; ++k) block.between[first + places[k - corners]] = nodes[k];
}

class MshReader {
 public:
  MshReader(std::string_view all, const std::string& what) : in_(all, what) {}

  Contents read() {
    read_header();
    for (std::string_view section = in_.next(); !section.empty(); section = in_.next()) {
      if (section[0] != '$') in_.fail(text(in_quotes(section), " where a section should begin"));
      if (section == "$PhysicalNames") read_names();
      else if (section == "$Entities" || section == "$PartitionedEntities") read_entities(section == "$PartitionedEntities");
      else if (section == "$Nodes") read_nodes();
      else if (section == "$Elements") read_elements();
      else if (section == "$ParametricNodes") in_.fail("its nodes have parameters; save it without them (Mesh.SaveParametric = 0)");
      else if (!in_.skip_beyond(text("$End", section.substr(1))))
        in_.fail(text("its section ", in_quotes(section), " does not end: the file is cut off"));
    }
    return std::move(contents_);
  }

 private:
  void read_header() {
    std::string_view word = in_.next();
    if (word == "$Comments" && in_.skip_beyond("$EndComments")) word = in_.next();
    if (word == "$NOD") in_.fail("this is a Gmsh mesh of version 1; save it as version 4.1 or 2.2");
    if (word != "$MeshFormat") in_.fail("this is no Gmsh mesh: it does not begin with $MeshFormat");
    const std::string_view version = in_.next();
    const auto [last, error] = std::from_chars(version.data(), version.data() + version.size(), version_);
    if (error != std::errc() || last != version.data() + version.size())
      in_.fail(text(in_quotes(version), " where the version of the Gmsh mesh should be"));
    if (!(version_ >= 2 && version_ < 2.3) && !(version_ >= 4 && version_ < 4.2))
      in_.fail(text("this is a Gmsh mesh of version ", version.substr(0, 20),
                    "; 2.0 to 2.2, 4.0 and 4.1 are read: save it as one of these"));
    binary_ = in_.number<int>("the kind of file") != 0;
    const int size = in_.number<int>("the size of a number");
    if (binary_ && size != 8) in_.fail(text("its numbers have ", size, " bytes; 8 are expected"));
    begin_bytes();
    swapped_ = binary_ && whole("a one in binary") != 1;
    end("$EndMeshFormat");
  }

  void read_names() {
    for (int n = in_.count("the number of physical names"); n > 0; --n) {
      const int dimension = in_.number<int>("a dimension"), tag = in_.number<int>("a physical group");
      const std::string_view line = in_.line();
      const std::size_t first = line.find('"'), last = line.rfind('"');
      if (first == last) in_.fail(text("a name in double quotes is expected for physical group ", tag));
      names_[{dimension, tag}] = line.substr(first + 1, last - first - 1);
    }
    end("$EndPhysicalNames");
  }

  /// Of version 4: the physical groups of entities.
  void read_entities(bool partitioned) {
    begin_bytes();
    if (partitioned) {
      wide("the number of partitions");
      for (long long n = count("the number of ghost entities"); n > 0; --n) whole("a ghost entity"), whole("a partition");
    }
    long long number[4];
    for (long long& n : number) n = count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (long long n = number[dimension]; n > 0; --n) {
        const int tag = whole("an entity");
        if (partitioned) {
          whole("a parent's dimension"), whole("a parent");
          for (long long k = count("the number of partitions"); k > 0; --k) whole("a partition");
        }
        for (int k = dimension == 0 && version_ >= 4.1 ? 3 : 6; k > 0; --k) real("a bound of an entity");
        std::vector<int>& groups = groups_of_[{dimension, tag}];
        for (long long k = count("the number of physical groups"); k > 0; --k) groups.push_back(whole("a physical group"));
        for (long long k = dimension > 0 ? count("the number of bounding entities") : 0; k > 0; --k) whole("a bounding entity");
      }
    end(partitioned ? "$EndPartitionedEntities" : "$EndEntities");
  }

  void read_nodes() {
    const bool in_blocks = version_ >= 4, numbers_first = version_ >= 4.1;
    if (in_blocks) begin_bytes();
    long long blocks = in_blocks ? count("the number of blocks of nodes") : 1, done = 0;
    const long long said = count("the number of nodes");
    if (numbers_first) wide("the least number of a node"), wide("the greatest number of a node");
    if (!in_blocks) begin_bytes();
    for (std::vector<long long> numbers; blocks > 0; --blocks) {
      const int dimension = in_blocks ? entity().first : 0;
      const int parameters = in_blocks && whole("whether nodes have parameters") != 0 ? dimension : 0;
      const long long here = in_blocks ? count("the number of nodes of a block") : said;
      numbers.clear();
      for (long long k = 0; numbers_first && k < here; ++k) numbers.push_back(wide("a node's number"));
      for (long long k = 0; k < here; ++k, ++done) {
        if (in_.ahead("$EndNodes")) end("$EndNodes", done, said, "nodes");
        add_node(numbers_first ? numbers[k] : whole("a node's number"));
        for (int p = 0; p < parameters; ++p) real("a parameter");
      }
    }
    end("$EndNodes", done, said, "nodes");
  }

  void add_node(long long number) {
    if (!place_.emplace(number, static_cast<int>(place_.size())).second) in_.fail(text("node ", number, " is there twice"));
    if (place_.size() > 2'000'000'000) in_.fail("it has more nodes than this program can number");
    for (int i = 0; i < 3; ++i) contents_.points.push_back(real("a coordinate"));
  }

  /// Version 4: blocks of one entity and type. Version 2: each with its tags, the first of which is its physical group; binary ones of
  /// one type and number of tags together.
  void read_elements() {
    const bool in_blocks = version_ >= 4;
    if (in_blocks) begin_bytes();
    long long blocks = in_blocks ? count("the number of blocks of elements") : 0, done = 0;
    const long long said = count("the number of elements");
    if (version_ >= 4.1) wide("the least number of an element"), wide("the greatest number of an element");
    if (!in_blocks) begin_bytes();
    while (in_blocks ? blocks-- > 0 : done < said) {
      if (in_.ahead("$EndElements")) end("$EndElements", done, said, "elements");
      std::vector<int> groups(1);
      const auto at = in_blocks ? entity() : std::pair{0, 0};
      if (in_blocks) groups = groups_of_[at];
      else if (!binary_) whole("an element's number");
      const int type = whole("an element's type");
      long long here = in_blocks ? count("the number of a block's elements") : binary_ ? whole("a number of elements") : 1;
      const int tags = in_blocks ? 0 : whole("the number of an element's tags");
      for (; here > 0; --here, ++done) {
        if (in_.ahead("$EndElements")) end("$EndElements", done, said, "elements");
        if (in_blocks || binary_) tag("an element's number");
        for (int t = 0; t < tags; ++t)
          if (const int tag = whole("a tag"); t == 0) groups[0] = tag;
        add(type, groups);
      }
    }
    for (auto& [of, block] : blocks_)
      if (!block.nodes.empty()) contents_.blocks.push_back(std::move(block));
    end("$EndElements", done, said, "elements");
  }

  /// The groups of an element's dimension with these tags, negative where it is turned over there; 0: none.
  std::vector<int> groups(int dimension, const std::vector<int>& tags) {
    std::vector<int> result;
    for (const int tag : tags) {
      if (tag == 0) continue;
      const std::pair key{dimension, static_cast<int>(std::abs(std::int64_t{tag}))};
      const auto [group, fresh] = group_.try_emplace(key, static_cast<int>(contents_.groups.size()));
      if (fresh) contents_.groups.push_back({dimension, names_.contains(key) ? names_[key] : std::to_string(key.second)});
      result.push_back(group->second);
    }
    return result;
  }

  /// The element whose nodes come next.
  void add(int number, const std::vector<int>& tags) {
    if (!last_ || last_->first.first != number || last_->first.second != tags) {
      const Type type = type_of(number);
      if (type.nodes == 0) in_.fail(text("elements of type ", number, " are not read, those of order 1 to 5 are; has it as many as it says?"));
      const std::vector<int> of = groups(type.shape ? kind(*type.shape).dimension : 0, tags);
      last_ = &*blocks_.try_emplace({number, tags}, Block{type.shape.value_or(Shape::segment), of, {}, type.order}).first;
      type_ = type;
    }
    nodes_.clear();
    for (int k = 0; k < type_.nodes; ++k) {
      const long long node = tag("a node of an element");
      const auto at = place_.find(node);
      if (at == place_.end()) in_.fail(text("node ", node, " of an element is not there"));
      nodes_.push_back(at->second);
    }
    if (type_.shape) add_element(type_, last_->second, nodes_.data());
  }

  /// Dimension and number of the entity that a block is of.
  std::pair<int, int> entity() {
    const int first = whole("an entity"), second = whole("an entity");
    const std::pair at = version_ >= 4.1 ? std::pair{first, second} : std::pair{second, first};
    if (at.first < 0 || at.first > 3) in_.fail(text("a block of dimension ", at.first, "; has the block before it as many as it says?"));
    return at;
  }

  /// The end of a section of so many things.
  void end(std::string_view name, long long done, long long said, const char* things) {
    if (done != said) in_.fail(text("it says that it has ", said, " ", things, ", and has ", done));
    if (in_.next() != name) in_.fail(text("it says that it has ", said, " ", things, ", and more follow"));
  }
  void end(std::string_view name) {
    if (in_.next() != name) in_.fail(text(in_quotes(name), " is expected"));
  }

  // Numbers are words, or bytes as the version has them.
  template <class Number>
  Number number(const char* of) {
    if (!binary_) return in_.number<Number>(of);
    char bytes[sizeof(Number)];
    in_.bytes(bytes, sizeof bytes, of);
    if (swapped_) std::reverse(bytes, bytes + sizeof bytes);
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  int whole(const char* of) { return number<std::int32_t>(of); }
  long long wide(const char* of) { return number<std::int64_t>(of); }
  long long tag(const char* of) { return version_ >= 4.1 ? wide(of) : whole(of); }
  double real(const char* of) { return number<double>(of); }
  long long count(const char* of) { return version_ < 4 ? in_.count(of) : in_.count(wide(of), of); }
  void begin_bytes() {
    if (binary_) in_.line();
  }

  Words in_;
  double version_ = 0;
  bool binary_ = false, swapped_ = false;
  std::map<std::pair<int, int>, std::string> names_;               // of dimension and physical group
  std::map<std::pair<int, int>, int> group_;                       // likewise → place in contents_.groups
  std::map<std::pair<int, int>, std::vector<int>> groups_of_;      // of dimension and entity: physical groups
  std::unordered_map<long long, int> place_;                       // of nodes by their numbers
  std::map<std::pair<int, std::vector<int>>, Block> blocks_;       // of a type and physical groups
  decltype(blocks_)::value_type* last_ = nullptr;                  // that the last element is of, and its type
  Type type_;
  std::vector<int> nodes_;                                         // of an element
  Contents contents_;
};

}  // namespace

Contents read_msh(std::string_view all, const std::string& what) {
  if (!all.starts_with('$')) throw InputError(what + ": this is no Gmsh mesh: it does not begin with $MeshFormat");
  return MshReader(all, what).read();
}

}  // namespace dotyk::meshfile

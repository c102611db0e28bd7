#include "meshfile/msh.hpp"

#include <cstdint>
#include <cstdlib>
#include <map>
#include <unordered_map>

#include "meshfile/gmsh_types.hpp"
#include "meshfile/words.hpp"

namespace dotyk::meshfile {
namespace {

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
      else if (section == "$Elements") version_ < 4 ? read_elements() : read_blocks_of_elements();
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
    if (binary_) {
      in_.binary();
      std::int32_t one = 0;
      in_.bytes(&one, sizeof one, "a one in binary");
      swapped_ = one != 1;
    }
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

  /// Of version 2. Binary elements of one type and number of tags come together.
  void read_elements() {
    const long long said = count("the number of elements");
    begin_bytes();
    std::map<std::pair<int, int>, Block> blocks;  // of each type and physical group
    for (long long done = 0, last; done < said; done = last) {
      if (in_.ahead("$EndElements")) end("$EndElements", done, said, "elements");
      if (!binary_) whole("an element's number");
      const int number = whole("an element's type");
      const GmshType type = known(number);
      last = done + (binary_ ? whole("a number of elements") : 1);
      const int tags = whole("the number of an element's tags");
      if (last <= done || last > said) end("$EndElements", last, said, "elements");
      for (; done < last; ++done) {
        if (binary_) whole("an element's number");
        const int group = tags > 0 ? whole("a tag") : 0;
        for (int t = 1; t < tags; ++t) whole("a tag");
        auto block = blocks.find({number, group});
        if (block == blocks.end()) block = blocks.emplace(std::pair{number, group}, block_of(type, {group})).first;
        add(type, block->second);
      }
    }
    for (auto& [of, block] : blocks)
      if (!block.nodes.empty()) contents_.blocks.push_back(std::move(block));
    end("$EndElements", said, said, "elements");
  }

  void read_blocks_of_elements() {
    begin_bytes();
    long long blocks = count("the number of blocks of elements"), done = 0;
    const long long said = count("the number of elements");
    if (version_ >= 4.1) wide("the least number of an element"), wide("the greatest number of an element");
    for (; blocks > 0; --blocks) {
      const auto at = entity();
      const GmshType type = known(whole("the type of a block's elements"));
      if (at.first != dimension(type)) in_.fail(text("elements of dimension ", dimension(type), " in a block of dimension ", at.first));
      Block block = block_of(type, groups_of_[at]);
      for (long long k = count("the number of elements of a block"); k > 0; --k, ++done) {
        if (in_.ahead("$EndElements")) end("$EndElements", done, said, "elements");
        tag("an element's number");
        add(type, block);
      }
      if (!block.nodes.empty()) contents_.blocks.push_back(std::move(block));
    }
    end("$EndElements", done, said, "elements");
  }

  GmshType known(int number) const {
    const GmshType type = gmsh_type(number);
    if (type.nodes == 0) in_.fail(text("there is no type ", number, " of elements; has the file as many as it says?"));
    return type;
  }
  static int dimension(const GmshType& type) { return type.shape ? kind(*type.shape).dimension : 0; }

  Block block_of(const GmshType& type, const std::vector<int>& physical) {
    Block block{type.shape.value_or(Shape::segment), {}, {}, type.order};
    for (const int tag : physical) {
      const std::pair key{dimension(type), std::abs(tag)};  // negative: elements turned over
      if (tag == 0) continue;
      const auto [group, fresh] = group_.try_emplace(key, static_cast<int>(contents_.groups.size()));
      if (fresh) contents_.groups.push_back({key.first, names_.contains(key) ? names_[key] : std::to_string(key.second)});
      block.groups.push_back(group->second);
    }
    return block;
  }

  void add(const GmshType& type, Block& block) {
    nodes_.clear();
    for (int k = 0; k < type.nodes; ++k) {
      const long long number = tag("a node of an element");
      const auto at = place_.find(number);
      if (at == place_.end()) in_.fail(text("node ", number, " of an element is not there"));
      nodes_.push_back(at->second);
    }
    if (type.shape) add_element(type, block, nodes_.data());
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
  std::vector<int> nodes_;
  Contents contents_;
};

}  // namespace

Contents read_msh(std::string_view all, const std::string& what) {
  if (!all.starts_with('$')) throw InputError(what + ": this is no Gmsh mesh: it does not begin with $MeshFormat");
  return MshReader(all, what).read();
}

}  // namespace dotyk::meshfile

// Reads Gmsh files, and lets Gmsh mesh geometries, with its own library.
//   dotyk_gmsh load FILE.msh
//   dotyk_gmsh mesh FILE DIMENSION SIZE ORDER     DIMENSION 0: that of the geometry; SIZE 0, ORDER 1: as the geometry says
#include <fcntl.h>
#include <gmsh.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <unordered_map>

#include "contents.hpp"
#include "reader/reader_main.hpp"

namespace {

using namespace dotyk::meshfile;
using dotyk::reader::answer, dotyk::reader::limit_reader;

/// The first error that Gmsh had to report; its exceptions name only the last.
std::string complaint() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  for (const std::string& line : log)
    if (line.rfind("Error", 0) == 0) return line.substr(line.find_first_not_of(" :", 5));
  return {};
}

void start() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::logger::start();
}

/// Runs a step of Gmsh's; what it reports as an error is one, whether it throws or not.
template <class Step>
void run(Step step) {
  std::string thrown;
  try {
    step();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    thrown = e.what();
    if (thrown.empty()) thrown = "it failed for an unknown reason";
  } catch (...) {  // Gmsh throws numbers, too
    thrown = "it failed for an unknown reason";
  }
  const std::string logged = complaint();
  if (logged.rfind("Error loading", 0) == 0) throw std::runtime_error("it is damaged or cut off");
  if (!logged.empty()) throw std::runtime_error("Gmsh: " + logged);
  if (!thrown.empty()) throw std::runtime_error("Gmsh: " + thrown);
}

struct Type {
  Shape shape{};
  bool known = false;
  int order = 1, nodes = 0, corners = 0;
  std::vector<int> between{};  ///< of order 2: which of its nodes stand in our order after the corners, -1: none
};

/// Gmsh's nodes between corners by their places in its reference element, `local` (dimension × nodes), which is straight.
std::vector<int> between(Shape shape, int dimension, const std::vector<double>& local) {
  std::vector<int> result;
  for (const std::vector<int>& corners : between_corners(shape)) {
    result.push_back(-1);
    for (std::size_t node = 0; (node + 1) * dimension <= local.size(); ++node) {
      double off = 0;
      for (int i = 0; i < dimension; ++i) {
        double mean = 0;
        for (const int k : corners) mean += local[static_cast<std::size_t>(k) * dimension + i] / static_cast<double>(corners.size());
        off += std::abs(local[node * dimension + i] - mean);
      }
      if (off < 1e-9) result.back() = static_cast<int>(node);
    }
  }
  return result;
}

Type type_of(int element) {
  std::string name;
  int dimension = 0;
  Type type;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(element, name, dimension, type.order, type.nodes, local, type.corners);
  static const std::pair<const char*, Shape> shapes[] = {
      {"Line", Shape::segment},           {"Triangle", Shape::triangle},     {"Quadrilateral", Shape::quadrilateral},
      {"Tetrahedron", Shape::tetrahedron}, {"Hexahedron", Shape::hexahedron}, {"Prism", Shape::prism},
      {"Pyramid", Shape::pyramid}};
  for (const auto& [start, shape] : shapes)
    if (name.rfind(start, 0) == 0 && type.corners == kind(shape).nodes) type.shape = shape, type.known = true;
  if (type.known && type.order == 2) type.between = between(type.shape, dimension, local);
  return type;
}

struct Element {
  int type = 0;
  std::vector<std::size_t> nodes;
};

/// From 4.9 on Gmsh says too where the element is.
template <class Get>
Element element(Get get, std::size_t number) {
  Element e;
  [[maybe_unused]] int dimension = 0, tag = 0;
  if constexpr (std::is_invocable_v<Get, std::size_t, int&, std::vector<std::size_t>&>)
    get(number, e.type, e.nodes);
  else
    get(number, e.type, e.nodes, dimension, tag);
  return e;
}

class Reader {
 public:
  Contents read() {
    gmsh::model::mesh::renumberElements();  // a file of version 4 can have two of one number
    read_nodes();
    read_groups();
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    for (const auto& [dimension, tag] : entities)
      if (dimension > 0) read_entity(dimension, tag);
    return std::move(contents_);
  }

 private:
  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> x, unused;
    gmsh::model::mesh::getNodes(tags, x, unused, -1, -1, false, false);
    if (x.size() != 3 * tags.size()) throw std::runtime_error("its nodes are damaged");
    if (tags.size() > 2'000'000'000) throw std::runtime_error("it has more nodes than this program can number");
    place_.reserve(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) place_.emplace(tags[i], static_cast<int>(i));
    contents_.points = std::move(x);
  }

  void read_groups() {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    for (const auto& [dimension, tag] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
      for (const int e : entities) groups_[{dimension, e}].push_back(static_cast<int>(contents_.groups.size()));
      contents_.groups.push_back({dimension, name.empty() ? std::to_string(tag) : name});
    }
  }

  void read_entity(int dimension, int tag) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
    for (std::size_t t = 0; t < types.size(); ++t) {
      add(dimension, tag, types[t], nodes[t]);
      read_others(dimension, tag, types[t], elements[t].size());
    }
  }

  /// Gmsh lists elements of a shape only as far as they are of the type of the first of them; these are the others, say of
  /// another order.
  void read_others(int dimension, int tag, int first, std::size_t listed) {
    std::vector<std::size_t> numbers, none;
    gmsh::model::mesh::preallocateElementsByType(first, true, false, numbers, none, tag);
    if (numbers.size() == listed) return;
    gmsh::model::mesh::getElementsByType(first, numbers, none, tag);  // by its name; it gives the whole shape
    std::map<int, std::vector<std::size_t>> nodes;
    std::size_t again = 0;
    for (const std::size_t number : numbers) {
      const Element e = element(gmsh::model::mesh::getElement, number);
      if (e.type == first) ++again;
      else nodes[e.type].insert(nodes[e.type].end(), e.nodes.begin(), e.nodes.end());
    }
    if (again != listed) throw std::runtime_error("its elements of several orders cannot be told apart; save all with one order");
    for (const auto& [type, all] : nodes) add(dimension, tag, type, all);
  }

  /// A block of elements of a type of Gmsh's, with their nodes one after the other.
  void add(int dimension, int tag, int element_type, const std::vector<std::size_t>& nodes) {
    const Type type = type_of(element_type);
    if (!type.known || type.nodes < 1) throw std::runtime_error("it has elements of an unknown type");
    Block block{type.shape, groups_[{dimension, tag}], {}, type.order};
    const std::size_t count = nodes.size() / type.nodes;
    block.nodes.reserve(count * type.corners);
    block.between.reserve(count * type.between.size());
    for (std::size_t i = 0; i < count * type.nodes; i += type.nodes) {
      for (int k = 0; k < type.corners; ++k) block.nodes.push_back(place(nodes[i + k]));
      for (const int k : type.between) block.between.push_back(k < 0 ? -1 : place(nodes[i + k]));
    }
    contents_.blocks.push_back(std::move(block));
  }

  int place(std::size_t node) const {
    const auto at = place_.find(node);
    if (at == place_.end()) throw std::runtime_error("node " + std::to_string(node) + " is used and not there");
    return at->second;
  }

  Contents contents_;
  std::unordered_map<std::size_t, int> place_;
  std::map<std::pair<int, int>, std::vector<int>> groups_;
};

Contents read_all() {
  Contents result;
  run([&] { result = Reader().read(); });
  return result;
}

/// Another name of the file, one without neighbours: beside FILE Gmsh looks for FILE.opt, and does what that says.
std::string lone_name(const std::string& file) {
  const int opened = open(file.c_str(), O_RDONLY | O_CLOEXEC);  // as long as this program runs
  if (opened < 0) throw std::runtime_error(std::string("cannot read it: ") + std::strerror(errno));
  return "/proc/self/fd/" + std::to_string(opened);
}

/// How many elements the file has, as Gmsh's log says; 0 where it does not say.
std::size_t elements_in_file() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::size_t all = 0;
  for (const std::string& line : log) {
    std::size_t count = 0;
    int end = 0;
    if (std::sscanf(line.c_str(), "Info: %zu element%n", &count, &end) == 1 && end > 0) all += count;
  }
  return all;
}

/// Gmsh drops elements without a word: of those that share a number in a file of version 2, all but the last.
void refuse_loss(const Contents& c) {
  std::vector<std::size_t> points, none;
  gmsh::model::mesh::preallocateElementsByType(15, true, false, points, none);
  std::size_t count = points.size();
  for (const Block& b : c.blocks) count += b.nodes.size() / kind(b.shape).nodes;
  const std::size_t said = elements_in_file();
  if (count < said)
    throw std::runtime_error(std::to_string(said - count) + " of its " + std::to_string(said) +
                             " elements are lost: their numbers are given more than once, or Gmsh's library does not hand over such elements");
}

Contents load(const std::string& file) {
  const std::string name = lone_name(file);
  start();
  run([&] { gmsh::merge(name); });
  const Contents result = read_all();
  refuse_loss(result);
  return result;
}

int geometry_dimension() {
  for (const int dimension : {3, 2}) {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dimension);
    if (!entities.empty()) return dimension;
  }
  throw std::runtime_error("the geometry has no surface and no volume to mesh");
}

Contents generate(const std::string& file, int dimension, double size, int order) {
  start();
  run([&] { gmsh::merge(file); });
  if (dimension == 0) dimension = geometry_dimension();
  if (size > 0) gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  if (order == 2) {
    gmsh::option::setNumber("Mesh.ElementOrder", 2);
    gmsh::option::setNumber("Mesh.HighOrderOptimize", 1);  // cells that curved sides would turn inside out
  }
  run([&] { gmsh::model::mesh::generate(dimension); });
  return read_all();
}

}  // namespace

int main(int count, char** argument) {
  const std::string verb = count > 1 ? argument[1] : "";
  if (verb == "load" && count == 3) {
    limit_reader(argument[2]);
    return answer([&](std::FILE* out) { write(out, load(argument[2])); });
  }
  if (verb == "mesh" && count == 6) {
    limit_reader();
    return answer([&](std::FILE* out) { write(out, generate(argument[2], std::stoi(argument[3]), std::stod(argument[4]), std::stoi(argument[5]))); });
  }
  return 2;
}

// Lets Gmsh mesh geometries, with its own library.
//   dotyk_gmsh FILE DIMENSION SIZE ORDER     DIMENSION 0: that of the geometry; SIZE 0, ORDER 1: as the geometry says
#include <gmsh.h>

#include <cstdio>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "gmsh_types.hpp"
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
  if (!logged.empty()) throw std::runtime_error("Gmsh: " + logged);
  if (!thrown.empty()) throw std::runtime_error("Gmsh: " + thrown);
}

class Reader {
 public:
  Contents read() {
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
      // Gmsh lists elements of a shape only as far as they are of the type of the first of them.
      std::vector<std::size_t> all, none;
      gmsh::model::mesh::preallocateElementsByType(types[t], true, false, all, none, tag);
      if (all.size() != elements[t].size()) throw std::runtime_error("a geometry with elements of several orders; mesh it with one");
      add(dimension, tag, types[t], nodes[t]);
    }
  }

  /// A block of elements of a type of Gmsh's, with their nodes one after the other.
  void add(int dimension, int tag, int number, const std::vector<std::size_t>& nodes) {
    const GmshType type = gmsh_type(number);
    if (!type.shape) throw std::runtime_error("it has elements of an unknown type");
    Block block{*type.shape, groups_[{dimension, tag}], {}, type.order};
    std::vector<int> places;
    for (const std::size_t node : nodes) places.push_back(place(node));
    for (std::size_t k = 0; k + type.nodes <= places.size(); k += type.nodes) add_element(type, block, &places[k]);
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
  if (count == 5) {
    limit_reader();
    return answer([&](std::FILE* out) { write(out, generate(argument[1], std::stoi(argument[2]), std::stod(argument[3]), std::stoi(argument[4]))); });
  }
  return 2;
}

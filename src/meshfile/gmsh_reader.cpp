// Lets Gmsh mesh geometries, with its own library.
//   dotyk_gmsh FILE DIMENSION SIZE ORDER     DIMENSION 0: that of the geometry; SIZE 0, ORDER 1: as the geometry says
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

#include "reader/reader_main.hpp"

namespace {

using namespace dotyk::reader;

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

template <class Sequence>
void put_values(std::FILE* out, const Sequence& values) {
  for (const auto& value : values) put(out, value);
}

struct Elements {
  int dimension, entity, type;
  std::vector<std::size_t> numbers, nodes;
};

/// Of all entities; Gmsh lists elements of a shape only as far as they are of the type of the first of them.
std::vector<Elements> all_elements(const gmsh::vectorpair& entities) {
  std::vector<Elements> result;
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> numbers, nodes;
    gmsh::model::mesh::getElements(types, numbers, nodes, dimension, tag);
    for (std::size_t t = 0; t < types.size(); ++t) {
      std::vector<std::size_t> all, none;
      gmsh::model::mesh::preallocateElementsByType(types[t], true, false, all, none, tag);
      if (all.size() != numbers[t].size()) throw std::runtime_error("it has elements of several orders; mesh it with one");
      result.push_back({dimension, tag, types[t], std::move(numbers[t]), std::move(nodes[t])});
    }
  }
  return result;
}

/// The model as a file of version 4.1, binary; see read_msh().
void write_model(std::FILE* out) {
  using Size = std::uint64_t;
  std::fputs("$MeshFormat\n4.1 1 8\n", out), put(out, 1);
  gmsh::vectorpair groups, entities;
  gmsh::model::getPhysicalGroups(groups);
  std::fprintf(out, "\n$EndMeshFormat\n$PhysicalNames\n%zu\n", groups.size());
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    std::fprintf(out, "%d %d \"%s\"\n", dimension, tag, name.empty() ? std::to_string(tag).c_str() : name.c_str());
  }
  std::fputs("$EndPhysicalNames\n$Entities\n", out);
  gmsh::model::getEntities(entities);
  Size count[4] = {};
  for (const auto& entity : entities) ++count[entity.first];
  put_values(out, count);
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> physical;
    gmsh::model::getPhysicalGroupsForEntity(dimension, tag, physical);
    put(out, tag), put_values(out, std::vector<double>(dimension == 0 ? 3 : 6)), put_all(out, physical);
    if (dimension > 0) put(out, Size{0});
  }
  std::vector<std::size_t> nodes;
  std::vector<double> x, unused;
  gmsh::model::mesh::getNodes(nodes, x, unused, -1, -1, false, false);
  std::fputs("\n$EndEntities\n$Nodes\n", out), put_values(out, std::vector<Size>{1, nodes.size(), 0, 0});
  put_values(out, std::vector<int>{0, 0, 0}), put_all(out, nodes), put_values(out, x);
  const std::vector<Elements> elements = all_elements(entities);
  Size all = 0;
  for (const Elements& e : elements) all += e.numbers.size();
  std::fputs("\n$EndNodes\n$Elements\n", out), put_values(out, std::vector<Size>{elements.size(), all, 0, 0});
  for (const Elements& e : elements) {
    put_values(out, std::vector<int>{e.dimension, e.entity, e.type}), put(out, Size{e.numbers.size()});
    const std::size_t each = e.nodes.size() / e.numbers.size();
    for (std::size_t k = 0; k < e.numbers.size(); ++k) {
      put(out, e.numbers[k]);
      for (std::size_t i = 0; i < each; ++i) put(out, e.nodes[k * each + i]);
    }
  }
  std::fputs("\n$EndElements\n", out);
}

int geometry_dimension() {
  for (const int dimension : {3, 2}) {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dimension);
    if (!entities.empty()) return dimension;
  }
  throw std::runtime_error("the geometry has no surface and no volume to mesh");
}

/// Cells that curved sides turn inside out, as far as Gmsh can. That it cannot it calls an error; dotyk refuses them by their places.
void mend_curved_cells() {
  std::vector<std::size_t> nodes, again;
  std::vector<double> before, after, unused;
  gmsh::model::mesh::getNodes(nodes, before, unused, -1, -1, false, false);
  try {
    gmsh::model::mesh::optimize("HighOrder");
  } catch (...) {
  }
  gmsh::model::mesh::getNodes(again, after, unused, -1, -1, false, false);
  if (again != nodes || !std::all_of(after.begin(), after.end(), [](double x) { return std::isfinite(x); }))
    for (std::size_t k = 0; k < nodes.size(); ++k) gmsh::model::mesh::setNode(nodes[k], {&before[3 * k], &before[3 * k] + 3}, {});
  gmsh::logger::stop();
  gmsh::logger::start();
}

void generate(const std::string& file, int dimension, double size, int order) {
  start();
  run([&] { gmsh::merge(file); });
  if (dimension == 0) dimension = geometry_dimension();
  if (size > 0) gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  if (order == 2) gmsh::option::setNumber("Mesh.ElementOrder", 2);
  gmsh::option::setNumber("Mesh.HighOrderOptimize", 0);
  run([&] { gmsh::model::mesh::generate(dimension); });
  if (order == 2) mend_curved_cells();
}

}  // namespace

int main(int count, char** argument) {
  if (count == 5) {
    limit_reader();
    return answer([&](std::FILE* out) {
      generate(argument[1], std::stoi(argument[2]), std::stod(argument[3]), std::stoi(argument[4]));
      run([&] { write_model(out); });
    });
  }
  return 2;
}

#include "meshfile/cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "meshfile/between.hpp"
#include "meshfile/cell_of.hpp"

namespace dotyk::meshfile {
namespace {

/// Of order 1.
mesh::Element element(const Contents& c, const std::vector<const Block*>& blocks, const std::string& what) {
  std::map<Shape, std::set<std::string>> regions;
  for (const Block* b : blocks) {
    auto& here = regions[b->shape];
    for (const int g : b->groups) here.insert(c.groups[g].name);
  }
  if (regions.size() > 1) {
    std::string found;
    for (const auto& [shape, where] : regions)
      found += text(found.empty() ? "" : "; ", kind(shape).plural, where.empty() ? "" : " in " + list(where));
    throw InputError(text(what, ": a mesh has cells of one shape, and these are of several (", found,
                          "): load one region, or mesh with one shape"));
  }
  if (regions.empty()) throw InputError(what + ": these regions hold no cells");
  if (const auto cell = cell_of(regions.begin()->first)) return *cell;
  throw InputError(text(what, ": its cells are ", kind(regions.begin()->first).plural, "; there are elements for triangles, quadrilaterals, ",
                        "tetrahedra and hexahedra: mesh it with one of these"));
}

/// Places of nodes in the contents, cell by cell.
struct Cells {
  std::vector<int> corners, between;  ///< -1 where there is none between
};

/// The cells, each once; `between` nodes of each where they are asked for (not 0).
Cells cells(const std::vector<const Block*>& blocks, int each, int between) {
  Cells all, once;
  for (const Block* b : blocks) {
    all.corners.insert(all.corners.end(), b->nodes.begin(), b->nodes.end());
    if (between > 0) all.between.insert(all.between.end(), b->between.begin(), b->between.end());
    all.between.resize(all.corners.size() / each * between, -1);
  }
  const std::size_t count = all.corners.size() / each;
  const auto at = [&](std::size_t c) { return all.corners.begin() + static_cast<std::ptrdiff_t>(c * each); };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto less = std::lexicographical_compare_three_way(at(a), at(a) + each, at(b), at(b) + each);
    return less < 0 || (less == 0 && a < b);
  });
  std::vector<char> again(count, 0);
  for (std::size_t k = 1; k < count; ++k)
    again[order[k]] = std::equal(at(order[k]), at(order[k]) + each, at(order[k - 1]));
  for (std::size_t c = 0; c < count; ++c) {
    if (again[c]) continue;
    once.corners.insert(once.corners.end(), at(c), at(c) + each);
    const auto first = all.between.begin() + static_cast<std::ptrdiff_t>(c * between);
    once.between.insert(once.between.end(), first, first + between);
  }
  return once;
}

/// Plane meshes: z must not vary, by more than rounding of the file's numbers.
void check_plane(const Contents& c, const Cells& cells, const std::string& what) {
  mesh::Box box;
  for (const std::vector<int>* nodes : {&cells.corners, &cells.between})
    for (const int n : *nodes)
      if (n >= 0) box.add(mesh::at_node(c.points, n, 3));
  if (!(box.extent(2) > 1e-9 * std::max(box.extent(0), box.extent(1)))) return;
  for (int k = 0; k < 2; ++k)
    if (!(box.extent(k) > 1e-9 * box.extent(2)))
      throw InputError(text(what, ": its cells lie in a plane of constant ", "xy"[k], "; turn them into the plane of x and y"));
  throw InputError(what + ": its cells are a surface in space, not a solid and not in the plane of x and y; for a solid, mesh the volume");
}

/// The mesh of the corners; `number` gets the new numbers of the file's nodes, -1 for those left out.
mesh::Mesh compact(const Contents& c, mesh::Element element, std::vector<int> cells, std::vector<int>& number) {
  mesh::Mesh mesh;
  mesh.element = element;
  number.assign(c.points.size() / 3, -1);
  for (const int n : cells) number[n] = 0;
  int count = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = count++;
    for (int k = 0; k < mesh.dimension(); ++k) mesh.coordinates.push_back(c.points[3 * n + k]);
  }
  for (int& n : cells) n = number[n];
  mesh.cells = std::move(cells);
  return mesh;
}

/// Puts left-handed cells into right-handed order; those twisted either way stay for mesh::check to refuse.
void turn_over(mesh::Mesh& mesh) {
  static const std::vector<int> mirrored[] = {{0, 2, 1}, {0, 3, 2, 1}, {0, 2, 1, 3}, {4, 5, 6, 7, 0, 1, 2, 3}};
  const std::vector<int> order = all_nodes(mesh.topology(), mirrored[static_cast<int>(mesh::first_order(mesh.element))]);
  const int n = mesh.topology().nodes;
  std::vector<int> before(n);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (!(mesh::least_jacobian(mesh, c) < 0)) continue;
    int* cell = &mesh.cells[static_cast<std::size_t>(c) * n];
    std::copy(cell, cell + n, before.begin());
    for (int k = 0; k < n; ++k) cell[k] = before[order[k]];
    if (!(mesh::least_jacobian(mesh, c) > 0)) std::copy(before.begin(), before.end(), cell);
  }
}

}  // namespace

mesh::Mesh mesh_of(const Contents& contents, const std::vector<const Block*>& blocks, int order, std::vector<int>& number, const std::string& what) {
  const mesh::Element first = element(contents, blocks, what);
  const mesh::ElementTopology& t = mesh::topology(order == 2 ? mesh::second_order(first) : first);
  Cells all = cells(blocks, t.corners, t.nodes - t.corners);
  if (all.corners.size() + all.between.size() > 1'600'000'000) throw InputError(what + ": it has more cells than this program can number");
  if (t.dimension == 2) check_plane(contents, all, what);
  mesh::Mesh mesh = compact(contents, first, std::move(all.corners), number);
  // To tell which nodes cells share takes most.
  if (order == 2) require_memory(static_cast<double>(mesh.cell_count()) * (8 * t.nodes + 40 * (t.nodes - t.corners)), "cells of order 2 of '" + what + "'");
  if (order == 2) mesh = with_nodes_between(std::move(mesh), all.between, contents.points, number, what);
  turn_over(mesh);
  return mesh;
}

}  // namespace dotyk::meshfile

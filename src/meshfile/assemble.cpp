#include "meshfile/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "base/text.hpp"
#include "meshfile/facet_table.hpp"

namespace dotyk::meshfile {
namespace {

/// "a, b, c", no more than a dozen.
std::string list(const std::set<std::string>& names) {
  std::string out;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > 12) return out + text(" and ", names.size() - 12, " more");
    out += (count > 1 ? ", '" : "'") + name + "'";
  }
  return out.empty() ? "none" : out;
}

void check_numbers(const Contents& c, const std::string& what) {
  if (c.points.size() % 3 != 0) throw InputError(what + ": its nodes are damaged");
  const auto nodes = static_cast<long long>(c.points.size() / 3);
  for (const Block& b : c.blocks) {
    if (b.nodes.size() % kind(b.shape).nodes != 0) throw InputError(text(what, ": its ", kind(b.shape).plural, " are damaged"));
    for (const int n : b.nodes)
      if (n < 0 || n >= nodes) throw InputError(text(what, ": one of its ", kind(b.shape).plural, " has a node that is not there"));
    for (const int g : b.groups)
      if (g < 0 || g >= static_cast<int>(c.groups.size())) throw InputError(what + ": its groups are damaged");
  }
}

int dimension(const Contents& c, const std::string& what) {
  int greatest = 0;
  for (const Block& b : c.blocks)
    if (!b.nodes.empty()) greatest = std::max(greatest, kind(b.shape).dimension);
  if (greatest < 2)
    throw InputError(what + ": it holds no cells: no triangles or quadrilaterals, tetrahedra or hexahedra");
  return greatest;
}

std::set<std::string> names(const Contents& c, int dim) {
  std::set<std::string> result;
  for (const Group& g : c.groups)
    if (g.dimension == dim) result.insert(g.name);
  return result;
}

void check_regions(const Contents& c, int dim, const std::vector<std::string>& regions, const std::string& what) {
  const std::set<std::string> there = names(c, dim), parts = names(c, dim - 1);
  for (const std::string& wanted : regions)
    if (!there.count(wanted))
      throw InputError(text(what, ": there is no region '", wanted, "'", parts.count(wanted) ? " (a boundary part has that name)" : "",
                            "; regions: ", list(there)));
}

/// The blocks of the cells asked for.
std::vector<const Block*> chosen_blocks(const Contents& c, int dim, const std::vector<std::string>& regions) {
  std::vector<const Block*> result;
  for (const Block& b : c.blocks) {
    if (kind(b.shape).dimension != dim || b.nodes.empty()) continue;
    const bool wanted = regions.empty() || std::any_of(b.groups.begin(), b.groups.end(), [&](int g) {
      return std::find(regions.begin(), regions.end(), c.groups[g].name) != regions.end();
    });
    if (wanted) result.push_back(&b);
  }
  return result;
}

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
  switch (const Shape shape = regions.begin()->first) {
    case Shape::triangle: return mesh::Element::triangle_p1;
    case Shape::quadrilateral: return mesh::Element::quadrilateral_q1;
    case Shape::tetrahedron: return mesh::Element::tetrahedron_p1;
    case Shape::hexahedron: return mesh::Element::hexahedron_q1;
    default:
      throw InputError(text(what, ": its cells are ", kind(shape).plural, "; there are elements for triangles, quadrilaterals, ",
                            "tetrahedra and hexahedra: mesh it with one of these"));
  }
}

/// The cells by the file's node numbers, each once.
std::vector<int> cells(const std::vector<const Block*>& blocks, int each) {
  std::vector<int> all;
  for (const Block* b : blocks) all.insert(all.end(), b->nodes.begin(), b->nodes.end());
  const std::size_t count = all.size() / each;
  const auto at = [&](std::size_t c) { return all.begin() + static_cast<std::ptrdiff_t>(c * each); };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto less = std::lexicographical_compare_three_way(at(a), at(a) + each, at(b), at(b) + each);
    return less < 0 || (less == 0 && a < b);
  });
  std::vector<char> again(count, 0);
  for (std::size_t k = 1; k < count; ++k)
    again[order[k]] = std::equal(at(order[k]), at(order[k]) + each, at(order[k - 1]));
  std::vector<int> once;
  once.reserve(all.size());
  for (std::size_t c = 0; c < count; ++c)
    if (!again[c]) once.insert(once.end(), at(c), at(c) + each);
  return once;
}

/// Plane meshes: z must not vary, by more than rounding of the file's numbers.
void check_plane(const Contents& c, const std::vector<int>& nodes, const std::string& what) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (const int n : nodes)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c.points[3 * static_cast<std::size_t>(n) + k]);
      high[k] = std::max(high[k], c.points[3 * static_cast<std::size_t>(n) + k]);
    }
  const double size = std::max(high[0] - low[0], high[1] - low[1]);
  if (!(high[2] - low[2] > 1e-9 * size)) return;
  for (int k = 0; k < 2; ++k)
    if (!(high[k] - low[k] > 1e-9 * (high[2] - low[2])))
      throw InputError(text(what, ": its cells lie in a plane of constant ", "xy"[k], "; turn them into the plane of x and y"));
  throw InputError(what + ": its cells are a surface in space, not a solid and not in the plane of x and y; for a solid, mesh the volume");
}

/// The mesh without parts; `number` gets the new numbers of the file's nodes, -1 for those left out.
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
  const std::vector<int>& order = mirrored[static_cast<int>(mesh.element)];
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

/// Do the outward cycles of two facets with the same nodes run the same way round?
bool same_way(const mesh::Mesh& mesh, mesh::Facet f, mesh::Facet g) {
  const int n = mesh.topology().nodes_per_facet, first = mesh.facet_node(f, 0);
  int at = 0;
  while (mesh.facet_node(g, at) != first) ++at;
  return mesh.facet_node(g, (at + 1) % n) == mesh.facet_node(f, 1) && (n > 2 || at == 0);
}

/// Right-handed cells that share a facet lie on its two sides, unless the mesh is folded; there are never three.
void refuse_overlaps(const mesh::Mesh& mesh, const FacetTable& table, const std::string& what) {
  const auto& e = table.entries();
  for (std::size_t i = 0, end; i < e.size(); i = end) {
    for (end = i + 1; end < e.size() && e[end].nodes == e[i].nodes;) ++end;
    for (std::size_t j = i + 1; j < end; ++j)
      if (end - i > 2 || same_way(mesh, e[i].facet, e[j].facet)) {
        const mesh::Point x = mesh.facet_centre(e[i].facet);
        throw InputError(text(what, ": cells ", e[i].facet.cell + 1, " and ", e[j].facet.cell + 1, " overlap: they lie on the same side of their common facet near ",
                              point_text(x.data(), mesh.dimension())));
      }
  }
}

struct PartCount {
  int within = 0, elsewhere = 0;
};

/// The boundary facets that the elements of the block are, added to `part`.
PartCount add_facets(const Block& block, const FacetTable& table, const std::vector<int>& number, std::vector<mesh::Facet>& part) {
  const int each = kind(block.shape).nodes;
  PartCount left_out;
  for (std::size_t k = 0; k < block.nodes.size(); k += each) {
    int nodes[4];
    bool here = true;
    for (int i = 0; i < each; ++i) here = (nodes[i] = number[block.nodes[k + i]]) >= 0 && here;
    const auto found = here ? table.find(nodes, each) : std::vector<mesh::Facet>();
    if (found.size() == 1) part.push_back(found.front());
    else ++(found.empty() ? left_out.elsewhere : left_out.within);
  }
  return left_out;
}

void add_parts(const Contents& c, const FacetTable& table, const std::vector<int>& number, bool whole, Loaded& loaded) {
  mesh::Mesh& mesh = loaded.mesh;
  std::map<std::string, PartCount> left_out;
  for (const Block& b : c.blocks) {
    if (kind(b.shape).dimension != mesh.dimension() - 1) continue;
    for (const int g : b.groups) {
      std::vector<mesh::Facet>& part = mesh.parts[c.groups[g].name];
      const PartCount here = add_facets(b, table, number, part);
      left_out[c.groups[g].name].within += here.within, left_out[c.groups[g].name].elsewhere += here.elsewhere;
    }
  }
  for (auto& [name, facets] : mesh.parts) {
    std::sort(facets.begin(), facets.end(), [](mesh::Facet a, mesh::Facet b) { return a.cell != b.cell ? a.cell < b.cell : a.local < b.local; });
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  }
  std::erase_if(mesh.parts, [](const auto& part) { return part.second.empty(); });
  for (const auto& [name, count] : left_out) {
    const std::string gone = mesh.parts.count(name) ? "" : ", so there is no such part";
    if (count.within) loaded.notes.push_back(text("part '", name, "': ", count.within, " of its facets lie between cells and are left out", gone));
    if (count.elsewhere && whole) loaded.notes.push_back(text("part '", name, "': ", count.elsewhere, " of its facets are of no cell and are left out", gone));
  }
}

}  // namespace

Loaded assemble(const Contents& contents, const std::vector<std::string>& regions, const std::string& what) {
  check_numbers(contents, what);
  const int dim = dimension(contents, what);
  check_regions(contents, dim, regions, what);
  const auto blocks = chosen_blocks(contents, dim, regions);
  const mesh::Element cell = element(contents, blocks, what);
  std::vector<int> nodes = cells(blocks, mesh::topology(cell).nodes), number;
  if (nodes.size() > 1'600'000'000) throw InputError(what + ": it has more cells than this program can number");
  if (dim == 2) check_plane(contents, nodes, what);
  Loaded loaded{compact(contents, cell, std::move(nodes), number), {}, {}};
  turn_over(loaded.mesh);
  mesh::check(loaded.mesh, what);
  const FacetTable table(loaded.mesh);
  refuse_overlaps(loaded.mesh, table, what);
  if (contents.order > 1)
    loaded.notes.push_back(text("its elements are of order ", contents.order, "; only their corners are used, so that curved sides become straight"));
  add_parts(contents, table, number, regions.empty(), loaded);
  std::set<std::string> in;
  for (const Block* b : blocks)
    for (const int g : b->groups)
      if (regions.empty() || std::find(regions.begin(), regions.end(), contents.groups[g].name) != regions.end()) in.insert(contents.groups[g].name);
  loaded.regions.assign(in.begin(), in.end());
  return loaded;
}

}  // namespace dotyk::meshfile

#include "meshfile/assemble.hpp"

#include <algorithm>
#include <climits>
#include <map>
#include <set>

#include "base/error.hpp"
#include "meshfile/cells.hpp"
#include "mesh/facet_table.hpp"

namespace dotyk::meshfile {
namespace {

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

void refuse_above_second(const std::vector<const Block*>& blocks, const std::string& what) {
  for (const Block* b : blocks)
    if (b->order > 2) throw InputError(text(what, ": its elements are of order ", b->order, "; save it with order 2, or load it with order = 1, by the corners"));
}

/// What the cells' order changes of the file's.
void note_order(const std::vector<const Block*>& blocks, int order, std::vector<std::string>& notes) {
  int least = INT_MAX, greatest = 0;
  for (const Block* b : blocks) least = std::min(least, b->order), greatest = std::max(greatest, b->order);
  if (greatest > order)
    notes.push_back(text("its elements are of order ", greatest, "; only their corners are used, so that curved sides become straight",
                         greatest == 2 ? " (order = 2 takes them as they are)" : ""));
  if (least < order)
    notes.push_back(text(greatest > least ? "some of " : "", "its elements are of order 1; nodes are put in the middle of their straight sides"));
}

/// What becomes of the file's groups, where that is not one region or part for each.
void note_groups(const Contents& c, int dim, std::vector<std::string>& notes) {
  std::map<std::pair<int, std::string>, int> count;
  for (const Group& g : c.groups) ++count[{g.dimension, g.name}];
  for (const auto& [group, n] : count) {
    const auto& [of, name] = group;
    if (of < dim - 1) notes.push_back(text("group '", name, "' is of ", of == 0 ? "points" : "lines", "; it is neither a region nor a part of the boundary"));
    else if (n > 1) notes.push_back(text(of == dim ? "region '" : "part '", name, "': ", n, " groups of the file have this name; it is all of them"));
  }
}

/// Two facets have the same corners: do they list them in opposite directions?
bool opposite(const mesh::Mesh& mesh, mesh::Facet f, mesh::Facet g) {
  const int n = mesh.topology().facet_corners, first = mesh.facet_node(f, 0);
  int at = 0;
  while (mesh.facet_node(g, at) != first) ++at;
  return n == 2 ? at == 1 : mesh.facet_node(g, (at + n - 1) % n) == mesh.facet_node(f, 1);
}

/// Right-handed cells that share a facet lie on its two sides, unless the mesh is folded. Of three, two lie on one side.
void refuse_overlaps(const mesh::Mesh& mesh, const mesh::FacetTable& table, const std::string& what) {
  for (int node = 0; node < mesh.node_count(); ++node)
    table.pairs(node, [&](mesh::Facet f, mesh::Facet g) {
      if (opposite(mesh, f, g)) return;
      const mesh::Point x = mesh.facet_centre(f);
      throw InputError(text(what, ": cells ", f.cell + 1, " and ", g.cell + 1, " overlap: they lie on the same side of their common facet near ",
                            point_text(x.data(), mesh.dimension())));
    });
}

struct PartCount {
  int within = 0, elsewhere = 0;
};

/// The boundary facets that the elements of the block are, added to `part`.
PartCount add_facets(const Block& block, const mesh::FacetTable& table, const std::vector<int>& number, std::vector<mesh::Facet>& part) {
  const int each = kind(block.shape).nodes;
  PartCount left_out;
  for (std::size_t k = 0; k < block.nodes.size(); k += each) {
    int nodes[4];
    bool here = true;
    for (int i = 0; i < each; ++i) here = (nodes[i] = number[block.nodes[k + i]]) >= 0 && here;
    int count = 0;
    mesh::Facet found{};
    if (here) table.with(mesh::FacetTable::sorted(nodes, each), [&](mesh::Facet f) { found = f, ++count; });
    if (count == 1) part.push_back(found);
    else ++(count == 0 ? left_out.elsewhere : left_out.within);
  }
  return left_out;
}

void add_parts(const Contents& c, const mesh::FacetTable& table, const std::vector<int>& number, bool whole, Loaded& loaded) {
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
    std::sort(facets.begin(), facets.end());
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

Loaded assemble(const Contents& contents, const Choice& choice, const std::string& what) {
  check(contents, what);
  const std::vector<std::string>& regions = choice.regions;
  const int dim = dimension(contents, what);
  check_regions(contents, dim, regions, what);
  const auto blocks = chosen_blocks(contents, dim, regions);
  Loaded loaded;
  std::vector<int> number;
  if (choice.order == 2) refuse_above_second(blocks, what);
  loaded.mesh = mesh_of(contents, blocks, choice.order, number, what);
  mesh::check(loaded.mesh, what);
  const mesh::FacetTable table(loaded.mesh);
  refuse_overlaps(loaded.mesh, table, what);
  note_order(blocks, choice.order, loaded.notes);
  note_groups(contents, dim, loaded.notes);
  add_parts(contents, table, number, regions.empty(), loaded);
  std::set<std::string> in;
  for (const Block* b : blocks)
    for (const int g : b->groups)
      if (regions.empty() || std::find(regions.begin(), regions.end(), contents.groups[g].name) != regions.end()) in.insert(contents.groups[g].name);
  loaded.regions.assign(in.begin(), in.end());
  return loaded;
}

}  // namespace dotyk::meshfile

// From a solution to its file for ParaView; the .pvtu of bodies that ranks refine: each rank writes its cells.
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <unordered_map>
#include <utility>

#include "base/whole_file.hpp"
#include "contact/matching.hpp"
#include "elasticity/stress.hpp"
#include "figure/compose/compose.hpp"
#include "figure/compose/compose_plate.hpp"
#include "figure/door/drawing.hpp"
#include "scene/model/slices.hpp"

namespace dotyk::figure {
namespace {

using scene::Contact;
using scene::Solution;

/// The first node of every body in the file, and the number of all.
std::vector<std::size_t> first_nodes(const scene::Scene& scene) {
  std::vector<std::size_t> first{0};
  for (const auto& body : scene.bodies) first.push_back(first.back() + body->mesh->node_count());
  return first;
}

void add_points(const mesh::Mesh& mesh, GridFile& file) {
  for (int n = 0; n < mesh.node_count(); ++n) {
    const mesh::Point x = mesh.point(n);
    file.points.insert(file.points.end(), x.begin(), x.end());
  }
}

void add_body(const Solution& s, int index, std::size_t first, GridFile& file) {
  const mesh::Mesh& mesh = *s.scene().bodies[index]->mesh;
  GridBody& body = file.bodies.emplace_back(GridBody{s.scene().bodies[index]->name, cell_shape(mesh), {}, mesh.topology().order});
  const std::vector<char> known = mesh::surrounded_cells(mesh);
  body.cells.reserve(mesh.cells.size());
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < mesh.topology().nodes && known[c]; ++k) body.cells.push_back(mesh.cell(c)[k] + static_cast<int>(first));
  add_points(mesh, file);
}

void add_fields(const Solution& s, GridFile& file) {
  NodeArrays arrays;
  for (int b = 0; b < static_cast<int>(s.scene().bodies.size()); ++b)
    for (int n = 0; n < s.scene().bodies[b]->mesh->node_count(); ++n) arrays.add(mesh::at_node(s.displacement(b), n, s.scene().dimension()), s.stress(b)[n]);
  file.arrays = std::move(arrays).all();
}

/// Leaves out points that no cell has.
void drop_stray_points(GridFile& file) {
  std::vector<int> number(file.points.size() / 3, -1);
  for (const GridBody& body : file.bodies)
    for (const int node : body.cells) number[node] = 0;
  int count = 0;
  for (int& n : number)
    if (n == 0) n = count++;
  const auto keep = [&](std::vector<double>& values) {
    const std::size_t each = values.size() / number.size();
    std::vector<double> kept;
    for (std::size_t n = 0; n < number.size(); ++n)
      if (number[n] >= 0) kept.insert(kept.end(), values.begin() + static_cast<std::ptrdiff_t>(n * each), values.begin() + static_cast<std::ptrdiff_t>((n + 1) * each));
    values.swap(kept);
  };
  keep(file.points);
  for (GridArray& array : file.arrays) keep(array.values);
  for (GridBody& body : file.bodies)
    for (int& node : body.cells) node = number[node];
}

/// Conditions of order 2 stand at corners, and what they say is linear (bilinear) between: its values at the facets' other nodes.
std::vector<scene::ContactNode> with_nodes_between(const Contact& contact, std::vector<scene::ContactNode> nodes) {
  const mesh::Mesh& mesh = *contact.first.body->mesh;
  const mesh::ElementTopology& t = mesh.topology();
  std::map<std::pair<int, int>, int> at;  // facet and node → condition
  for (std::size_t k = 0; t.order == 2 && k < nodes.size(); ++k)
    for (const int f : contact.rows[k].facets) at[{f, nodes[k].node}] = static_cast<int>(k);
  for (int f = 0; !at.empty() && f < static_cast<int>(contact.first.facets.size()); ++f)
    for (int k = t.facet_corners; k < t.nodes_per_facet; ++k) {
      scene::ContactNode between{.node = mesh.facet_node(contact.first.facets[f], k)};
      double most = -INFINITY, sum = 0;
      for (int c = 0; c < t.facet_corners; ++c) {
        const auto row = at.find({f, mesh.facet_node(contact.first.facets[f], c)});
        const double weight = mesh::corner_hat(t, c, k);
        if (row == at.end() || weight == 0) continue;
        const scene::ContactNode& corner = nodes[row->second];
        sum += weight, between.pressure += weight * corner.pressure, between.gap += weight * corner.gap;
        if (corner.pressure > most) most = corner.pressure, between.status = corner.status;
      }
      if (sum > 1 - 1e-9) nodes.push_back(between);
    }
  return nodes;
}

/// Of a contact whose nodes match: node of the first part → that across.
std::unordered_map<int, int> across(const Contact& contact) {
  std::unordered_map<int, int> node;
  if (!contact.second.body || contact.pairing != contact::Pairing::matching) return node;
  const scene::Part &first = contact.first, &second = contact.second;
  if (first.body->mesh->topology().order == 1)
    for (const contact::ContactRow& row : contact.rows) node.emplace(row.node, row.partners.front().node);
  else
    for (const auto& pair : contact::find_matching({*first.body->mesh, first.facets, ""}, {*second.body->mesh, second.facets, ""}).pairs)
      node.emplace(pair.first, pair.second);
  return node;
}

std::vector<int> letters(const std::string& text) { return {text.begin(), text.end()}; }
std::string text_of(const std::vector<int>& letters) { return {letters.begin(), letters.end()}; }

/// a.pvtu, rank → a_rank.vtu in the same folder.
std::string piece_name(const std::string& list, int rank) {
  const std::filesystem::path place(list);
  return (place.parent_path() / text(place.stem().string(), "_", rank, ".vtu")).string();
}

// What rank 0 says: the name of the list, those of the bodies; pressures, gaps and statuses at the nodes of contacts, where there are contacts.
enum Whole { kFile, kFirstName };

/// The arrays of the contacts at the nodes of a piece, from those at some nodes.
void add_contacts(const std::vector<int>& number, const std::vector<int>& nodes, const Lists& said, GridFile& file) {
  if (said.real.empty()) return;
  std::unordered_map<int, std::size_t> place;
  for (std::size_t k = 0; k < nodes.size(); ++k) place.emplace(nodes[k], k);
  std::vector<GridArray> arrays = contact_arrays(number.size());
  for (std::size_t n = 0; n < number.size(); ++n)
    if (const auto at = place.find(number[n]); at != place.end())
      for (std::size_t a = 0; a < arrays.size(); ++a) arrays[a].values[n] = said.real[a][at->second];
  for (GridArray& array : arrays) file.arrays.push_back(std::move(array));
}

/// The rank's own cells.
GridFile piece(const multigrid::VisitedCells& at, const Lists& said) {
  GridFile file{piece_name(text_of(said.whole[kFile]), at.rank), {}, {}, {}};
  NodeArrays arrays;
  std::vector<int> number;  // of the piece's nodes, among those of all ranks
  for (std::size_t name = kFirstName; name < said.whole.size(); ++name) file.bodies.push_back({text_of(said.whole[name]), CellShape::triangle, {}, 1});
  scene::each_body(at, [&](const elasticity::ShareCells& cells, const std::vector<double>& u, std::size_t first) {
    const mesh::Mesh& mesh = cells.mesh;
    const std::vector<elasticity::Stress> stress = elasticity::nodal_stress(mesh, cells.material, u);
    GridBody& body = file.bodies[static_cast<std::size_t>(cells.body)];
    body.shape = cell_shape(mesh), body.order = mesh.topology().order;
    std::vector<int> place(static_cast<std::size_t>(mesh.node_count()), -1);
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int k = 0; k < mesh.topology().nodes && scene::owns(at, first, mesh, c); ++k) {
        const int node = mesh.cell(c)[k];
        if (place[node] < 0) {
          place[node] = static_cast<int>(number.size()), number.push_back(at.number[first + static_cast<std::size_t>(node)]);
          const mesh::Point x = mesh.point(node);
          file.points.insert(file.points.end(), x.begin(), x.end());
          arrays.add(mesh::at_node(u, node, mesh.dimension()), stress[node]);
        }
        body.cells.push_back(place[node]);
      }
  });
  file.arrays = std::move(arrays).all();
  add_contacts(number, at.told, said, file);
  return file;
}

}  // namespace

void NodeArrays::add(const Vec3& u, const elasticity::Stress& at_node) {
  displacement_.values.insert(displacement_.values.end(), u.begin(), u.end());
  for (const int v : {0, 1, 2, 5, 3, 4}) stress_.values.push_back(at_node[v]);  // ours is xx yy zz yz xz xy
  von_mises_.values.push_back(elasticity::von_mises(at_node));
}

std::vector<GridArray> contact_arrays(std::size_t nodes) {
  return {{"contact_pressure", {""}, std::vector<double>(nodes, 0.0)}, {"contact_gap", {""}, std::vector<double>(nodes, NAN)}, {"contact_status", {""}, std::vector<double>(nodes, -1.0)}};
}

std::vector<GridArray> contact_arrays(const Solution& s) {
  const std::vector<std::size_t> first = first_nodes(s.scene());
  std::vector<GridArray> arrays = contact_arrays(first.back());
  GridArray &pressure = arrays[0], &gap = arrays[1], &status = arrays[2];
  const auto show = [&](std::size_t node, const scene::ContactNode& n) {
    const double p = pressure.values[node];
    if (status.values[node] >= 0 && (p > n.pressure || (p == n.pressure && gap.values[node] <= n.gap))) return;
    pressure.values[node] = n.pressure;
    gap.values[node] = n.gap;
    status.values[node] = static_cast<int>(n.status);
  };
  bool any = false;
  for (const auto& contact : s.scene().contacts) {
    if (contact->kind != Contact::Kind::contact) continue;
    any = true;
    const int one = s.scene().index_of(contact->first.body.get());
    const int other = s.scene().index_of(contact->second.body.get());
    const std::unordered_map<int, int> partner = across(*contact);
    for (const scene::ContactNode& n : with_nodes_between(*contact, s.contact(*contact).nodes)) {
      show(first[one] + n.node, n);
      if (const auto at = partner.find(n.node); at != partner.end()) show(first[other] + at->second, n);
    }
  }
  return any ? arrays : std::vector<GridArray>();
}

GridFile compose_grid(const Solution& s, const std::string& name) {
  GridFile file{name, {}, {}, {}};
  const auto first = first_nodes(s.scene());
  for (int b = 0; b < static_cast<int>(s.scene().bodies.size()); ++b) add_body(s, b, first[b], file);
  add_fields(s, file);
  for (GridArray& array : contact_arrays(s)) file.arrays.push_back(std::move(array));
  if (std::ranges::any_of(s.scene().bodies, [](const auto& body) { return body->unrefined != nullptr; })) drop_stray_points(file);
  return file;
}

GridFile compose_grid(const plate::Solution& s, const std::string& file) {
  const mesh::Mesh& mesh = *s.plate().mesh;
  GridFile grid{file, {}, {{"plate", CellShape::triangle, mesh.cells}}, {}};
  GridArray displacement{"displacement", {"x", "y", "z"}, {}}, moment{"moment", {"xx", "yy", "xy"}, {}};
  add_points(mesh, grid);
  for (int n = 0; n < mesh.node_count(); ++n) {
    displacement.values.insert(displacement.values.end(), {0, 0, s.vertex_deflection(n)});
    const plate::Moment& m = s.vertex_moments()[n];
    moment.values.insert(moment.values.end(), {m.xx, m.yy, m.xy});
  }
  grid.arrays = {std::move(displacement), std::move(moment)};
  if (s.model().obstacle_row.empty()) return grid;
  GridArray force{"obstacle_force", {""}, std::vector<double>(mesh.node_count(), 0.0)};
  for (int n = 0; n < mesh.node_count(); ++n)
    if (s.model().obstacle_row[n] >= 0) force.values[n] = s.result().state.lambda[s.model().obstacle_row[n]];
  grid.arrays.push_back(std::move(force));
  return grid;
}

Lists write_cells(const multigrid::VisitedCells& at, const Lists& said) {
  Lists told{{{}, {0}}, {}};  // what went wrong; was a file written?
  try {
    const GridFile file = piece(at, said);
    if (file.points.empty()) return told;
    if (std::filesystem::is_symlink(file.file)) std::filesystem::remove(file.file);  // it may lead to anywhere
    write(file);
    told.whole[1][0] = 1;
  } catch (const std::exception& error) {
    told.whole[0] = letters(error.what());
  }
  return told;
}

void write_pieces(const scene::Solution& solution, const std::string& file) {
  Lists said{{letters(file)}, {}};
  for (const auto& body : solution.scene().bodies) said.whole.push_back(letters(body->name));
  std::vector<int> nodes;
  const std::vector<GridArray> contacts = contact_arrays(solution);
  said.real.resize(contacts.size());
  for (std::size_t n = 0; !contacts.empty() && n < contacts[0].values.size(); ++n) {
    if (std::isnan(contacts[1].values[n])) continue;
    nodes.push_back(static_cast<int>(n));
    for (std::size_t a = 0; a < contacts.size(); ++a) said.real[a].push_back(contacts[a].values[n]);
  }
  GridFile list{file, {}, {}, NodeArrays().all()};
  for (const GridArray& array : contacts) list.arrays.push_back({array.name, array.components, {}});
  check(list);
  std::filesystem::remove(place_to_write(file));
  const auto told = scene::visit_refined(solution.model(), solution.result().state.u, multigrid::VisitFor::write, write_cells, std::move(said), std::move(nodes));
  for (std::size_t r = 0; r < told.size(); ++r) {
    if (!told[r].whole[0].empty()) throw InputError(text("rank ", r, ": ", text_of(told[r].whole[0])));
    if (told[r].whole[1][0]) list.written.push_back(std::filesystem::path(piece_name(file, static_cast<int>(r))).filename().string());
  }
  write(list);
}

}  // namespace dotyk::figure

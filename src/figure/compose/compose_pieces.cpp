// The .pvtu of bodies that ranks refine: each rank writes its cells.
#include <cmath>
#include <exception>
#include <filesystem>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "elasticity/share.hpp"
#include "elasticity/stress.hpp"
#include "figure/compose/compose.hpp"
#include "figure/door/drawing.hpp"
#include "scene/model/slices.hpp"

namespace dotyk::figure {

namespace {

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

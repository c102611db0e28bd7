#include "scene/model/congruent.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/parallel.hpp"

namespace dotyk::scene {
namespace {

/// Of all cells: least Jacobian by the greatest extent, seen from the first node, to the power of one dimension less.
double least_height(const mesh::Mesh& mesh) {
  const int dim = mesh.dimension(), nodes = mesh.topology().nodes;
  double least = INFINITY;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double extent = 0;
    for (int k = 1; k < nodes; ++k)
      for (int i = 0; i < dim; ++i)
        extent = std::max(extent, std::abs(mesh.node(mesh.cell(c)[k])[i] - mesh.node(mesh.cell(c)[0])[i]));
    least = std::min(least, mesh::least_jacobian(mesh, c) / std::pow(extent, dim - 1));
  }
  return least;
}

bool translated(const mesh::Mesh& a, const mesh::Mesh& b, double tolerance) {
  const int dim = a.dimension();
  for (std::size_t k = 0; k < a.coordinates.size(); ++k) {
    const double of_a = a.coordinates[k] - a.coordinates[k % dim], of_b = b.coordinates[k] - b.coordinates[k % dim];
    if (!(std::abs(of_a - of_b) <= tolerance)) return false;
  }
  return true;
}

/// Of equal matrix; what tells most pieces apart is asked first.
bool alike(const Piece& a, const Piece& b, double tolerance) {
  return a.part.mesh.element == b.part.mesh.element && a.part.mesh.coordinates.size() == b.part.mesh.coordinates.size() &&
         a.springs.empty() && b.springs.empty() && translated(a.part.mesh, b.part.mesh, tolerance) &&
         a.part.mesh.cells == b.part.mesh.cells && a.numbering.unknown == b.numbering.unknown && a.material == b.material;
}

/// Equal for pieces that are alike.
std::size_t hash(const Piece& piece) {
  std::size_t h = piece.numbering.node.size();
  for (const int n : piece.part.mesh.cells) h = h * 1000003u + static_cast<std::size_t>(n);
  return h;
}

}  // namespace

std::vector<int> congruent(const std::vector<Piece>& pieces) {
  std::vector<double> tolerance(pieces.size());
  parallel_for(static_cast<int>(pieces.size()), [&](int k) { tolerance[k] = 1e-12 * least_height(pieces[k].part.mesh); });
  std::vector<int> result(pieces.size());
  std::unordered_map<std::size_t, std::vector<int>> first;  // those that are no translates of earlier ones, by hash
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    std::vector<int>& known = first[hash(pieces[k])];
    const auto same = std::find_if(known.begin(), known.end(), [&](int j) {
      return alike(pieces[j], pieces[k], std::min(tolerance[j], tolerance[k]));
    });
    result[k] = same == known.end() ? static_cast<int>(k) : *same;
    if (same == known.end()) known.push_back(static_cast<int>(k));
  }
  return result;
}

}  // namespace dotyk::scene

#include "elasticity/refined.hpp"

#include <algorithm>

#include "elasticity/kernel.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::elasticity {
namespace {

/// Moves the nodes between corners of the pieces of a mesh of order 2 to where its cells map them.
template <class E>
void place_between(const mesh::Mesh& whole, mesh::Mesh& pieces) {
  const mesh::ElementTopology& t = whole.topology();
  const int each = pieces.cell_count() / whole.cell_count();
  for (int c = 0; c < pieces.cell_count(); ++c) {
    const int *parent = whole.cell(c / each), *piece = pieces.cell(c);
    double x[E::nodes][E::dim];
    cell_coordinates<E>(whole, c / each, x);
    for (std::size_t k = 0; k < t.between.size(); ++k) {
      std::array<double, E::dim> xi{};
      for (const int corner : t.between[k]) {
        const auto at = E::node(static_cast<int>(std::find(parent, parent + E::nodes, piece[corner]) - parent));
        for (int i = 0; i < E::dim; ++i) xi[i] += at[i] / static_cast<double>(t.between[k].size());
      }
      const auto shape = E::shape(xi);
      double* node = &pieces.coordinates[static_cast<std::size_t>(piece[t.corners + k]) * E::dim];
      for (int i = 0; i < E::dim; ++i) {
        node[i] = 0;
        for (int a = 0; a < E::nodes; ++a) node[i] += shape[a] * x[a][i];
      }
    }
  }
}

}  // namespace

mesh::Mesh refined(const mesh::Mesh& mesh, Monitor* watch) {
  const auto go_on = [&] { if (watch) watch->check(); };
  mesh::Mesh second = mesh::second_order(mesh, watch);
  go_on();
  mesh::Mesh cut = mesh::cut_at_nodes(std::move(second));
  if (mesh.topology().order == 1) return cut;
  go_on();
  mesh::Mesh pieces = mesh::second_order(std::move(cut), watch);
  go_on();
  dispatch(mesh.element, [&]<class E>() {
    if constexpr (E::order == 2) place_between<E>(mesh, pieces);
  });
  return pieces;
}

}  // namespace dotyk::elasticity

#include "elasticity/spring_rows.hpp"

#include <stdexcept>

#include "elasticity/load.hpp"

namespace dotyk::elasticity {

SpringRows spring_rows(const mesh::Mesh& mesh, const std::vector<FacetSpring>& springs, const Numbering& numbering) {
  const int dim = mesh.dimension();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> stiffness;
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < dim; ++i) {
        const double k = spring.stiffness[p.index][i] * p.measure;
        if (!(k > 0)) continue;
        for (int a = 0; a < p.nodes; ++a) {
          const int v = numbering.unknown[static_cast<std::size_t>(mesh.facet_node(spring.facet, a)) * dim + i];
          if (v < 0) throw std::logic_error("springs as rows act on unknowns alone");
          entries.emplace_back(static_cast<int>(stiffness.size()), v, p.shape[a]);
        }
        stiffness.push_back(k);
      }
    });
  SpringRows rows{algebra::SparseRows(static_cast<Eigen::Index>(stiffness.size()), numbering.count()),
                  Eigen::Map<const algebra::Vector>(stiffness.data(), static_cast<Eigen::Index>(stiffness.size()))};
  rows.S.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

}  // namespace dotyk::elasticity

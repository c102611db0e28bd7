#include "elasticity/share.hpp"

#include <doctest/doctest.h>

#include "../support/elastic.hpp"

using namespace dotyk;
using mesh::Point;

TEST_CASE("a share has the rows of its unknowns: all elements, supports, stiffness of cells") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const mesh::Mesh m = test::unit(dim, family, 3);
      std::vector<double> E, nu;
      for (int c = 0; c < m.cell_count(); ++c) E.push_back(100 + c), nu.push_back(0.2 + 0.1 * (c % 2));
      const elasticity::MaterialField varying(E, nu, dim, elasticity::Plane::stress), uniform = test::steel(dim);
      const auto numbering = test::prescribe(m, [](const Point& x, int i) { return x[0] == 0 && i == 0; }, [](const Point&) { return Point{0.1, 0, 0}; });
      for (const auto* material : {&varying, &uniform}) {
        const algebra::SparseMatrix whole = elasticity::assemble(m, *material, {}, numbering);
        std::vector<char> own(static_cast<std::size_t>(numbering.count()), 0);
        for (int i = 0; i < numbering.count(); ++i) own[i] = m.point(numbering.node[i])[1] > 0.5;
        Share share = elasticity::share(m, *material, {}, numbering, own);
        CHECK(static_cast<int>(share.unknowns.size()) < numbering.count());
        const algebra::SparseMatrix part = elasticity::assemble_share(elasticity::joined({share}).lists);
        REQUIRE(part.rows() == static_cast<Eigen::Index>(share.unknowns.size()));
        std::vector<int> place(own.size(), -1);
        for (std::size_t k = 0; k < share.unknowns.size(); ++k) place[share.unknowns[k]] = static_cast<int>(k);
        for (int j = 0; j < whole.cols(); ++j)
          for (algebra::SparseMatrix::InnerIterator it(whole, j); it; ++it) {
            if (!own[it.row()] && !own[j]) continue;
            REQUIRE((place[it.row()] >= 0 && place[j] >= 0));
            CHECK(part.coeff(place[it.row()], place[j]) == it.value());
          }
      }
    }
}

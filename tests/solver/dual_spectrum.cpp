#include "solver/feti/coarse_space.hpp"

#include <doctest/doctest.h>

#include "../support/dual.hpp"
#include "algebra/dense/decompositions.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Ends;
using algebra::Vector;

TEST_CASE("the spectrum of PFP on the balanced multipliers: a bound from above, both ends from inside") {
  Monitor quiet;
  for (const bool support_rows : {true, false}) {
    const auto p = test::cut_box(support_rows, 4);
    const auto dual = test::dual_of(p);
    const solver::CoarseSpace coarse(dual.G(), dual.e());
    const int n = dual.rows();
    const DenseMatrix P = test::projector(coarse, n);
    const DenseMatrix F = test::as_matrix(n, [&](const Vector& v) { return dual.apply(v); });
    const Vector exact = algebra::eigenvalues(P * F * P);
    const double greatest = exact[n - 1], least = exact[coarse.modes() - static_cast<int>(coarse.held().size())];
    REQUIRE(least > 1e-8 * greatest);
    const auto one = solver::dual_spectrum(dual, coarse, Ends::greatest, quiet);
    CHECK(one.bound() >= greatest);
    CHECK(one.bound() <= 1.01 * greatest);
    const auto both = solver::dual_spectrum(dual, coarse, Ends::both, quiet);
    CHECK(both.steps > one.steps);
    CHECK(both.greatest <= greatest * (1 + 1e-12));
    CHECK(both.least >= least * (1 - 1e-9));
    CHECK(both.greatest / both.least == doctest::Approx(greatest / least).epsilon(0.05));
  }
}

TEST_CASE("where every multiplier is given by balance there is no spectrum") {
  // A free bar on one row.
  problem::Problem p;
  const DenseMatrix K{{1, -1}, {-1, 1}};
  problem::add(p, test::block("bar", test::SpringGrid{test::lower(K), {0, 1}, 2}, Vector{{0, 1}}, 1, true));
  p.B = test::rows(DenseMatrix{{1, 0}});
  p.c = Vector::Zero(1);
  p.groups = {test::group(problem::unilateral(), 0, 1)};
  Monitor quiet;
  const auto dual = test::dual_of(p);
  const solver::CoarseSpace coarse(dual.G(), dual.e());
  CHECK(coarse.particular()[0] == doctest::Approx(1));
  CHECK(solver::dual_spectrum(dual, coarse, Ends::both, quiet).bound() == 0);
}

#include <doctest/doctest.h>

#include <numeric>

#include "../support/elastic.hpp"
#include "elasticity/error_estimate.hpp"
#include "moduli.hpp"

using namespace dotyk;
using mesh::Point;
using std::numbers::pi;
using test::kE;
using test::kLambda;
using test::kMu;
using test::kNu;

namespace {

// u_i = a_i Π sin(π x_j), zero on the boundary of the unit square or cube; f = −div σ(u).
constexpr double kAmount[3] = {1, -0.5, 0.7};

double factor(double x, int derivatives) {
  switch (derivatives) {
    case 0:
      return std::sin(pi * x);
    case 1:
      return pi * std::cos(pi * x);
    default:
      return -pi * pi * std::sin(pi * x);
  }
}

/// ∂_k ∂_l of Π sin(π x_j); k or l = -1: none.
double derivative(const Point& x, int dim, int k, int l) {
  double product = 1;
  for (int j = 0; j < dim; ++j) product *= factor(x[j], (k == j) + (l == j));
  return product;
}

Point exact(const Point& x, int dim) {
  Point u{0, 0, 0};
  for (int i = 0; i < dim; ++i) u[i] = kAmount[i] * derivative(x, dim, -1, -1);
  return u;
}

Point force(const Point& x, int dim) {
  Point f{0, 0, 0};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      f[i] -= (kLambda + kMu) * kAmount[j] * derivative(x, dim, i, j) + kMu * kAmount[i] * derivative(x, dim, j, j);
  return f;
}

struct Errors {
  double nodal, energy, effectivity;
};

/// Root mean square error at nodes; error of the energy norm, from energies: ‖u − u_h‖² = a(u,u) − a(u_h,u_h)
/// up to the quadrature of f, which is of higher order.
Errors errors(int dim, mesh::Family family, int n) {
  const auto m = test::unit(dim, family, n);
  const auto numbering = test::prescribe(
      m, [&](const Point& x, int) { return test::on_boundary(x, dim); },
      [](const Point&) {
        return Point{0, 0, 0};
      });
  const auto material = test::steel(dim, kE, kNu);
  std::vector<double> load(m.coordinates.size(), 0);
  elasticity::add_body_force(
      m, [&](const Point& x) { return force(x, dim); }, load);
  const auto system = test::system_of(m, material, {}, load, numbering);
  const std::vector<double> u = test::solve_sparse(system, numbering);
  REQUIRE(u.size() == m.coordinates.size());
  const auto reference = test::nodal(m, [&](const Point& x) { return exact(x, dim); });
  double sum = 0;
  for (std::size_t k = 0; k < u.size(); ++k) sum += (u[k] - reference[k]) * (u[k] - reference[k]);
  // a(u, u) = ∫ f u: sines and cosines squared give ½ each axis.
  double whole = 0;
  for (int i = 0; i < dim; ++i) whole += kAmount[i] * kAmount[i] * pi * pi * ((kLambda + kMu) + dim * kMu) / (1 << dim);
  const auto estimate = elasticity::estimate_error(m, material, u, {}, {});
  double recovery = 0;
  for (const auto& cell : estimate.cells) recovery += cell.recovery;
  // Energy error by quadrature against the interpolated exact stress would add its own; the estimate's
  // ∫σ_h c⁻¹ σ_h is exact, so take the difference of energies.
  const double energy = std::sqrt(std::abs(whole - std::reduce(estimate.solution.begin(), estimate.solution.end())));
  return {std::sqrt(sum / u.size()), energy, std::sqrt(recovery) / energy};
}

}  // namespace

TEST_CASE("a manufactured solution converges with order 2 in displacement and 1 in energy") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const int n = dim == 2 ? 24 : mesh::simplices(family) ? 12 : 8;
      const Errors coarse = errors(dim, family, n), fine = errors(dim, family, 2 * n);
      const double order = std::log2(coarse.nodal / fine.nodal), energy_order = std::log2(coarse.energy / fine.energy);
      INFO("dimension ", dim, " element ", test::name(family), " orders ", order, " ",
           energy_order);
      CHECK(order > 1.85);  // 2 in the limit
      CHECK(order < 2.15);
      CHECK(energy_order > 0.93);  // 1 in the limit
      CHECK(energy_order < 1.07);
    }
}

TEST_CASE("the recovery estimate of a smooth solution is within a quarter of the true error") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const Errors e = errors(dim, family, dim == 2 ? 40 : 16);
      INFO("dimension ", dim, " element ", test::name(family), " effectivity ", e.effectivity);
      CHECK(e.effectivity > 0.8);
      CHECK(e.effectivity < 1.25);
    }
}

#include "elasticity/assembly.hpp"

#include <doctest/doctest.h>

#include "../support/elastic.hpp"
#include "../support/one_core.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using mesh::Point;

TEST_CASE("with prescribed components K, f and the energy are those of the full system restricted") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      test::Random random(211);
      auto m = test::unit(dim, family, 3);
      test::distort(m, 0.05);
      const auto elastic = test::even_springs(m, "right", {2, 0.5, 3});
      const Vector force = random.vector(static_cast<int>(m.coordinates.size()));
      const std::vector<double> nodal(force.begin(), force.end());
      const auto whole = test::system_of(m, test::steel(dim), elastic, nodal, test::all_free(m));
      const DenseMatrix K = test::full(whole.K);
      CHECK(whole.offset == 0);
      CHECK((whole.f - force).norm() == 0);
      // Random components at random nodes, so that nodes with none, some and all components fixed meet.
      std::vector<char> fixed(nodal.size());
      std::vector<double> value(nodal.size(), 0);
      for (std::size_t k = 0; k < fixed.size(); ++k) {
        fixed[k] = random.below(3) == 0;
        if (fixed[k] && random.coin()) value[k] = random.between(-1, 1);
      }
      const auto numbering = elasticity::number(m, fixed, value);
      const auto part = test::system_of(m, test::steel(dim), elastic, nodal, numbering);
      std::vector<int> in, out;
      for (std::size_t k = 0; k < fixed.size(); ++k) (fixed[k] ? out : in).push_back(static_cast<int>(k));
      const Vector given = Eigen::Map<const Vector>(value.data(), static_cast<int>(value.size()))(out);
      CHECK(test::relative(test::full(part.K), K(in, in)) < 1e-14);
      CHECK(test::relative(part.f, force(in) - K(in, out) * given) < 1e-13);
      // ½uᵀKu − fᵀu + offset is the energy of all components, for any u.
      const Vector u = random.vector(numbering.count());
      Vector all = Vector::Zero(K.rows());
      all(in) = u;
      all(out) = given;
      const double energy = 0.5 * all.dot(K * all) - force.dot(all);
      CHECK(std::abs(0.5 * u.dot(test::full(part.K) * u) - part.f.dot(u) + part.offset - energy) <
            1e-12 * (std::abs(energy) + K.norm()));
    }
}

TEST_CASE("the assembled system is the same to the last bit on one core and on several") {
  const auto m = test::unit(3, mesh::Family::p1, 20);
  REQUIRE(m.cell_count() > 40'000);
  test::Random random(212);
  std::vector<char> fixed(m.coordinates.size());
  std::vector<double> value(fixed.size(), 0);
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (random.below(10) == 0) fixed[k] = 1, value[k] = random.between(-1, 1);
  const auto numbering = elasticity::number(m, fixed, value);
  const std::vector<double> force(fixed.size(), 1);
  const auto assembled = [&] { return test::system_of(m, test::steel(3), {}, force, numbering); };
  const auto several = assembled();
  const test::OneCore core;
  const auto one = assembled();
  CHECK(std::equal(one.K.valuePtr(), one.K.valuePtr() + one.K.nonZeros(), several.K.valuePtr()));
  CHECK(one.f == several.f);
  CHECK(one.offset == several.offset);
}

TEST_CASE("the energy of prescribed components does not lose digits as cells become many") {
  const auto m = test::unit(3, mesh::Family::p1, 32);
  const auto pressed = test::prescribe(m, [](const Point&, int) { return true; }, [](const Point& x) { return Point{0, 0, -0.01 * x[2]}; });
  const double energy = 0.5e-4 * test::steel(3).at(0).c[2][2][2][2];
  CHECK(std::abs(elasticity::load(m, test::steel(3), {}, {}, pressed).offset / energy - 1) < 1e-13);  // 32² roundings, of a node each
}

TEST_CASE("all components prescribed: no unknowns, the energy is the offset") {
  const auto m = test::rectangle(mesh::Family::q1, 2, 2);
  const auto stretched = [](const Point& x) { return Point{0.01 * x[0], 0, 0}; };
  const auto numbering = test::prescribe(
      m, [](const Point&, int) { return true; }, stretched);
  const auto s = test::system_of(m, test::steel(2), {}, {}, numbering);
  CHECK(s.K.rows() == 0);
  const double c = elasticity::isotropic(210, 0.3, 2, elasticity::Plane::strain).c[0][0][0][0];
  CHECK(s.offset == doctest::Approx(0.5 * c * 1e-4).epsilon(1e-13));
}

TEST_CASE("springs: the energy of any displacement is ½∫ k u² over the facets") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto m = test::unit(dim, family, 3);
      const auto free = test::all_free(m);
      const DenseMatrix K = test::full(elasticity::assemble(m, test::steel(dim), {}, free)),
                        S = test::full(
                                elasticity::assemble(m, test::steel(dim), test::even_springs(m, "top", {2, 5, 7}), free)) -
                            K;
      const auto rows = elasticity::spring_rows(m, test::even_springs(m, "top", {2, 5, 7}), free);
      CHECK(rows.stiffness.minCoeff() > 0);
      // The difference of K with and without springs is known to rounding of K.
      CHECK((DenseMatrix(rows.S.transpose() * rows.stiffness.asDiagonal() * rows.S) - S).cwiseAbs().maxCoeff() < 1e-14 * K.maxCoeff());
      const auto energy = [&](const elasticity::VectorField& u) {
        const auto nodal = test::nodal(m, u);
        const auto x = Eigen::Map<const Vector>(nodal.data(), static_cast<int>(nodal.size()));
        return 0.5 * x.dot(S * x);
      };
      CHECK(energy([](const Point&) { return Point{1, 0, 0}; }) == doctest::Approx(1).epsilon(1e-12));
      CHECK(energy([](const Point&) { return Point{0, 1, 0}; }) == doctest::Approx(2.5).epsilon(1e-12));
      CHECK(energy([](const Point& x) { return Point{x[0], 0, 0}; }) == doctest::Approx(1.0 / 3).epsilon(1e-12));
      if (dim == 3)
        CHECK(energy([](const Point& x) { return Point{0, 0, x[0]}; }) == doctest::Approx(3.5 / 3).epsilon(1e-12));
      // Other parts feel nothing.
      const int axis = dim - 1;
      CHECK(std::abs(energy([&](const Point& x) { return Point{0, x[axis] > 0.99 ? 0.0 : 1.0, 0}; })) < 1e-12);
    }
}

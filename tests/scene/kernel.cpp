#include <doctest/doctest.h>

#include "../support/scenes.hpp"
#include "algebra/dense/generalised_inverse.hpp"
#include "base/error.hpp"
#include "scene/model/model.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

scene::Model built(const std::shared_ptr<scene::Body>& b) {
  Monitor quiet;
  problem::Clock clock;
  return scene::build(*scene::make_scene({b}), clock, quiet);
}

double residual(const problem::Block& block) {
  return algebra::kernel_residual(block.K, block.kernel).maxCoeff();
}

/// A square or cube, distorted inside, stretched by `flat` along its last axis, `far` from the origin.
mesh::Mesh placed(int dim, mesh::Family family, double flat, double far) {
  mesh::Mesh m = test::unit(dim, family, 4);
  test::distort(m, 0.03);
  mesh::transform(m, [=](Point x) {
    x[dim - 1] *= flat;
    for (int i = 0; i < dim; ++i) x[i] += far;
    return x;
  });
  return m;
}

}  // namespace

TEST_CASE("the stiffness of a free body does nothing on its rigid motions, to rounding") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const double flat : {1.0, 1e-3, 1e3})
        for (const double far : {0.0, 1e3, 1e7})
          for (const double nu : {0.3, 0.499999, -0.9}) {
            INFO(dim, "-D, flat ", flat, ", far ", far, ", nu ", nu);
            if (far * 1e-12 > std::min(1.0, flat) * 1e-5) continue;  // the nodes' coordinates themselves are rounded
            const auto model = built(test::body("body", placed(dim, family, flat, far), 1e5, nu));
            CHECK(model.problem.blocks[0].kernel.cols() == (dim == 2 ? 3 : 6));
            CHECK(residual(model.problem.blocks[0]) < 2e-14);
          }
}

TEST_CASE("a body of parts whose stiffness differs by 1e12, and one partly supported") {
  for (const int dim : {2, 3}) {
    const mesh::Mesh m = test::unit(dim, mesh::Family::q1, 4);
    std::vector<double> E, nu(m.cell_count(), 0.3);
    for (int c = 0; c < m.cell_count(); ++c) E.push_back(m.cell_centre(c)[0] < 0.5 ? 1e-6 : 1e6);
    const auto b = scene::make_body("layers", std::make_shared<const mesh::Mesh>(m),
                                    elasticity::MaterialField(E, nu, dim, elasticity::Plane::strain), {});
    test::slide(b, "left");
    test::springs(b, "bottom", {dim == 2 ? 0.0 : 1e-9, 0, 0});
    const auto model = built(b);
    CHECK(model.problem.blocks[0].kernel.cols() == (dim == 2 ? 1 : 3));
    CHECK(residual(model.problem.blocks[0]) < 2e-14);
  }
}

TEST_CASE("a kernel that the stiffness does not have is refused, naming the motion") {
  const auto b = test::block("lid", 2, mesh::Family::p1, 4);
  const auto model = built(b);
  problem::Block block = model.problem.blocks[0];
  block.kernel(0, 2) += 1e-9;  // a rotation that strains one cell a little
  CHECK(residual(block) > 1e-11);
  problem::Problem p;
  CHECK_THROWS_WITH_AS(problem::add(p, block), doctest::Contains("'lid': the stiffness resists rotation about (0.5, 0.5)"),
                       InputError);
  CHECK(p.blocks.empty());
}

TEST_CASE("a material without stiffness in some strain is another failure, told where the material is made") {
  algebra::DenseMatrix v(3, 3);
  v << 2, 2, 0, 2, 2, 0, 0, 0, 1;  // nothing resists xx = −yy
  CHECK_THROWS_WITH_AS(elasticity::from_voigt(v), doctest::Contains("stiffness must be positive definite; its least eigenvalue"),
                       InputError);
  v(0, 0) += 1e-15;
  CHECK_THROWS_AS(elasticity::from_voigt(v), InputError);
  v(0, 0) += 1e-3;
  CHECK_NOTHROW(elasticity::from_voigt(v));
}

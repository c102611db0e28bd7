#include <doctest/doctest.h>

#include "../support/subdomains.hpp"

using namespace dotyk;
using mesh::Point;
using problem::Subdomain;

namespace {

bool same(const Subdomain& a, const Subdomain& b) {
  return a.K().nonZeros() == b.K().nonZeros() && a.kernel().cols() == b.kernel().cols() && test::full(a.K()) == test::full(b.K()) &&
         a.kernel() == b.kernel();
}

/// Matrices that differ from each other.
int different(const problem::Problem& p) {
  std::vector<const Subdomain*> found;
  for (const Subdomain& s : p.subdomains)
    if (std::none_of(found.begin(), found.end(), [&](const Subdomain* f) { return f->size() == s.size() && same(*f, s); }))
      found.push_back(&s);
  return static_cast<int>(found.size());
}

/// Equal matrices are the right ones: they sum up to the blocks', but for what coordinates X lose in cells of size h,
/// some 1e-16 X/h.
void check_sums(const problem::Problem& p, double tolerance) {
  const auto sum = test::glued(p), all = test::whole(p);
  CHECK((sum.K - all.K).cwiseAbs().maxCoeff() < tolerance * all.K.cwiseAbs().maxCoeff());
}

std::shared_ptr<scene::Body> moved(const std::shared_ptr<scene::Body>& body, const std::string& name, Point by) {
  mesh::Mesh m = *body->mesh;
  mesh::transform(m, [=](Point x) { return Point{x[0] + by[0], x[1] + by[1], x[2] + by[2]}; });
  return test::body(name, std::move(m));
}

}  // namespace

TEST_CASE("equal boxes of equal blocks have bitwise equal matrices and kernels") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      // Thirds: no coordinate but 0 and 1 is exact.
      const auto a = test::block("a", dim, family, dim == 2 ? 9 : 6), b = moved(a, "b", {0.7, 1.3, 3.1});
      test::fix(a, "left");
      const auto scene = scene::make_scene({a, b});
      const auto rows = test::cut(*scene, test::by_boxes({3, 3, 3}, true));
      CHECK(rows.problem.subdomains.size() == (dim == 2 ? 18 : 54));
      CHECK(different(rows.problem) == 1);
      check_sums(rows.problem, 1e-13);
      // Supports in the matrices: those at the left of `a` are another kind.
      const auto held = test::cut(*scene, test::by_boxes({3, 3, 3}, false));
      CHECK(different(held.problem) == 2);
      check_sums(held.problem, 1e-13);
    }
}

TEST_CASE("what makes a matrix different: material, springs, grading, a node moved by more than rounding") {
  const auto count = [](const std::shared_ptr<scene::Body>& body, bool support_rows = true) {
    const auto model = test::cut(*scene::make_scene({body}), test::by_boxes({2, 2, 1}, support_rows));
    CHECK(model.problem.subdomains.size() == 4);
    check_sums(model.problem, 1e-13);
    return different(model.problem);
  };
  CHECK(count(test::block("plain", 2, mesh::Family::q1, 6)) == 1);
  auto sprung = test::block("sprung", 2, mesh::Family::q1, 6);
  test::springs(sprung, "left", {1, 1, 0});
  CHECK(count(sprung) == 1);  // springs are rows
  CHECK(count(sprung, false) >= 2);  // or not compared: those on the left may differ from each other by rounding
  mesh::Mesh graded = test::rectangle(mesh::Family::q1, 6, 6);
  mesh::transform(graded, [](Point x) { return Point{x[0] * (1 + x[0]) / 2, x[1], 0}; });
  CHECK(count(test::body("graded", graded)) == 2);
  mesh::Mesh bumped = test::rectangle(mesh::Family::q1, 6, 6);
  bumped.coordinates[2 * 8] += 1e-10;
  CHECK(count(test::body("bumped", bumped)) == 2);
  mesh::Mesh m = test::rectangle(mesh::Family::q1, 6, 6);
  std::vector<double> E(m.cell_count(), 100), nu(m.cell_count(), 0.3);
  E[0] = 101;
  CHECK(count(scene::make_body("soft", std::make_shared<const mesh::Mesh>(m),
                               elasticity::MaterialField(E, nu, 2, elasticity::Plane::strain), {})) == 2);
}

TEST_CASE("far from the origin coordinates have lost digits: equal matrices where rounding allows, right ones always") {
  for (const double far : {10.0, 1e3, 1e6}) {
    const auto near = test::block("near", 2, mesh::Family::q1, 6);
    const auto model = test::cut(*scene::make_scene({near, moved(near, "away", {far, far / 3, 0})}),
                                 test::by_boxes({2, 2, 1}, true));
    if (far == 10) CHECK(different(model.problem) == 1);
    check_sums(model.problem, 1e-12);
  }
}

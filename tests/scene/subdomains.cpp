#include "scene/model/subdomains.hpp"

#include <doctest/doctest.h>

#include "../support/random.hpp"
#include "../support/subdomains.hpp"
#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"

using namespace dotyk;
using mesh::Point;
using problem::Subdomain;

namespace {

/// Two distorted blocks with all that a stiffness and a load are made of: a material that varies, one fixed,
/// springs, displacements prescribed (not zero), tractions.
std::shared_ptr<scene::Scene> laden(int dim, mesh::Family family, int n) {
  mesh::Mesh m = test::unit(dim, family, n);
  test::distort(m, 0.04);
  std::vector<double> E, nu(m.cell_count(), 0.3);
  for (int c = 0; c < m.cell_count(); ++c) E.push_back(100 * (1 + c % 7));
  const auto lower = scene::make_body("lower", std::make_shared<const mesh::Mesh>(std::move(m)),
                                      elasticity::MaterialField(E, nu, dim, elasticity::Plane::strain),
                                      [](const Point& x) { return Point{x[0], 1, -x[1]}; });
  const auto upper = test::block("upper", dim, family, n, 1.5, 400);
  test::slide(lower, "bottom");
  auto right = test::part(lower, "right"), top = test::part(upper, "top");
  std::array<elasticity::ScalarField, 3> by;
  by[0] = [](const Point& x) { return 0.01 * (1 + x[1]); };
  scene::displace(right, by, "push");
  test::springs(lower, "left", {5, 0.5, 1});
  test::springs(upper, "bottom", {0, 7, 1});
  scene::load(top, [](const Point& x) { return Point{0.2, -1 - x[0], 0.3}; }, "press");
  test::press(lower, "top", 2);
  return scene::make_scene({lower, upper});
}

/// The dimension of K's kernel by its eigenvalues.
int nullity(const algebra::DenseMatrix& K) {
  const algebra::Vector values = algebra::eigenvalues(K);
  return static_cast<int>((values.array() < 1e-11 * values[values.size() - 1]).count());
}

/// The kernel is one of K, independent, and all of it.
void check_kernel(const Subdomain& s) {
  REQUIRE(s.kernel().rows() == s.size());
  const algebra::DenseMatrix K = test::full(s.K());
  CHECK(nullity(K) == s.kernel().cols());
  if (s.kernel().cols() == 0) return;
  CHECK((K * s.kernel()).cwiseAbs().maxCoeff() < 1e-13 * K.cwiseAbs().maxCoeff() * s.kernel().cwiseAbs().maxCoeff() * s.size());
  const algebra::Vector singular = algebra::singular_values(s.kernel());
  CHECK(singular[singular.size() - 1] > 1e-3 * singular[0]);
}

/// Shapes, ascending nodes, every unknown of the problem in some subdomain, and nothing held that is not.
void check_numbering(const problem::Problem& p, bool support_rows) {
  std::vector<char> seen(p.unknowns(), 0);
  int block = 0;
  for (const Subdomain& s : p.subdomains) {
    CHECK(s.block >= block);
    block = s.block;
    const problem::Block& b = p.blocks[s.block];
    REQUIRE(s.K().rows() == s.size());
    REQUIRE(s.value.size() == s.size());
    REQUIRE(static_cast<int>(s.node.size()) == s.size());
    REQUIRE(static_cast<int>(s.unknown.size()) == s.size());
    CHECK(std::is_sorted(s.node.begin(), s.node.end()));
    for (int i = 0; i < s.size(); ++i) {
      if (s.unknown[i] < 0) {
        CHECK(support_rows);
        continue;
      }
      REQUIRE(s.unknown[i] >= b.first);
      REQUIRE(s.unknown[i] < b.first + b.size());
      CHECK(b.node[s.unknown[i] - b.first] == s.node[i]);
      CHECK(s.value[i] == 0);
      seen[s.unknown[i]] = 1;
    }
  }
  CHECK(std::find(seen.begin(), seen.end(), 0) == seen.end());
}

/// To rounding: 1e-12 of the greatest entry leaves room for sums of some ten cells.
void check_sums(const problem::Problem& p) {
  const auto sum = test::glued(p), all = test::whole(p);
  CHECK((sum.K - all.K).cwiseAbs().maxCoeff() < 1e-12 * all.K.cwiseAbs().maxCoeff());
  CHECK((sum.f - all.f).cwiseAbs().maxCoeff() <= 1e-12 * all.f.cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("the subdomains' energies sum up to the blocks'") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const bool support_rows : {true, false}) {
        const auto scene = laden(dim, family, dim == 2 ? 8 : 4);
        for (const auto& decomposition : {test::by_count(9, support_rows), test::by_boxes({3, 2, 2}, support_rows),
                                          test::by_boxes({1, 1, 2}, support_rows), test::by_count(1000, support_rows)}) {
          const auto model = test::cut(*scene, decomposition);
          if (model.problem.subdomains.empty()) {
            CHECK(dim == 2);  // one box a body
            CHECK(!support_rows);
            continue;
          }
          check_numbering(model.problem, support_rows);
          check_sums(model.problem);
          if (decomposition.count == 9) CHECK(model.problem.subdomains.size() == 9);
        }
      }
}

TEST_CASE("supports as rows: springs, too: the kernel of every subdomain is all rigid motions") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto scene = laden(dim, family, dim == 2 ? 8 : 4);
      const auto model = test::cut(*scene, test::by_count(11, true));
      int rigid = 0, held = 0, springs = 0;
      for (const Subdomain& s : model.problem.subdomains) {
        check_kernel(s);
        rigid += s.kernel().cols() == (dim == 2 ? 3 : 6);
        for (int i = 0; i < s.size(); ++i) held += s.unknown[i] < 0;
        springs += static_cast<int>(s.spring.size());
      }
      CHECK(rigid == static_cast<int>(model.problem.subdomains.size()));
      CHECK(springs > 0);
      CHECK(held > 0);
      const auto sizes = test::counts(model.problem.subdomains);
      CHECK(model.problem.subdomains.size() == 11);
      CHECK(sizes.held == held);
      int all = 0;
      for (const Subdomain& s : model.problem.subdomains) all += s.size();
      CHECK(sizes.gluing == all - held - model.problem.unknowns());
      CHECK(sizes.least <= all / 11);
      CHECK(sizes.greatest >= all / 11);
    }
}

TEST_CASE("held components have their prescribed values, and the force on them is shared, too") {
  const auto scene = laden(2, mesh::Family::q1, 6);
  const auto model = test::cut(*scene, test::by_boxes({2, 3, 1}, true));
  algebra::Vector force = algebra::Vector::Zero(model.bodies[0].force.size());
  for (const Subdomain& s : model.problem.subdomains)
    for (int i = 0; i < s.size(); ++i) {
      if (s.block == 0) force[s.node[i] * 2 + i % 2] += s.f[i];
      if (s.unknown[i] >= 0) continue;
      CHECK(s.value[i] == model.numbering[s.block].value(s.node[i] * 2 + i % 2));
    }
  for (int k = 0; k < force.size(); ++k) CHECK(force[k] == doctest::Approx(model.bodies[0].force[k]).epsilon(1e-14));
}

TEST_CASE("supports in the matrices: what they leave of a subdomain's rigid motions is its kernel") {
  for (const auto family : test::kFamilies) {
    // Fixed along the edge x = z = 0: subdomains at it turn about it, the others float.
    auto block = test::block("block", 3, family, 4);
    test::hold(*block, [](const Point& x) { return x[0] == 0 && x[2] == 0; });
    const auto model = test::cut(*scene::make_scene({block}), test::by_boxes({2, 2, 2}, false));
    REQUIRE(model.problem.subdomains.size() == 8);
    check_sums(model.problem);
    int turning = 0, floating = 0;
    for (const Subdomain& s : model.problem.subdomains) {
      check_kernel(s);
      turning += s.kernel().cols() == 1;
      floating += s.kernel().cols() == 6;
    }
    CHECK(turning == 2);
    CHECK(floating == 6);
  }
  // Fixed at a corner; the subdomain there turns about it in three ways.
  auto block = test::block("block", 3, mesh::Family::q1, 4);
  test::hold(*block, [](const Point& x) { return x[0] + x[1] + x[2] == 0; });
  const auto corner = test::cut(*scene::make_scene({block}), test::by_boxes({2, 2, 2}, false));
  int turning = 0;
  for (const Subdomain& s : corner.problem.subdomains) {
    check_kernel(s);
    turning += s.kernel().cols() == 3;
  }
  CHECK(turning == 1);
  // In the plane, sliding and held by springs of one direction.
  auto plate = test::block("plate", 2, mesh::Family::p1, 6);
  test::slide(plate, "left");
  test::springs(plate, "top", {0, 3, 0});
  const auto sliding = test::cut(*scene::make_scene({plate}), test::by_boxes({3, 3, 1}, false));
  std::array<int, 4> of_dimension{};
  for (const Subdomain& s : sliding.problem.subdomains) {
    check_kernel(s);
    ++of_dimension[s.kernel().cols()];
  }
  // On the left u_x = 0: one translation is left; at the top u_y = 0: another; in their corner none.
  CHECK(of_dimension == std::array<int, 4>{1, 4, 0, 4});
}

TEST_CASE("distorted meshes by METIS: kernels with supports in the matrices, against the eigenvalues") {
  for (const int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const auto model = test::cut(*laden(dim, family, dim == 2 ? 6 : 3), test::by_count(12, false));
      for (const Subdomain& s : model.problem.subdomains) check_kernel(s);
    }
}

TEST_CASE("a body of one piece: empty with supports in the matrices, cut off its supports where they are rows") {
  const auto scene = laden(2, mesh::Family::q1, 4);
  CHECK(test::cut(*scene, test::by_count(1, false)).problem.subdomains.empty());
  CHECK(test::cut(*scene, test::by_boxes({1, 1, 1}, false)).problem.subdomains.empty());
  for (const auto& one : {test::by_count(1, true), test::by_boxes({1, 1, 1}, true)}) {
    const auto model = test::cut(*scene, one);
    CHECK(model.problem.subdomains.size() == 2);
    check_numbering(model.problem, true);
    check_sums(model.problem);
  }
  Monitor quiet;
  problem::Clock clock;
  CHECK(scene::build(*scene, clock, quiet).problem.subdomains.empty());
}

TEST_CASE("bodies and pieces without an unknown") {
  auto slab = test::block("slab", 2, mesh::Family::q1, 2), block = test::block("block", 2, mesh::Family::q1, 2, 1);
  test::hold(*slab, [](const Point&) { return true; });
  test::hold(*block, [](const Point& x) { return x[0] < 0.6; });
  const auto scene = scene::make_scene({slab, block});
  const auto held = test::cut(*scene, test::by_boxes({2, 1, 1}, false));
  REQUIRE(held.problem.subdomains.size() == 1);  // the right half of the block
  CHECK(held.problem.subdomains[0].size() == 6);
  check_sums(held.problem);
  const auto rows = test::cut(*scene, test::by_boxes({2, 1, 1}, true));
  CHECK(rows.problem.subdomains.size() == 4);
  check_numbering(rows.problem, true);
  check_sums(rows.problem);
}

TEST_CASE("another loading: f and values as when cut with it, K left as it is") {
  for (const bool support_rows : {true, false}) {
    const auto scene = laden(2, mesh::Family::q1, 6);
    std::vector<scene::Body> bodies;
    for (const auto& body : scene->bodies) bodies.push_back(*body);
    auto model = test::cut(*scene, test::by_count(7, support_rows));
    const auto before = model.problem.subdomains;
    scene::Loading loading;
    loading.all = 0.5;
    loading.factor = {{"push", -2}, {"press", 3}};
    problem::Clock clock;
    scene::reload(*scene, bodies, loading, model, clock);
    check_sums(model.problem);
    const auto fresh = test::cut(*scene, test::by_count(7, support_rows), loading);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Subdomain &s = model.problem.subdomains[k], &other = fresh.problem.subdomains[k];
      CHECK((s.f - other.f).norm() <= 1e-13 * other.f.norm());
      CHECK(s.value == other.value);
      CHECK((test::full(s.K()) - test::full(before[k].K())).norm() == 0);
      CHECK((test::full(s.K()) - test::full(other.K())).norm() == 0);
    }
  }
}

namespace asking {

/// A method that asks for subdomains, looks at them and lets another one solve.
struct Settings : solver::Settings {
  problem::Decomposition decomposition;
  std::shared_ptr<std::vector<std::size_t>> seen = std::make_shared<std::vector<std::size_t>>();
};

solver::Result solve(const problem::Problem& problem, const Settings& settings, Monitor& monitor) {
  settings.seen->push_back(problem.subdomains.size());
  check_sums(problem);
  return solver::solve(problem, solver::Pdas{}, monitor);
}

}  // namespace asking

TEST_CASE("a method gets the subdomains it asks for, in every step; solutions keep none") {
  auto block = test::block("block", 2, mesh::Family::q1, 6);
  test::fix(block, "left");
  test::press(block, "top", 1);
  const auto scene = scene::make_scene({block});
  scene::add_contact(*scene, test::part(block, "bottom"), contact::RigidPlane{{0, -0.001, 0}, {0, 1, 0}}, {}, false);
  asking::Settings settings;
  settings.decomposition = test::by_boxes({2, 2, 1}, true);
  Monitor quiet;
  scene::Step half;
  half.all = 0.5;
  const auto s = scene::solve(scene, settings, {}, quiet, {half, {}, half});
  CHECK(*settings.seen == std::vector<std::size_t>{4, 4, 4});
  for (const auto& step : s->steps()) CHECK(step->model().problem.subdomains.empty());
  const auto plain = test::solve(scene);
  settings.seen->clear();
  const auto cut = scene::solve(scene, settings, {}, quiet);
  CHECK(settings.seen->size() == 1);
  CHECK(cut->model().problem.subdomains.empty());
  CHECK((cut->result().state.u.here() - plain->result().state.u.here()).norm() == 0);
}

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "../support/scenes.hpp"
#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"

using namespace dotyk;
using contact::Multipliers;
using mesh::Point;
using test::given;

namespace {

scene::GivenLaw given(elasticity::ScalarField g) { return {problem::laws::friction, std::move(g)}; }

std::shared_ptr<scene::Solution> solved(const std::shared_ptr<scene::Scene>& s) {
  Monitor quiet;
  auto solution = scene::solve(s, solver::Newton{}, {}, quiet);
  REQUIRE_MESSAGE(solution->result().converged, solution->result().reason);
  CHECK(solution->residual().law < 1e-9);
  return solution;
}

using Matrix = Eigen::Matrix3d;

Point times(const Matrix& A, const Point& x) {
  const Eigen::Vector3d y = A * Eigen::Vector3d(x[0], x[1], x[2]);
  return {y[0], y[1], y[2]};
}

/// A rotation in the plane, or about an axis that is none of the frame's.
Matrix rotation(int dim, double angle) {
  const Eigen::Vector3d axis = dim == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, 2, -1).normalized();
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Isotropic stress of a displacement gradient, plane strain in the plane.
Matrix stress(const Matrix& gradient, double E, double nu) {
  const Matrix strain = 0.5 * (gradient + gradient.transpose());
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  return lambda * strain.trace() * Matrix::Identity() + 2 * mu * strain;
}

struct Pair {
  std::shared_ptr<scene::Body> low, high;
  std::shared_ptr<scene::Scene> scene;
  std::shared_ptr<const scene::Contact> contact;
};

/// Two blocks on top of each other, turned by Q; the upper one's bottom is the first part.
Pair pair(int dim, mesh::Family family, int n, const Matrix& Q) {
  Pair p;
  p.low = test::block("low", dim, family, n, 0);
  p.high = test::block("high", dim, family, n, 1);
  for (const auto& b : {p.low, p.high}) {
    mesh::Mesh turned = *b->mesh;
    mesh::transform(turned, [&](const Point& x) { return times(Q, x); });
    b->mesh = std::make_shared<const mesh::Mesh>(std::move(turned));
  }
  p.scene = scene::make_scene({p.low, p.high});
  return p;
}

void join(Pair& p, const scene::GivenLaw& friction, const scene::Discretisation& d) {
  p.contact = scene::add_contact(*p.scene, test::part(p.high, "bottom"), test::part(p.low, "top"), {}, friction, false, d);
}

}  // namespace

TEST_CASE("constant pressure and a constant shear below the bound are transmitted exactly") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const double angle : {0.0, 0.4})
        for (const scene::Discretisation d : {scene::Discretisation{}, scene::Discretisation{Multipliers::p1_p0, 0},
                                              scene::Discretisation{Multipliers::p1_p0, 0.5}}) {
          const Matrix Q = rotation(dim, angle);
          Matrix A = Matrix::Zero();  // a linear displacement: pressed together and sheared
          A.topLeftCorner(dim, dim).setConstant(0.002);
          A(dim - 1, dim - 1) = -0.02;
          A(0, dim - 1) = 0.007;
          if (dim == 3) A(1, 2) = -0.003;
          A = Q * A * Q.transpose();
          const Matrix sigma = stress(A, 210, 0.3);
          Pair p = pair(dim, family, 4, Q);
          auto bottom = test::part(p.low, "bottom");
          std::array<elasticity::ScalarField, 3> exact;
          for (int i = 0; i < dim; ++i) exact[i] = [=](const Point& x) { return times(A, x)[i]; };
          scene::displace(bottom, exact);
          const auto outside = [&](const std::shared_ptr<scene::Body>& b, const char* name, int axis, double sign) {
            Point e{0, 0, 0};
            e[axis] = sign;
            const Eigen::Vector3d t = sigma * Q * Eigen::Vector3d(e[0], e[1], e[2]);
            test::pull(b, name, [=](const Point&) { return Point{t[0], t[1], t[2]}; });
          };
          for (const auto& b : {p.low, p.high}) {
            outside(b, "left", 0, -1), outside(b, "right", 0, 1);
            if (dim == 3) outside(b, "front", 1, -1), outside(b, "back", 1, 1);
          }
          outside(p.high, "top", dim - 1, 1);
          join(p, given(5), d);
          const auto s = solved(p.scene);
          // Exact but for rounding of some hundred unknowns.
          const double tiny = 1e-10;
          for (int b : {0, 1}) {
            const auto& m = *s->body(b).mesh;
            for (int n = 0; n < m.node_count(); ++n)
              for (int i = 0; i < dim; ++i)
                CHECK(std::abs(s->displacement(b)[static_cast<std::size_t>(n) * dim + i] - times(A, m.point(n))[i]) < tiny);
          }
          const auto c = s->contact(*p.contact);
          CHECK(c.stick == static_cast<int>(c.nodes.size()));
          for (const auto& node : c.nodes) {
            const Eigen::Vector3d normal(node.normal[0], node.normal[1], node.normal[2]), t = sigma * normal;
            CHECK(std::abs(node.pressure + normal.dot(t)) < tiny);
            for (int i = 0; i < 3; ++i) CHECK(std::abs(node.shear[i] - (t - normal.dot(t) * normal)[i]) < tiny);
          }
          const Eigen::Vector3d force = sigma * Q * Eigen::Vector3d(0, dim == 2 ? -1 : 0, dim == 2 ? 0 : -1);
          for (int i = 0; i < dim; ++i) CHECK(std::abs(c.force[i] - force[i]) < tiny);
        }
}

TEST_CASE("a block that slides as a whole: the friction is the bound's integral") {
  // Zero on the left quarter, then rising: piecewise linear on the mesh, ∫ = 4 ∫₀^¾ s ds = 9/8 per width.
  const auto g = [](const Point& x) { return 4 * std::max(0.0, x[0] - 0.25); };
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies)
      for (const double size : {0.0, 0.3, 0.5})
        for (const bool rigid : {false, true}) {
          const auto high = test::block("high", dim, family, 4, 1);
          auto top = test::part(high, "top");
          std::array<elasticity::ScalarField, 3> move;
          for (int i = 0; i < dim; ++i)
            move[i] = [=](const Point&) { return i == 0 ? 0.1 : i == dim - 1 ? -0.05 : 0.04; };
          scene::displace(top, move);
          std::vector<std::shared_ptr<scene::Body>> bodies{high};
          const auto low = test::block("low", dim, family, 4, 0);
          if (!rigid) bodies.push_back(low), test::fix(low, "bottom");
          auto scene = scene::make_scene(bodies);
          const scene::Discretisation d{Multipliers::p1_p0, size};
          Point at{0, 0, 0}, up{0, 0, 0};
          at[dim - 1] = up[dim - 1] = 1;
          const auto contact =
              rigid ? scene::add_contact(*scene, test::part(high, "bottom"), contact::RigidPlane{at, up}, {}, false, given(g), d)
                    : scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {}, given(g), false, d);
          const auto s = solved(scene);
          const auto c = s->contact(*contact);
          double slipping = 0;
          for (const auto& node : c.nodes) {
            CHECK(node.status != problem::Status::stick);
            const double shear = test::length(node.shear);
            // A node in space lies in several cells, whose directions differ a little.
            CHECK(shear == doctest::Approx(g(node.x)).epsilon(dim == 2 ? 1e-10 : 0.01));
            CHECK(shear <= g(node.x) * (1 + 1e-10));  // Newton's residual
          }
          for (const auto& cell : s->model().friction[0]) {
            const double force = s->result().state.lambda.segment(cell.row[0], cell.count).norm();
            CHECK(force == doctest::Approx(cell.cell.bound).epsilon(1e-10));
            slipping += force;
          }
          CHECK(slipping == doctest::Approx(9.0 / 8).epsilon(1e-10));
          // In the plane all slip points one way; in space the resultant falls short by the spread of directions.
          if (dim == 2)
            CHECK(c.force[0] == doctest::Approx(-9.0 / 8).epsilon(1e-12));
          else
            CHECK(std::hypot(c.force[0], c.force[1]) == doctest::Approx(9.0 / 8).epsilon(0.01));
          // Action is reaction: with the support above, and with the one below.
          const Point above = s->reaction(top);
          const Point below = rigid ? Point{} : s->reaction(test::part(low, "bottom"));
          for (int i = 0; i < dim; ++i) {
            CHECK(above[i] + c.force[i] == doctest::Approx(0).scale(1).epsilon(1e-10));
            if (!rigid) CHECK(below[i] == doctest::Approx(c.force[i]).epsilon(1e-9));
          }
          // Dissipation: the bound times the mean slip, never more than ∫ g|u_t| of the interpolated slip.
          if (dim == 2) {
            const contact::Surface surface = scene::surface_of(*contact);
            double work = 0;
            for (const auto& f : surface.facets) {
              const auto gram = contact::gram(surface.mesh, f.facet);
              for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b)
                  work += gram[a][b] * g(c.nodes[f.row[a]].x) * test::length(c.nodes[f.row[b]].slip);
            }
            CHECK(s->friction_energy() == doctest::Approx(work).epsilon(1e-11));
          }
        }
}

TEST_CASE("nodal and report's multipliers approach each other faster than either the exact solution") {
  const auto total = [](int n, Multipliers m) {
    const auto half = [&](const char* name, double y) {
      return test::body(name, test::rectangle(mesh::Family::p1, n, n / 2, 0, y, 2, y + 1), 1000);
    };
    const auto low = half("lower", 0), high = half("upper", 1);
    test::fix(low, "bottom");
    test::pull(high, "top", [](const Point&) { return Point{2, -10, 0}; });
    auto scene = scene::make_scene({low, high});
    const auto contact = scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {}, given(2.5), false, {m, 0});
    const auto s = solved(scene);
    const auto c = s->contact(*contact);
    CHECK(c.force[0] == doctest::Approx(-4).epsilon(1e-11));
    CHECK(c.force[1] == doctest::Approx(20).epsilon(1e-11));
    CHECK(c.open == 0);
    for (const auto& node : c.nodes) {
      CHECK(test::length(node.shear) <= 2.5 * (1 + 1e-11));
      if (node.status == problem::Status::slip) CHECK(test::length(node.shear) == doctest::Approx(2.5).epsilon(1e-11));
    }
    return s->energy() + s->friction_energy();
  };
  double difference[3], nodal[3], report[3];
  const int cells[3] = {8, 16, 32};
  for (int k = 0; k < 3; ++k) {
    nodal[k] = total(cells[k], Multipliers::nodal);
    report[k] = total(cells[k], Multipliers::p1_p0);
    difference[k] = std::abs(nodal[k] - report[k]);
  }
  for (int k = 0; k < 2; ++k) {
    MESSAGE("order of the difference of energies " << std::log2(difference[k] / difference[k + 1]) << ", of the energy "
            << (k == 0 ? std::log2(std::abs((report[0] - report[1]) / (report[1] - report[2]))) : 0));
    CHECK(difference[k] > 4 * difference[k + 1]);                         // at least second order
    CHECK(difference[k] < 0.01 * std::abs(report[k] - report[k + 1]));    // small against the error itself
  }
}

TEST_CASE("in space as well, for triangles and quadrilaterals") {
  for (const auto family : test::kFamilies) {
    double difference[2], change = 0, last = 0;
    const int cells[2] = {4, 8};
    for (int k = 0; k < 2; ++k) {
      double energy[2];
      for (const auto m : {Multipliers::nodal, Multipliers::p1_p0}) {
        const auto low = test::block("low", 3, family, cells[k], 0), high = test::block("high", 3, family, cells[k], 1);
        test::fix(low, "bottom");
        test::pull(high, "top", [](const Point&) { return Point{0.5, 0.25, -3}; });
        auto scene = scene::make_scene({low, high});
        scene::add_contact(*scene, test::part(high, "bottom"), test::part(low, "top"), {}, given(1), false, {m, 0});
        const auto s = solved(scene);
        energy[static_cast<int>(m)] = s->energy() + s->friction_energy();
      }
      difference[k] = std::abs(energy[0] - energy[1]);
      change = std::abs(energy[1] - last), last = energy[1];
    }
    MESSAGE("differences " << difference[0] << ", " << difference[1] << "; the energy changed by " << change);
    CHECK(difference[1] < 0.5 * difference[0]);
    CHECK(difference[1] < 0.2 * change);
  }
}

TEST_CASE("frictionless: the pressure in space is piecewise linear, in the plane as with nodal multipliers") {
  for (int dim : {2, 3}) {
    double energy[2], highest[2];
    for (const auto m : {Multipliers::nodal, Multipliers::p1_p0}) {
      const auto cube = test::block("cube", dim, mesh::Family::q1, 8);
      test::fix(cube, "bottom");
      auto scene = scene::make_scene({cube});
      Point centre{0.5, dim == 3 ? 0.5 : 0, 0};
      centre[dim - 1] = 3.98;
      const auto contact = scene::add_contact(*scene, test::part(cube, "top"), contact::RigidBall{centre, 3}, {}, true, {}, {m, 0});
      const auto s = solved(scene);
      const auto c = s->contact(*contact);
      double sum = 0;
      for (const auto& node : c.nodes) {
        CHECK(node.pressure >= 0);
        sum += node.pressure * node.weight;
      }
      CHECK(s->reaction(test::part(cube, "bottom"))[dim - 1] == doctest::Approx(-c.force[dim - 1]).epsilon(1e-10));
      CHECK(sum == doctest::Approx(std::abs(c.force[dim - 1])).epsilon(1e-10));  // a flat part's normals are parallel
      energy[static_cast<int>(m)] = s->energy();
      highest[static_cast<int>(m)] = c.max_pressure;
    }
    if (dim == 2)
      CHECK(energy[1] == energy[0]);
    else
      CHECK(energy[1] == doctest::Approx(energy[0]).epsilon(0.1));
    CHECK(highest[1] == doctest::Approx(highest[0]).epsilon(0.25));
  }
}

TEST_CASE("where supports hold both sides of the contact, multipliers stay unique") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      Pair p = pair(dim, family, 6, Matrix::Identity());
      test::fix(p.low, "bottom");
      for (const auto& b : {p.low, p.high})
        for (const char* side : {"left", "right"}) test::fix(b, side);
      test::pull(p.high, "top", [=](const Point&) {
        Point t{0, 0, 0};
        t[0] = 1, t[dim - 1] = -3;
        return t;
      });
      join(p, given(0.2), {Multipliers::p1_p0, 0});
      problem::Clock clock;
      Monitor quiet;
      const scene::Model model = scene::build(*p.scene, clock, quiet);
      const problem::CondensedProblem condensed(model.problem, problem::rigid_motions(model.problem),
                                                algebra::Ordering::automatic, clock, quiet);
      const algebra::Vector eigen = algebra::eigenvalues(condensed.W());
      CHECK(eigen[0] > 1e-4 * eigen.tail(1)[0]);
      const auto s = solved(p.scene);
      CHECK(s->result().reason.find("regularised") == std::string::npos);
      const auto c = s->contact(*p.contact);
      CHECK(c.max_pressure > 0);
      // Every support's reaction with the load: nothing is lost where hats are shared out.
      for (int i = 0; i < dim; ++i) {
        double sum = i == 0 ? 1 : i == dim - 1 ? -3 : 0;
        std::vector<scene::Part> held{test::part(p.low, "bottom")};
        for (const auto& b : {p.low, p.high})
          for (const char* side : {"left", "right"}) held.push_back(test::part(b, side));
        for (const auto& part : held) sum += s->reaction(part)[i];
        CHECK(std::abs(sum) < 1e-10);
      }
    }
}

TEST_CASE("no slip at all, and no friction, with the report's multipliers") {
  const double infinite = std::numeric_limits<double>::infinity();
  for (int dim : {2, 3}) {
    const auto energy = [&](const scene::GivenLaw& friction) {
      Pair p = pair(dim, mesh::Family::p1, 4, Matrix::Identity());
      test::fix(p.low, "bottom");
      test::fix(p.high, "left");
      test::pull(p.high, "top", [=](const Point&) {
        Point t{0.3, 0, 0};
        t[dim - 1] = -1;
        return t;
      });
      join(p, friction, {Multipliers::p1_p0, 0});
      return solved(p.scene)->energy();
    };
    CHECK(energy(given(infinite)) == doctest::Approx(energy(given(1e6))).epsilon(1e-10));
    CHECK(energy(given(0)) == doctest::Approx(energy({})).epsilon(1e-14));
    CHECK_THROWS_WITH_AS(energy(given([&](const Point& x) { return x[0] < 0.5 ? infinite : 1; })),
                         doctest::Contains("infinite on a part"), InputError);
    CHECK_THROWS_WITH_AS(energy({problem::laws::coulomb, [](const Point&) { return 0.3; }}),
                         doctest::Contains("Coulomb friction does not go with multipliers"), InputError);
  }
}

TEST_CASE("a part that overhangs: friction and pressure belong to the contact boundary alone") {
  for (const auto m : {Multipliers::nodal, Multipliers::p1_p0}) {
    // The wider block is the first part: its cells beyond the narrow one carry nothing.
    const auto wide = test::body("wide", test::rectangle(mesh::Family::p1, 8, 4, -0.5, 0, 1.5, 1));
    const auto narrow = test::body("narrow", test::rectangle(mesh::Family::p1, 4, 4, 0, 1, 1, 2));
    test::fix(wide, "bottom");
    auto top = test::part(narrow, "top");
    scene::displace(top, {[](const Point&) { return 0.1; }, [](const Point&) { return -0.05; }, {}});
    auto scene = scene::make_scene({wide, narrow});
    const auto contact = scene::add_contact(*scene, test::part(wide, "top"), test::part(narrow, "bottom"), {}, given(2), false, {m, 0});
    const auto c = solved(scene)->contact(*contact);
    CHECK(c.area == doctest::Approx(1).epsilon(1e-14));
    CHECK(c.force[0] == doctest::Approx(2).epsilon(1e-11));
  }
}

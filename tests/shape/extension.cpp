#include "shape/design/extension.hpp"

#include <doctest/doctest.h>

#include "../support/scenes.hpp"
#include "base/error.hpp"

using namespace dotyk;
using mesh::Point;
using shape::BoundaryMotion;
using shape::Extension;
using shape::extend;

namespace {

using Field = std::vector<double>;

mesh::Mesh moved(mesh::Mesh m, const Field& V, double t) {
  for (std::size_t k = 0; k < V.size(); ++k) m.coordinates[k] += t * V[k];
  return m;
}

/// A motion by a velocity field on a part.
BoundaryMotion by(const scene::Part& part, const std::function<Point(const Point&)>& v) {
  BoundaryMotion m = shape::bspline_motion(part, {{4, 4}, 1, Point{1, 0, 0}});
  m.weight = algebra::DenseMatrix::Ones(m.weight.rows(), 1);
  for (std::size_t a = 0; a < m.nodes.size(); ++a) m.direction[a] = v(part.body->mesh->point(m.nodes[a]));
  return m;
}

double difference(const mesh::Mesh& m, const Field& V, const std::function<Point(const Point&)>& exact) {
  double worst = 0;
  for (int n = 0; n < m.node_count(); ++n)
    for (int i = 0; i < m.dimension(); ++i) worst = std::max(worst, std::abs(V[static_cast<std::size_t>(n) * m.dimension() + i] - exact(m.point(n))[i]));
  return worst;
}

scene::Part whole_boundary(const std::shared_ptr<scene::Body>& body) {
  return scene::chosen_part(body, "all", [](auto&, auto&) { return true; });
}

/// A block whose top bulges, its cells uneven: rows of nodes between bottom and top remain.
mesh::Mesh uneven(mesh::Family family, int nx, int ny) {
  mesh::Mesh m = test::rectangle(family, nx, ny, 0, 0, 2, 1);
  mesh::transform(m, [](const Point& x) { return Point{x[0] + 0.1 * std::sin(3 * x[0]) * x[0] * (2 - x[0]), x[1] * (1 + 0.2 * std::sin(x[0])) + 0.1 * x[1] * (1 - x[1]), 0}; });
  return m;
}

}  // namespace

TEST_CASE("the harmonic extension continues affine motions of the whole boundary exactly, on distorted meshes, all elements") {
  for (int dimension : {2, 3})
    for (const auto family : test::kFamilies) {
      mesh::Mesh m = test::unit(dimension, family, 4);
      test::distort(m, 0.02);
      const auto affine = [&](const Point& x) {
        return Point{0.3 + x[0] - 2 * x[1] + 0.5 * x[2], 0.2 * x[0] + 0.7 * x[1] - x[2], dimension == 2 ? 0.0 : 1 - x[0] + 0.3 * x[1] + 2 * x[2]};
      };
      const auto body = test::body("block", m);
      const auto part = whole_boundary(body);
      BoundaryMotion motion{part, {}, {}, {}};
      for (int n = 0; n < m.node_count(); ++n) {
        bool outside = false;
        for (int i = 0; i < dimension; ++i) outside = outside || m.node(n)[i] == 0 || m.node(n)[i] == 1;
        if (outside) motion.nodes.push_back(n), motion.direction.push_back(affine(m.point(n)));
      }
      motion.weight = algebra::DenseMatrix::Ones(static_cast<Eigen::Index>(motion.nodes.size()), 1);
      CHECK(difference(m, extend(motion, {}).front(), affine) < 1e-12);
    }
}

TEST_CASE("a bottom moved as one: lines of a rectangle are stretched evenly, harmonic and structured alike") {
  for (const auto family : test::kFamilies) {
    const auto body = test::body("block", test::rectangle(family, 8, 6, 0, 1, 4, 3));
    const auto motion = by(test::part(body, "bottom"), [](const Point&) { return Point{0, 1, 0}; });
    const auto even = [](const Point& x) { return Point{0, (3 - x[1]) / 2, 0}; };
    for (const auto kind : {Extension::harmonic, Extension::structured})
      CHECK(difference(*body->mesh, extend(motion, {test::part(body, "top")}, kind).front(), even) < 1e-12);
  }
  for (const auto family : test::kFamilies) {  // in space the sides slide, too
    const auto body = test::body("box", test::box(family, 3, 3, 4));
    const auto motion = by(test::part(body, "bottom"), [](const Point&) { return Point{0, 0, 1}; });
    CHECK(difference(*body->mesh, extend(motion, {}).front(), [](const Point& x) { return Point{0, 0, 1 - x[2]}; }) < 1e-12);
  }
}

TEST_CASE("sides that are straight but along no axis stretch as well: a turned block gives the turned field") {
  const double c = std::cos(0.4), s = std::sin(0.4);
  for (const auto family : test::kFamilies) {
    mesh::Mesh m = test::rectangle(family, 8, 6);
    const auto straight = test::body("straight", m);
    mesh::transform(m, [&](const Point& x) { return Point{c * x[0] - s * x[1], s * x[0] + c * x[1], 0}; });
    const auto turned = test::body("turned", m);
    const auto a = extend(shape::bspline_motion(test::part(straight, "bottom"), {}), {});
    const auto b = extend(shape::bspline_motion(test::part(turned, "bottom"), {}), {});
    REQUIRE(a.size() == 6);
    double worst = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
      for (std::size_t n = 0; n + 1 < a[v].size(); n += 2)
        worst = std::max(worst, std::hypot(c * a[v][n] - s * a[v][n + 1] - b[v][n], s * a[v][n] + c * a[v][n + 1] - b[v][n + 1]));
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("both kinds have the given velocity on the part, move nothing off the other sides, and are linear in it") {
  for (const auto family : test::kFamilies)
    for (const auto kind : {Extension::harmonic, Extension::structured}) {
      const auto body = test::body("block", test::rectangle(family, 12, 8, 0, 0, 3, 2));
      const auto motion = shape::bspline_motion(test::part(body, "bottom"), {{6, 6}, 3, Point{0, 1, 0}});
      const auto V = extend(motion, {}, kind);
      REQUIRE(V.size() == 6);
      for (int v = 0; v < 6; ++v) {
        for (std::size_t a = 0; a < motion.nodes.size(); ++a) {
          CHECK(V[v][motion.nodes[a] * 2] == 0);
          CHECK(V[v][motion.nodes[a] * 2 + 1] == motion.velocity(a, v)[1]);
        }
        for (int n = 0; n < body->mesh->node_count(); ++n) {
          const double* x = body->mesh->node(n);
          if (x[0] == 0 || x[0] == 3) CHECK(V[v][n * 2] == 0);
          if (x[1] == 2) CHECK(V[v][n * 2 + 1] == 0);
        }
      }
      algebra::DenseMatrix T(6, 1);
      T << 1, -2, 0.5, 3, 0, -1;
      const auto sum = extend(shape::combined(motion, T), {}, kind);
      double worst = 0;
      for (std::size_t k = 0; k < sum[0].size(); ++k) {
        double expected = 0;
        for (int v = 0; v < 6; ++v) expected += T(v, 0) * V[v][k];
        worst = std::max(worst, std::abs(sum[0][k] - expected));
      }
      CHECK(worst < 1e-13);
    }
}

TEST_CASE("no cell inverts where a control point goes a third of the height in, or out; nine tenths along lines") {
  for (const auto family : test::kFamilies)
    for (const auto kind : {Extension::harmonic, Extension::structured})
      for (const auto& m : {test::rectangle(family, 40, 20, 0, 0, 2, 1), uneven(family, 24, 12)}) {
        const auto body = test::body("block", m);
        for (const char* name : {"bottom", "top"})
          for (const auto& V : extend(shape::bspline_motion(test::part(body, name), {{6, 6}, 3, Point{0, 1, 0}}), {}, kind))
            for (double t : kind == Extension::harmonic ? std::vector{-0.33, 0.33} : std::vector{-0.9, 0.9}) CHECK_NOTHROW(mesh::check(moved(m, V, t), "moved"));
      }
}

TEST_CASE("the harmonic field is of the shape, not of the mesh: second order between meshes") {
  double last = 0;
  std::vector<double> middle;
  for (int n : {6, 12, 24, 48}) {
    const auto body = test::body("block", test::rectangle(mesh::Family::q1, n, n));
    const auto V = extend(shape::bspline_motion(test::part(body, "bottom"), {{6, 6}, 3, Point{0, 1, 0}}), {})[2];
    middle.push_back(V[2 * static_cast<std::size_t>((n + 1) * (n / 3) + n / 3) + 1]);
  }
  last = (middle[1] - middle[2]) / (middle[2] - middle[3]);
  CHECK(last == doctest::Approx(4).epsilon(0.3));
}

TEST_CASE("how far a control point may go does not depend on the mesh") {
  std::vector<double> limit;
  for (int n : {16, 32, 64}) {
    const auto body = test::body("block", test::rectangle(mesh::Family::q1, 2 * n, n, 0, 0, 2, 1));
    const auto V = extend(shape::bspline_motion(test::part(body, "bottom"), {{6, 6}, 3, Point{0, 1, 0}}), {})[0];
    double low = 0, high = 2;
    for (int k = 0; k < 12; ++k) {
      const double t = (low + high) / 2;
      const auto m = moved(*body->mesh, V, -t);
      bool valid = true;
      for (int c = 0; c < m.cell_count(); ++c) valid = valid && mesh::least_jacobian(m, c) > 0;
      (valid ? low : high) = t;
    }
    limit.push_back(low);
  }
  CHECK(limit[0] - limit[1] < 0.15);
  CHECK(limit[1] - limit[2] < 0.6 * (limit[0] - limit[1]));  // the least Jacobian of cells at the boundary: first order
}

TEST_CASE("sides follow to their next corner, to a fixed part, or from one end of the part to the other") {
  const auto body = test::body("block", test::rectangle(mesh::Family::q1, 8, 8));
  const auto up = [](const Point&) { return Point{0.5, 1, 0}; };
  const auto at = [&](const Field& V, double x, double y) {
    for (int n = 0; n < body->mesh->node_count(); ++n)
      if (std::hypot(body->mesh->node(n)[0] - x, body->mesh->node(n)[1] - y) < 1e-9) return Point{V[2 * n], V[2 * n + 1], 0};
    return Point{NAN, NAN, NAN};
  };
  const auto bottom = extend(by(test::part(body, "bottom"), up), {}).front();
  CHECK(at(bottom, 0, 0.75) == Point{0.125, 0.25, 0});
  CHECK(at(bottom, 1, 0.25) == Point{0.375, 0.75, 0});
  CHECK(at(bottom, 0.5, 1) == Point{0, 0, 0});
  const auto middle = scene::chosen_part(body, "middle", [](const Point& x, const Point& n) { return n[1] < -0.5 && std::abs(x[0] - 0.5) < 0.25; });
  const auto beside = extend(by(middle, up), {}).front();
  CHECK(at(beside, 0.125, 0) == Point{0.25, 0.5, 0});
  CHECK(at(beside, 0, 0) == Point{0, 0, 0});
  const auto upper = scene::chosen_part(body, "upper", [](const Point& x, const Point& n) { return n[0] < -0.5 && x[1] > 0.5; });
  CHECK(at(extend(by(test::part(body, "bottom"), up), {upper}).front(), 0, 0.25) == Point{0.25, 0.5, 0});
  const auto disc = test::body("disc", test::disc(mesh::Family::p1, 6));
  const auto arc = scene::chosen_part(disc, "arc", [](const Point& x, const Point&) { return x[1] < 0; });
  const Field whole = extend(by(arc, up), {}).front();  // both ends move alike, and all between
  for (int n = 0; n < disc->mesh->node_count(); ++n) CHECK(std::hypot(whole[2 * n] - 0.5, whole[2 * n + 1] - 1) < 1e-12);
}

TEST_CASE("fixed parts stay as they are; where the motion would move them it is refused") {
  const auto body = test::body("block", test::rectangle(mesh::Family::q1, 8, 4));
  const auto inner = shape::bspline_motion(test::part(body, "bottom"), {{6, 6}, 3, Point{0, 1, 0}});
  algebra::DenseMatrix T = algebra::DenseMatrix::Zero(6, 4);
  T.middleRows(1, 4).setIdentity();
  const auto V = extend(shape::combined(inner, T), {test::part(body, "left"), test::part(body, "top")});
  for (const auto& v : V)
    for (int n = 0; n < body->mesh->node_count(); ++n)
      if (body->mesh->node(n)[0] == 0 || body->mesh->node(n)[1] == 1) CHECK((v[n * 2] == 0 && v[n * 2 + 1] == 0));
  CHECK_THROWS_WITH_AS(extend(inner, {test::part(body, "left")}),
                       "'block' left is to stay, but variable 1 of 'block' bottom moves its node (0, 0)", InputError);
  CHECK_THROWS_AS(extend(inner, {test::part(body, "left")}, Extension::structured), InputError);
  const auto other = test::body("other", test::rectangle(mesh::Family::q1, 2, 2));
  CHECK_THROWS_AS(extend(inner, {test::part(other, "left")}), InputError);
}

TEST_CASE("structured extensions refuse what is no mapped grid; harmonic ones take it") {
  for (const auto family : test::kFamilies) {
    const auto body = test::body("disc", test::disc(family, 6));
    const auto motion = shape::bspline_motion(test::part(body, "boundary"), {{8, 8}, 3, {}});
    CHECK_THROWS_AS(extend(motion, {}, Extension::structured), InputError);
    for (const auto& V : extend(motion, {}))
      for (double t : {-0.2, 0.2}) CHECK_NOTHROW(mesh::check(moved(*body->mesh, V, t), "moved"));
    const auto box = test::body("box", test::box(family, 2, 2, 2));
    CHECK_THROWS_AS(extend(shape::bspline_motion(test::part(box, "top"), {{4, 4}, 3, {}}), {}, Extension::structured), InputError);
    CHECK_NOTHROW(extend(shape::bspline_motion(test::part(box, "top"), {{4, 4}, 3, {}}), {}));
  }
}

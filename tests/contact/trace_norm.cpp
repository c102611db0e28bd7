#include "contact/trace_norm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "../support/meshes.hpp"
#include "contact/rigid.hpp"

using namespace dotyk;
using mesh::Point;

namespace {

Monitor quiet;

struct ScaledTop {
  mesh::Mesh mesh;
  std::vector<contact::ContactRow> rows;
  contact::Surface surface;
  ScaledTop(int dim, mesh::Family family, int n, double scale = 1)
      : mesh(scaled(test::unit(dim, family, n), scale)), rows(made(mesh, scale)),
        surface(contact::surface(mesh, mesh.parts.at("top"), rows, {})) {}
  static mesh::Mesh scaled(mesh::Mesh m, double scale) {
    for (double& x : m.coordinates) x *= scale;
    return m;
  }
  static std::vector<contact::ContactRow> made(const mesh::Mesh& m, double scale) {
    Point at{0, 0, 0}, down{0, 0, 0};
    at[m.dimension() - 1] = scale;
    down[m.dimension() - 1] = -1;
    return contact::against(m, m.parts.at("top"), contact::RigidPlane{at, down}, {}, false);
  }
  /// The interpolated function as a density.
  contact::Density density(const std::function<double(const Point&)>& f) const {
    contact::Density d;
    for (std::size_t k = 0; k < surface.facets.size(); ++k) {
      contact::DensityPiece piece{static_cast<int>(k), -1, {0, 0, 0, 0}};
      for (int a = 0; a < surface.facets[k].corners; ++a)
        piece.corner[a] = f(mesh.point(mesh.facet_node(surface.facets[k].facet, a)));
      d.push_back(piece);
    }
    return d;
  }
  std::vector<char> all() const { return std::vector<char>(rows.size(), 1); }
};

}  // namespace

TEST_CASE("the trace norm of waves: the L2 norm times (k² + 1/ℓ²)^(-1/4)") {
  for (int dim : {2, 3})
    for (const auto family : test::kFamilies) {
      const ScaledTop top(dim, family, dim == 2 ? 64 : 16);
      const double length = 0.7;
      std::vector<contact::Density> waves;
      for (int k : {0, 1, 3}) waves.push_back(top.density([=](const Point& x) { return std::cos(k * std::numbers::pi * x[0]); }));
      const auto gram = contact::trace_gram(top.surface, top.all(), waves, length, quiet);
      const int number[3] = {0, 1, 3};
      for (int a = 0; a < 3; ++a) {
        const double k = number[a] * std::numbers::pi, l2 = number[a] == 0 ? 1 : 0.5;
        // Interpolation of the third wave, (kh)²/6 of its square: a hundredth in space.
        CHECK(gram(a, a) == doctest::Approx(l2 / std::sqrt(k * k + 1 / (length * length))).epsilon(dim == 2 ? 0.005 : 0.07));
        for (int b = 0; b < a; ++b) CHECK(std::abs(gram(a, b)) < (dim == 2 ? 1e-3 : 5e-3));
      }
      // A constant is its own solution: only the rule's 1e-4 is left.
      CHECK(gram(0, 0) == doctest::Approx(length).epsilon(2e-4));
    }
}

TEST_CASE("where traces vanish at the ends, a sine is the wave") {
  const ScaledTop top(2, mesh::Family::p1, 64);
  std::vector<char> moves = top.all();
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const double x = top.mesh.point(top.rows[k].node)[0];
    if (x == 0 || x == 1) moves[k] = 0;
  }
  for (int n : {1, 2, 5}) {
    const double k = n * std::numbers::pi;
    const auto gram = contact::trace_gram(top.surface, moves, {top.density([=](const Point& x) { return std::sin(k * x[0]); })}, 2, quiet);
    CHECK(gram(0, 0) == doctest::Approx(0.5 / std::sqrt(k * k + 0.25)).epsilon(0.02));
  }
}

TEST_CASE("the trace norm has the units of its formula, and adds up over halves") {
  for (const auto family : test::kFamilies) {
    const ScaledTop one(2, family, 4), large(2, family, 4, 1000);
    const auto f = [](double scale) { return [=](const Point& x) { return 1 + 3 * x[0] / scale; }; };
    const double a = contact::trace_gram(one.surface, one.all(), {one.density(f(1))}, 0.5, quiet)(0, 0);
    const double b = contact::trace_gram(large.surface, large.all(), {large.density(f(1000))}, 500, quiet)(0, 0);
    CHECK(b == doctest::Approx(1e6 * a).epsilon(1e-4));  // ∫∫ in the plane: length²
    contact::Density halves;
    for (const auto& piece : one.density(f(1)))
      for (int half : {0, 1}) halves.push_back({piece.facet, half, {piece.corner[0], piece.corner[1], 0, 0}});
    CHECK(contact::trace_gram(one.surface, one.all(), {halves}, 0.5, quiet)(0, 0) == doctest::Approx(a).epsilon(1e-12));
  }
}

// How a model is added: bars in a truss that touch stops, the ground and each other. Its rows come from the shared builder, its method is the default one.
#include <doctest/doctest.h>

#include <cmath>

#include "problem/residual.hpp"
#include "problem/rows.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/verdict.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/proximal.hpp"

using namespace dotyk;
using algebra::Vector;
using Eigen::Vector2d;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;

namespace {

struct Bar {
  int from, to;
  double EA;
};

/// Joints with two displacements each, but for those that are fixed.
struct Truss {
  std::vector<Vector2d> joints;
  std::vector<Bar> bars;
  std::vector<int> fixed;
  std::vector<std::pair<int, Vector2d>> loads;

  int unknown(int joint, int component) const {
    int before = 0;
    for (const int f : fixed) {
      if (f == joint) return -1;
      before += f < joint;
    }
    return 2 * (joint - before) + component;
  }

  /// ½Σ EA/L (t·(u_to − u_from))² − Σ F·u; the kernel of a truss that nothing fixes: two translations and a rotation.
  problem::Block block() const {
    const int n = 2 * static_cast<int>(joints.size() - fixed.size());
    algebra::DenseMatrix K = algebra::DenseMatrix::Zero(n, n);
    for (const Bar& bar : bars) {
      const Vector2d way = joints[bar.to] - joints[bar.from], t = way.normalized();
      for (const auto& [i, si] : {std::pair(bar.from, -1), {bar.to, 1}})
        for (const auto& [j, sj] : {std::pair(bar.from, -1), {bar.to, 1}})
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              if (unknown(i, a) >= 0 && unknown(j, b) >= 0) K(unknown(i, a), unknown(j, b)) += si * sj * bar.EA / way.norm() * t[a] * t[b];
    }
    problem::Block block;
    block.name = "truss";
    block.K = algebra::SparseMatrix(algebra::DenseMatrix(K.triangularView<Eigen::Lower>()).sparseView());
    block.f = Vector::Zero(n);
    for (const auto& [joint, force] : loads)
      for (int a = 0; a < 2; ++a) block.f[unknown(joint, a)] += force[a];
    for (int i = 0; i < n; ++i) block.node.push_back(i / 2);
    block.kernel.resize(n, fixed.empty() ? 3 : 0);
    for (int i = 0; i < n && fixed.empty(); ++i) block.kernel.row(i) << (i % 2 == 0), (i % 2 == 1), i % 2 == 0 ? -joints[i / 2].y() : joints[i / 2].x();
    if (fixed.empty()) block.motions = {{Motion::Kind::translation, {1, 0}}, {Motion::Kind::translation, {0, 1}}, {Motion::Kind::rotation, {}, {}}};
    return block;
  }
};

/// A joint, or how far one joint is ahead of another, along a direction: the law is about v = gap − direction·(u_joint − u_other).
struct Touch {
  int joint, other;
  Vector2d direction;
  double gap;
  LawChoice law;
  double friction = 0;  ///< Coulomb's coefficient
};

problem::Problem touching(const Truss& truss, const std::vector<Touch>& touches) {
  problem::Problem p;
  problem::add(p, truss.block());
  problem::Rows rows(p);
  const auto enter = [&](const Touch& touch, const Vector2d& direction) {
    for (const auto& [joint, sign] : {std::pair(touch.joint, 1), {touch.other, -1}})
      for (int a = 0; a < 2; ++a)
        if (joint >= 0 && truss.unknown(joint, a) >= 0) rows.entry(truss.unknown(joint, a), sign * direction[a]);
  };
  std::vector<int> normal;
  for (const Touch& touch : touches) {
    rows.open_group("touch", touch.law);
    enter(touch, touch.direction);
    normal.push_back(rows.add(touch.gap));
  }
  for (std::size_t k = 0; k < touches.size(); ++k) {
    if (touches[k].friction == 0) continue;
    const int first = rows.open_friction();
    enter(touches[k], {-touches[k].direction.y(), touches[k].direction.x()});
    rows.add(0);
    p.friction.push_back({"touch", problem::coulomb({touches[k].friction}), first, 1, {normal[k]}});
  }
  rows.finish({});
  return p;
}

solver::Result solved(const problem::Problem& p, const solver::Method& method = {}) {
  Monitor quiet;
  solver::Result r = solver::solve(p, method, {}, quiet);
  solver::judge(p, r);
  REQUIRE_MESSAGE(r.converged, r.reason);
  return r;
}

}  // namespace

TEST_CASE("two bars over a stop: it bears what the bars do not at its gap") {
  const double h = 0.6, EA = 50, load = 3, gap = 0.01, L = std::sqrt(1 + h * h), k = 2 * EA * h * h / (L * L * L);
  const Truss truss{{{-1, 0}, {0, h}, {1, 0}}, {{0, 1, EA}, {1, 2, EA}}, {0, 2}, {{1, {0, -load}}}};
  CHECK(solved(touching(truss, {{1, -1, {0, -1}, gap, {&laws::signorini}}})).state.lambda[0] == doctest::Approx(load - k * gap).epsilon(1e-12));
  CHECK(solved(touching(truss, {{1, -1, {0, -1}, 1.1 * load / k, {&laws::signorini}}})).state.lambda[0] == 0);
  CHECK(solved(touching(truss, {{1, -1, {0, -1}, 0, {&laws::elastic, k}}})).state.lambda[0] == doctest::Approx(load / 2).epsilon(1e-12));
  // Normal compliance: load − kx = c x².
  const double c = 40, x = (-k + std::sqrt(k * k + 4 * c * load)) / (2 * c);
  CHECK(solved(touching(truss, {{1, -1, {0, -1}, 0, {&laws::compliance, {c, 2}}}})).state.lambda[0] == doctest::Approx(c * x * x).epsilon(1e-9));
}

TEST_CASE("two trusses that touch, and slip with friction: two methods, and the closed form of slip") {
  const double EA = 50, mu = 0.3, push = 2;
  // A vertical bar stands on a block of two bars; its foot slips on them.
  const Truss truss{{{0, 2}, {0, 1}, {-1, 0}, {0, 1}, {1, 0}, {-1, 1}}, {{0, 1, EA}, {2, 3, EA}, {3, 4, EA}, {5, 1, EA}}, {0, 2, 4, 5}, {{1, {1.5, -push}}}};
  const problem::Problem p = touching(truss, {{1, 3, {0, -1}, 0, {&laws::signorini}, mu}});
  const auto newton = solved(p, solver::Newton{}), proximal = solved(p, solver::Proximal{});
  CHECK((newton.state.u.here() - proximal.state.u.here()).norm() < 1e-9 * newton.state.u.here().norm());
  CHECK((newton.state.u.here() - solved(p).state.u.here()).norm() == 0);  // the default with friction
  const double normal = newton.state.lambda[0], shear = newton.state.lambda[1];
  CHECK(std::abs(shear) == doctest::Approx(mu * normal).epsilon(1e-12));  // and so normal > 0
  CHECK((p.B * newton.state.u.here())[1] * shear > 0);
}

TEST_CASE("a truss that nothing fixes rests on two stops: statics alone") {
  const Truss truss{{{0, 0}, {2, 0}, {0.5, 1}}, {{0, 1, 10}, {1, 2, 10}, {2, 0, 10}}, {}, {{2, {0, -4}}}};
  const problem::Problem p = touching(truss, {{0, -1, {0, -1}, 0, {&laws::signorini}}, {1, -1, {0, -1}, 0, {&laws::signorini}}, {0, -1, {1, 0}, 0, {&laws::prescribed}}});
  const auto r = solved(p);
  CHECK(r.state.lambda[0] == doctest::Approx(3).epsilon(1e-12));
  CHECK(r.state.lambda[1] == doctest::Approx(1).epsilon(1e-12));
  Monitor quiet;
  Truss tipped = truss;
  tipped.loads = {{2, {8, -4}}};
  CHECK_THROWS_WITH_AS(solver::solve(touching(tipped, {{0, -1, {0, -1}, 0, {&laws::signorini}}, {1, -1, {0, -1}, 0, {&laws::signorini}}}), {}, {}, quiet),
                       doctest::Contains("translation along x"), InputError);
}

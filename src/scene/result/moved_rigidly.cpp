#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

using algebra::Vector;

namespace {

/// How the motion displaces the unknowns of the body, and how far it moves the node that it moves most.
std::pair<Vector, double> displacement(const Solution& solution, int body, const RigidMotion& motion) {
  const mesh::Mesh& mesh = *solution.body(body).mesh;
  const elasticity::Numbering& numbering = solution.model().numbering[body];
  Vector w = Vector::Zero(numbering.count());
  double most = 0;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const mesh::Point moved = mesh::plus(motion.translation, mesh::cross(motion.rotation, mesh::minus(mesh.point(n), motion.about)));
    most = std::max(most, mesh::length(moved));
    for (int i = 0; i < mesh.dimension(); ++i) {
      const int unknown = numbering.unknown[n * mesh.dimension() + i];
      if (unknown >= 0) w[unknown] = moved[i];
      else if (moved[i] != 0)
        throw InputError(text("its supports hold '", solution.body(body).name, "' at (", mesh.point(n)[0], ", ", mesh.point(n)[1],
                              mesh.dimension() == 3 ? text(", ", mesh.point(n)[2]) : "", ") against this motion"));
    }
  }
  return {std::move(w), most};
}

}  // namespace

std::shared_ptr<Solution> moved_rigidly(const Solution& solution, int body, const RigidMotion& motion) {
  require_whole(solution.scene(), "a solution moved rigidly");
  const problem::Problem& problem = solution.model().problem;
  const problem::Block& block = problem.blocks[body];
  if (block.K.rows() == 0) throw InputError("a step that is not the last of its history has no other members; solve up to it");
  const auto [w, most] = displacement(solution, body, motion);
  constexpr double kRounding = 1e-9;
  const Vector amounts = block.kernel.cols() > 0 ? algebra::least_squares(block.kernel, w) : Vector();
  const double held = block.kernel.cols() > 0 ? (block.kernel * amounts - w).lpNorm<Eigen::Infinity>() : w.lpNorm<Eigen::Infinity>();
  if (held > kRounding * most) throw InputError(text("supports hold '", block.name, "' elastically against this motion"));
  problem::State state = solution.result().state;
  state.u.change().segment(block.first, block.size()) += w;
  const double off = problem::distance_from_laws(problem, state);
  if (!(off <= solution.result().noise))
    throw InputError(text("contacts or laws do not allow it: moved by this, '", block.name, "' is ", off, " off its laws (relative; rounding leaves ",
                          solution.result().noise, "). Solutions that differ by a motion say so in their reason"));
  return solution.with(state.u.here());
}

}  // namespace dotyk::scene

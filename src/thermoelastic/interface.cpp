#include "thermoelastic/interface.hpp"

#include <algorithm>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "beam/solvable.hpp"
#include "problem/rows.hpp"
#include "problem/solvability.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::thermoelastic {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// "u = 0 at the left end and 1 at the right one, 0.5 along the axis": amounts of the kernel's modes, part by part.
std::string motion(const Model& model, const std::vector<int>& parts, const Vector& amounts) {
  std::string out;
  int mode = 0;
  for (const int p : parts) {
    const bool bending = model.parts[p].effect.kind() == Effect::Kind::bending;
    const Vector own = amounts.segment(mode, model.parts[p].kernel.cols());
    mode += static_cast<int>(own.size());
    if (own.isZero(1e-6 * amounts.lpNorm<Eigen::Infinity>())) continue;
    out += (out.empty() ? "" : ", ") + (bending ? beam::ends(own[0], own[1])
                                                : text(own[0] < 0 ? "towards the left" : "towards the right", " along the axis"));
  }
  return out;
}

}  // namespace

Interface::Interface(const Model& model, std::vector<int> parts, const std::vector<int>& gamma, const DenseMatrix& S)
    : model_(model), parts_(std::move(parts)) {
  const int n = static_cast<int>(gamma.size());
  problem::Block block;
  block.name = "thermoelastic beam";
  block.f = Vector::Zero(n);
  int motions = 0;
  for (const int p : parts_) motions += static_cast<int>(model.parts[p].kernel.cols());
  block.kernel = DenseMatrix::Zero(n, motions);
  problem::Rows rows(problem_);
  int mode = 0;
  for (const int p : parts_) {
    const Part& part = model.parts[p];
    const int last = part.first + part.effect.unknowns(), modes = static_cast<int>(part.kernel.cols());
    for (int i = 0; i < n; ++i)
      if (gamma[i] >= part.first && gamma[i] < last)
        block.kernel.row(i).segment(mode, modes) = part.kernel.row(gamma[i] - part.first);
    mode += modes;
    if (part.effect.kind() == Effect::Kind::stretching) block.motions.push_back({Motion::Kind::translation, {1, 0}});
    else
      block.motions.insert(block.motions.end(),
                           {{Motion::Kind::translation, {0, 1}}, {Motion::Kind::rotation, {}, {model.data.length / 2, 0}}});
    for (const Held& held : part.held) {
      rows.open_group(held.name, held.law, held.unit);
      rows.add({{static_cast<int>(std::find(gamma.begin(), gamma.end(), held.unknown) - gamma.begin()), -held.turn}}, 0);
    }
  }
  block.K = algebra::SparseMatrix(DenseMatrix(S.triangularView<Eigen::Lower>()).sparseView());
  for (int i = 0; i < n; ++i) block.node.push_back(i);
  problem_.blocks.push_back(std::move(block));  // its kernel is one up to what rounding left of stiff cells in S
  rows.finish({});
  problem_.row_name = [groups = problem_.groups](int row) { return groups[row].name; };
}

void Interface::require_solvable(double t) {
  const auto rigid = problem::rigid_motions(problem_);
  if (solvable_.size() == rigid.e.size() && solvable_ == rigid.e) return;
  const auto s = problem::solvability(rigid, problem_);
  if (s.verdict == problem::Solvability::Verdict::unsolvable) {
    const std::string moves = motion(model_, parts_, s.motion);
    const std::string why = moves.find("u =") == std::string::npos ? "" : beam::theorem(plain(model_.data));
    throw InputError(text("no solution at t = ", t, ": nothing stops the motion ", moves, ", on which the load does work",
                          why.empty() ? "" : "; ", why));
  }
  solvable_ = rigid.e;
}

Vector Interface::solve(Vector g, const Vector& resultants, const SupportsDriven& driven, double t,
                        const solver::Method& method, std::vector<Vector>& reactions, Work& work, Monitor& monitor) {
  // Heat moves nothing rigidly: the resultants are the load's, and not what rounding makes of them.
  const DenseMatrix& R = problem_.blocks.front().kernel;
  g -= R * algebra::Ldlt(R.transpose() * R).solve(Vector(R.transpose() * g - resultants));
  problem_.blocks.front().f = g;
  int row = 0;
  for (const int p : parts_)
    for (const Held& held : model_.parts[p].held) problem_.c[row++] = -held.given(driven);
  require_solvable(t);
  if (problem_.rows() == 0) {  // no support at all: the load is balanced, and the least solution as good as any
    const DenseMatrix S = DenseMatrix(problem_.blocks.front().K.lower()).selfadjointView<Eigen::Lower>();
    return algebra::MinimumNorm(S).solve(g);
  }
  solver::Result result = solver::solve(problem_, method, {{}, condenser_}, monitor, true);
  solver::judge(problem_, result);
  if (!result.converged) {
    monitor.check();
    throw InputError(text("", result.method, " did not converge at t = ", t, ": ", result.reason));
  }
  if (!beam::balanced(problem_, result.state.lambda)) throw InputError(text("at t = ", t, " ", beam::kUnbalanced));
  ++work.problems;
  work.reason = result.reason;
  work.iterations += result.iterations;
  work.method = result.method;
  row = 0;
  for (const int p : parts_) {
    const auto& held = model_.parts[p].held;
    reactions[p].resize(static_cast<int>(held.size()));
    for (std::size_t i = 0; i < held.size(); ++i, ++row)
      reactions[p][static_cast<int>(i)] = held[i].turn * result.state.lambda[row];
  }
  return result.state.u;
}

}  // namespace dotyk::thermoelastic

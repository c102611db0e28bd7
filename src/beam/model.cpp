#include "beam/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
#include "beam/element.hpp"
#include "problem/rows.hpp"

namespace dotyk::beam {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;
using problem::LawChoice;

namespace {

/// f, refusing values that are not finite, or not positive.
std::function<double(double)> checked(const std::function<double(double)>& f, const char* what, bool positive) {
  return [&f, what, positive](double x) {
    const double value = f(x);
    if (!std::isfinite(value) || (positive && !(value > 0)))
      throw InputError(text(what, " is ", value, " at x = ", x, positive ? "; it must be positive" : "; it must be finite"));
    return value;
  };
}

/// `value` as a multiple of so large a power of two that the sum of two such numbers up to `largest` has no rounding; as it is where too many
/// digits would go: the cell would resist its rotation.
double without_last_digits(double value, double largest) {
  constexpr double kMost = 1000;
  if (!(largest < kMost * std::abs(value))) return value;
  const double unit = std::ldexp(1.0, std::ilogb(largest) + 2 - std::numeric_limits<double>::digits);
  return unit > 0 ? std::nearbyint(value / unit) * unit : value;
}

/// Rounds what acts on deflections so that sums of neighbouring cells are exact, and K resists no motion of the beam up as a whole. Rounding of
/// these sums, of 12 EJ/h³, would be springs from nowhere: with cells of a thousandth of the length no longer weak beside what a long stretch of
/// the beam resists with.
void let_move(std::vector<Eigen::Matrix4d>& cells) {
  const std::vector<Eigen::Matrix4d> exact = cells;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    double lifting = 0, turning = 0;  // the greatest of the cell and its neighbours
    for (std::size_t n = k == 0 ? 0 : k - 1; n <= k + 1 && n < cells.size(); ++n) {
      lifting = std::max(lifting, std::abs(exact[n](0, 0)));
      turning = std::max({turning, std::abs(exact[n](0, 1)), std::abs(exact[n](0, 3))});
    }
    Eigen::Matrix4d& K = cells[k];
    K(0, 0) = K(2, 2) = without_last_digits(K(0, 0), lifting);
    K(0, 2) = K(2, 0) = -K(0, 0);
    for (const int end : {1, 3}) {
      K(0, end) = K(end, 0) = without_last_digits(K(0, end), turning);
      K(2, end) = K(end, 2) = -K(0, end);
    }
  }
}

class Builder {
 public:
  Builder(const Beam& beam, const std::vector<Broken>& broken) : beam_(beam), broken_(broken) {
    require_valid(beam);
    model_.nodes = nodes(beam);
    model_.unit = beam.length;
    scale_ = Four(1, 1 / model_.unit, 1, 1 / model_.unit);
  }

  Model operator()() {
    const int n = 2 * static_cast<int>(model_.nodes.size());
    f_ = Vector::Zero(n);
    for (std::size_t cell = 0; cell + 1 < model_.nodes.size(); ++cell) add_cell(static_cast<int>(cell));
    add_stiffness();
    for (const PointLoad& load : beam_.loads) add_load(load);
    for (const Support& support : beam_.supports) add_support(support);
    for (std::size_t i = 0; i < beam_.foundation.size(); ++i) add_foundation(static_cast<int>(i));
    problem::add(model_.problem, block(n));
    rows_.finish({});
    model_.problem.row_name = [groups = model_.problem.groups](int row) { return groups[row].name; };
    if (model_.problem.rows() > 0) problem::require_moderate(model_.problem, problem::kMostForceOnRows);
    return std::move(model_);
  }

 private:
  void add_cell(int cell) {
    const double x0 = model_.nodes[cell], h = model_.nodes[cell + 1] - x0;
    const Eigen::Matrix4d K = beam_.EJ_of ? stiffness(checked(beam_.EJ_of, "EJ", true), x0, h) : stiffness(beam_.EJ, h);
    stiffness_.push_back(scale_.asDiagonal() * K * scale_.asDiagonal());
    const Four f = beam_.q_of ? load(checked(beam_.q_of, "the load", false), x0, h) : load(beam_.q, h);
    f_.segment<4>(2 * cell) += scale_.cwiseProduct(f);
  }

  void add_stiffness() {
    let_move(stiffness_);
    for (std::size_t cell = 0; cell < stiffness_.size(); ++cell)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j <= i; ++j) {
          const int first = 2 * static_cast<int>(cell);
          K_.emplace_back(first + i, first + j, stiffness_[cell](i, j));
        }
  }

  void add_load(const PointLoad& load) {
    const auto [cell, s] = place(model_.nodes, load.x);
    const Hermite at(s, model_.nodes[cell + 1] - model_.nodes[cell]);
    f_.segment<4>(2 * cell) += scale_.cwiseProduct(Four(load.force * at.value + load.moment * at.slope));
  }

  void add_support(const Support& support) {
    SupportRows rows;
    rows.node = nearest(model_.nodes, support.x);
    rows.turn = support.rotation->directed() ? -1 : 1;
    rows.deflection = add_row(support.deflection, support.name + " deflection", 2 * rows.node, 1, 1, support.deflection_at);
    rows.rotation = add_row(support.rotation, support.name + " rotation", 2 * rows.node + 1, model_.unit, rows.turn, support.rotation_at);
    model_.supports.push_back(rows);
  }

  void add_foundation(int node) {
    const auto& [law, at] = beam_.foundation[node];
    const bool row = has_row(beam_, model_.nodes, node);
    model_.foundation.push_back(row ? add_row(law, text("foundation at x = ", model_.nodes[node]), 2 * node, 1, 1, at, model_.share(node)) : -1);
  }

  /// The row of a law about turn·(w/unit − at), w an unknown, for this share; −1 where it has none.
  int add_row(const LawChoice& law, const std::string& name, int unknown, double unit, double turn, double at, double share = 1) {
    f_[unknown] += law.force() / unit;
    if (law->breaks && is_broken()) {
      offset_ += problem::breaking_energy(law);
      return -1;
    }
    if (!problem::row_law(law)) return -1;
    rows_.open_group(name, law, unit);
    return rows_.add({{unknown, -turn}}, -unit * (law.displacement() + turn * at), share);
  }

  /// The next support that may break.
  bool is_broken() {
    const std::size_t k = next_breaking_++;
    return k < broken_.size() && broken_[k] == Broken::yes;
  }

  problem::Block block(int n) {
    problem::Block block;
    block.name = "beam";
    block.K = algebra::from_triplets(n, n, K_);
    block.f = f_;
    block.offset = offset_;
    block.kernel = DenseMatrix(n, 2);
    const double middle = beam_.length / 2;
    for (int i = 0; i < n / 2; ++i) {
      block.node.insert(block.node.end(), {i, i});
      block.kernel.block<2, 2>(2 * i, 0) << 1, (model_.nodes[i] - middle) / model_.unit, 0, 1;
    }
    block.motions = {{Motion::Kind::translation, {0, 1}}, {Motion::Kind::rotation, {}, {middle, 0}}};
    return block;
  }

  const Beam& beam_;
  const std::vector<Broken>& broken_;
  std::size_t next_breaking_ = 0;
  Model model_;
  Four scale_;
  std::vector<Eigen::Matrix4d> stiffness_;  ///< of cells
  std::vector<Eigen::Triplet<double>> K_;
  problem::Rows rows_{model_.problem};
  Vector f_;
  double offset_ = 0;
};

}  // namespace

double Model::share(int node) const {
  const int last = static_cast<int>(nodes.size()) - 1;
  return (nodes[std::min(node + 1, last)] - nodes[std::max(node - 1, 0)]) / 2;
}

Model build(const Beam& beam, const std::vector<Broken>& broken) { return Builder(beam, broken)(); }

std::vector<Breaking> breaking(const Beam& beam) {
  std::vector<Breaking> out;
  for (std::size_t i = 0; i < beam.supports.size(); ++i) {
    if (beam.supports[i].deflection->breaks) out.push_back({static_cast<int>(i), false});
    if (beam.supports[i].rotation->breaks) out.push_back({static_cast<int>(i), true});
  }
  return out;
}

}  // namespace dotyk::beam

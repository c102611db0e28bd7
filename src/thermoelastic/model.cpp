#include "thermoelastic/model.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "beam/beam.hpp"
#include "beam/solvable.hpp"
#include "problem/rows.hpp"
#include "problem/solvability.hpp"
#include "solver/core/default_method.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::thermoelastic {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;
using Entries = std::vector<Eigen::Triplet<double>>;

void add(Entries& to, int row, int column, const DenseMatrix& block) {
  for (int i = 0; i < block.rows(); ++i)
    for (int j = 0; j < block.cols(); ++j) to.emplace_back(row + i, column + j, block(i, j));
}

SparseMatrix sparse(int rows, int columns, const Entries& entries) {
  SparseMatrix out(rows, columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

double checked(double value, const char* what, double x, double t) {
  if (!std::isfinite(value)) throw InputError(text("", what, " is ", value, " at x = ", x, ", t = ", t));
  return value;
}

std::function<double(double)> at_time(const Source& source, const char* what, double t) {
  return [&source, what, t](double x) { return checked(source.of(x, t), what, x, t); };
}

/// A number, or a function of x at the middles of the cells.
Vector on_cells(double constant, const std::function<double(double)>& of, const std::vector<double>& nodes, const char* what, bool positive) {
  Vector out = Vector::Constant(static_cast<int>(nodes.size()) - 1, constant);
  for (int cell = 0; of && cell < out.size(); ++cell) {
    const double x = (nodes[cell] + nodes[cell + 1]) / 2;
    out[cell] = of(x);
    if (!std::isfinite(out[cell]) || !(positive ? out[cell] > 0 : out[cell] >= 0))
      throw InputError(text("", what, " is ", out[cell], " at x = ", x, "; it must be ", positive ? "positive" : "zero or positive"));
  }
  return out;
}

std::vector<Held> held(const Data& data, const std::vector<double>& nodes, Effect::Kind kind) {
  std::vector<Held> out;
  const auto add = [&](const Support& s, std::size_t i, What what, const char* of, const problem::LawChoice& law,
                       int unknown, double unit, double turn) {
    if (problem::bears(law))
      out.push_back({static_cast<int>(i), what, s.name + of, unknown, unit, law->directed() ? turn : 1, law});
  };
  for (std::size_t i = 0; i < data.supports.size(); ++i) {
    const Support& s = data.supports[i];
    const int node = beam::nearest(nodes, s.x);
    if (kind == Effect::Kind::bending) {
      add(s, i, What::deflection, " deflection", s.deflection, 2 * node, 1, 1);
      add(s, i, What::rotation, " rotation", s.rotation, 2 * node + 1, data.length, -1);
    } else if (node == 0 || node + 1 == static_cast<int>(nodes.size())) {
      add(s, i, What::displacement, " displacement", s.displacement, 2 * node, 1, node == 0 ? 1 : -1);
    }
  }
  return out;
}

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

double Held::given(const SupportsDriven& driven) const {
  return unit * ((law.displacement()) + turn * place(driven));
}

Model::Model(const Data& given, const std::vector<Effect::Kind>& effects) : data(given), coefficients(given), heat(nodes(given)) {
  for (const Effect::Kind kind : effects) add_part(kind, heat.nodes());
  add_matrices();
  unit_heat_ = heat.load([](double) { return 1.0; });
  data.E_of = data.expansion_of = nullptr;  // they may not outlive the call that gave them
}

void Model::add_part(Effect::Kind kind, const std::vector<double>& nodes) {
  const bool bending = kind == Effect::Kind::bending;
  const Vector E = on_cells(data.E, data.E_of, nodes, "Young's modulus E", true);
  const Vector expansion = on_cells(data.expansion, data.expansion_of, nodes, "expansion", false);
  Effect effect(kind, nodes, E * (bending ? coefficients.J : coefficients.F), bending ? -expansion : expansion);
  Part part{effect,
            0,
            static_cast<int>(parts.size()) * heat.unknowns(),
            bending ? coefficients.weight_gradient : coefficients.weight_mean,
            held(data, nodes, kind),
            effect.kernel()};
  if (!parts.empty()) part.first = parts.back().first + parts.back().effect.unknowns();
  for (Held& law : part.held) law.unknown += part.first;
  for (int end = 0; end < 2; ++end)
    if (bending ? data.heat_ends[end].gradient : data.heat_ends[end].mean)
      held_heat.push_back({part.first_heat + (end == 0 ? 0 : heat.unknowns() - 2), static_cast<int>(parts.size()), end});
  DenseMatrix unit(effect.cell_unknowns(), effect.cells());
  for (int cell = 0; cell < effect.cells(); ++cell) unit.col(cell) = effect.cell_load(cell, [](double) { return 1.0; });
  unit_loads_.push_back(unit);
  parts.push_back(std::move(part));
}

void Model::add_matrices() {
  Entries stiffness, coupling, capacities, conductions;
  const int size = parts.back().first + parts.back().effect.unknowns(), heats = static_cast<int>(parts.size()) * heat.unknowns();
  const auto& a = coefficients;
  for (int cell = 0; cell < heat.cells(); ++cell) {
    const Eigen::Matrix4d mass = heat.mass(cell), D = heat.conduction(cell);
    for (const Part& p : parts) {
      const double C = p.effect.modulus()[cell], h = p.effect.h(cell);
      const CellStrain B = p.effect.strain_matrix(cell);
      const int at = p.first + 2 * cell, at_heat = p.first_heat + 2 * cell;
      add(stiffness, at, at, C * h * B.transpose() * B);
      add(coupling, at, at_heat, -p.effect.beta()[cell] * C * h * B.transpose() * heat.projection(cell));
      add(capacities, at_heat, at_heat, p.weight * a.a1 * mass);
      add(conductions, at_heat, at_heat, p.weight * (D + (p.effect.kind() == Effect::Kind::bending ? a.a22 : a.a11) * mass));
    }
    if (parts.size() == 2)
      for (const int first : {0, 1})
        add(conductions, parts[first].first_heat + 2 * cell, parts[1 - first].first_heat + 2 * cell,
            a.weight_mean * a.a12 * mass);
  }
  K = sparse(size, size, stiffness);
  G = sparse(size, heats, coupling);
  capacity = sparse(heats, heats, capacities);
  conduction = sparse(heats, heats, conductions);
}

Source Model::heat_source(const Part& part, const Loads& loads, double t) const {
  const double above = data.exchange_above * checked(loads.ambient_above(t), "the temperature above", 0, t);
  const double below = data.exchange_below * checked(loads.ambient_below(t), "the temperature below", 0, t);
  const double k = data.conductivity, H = data.height;
  const bool bending = part.effect.kind() == Effect::Kind::bending;
  const Source& given = bending ? loads.heat_gradient : loads.heat;
  const double exchanged = bending ? 6 * (above - below) / (k * H * H) : (above + below) / (k * H);
  if (!given.of) return {exchanged + given.constant / k, {}};
  return {0, [&given, exchanged, k](double x, double time) { return exchanged + given.of(x, time) / k; }};
}

SupportsDriven Model::driven(const Loads& loads, double t) const {
  SupportsDriven out(data.supports.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Support& s = data.supports[i];
    const std::array<const problem::LawChoice*, 3> laws{&s.deflection, &s.rotation, &s.displacement};
    for (int k = 0; k < 3; ++k)
      out[i][k].force = laws[k]->force();
  }
  for (const SupportLoads& given : loads.supports) {
    const auto at = std::find_if(data.supports.begin(), data.supports.end(), [&](const Support& s) { return s.x == given.x; });
    if (at == data.supports.end()) throw InputError(text("no support is at x = ", given.x, ", where loads of one are given"));
    const std::array<const Drive*, 3> drives{&given.deflection, &given.rotation, &given.displacement};
    for (int k = 0; k < 3; ++k) {
      Driven& now = out[at - data.supports.begin()][k];
      now.place = checked(drives[k]->place(t), "the place of a support", given.x, t);
      now.force += checked(drives[k]->force(t), "the force at a support", given.x, t);
    }
  }
  return out;
}

Forces Model::forces(const Loads& loads, double t) const {
  Forces out{Vector::Zero(K.rows()), Vector::Zero(capacity.rows()), Vector(held_heat.size()), {}, driven(loads, t)};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& p = parts[i];
    const bool bending = p.effect.kind() == Effect::Kind::bending;
    const Source& given = bending ? loads.transverse : loads.axial;
    DenseMatrix cells = given.constant * unit_loads_[i];
    if (given.of)
      for (int c = 0; c < p.effect.cells(); ++c)
        cells.col(c) = p.effect.cell_load(c, at_time(given, bending ? "the load" : "the axial load", t));
    for (int c = 0; c < p.effect.cells(); ++c) out.f.segment(p.first + 2 * c, p.effect.cell_unknowns()) += cells.col(c);
    out.on_cells.push_back(std::move(cells));
    for (std::size_t s = 0; s < data.supports.size(); ++s) {
      const int at = p.first + 2 * beam::nearest(heat.nodes(), data.supports[s].x);
      const auto force = [&](What what) { return out.supports[s][static_cast<int>(what)].force; };
      out.f[at] += force(bending ? What::deflection : What::displacement);
      if (bending) out.f[at + 1] += force(What::rotation) / data.length;
    }
    const Source source = heat_source(p, loads, t);
    out.r.segment(p.first_heat, heat.unknowns()) =
        p.weight * (source.of ? heat.load(at_time(source, "the heat", t)) : source.constant * unit_heat_);
  }
  for (std::size_t k = 0; k < held_heat.size(); ++k) {
    const bool bending = parts[held_heat[k].part].effect.kind() == Effect::Kind::bending;
    const int end = held_heat[k].end;
    out.held_heat[k] =
        checked((bending ? loads.gradient : loads.mean)[end](t), "the temperature prescribed", end == 0 ? 0 : data.length, t);
  }
  return out;
}

Vector Model::initial(const Initial& given) const {
  Vector theta = Vector::Zero(capacity.rows()), b = theta;
  for (const Part& p : parts) {
    const Source& source = p.effect.kind() == Effect::Kind::bending ? given.gradient : given.mean;
    const auto at_start =
        source.of ? at_time(source, "the temperature at first", 0) : [value = source.constant](double) { return value; };
    b.segment(p.first_heat, heat.unknowns()) = p.weight * coefficients.a1 * heat.load(at_start);
  }
  return Eigen::SimplicialLDLT<SparseMatrix>(capacity).solve(b);
}

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

#include "program/lcp.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/indefinite.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "program/active_set.hpp"

namespace dotyk::program {

using algebra::DenseMatrix;

namespace {

constexpr int kEnumerable = 16;
constexpr double kSolved = 1e-9;

/// z = scale ∘ ẑ, ŵ = scale ∘ w: complementarity stays, the diagonal becomes about 1.
Lcp scaled(const Lcp& lcp, Vector& scale) {
  const int n = lcp.size();
  Vector size = Vector::Zero(n);  // the diagonal, where it is 0 the greatest entry of row and column
  scale = Vector::Ones(n);
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(lcp.M, j); it; ++it)
      for (const auto i : {it.row(), it.col()}) size[i] = std::max(size[i], std::abs(it.value()));
  const Vector diagonal = lcp.M.diagonal();
  size = (diagonal.array() != 0).select(diagonal.cwiseAbs(), size);
  for (int i = 0; i < n; ++i)
    if (size[i] > 0) scale[i] = 1 / std::sqrt(size[i]);
  return {scale.asDiagonal() * lcp.M * scale.asDiagonal(), scale.cwiseProduct(lcp.q), lcp.name};
}

bool semidefinite(const SparseMatrix& M) {
  const SparseMatrix symmetric = M + SparseMatrix(M.transpose());
  return negative_curvature(symmetric.triangularView<Eigen::Lower>(), 1e-12).size() == 0;
}

/// Linear program over the solutions that belong to a set: w = 0 and z ≥ 0 on it, z = 0 and w ≥ 0 off it.
QuadraticProgram over_set(const Lcp& lcp, const FreeSet& free, const Vector& cost) {
  const int n = lcp.size();
  QuadraticProgram p;
  p.P = SparseMatrix(n, n);
  p.q = cost;
  DenseMatrix a(2 * n, n);
  a << DenseMatrix(lcp.M), DenseMatrix::Identity(n, n);
  p.A = a.sparseView(0, 0);
  p.low.resize(2 * n), p.high.resize(2 * n);
  for (int i = 0; i < n; ++i) {
    p.low[i] = -lcp.q[i], p.high[i] = free[i] ? -lcp.q[i] : INFINITY;
    p.low[n + i] = 0, p.high[n + i] = free[i] ? INFINITY : 0;
  }
  return p;
}

class Solver {
 public:
  Solver(const Lcp& lcp, const LcpSettings& settings, Monitor& monitor)
      : lcp_(lcp), settings_(settings), monitor_(monitor), n_(lcp.size()) {}

  LcpResult run() {
    out_.z = Vector::Zero(n_);
    const algebra::StopFactoring stops(monitor_);
    try {
      search();
    } catch (const Interrupted&) {  // a factor was left unfinished
    }
    if (!found_ && monitor_.stop()) out_.reason = "stopped on request";
    return out_;
  }

 private:
  void search() {
    using Method = LcpSettings::Method;
    const Method method = settings_.method;
    if (method == Method::enumeration && n_ > kEnumerable)
      throw InputError(text("enumeration takes up to ", kEnumerable, " unknowns, here are ", n_));
    if (method == Method::automatic || method == Method::newton_min) newton();
    if (!found_ && !monitor_.stop() && (method == Method::automatic || method == Method::lemke)) by_lemke();
    const bool decide = method == Method::enumeration || (!found_ && method != Method::newton_min);
    if ((decide || settings_.unique) && n_ <= kEnumerable && method != Method::newton_min && !monitor_.stop()) count();
  }

  bool accept(const Vector& z, const char* method) {
    if (!z.size() || residual(lcp_, z) > kSolved) return false;
    out_.z = z.cwiseMax(0);
    out_.method = method;
    out_.status = LcpStatus::solved;
    return found_ = true;
  }

  void newton() {
    const NewtonMin r = newton_min(lcp_, settings_.start, monitor_);
    out_.solves = r.solves;
    out_.cycle = r.cycle;
    if (r.end == NewtonMin::End::solved && accept(r.z, "newton_min")) out_.reason = "active set confirmed";
    else if (r.end == NewtonMin::End::cycle) out_.reason = text("the active set goes round among ", r.cycle.size(), " sets");
    else out_.reason = r.end == NewtonMin::End::singular ? "M is singular on an active set" : "no end";
    if (!found_ && r.z.size()) out_.z = r.z;
  }

  void by_lemke() {
    const Lemke r = lemke(lcp_, monitor_);
    out_.pivots = r.pivots;
    const std::string before = out_.reason.empty() ? "" : out_.reason + "; ";
    if (r.solved && accept(r.z, "lemke")) {
      out_.reason = before + "Lemke's method found the solution";
    } else if (r.ray && semidefinite(lcp_.M)) {
      out_.status = LcpStatus::none;
      out_.reason = before + "Lemke's method ends on a ray, and M is positive semidefinite: there is no solution";
    } else if (!r.ray && !r.solved) {
      out_.reason = before + text("Lemke's method stops at its limit of ", r.pivots, " pivots",
                                  settings_.method == LcpSettings::Method::lemke ? ": try newton_min" : "");
    } else {
      out_.reason = before + "Lemke's method ends " + (r.ray ? "on a ray" : "without a solution") + ", which decides nothing for this M";
    }
  }

  void count() {
    const Enumeration all = enumerate(lcp_, 2, monitor_);
    out_.counted = all.complete;
    if (!found_ && !all.solutions.empty()) {
      accept(all.solutions.front(), "enumeration");
      out_.reason += std::string(out_.reason.empty() ? "" : "; ") + "found by enumeration";
    }
    if (!found_ && all.complete) {
      out_.status = LcpStatus::none;
      out_.reason = text("none of the ", 1ul << n_, " sets gives a solution");
    }
    for (const Vector& z : all.solutions)
      if (found_ && (z - out_.z).norm() > 1e-6 * (1 + out_.z.norm())) out_.other = z;
    if (out_.other.size()) {
      out_.status = LcpStatus::several;
      out_.reason += all.continuum ? "; there is more than one: a whole segment" : "; there is more than one";
    }
  }

  const Lcp& lcp_;
  const LcpSettings& settings_;
  Monitor& monitor_;
  int n_;
  bool found_ = false;
  LcpResult out_;
};

}  // namespace

void check(const Lcp& lcp) {
  if (lcp.size() == 0) throw InputError("the problem has no unknowns");
  if (lcp.M.rows() != lcp.size() || lcp.M.cols() != lcp.size())
    throw InputError(text("M is ", lcp.M.rows(), "x", lcp.M.cols(), "; q has ", lcp.size(), " entries"));
  if (!Eigen::Map<const Vector>(lcp.M.valuePtr(), lcp.M.nonZeros()).allFinite() || !lcp.q.allFinite()) throw InputError("M or q holds nan or inf");
}

double residual(const Lcp& lcp, const Vector& z) {
  const Vector w = lcp.M * z + lcp.q;
  const SparseMatrix sizes = lcp.M.cwiseAbs();
  const Vector size = sizes * z.cwiseAbs() + lcp.q.cwiseAbs();
  const double largest = z.lpNorm<Eigen::Infinity>();
  double worst = 0;
  for (int i = 0; i < lcp.size(); ++i) {
    const double z_part = z[i] / (1 + largest), w_part = w[i] / (size[i] > 0 ? std::max(size[i], 1e-300) : 1);
    worst = std::max(worst, std::abs(std::min(z_part, w_part)));
  }
  return worst;
}

Vector on_set(const Lcp& lcp, const FreeSet& free) {
  constexpr std::size_t kFew = 64;  // exchanges of rows and columns tell best whether such a matrix is singular
  std::vector<int> index, place(lcp.size(), -1);
  for (int i = 0; i < lcp.size(); ++i)
    if (free[i]) place[i] = static_cast<int>(index.size()), index.push_back(i);
  Vector z = Vector::Zero(lcp.size());
  if (index.empty()) return z;
  const auto count = static_cast<Eigen::Index>(index.size());
  algebra::Triplets entries;
  for (int j : index)
    for (SparseMatrix::InnerIterator it(lcp.M, j); it; ++it)
      if (free[it.row()]) entries.emplace_back(place[it.row()], place[j], it.value());
  const SparseMatrix M = algebra::from_triplets(count, count, entries);
  Vector x = -lcp.q(index);
  if (index.size() <= kFew) {
    const algebra::PivotedLu lu{DenseMatrix(M)};
    if (!lu.regular()) return {};
    x = lu.solve(x);
  } else {
    const algebra::SparseLu lu(M);
    if (lu.singular()) return {};
    x = lu.solve(x);
  }
  if (!x.allFinite()) return {};
  z(index) = x;
  return z;
}

NewtonMin newton_min(const Lcp& lcp, FreeSet free, Monitor& monitor, int max_solves) {
  NewtonMin out;
  const Stopwatch clock;
  free.resize(lcp.size(), 0);
  std::vector<FreeSet> seen;
  for (;;) {
    const auto before = std::find(seen.begin(), seen.end(), free);
    if (before != seen.end()) {
      // The set that repeats itself is the solution's; any longer loop is a cycle.
      out.cycle.assign(before, seen.end());
      out.end = out.cycle.size() == 1 ? NewtonMin::End::solved : NewtonMin::End::cycle;
      if (out.cycle.size() == 1) out.cycle.clear();
      return out;
    }
    if (out.solves == max_solves || monitor.stop()) return out;
    const Vector z = on_set(lcp, free);
    if (z.size() == 0) {
      out.end = NewtonMin::End::singular;
      return out;
    }
    ++out.solves;
    out.z = z;
    Vector w = lcp.M * z + lcp.q;
    seen.push_back(free);
    int active = 0, changed = 0;
    for (int i = 0; i < lcp.size(); ++i) {
      if (free[i]) w[i] = 0;  // exactly, so that rounding does not decide
      active += free[i], changed += free[i] != static_cast<char>(z[i] > w[i]);
      free[i] = z[i] > w[i];
    }
    monitor.iteration({.iteration = out.solves, .active = active, .changed = changed, .seconds = clock.seconds()});
  }
}

Enumeration enumerate(const Lcp& lcp, int most, Monitor& monitor) {
  const int n = lcp.size();
  Enumeration out;
  const auto add = [&](const Vector& z) {
    const double size = 1 + z.lpNorm<Eigen::Infinity>();
    if (z.minCoeff() < -1e-10 * size || residual(lcp, z) > 1e-9) return;
    for (const Vector& known : out.solutions)
      if ((known - z).lpNorm<Eigen::Infinity>() <= 1e-7 * size) return;
    if (static_cast<int>(out.solutions.size()) < most) out.solutions.push_back(z);
  };
  // Where M is singular on a set there may be a segment of solutions: its ends in two opposite directions.
  const auto add_segment = [&](const FreeSet& free) {
    Monitor quiet;
    Vector cost(n);
    for (int i = 0; i < n; ++i) cost[i] = 1 + 0.37 * std::sin(1.0 + 7.0 * i);  // positive: z ≥ 0 keeps it bounded
    ActiveSet settings;
    settings.start = ActiveSet::Start::cold;
    const Result least = solve(over_set(lcp, free, cost), settings, quiet);
    if (least.status != Status::solved) return;
    const std::size_t before = out.solutions.size();
    add(least.x);
    const Result greatest = solve(over_set(lcp, free, -cost), settings, quiet);
    if (greatest.status == Status::solved) add(greatest.x);
    if (greatest.status == Status::unbounded) add(least.x + (1 + least.x.norm()) * greatest.direction);
    out.continuum = out.continuum || greatest.status == Status::unbounded || out.solutions.size() >= before + 2;
  };
  for (unsigned long set = 0; set < (1ul << n) && static_cast<int>(out.solutions.size()) < most; ++set) {
    out.complete = !monitor.stop();  // a singular set may take milliseconds
    if (!out.complete) break;
    FreeSet free(n);
    for (int i = 0; i < n; ++i) free[i] = set >> i & 1;
    const Vector z = on_set(lcp, free);
    if (z.size()) add(z);
    else add_segment(free);
  }
  return out;
}

const char* text_of(LcpStatus status) {
  constexpr const char* kNames[] = {"solved", "several", "none", "stopped"};
  return kNames[static_cast<int>(status)];
}

LcpResult solve(const Lcp& lcp, const LcpSettings& settings, Monitor& monitor) {
  check(lcp);
  if (!settings.start.empty() && static_cast<int>(settings.start.size()) != lcp.size())
    throw InputError(text("the start has ", settings.start.size(), " flags for ", lcp.size(), " unknowns"));
  const Stopwatch clock;
  Vector scale;
  const Lcp units = scaled(lcp, scale);
  LcpResult out = Solver(units, settings, monitor).run();
  out.z = scale.cwiseProduct(out.z);
  if (out.other.size()) out.other = scale.cwiseProduct(out.other);
  out.w = lcp.M * out.z + lcp.q;
  out.residual = residual(lcp, out.z);
  out.seconds = clock.seconds();
  const bool found = out.status == LcpStatus::solved || out.status == LcpStatus::several;
  if (found && !(out.z.allFinite() && out.w.allFinite() && std::isfinite(out.residual))) {
    out.status = LcpStatus::stopped;
    out.reason = "values beyond the range of numbers: z or Mz + q is not finite; choose units in which the numbers are moderate";
  }
  return out;
}

}  // namespace dotyk::program

#include "solver/feti/torn_problem.hpp"

#include "solver/bounded/dual_laws.hpp"

namespace dotyk::solver {

using algebra::SparseRows;
using algebra::Vector;
using problem::Problem;

namespace {

/// A diagonal entry below this part of the piece's greatest is none.
constexpr double kNoStiffness = 1e-14;

using Entries = std::vector<Eigen::Triplet<double>>;

/// The copies of every unknown, ascending.
using Copies = std::vector<std::vector<int>>;

Copies copies_of(const TornProblem& torn) {
  Copies copies(torn.unknowns);
  for (int v = 0; v < torn.copies(); ++v)
    if (torn.unknown[v] >= 0) copies[torn.unknown[v]].push_back(v);
  return copies;
}

void add_blocks(const Problem& problem, TornProblem& torn) {
  for (const problem::Block& b : problem.blocks)
    torn.pieces.push_back({"'" + b.name + "'", &b.K.lower(), &b.f, &b.node, &b.kernel, b.first, {}, 0});
  torn.unknown.resize(torn.unknowns);
  std::iota(torn.unknown.begin(), torn.unknown.end(), 0);
  torn.value = Vector::Zero(torn.unknowns);
}

void add_subdomains(const Problem& problem, TornProblem& torn) {
  int number = 0;
  for (std::size_t k = 0; k < problem.subdomains.size(); ++k) {
    const problem::Subdomain& s = problem.subdomains[k];
    number = k > 0 && problem.subdomains[k - 1].block == s.block ? number + 1 : 1;
    torn.pieces.push_back({text("piece ", number, " of '", problem.blocks[s.block].name, "'"), &s.K(), &s.f, &s.node,
                           &s.kernel(), torn.copies(), {}, 0});
    torn.unknown.insert(torn.unknown.end(), s.unknown.begin(), s.unknown.end());
  }
  torn.value.resize(torn.copies());
  for (std::size_t k = 0; k < problem.subdomains.size(); ++k)
    torn.value.segment(torn.pieces[k].first, torn.pieces[k].size()) = problem.subdomains[k].value;
}

/// k and the greatest diagonal entry. An unknown without stiffness of its own counts for the stiffest of its piece.
void take_stiffness(TornProblem& torn) {
  Vector k(torn.copies());
  for (const Piece& piece : torn.pieces) {
    if (piece.size() == 0) continue;
    const Vector diagonal = piece.K->diagonal();
    const double most = diagonal.maxCoeff();
    k.segment(piece.first, piece.size()) = (diagonal.array() > kNoStiffness * most).select(diagonal, most);
  }
  const double greatest = k.size() > 0 ? k.maxCoeff() : 0;
  if (greatest > 0) torn.stiffest = greatest;
  torn.stiffness = k.unaryExpr([=](double x) { return x > 0 ? x / greatest : 1.0; });
}

/// Rows of the problem on all copies, not yet scaled.
SparseRows spread(const Problem& problem, const TornProblem& torn, const Copies& copies) {
  Entries entries;
  for (int j = 0; j < torn.unknowns; ++j) {
    if (copies[j].empty()) throw std::logic_error(text("unknown ", j, " belongs to no piece"));
    double sum = 0;
    for (int v : copies[j]) sum += torn.stiffness[v];
    for (int v : copies[j]) entries.emplace_back(j, v, torn.stiffness[v] / sum);
  }
  SparseRows shares(torn.unknowns, torn.copies());
  shares.setFromTriplets(entries.begin(), entries.end());
  return problem.B * shares;
}

/// A row's norm in k⁻¹, `first` being the first copy of its columns, its spring's compliance included.
double row_norm(const TornProblem& torn, const SparseRows& rows, int r, int first, double compliance) {
  double norm = std::sqrt(torn.stiffest * compliance);
  for (SparseRows::InnerIterator it(rows, r); it; ++it)
    norm = std::hypot(norm, it.value() / std::sqrt(torn.stiffness[first + it.col()]));
  return norm;
}

/// One over each row's norm, or over the greater one of a friction point's rows; 1 for rows without entries.
Vector scale_of(const Problem& problem, const TornProblem& torn, const SparseRows& rows, const Vector& compliance) {
  Vector norm(rows.rows());
  for (int r = 0; r < rows.rows(); ++r) norm[r] = row_norm(torn, rows, r, 0, compliance[r]);
  for (const problem::FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      auto point = norm.segment(group.row(k), group.components);
      point.setConstant(point.maxCoeff());
    }
  return norm.unaryExpr([](double n) { return n > 0 ? 1 / n : 1.0; });
}

void add_gluing(const TornProblem& torn, const Copies& copies, int& row, Entries& entries) {
  for (const std::vector<int>& all : copies) {
    double before = torn.stiffness[all[0]];
    for (std::size_t next = 1; next < all.size(); ++next, ++row) {
      const double k = torn.stiffness[all[next]], s = std::sqrt(before / (before + k) * k);
      for (int v : std::span(all).first(next)) entries.emplace_back(row, v, s * (torn.stiffness[v] / before));
      entries.emplace_back(row, all[next], -s);
      before += k;
    }
  }
}

void add_springs(const Problem& problem, TornProblem& torn, int row, Entries& entries) {
  for (std::size_t p = 0; p < problem.subdomains.size(); ++p) {
    const problem::Subdomain& s = problem.subdomains[p];
    const int first = torn.pieces[p].first;
    for (int q = 0; q < s.spring.size(); ++q, ++row) {
      const double scale = 1 / row_norm(torn, s.S, q, first, 1 / s.spring[q]);
      for (SparseRows::InnerIterator it(s.S, q); it; ++it)
        entries.emplace_back(row, first + static_cast<int>(it.col()), scale * it.value());
      torn.compliance[row] = scale * scale / s.spring[q];
    }
  }
}

/// Numbers the copies that rows touch; gives each entry its touched copy's number.
void number_touched(TornProblem& torn, Entries& entries) {
  std::vector<int> place(torn.copies(), -1);
  for (const auto& e : entries) place[e.col()] = 0;
  for (Piece& piece : torn.pieces) {
    piece.first_touched = static_cast<int>(torn.touched.size());
    for (int i = 0; i < piece.size(); ++i)
      if (int& number = place[piece.first + i]; number == 0) {
        piece.touched.push_back(i);
        number = static_cast<int>(torn.touched.size());
        torn.touched.push_back(piece.first + i);
      }
  }
  torn.touched_weight = torn.stiffness(torn.touched).cwiseInverse();
  for (auto& e : entries) e = {e.row(), place[e.col()], e.value()};
  torn.B.resize(torn.rows(), static_cast<Eigen::Index>(torn.touched.size()));
  torn.B.setFromTriplets(entries.begin(), entries.end());
  torn.Bt = torn.B.transpose();
}

}  // namespace

TornProblem tear(const Problem& problem) {
  TornProblem torn;
  torn.unknowns = problem.unknowns();
  problem.subdomains.empty() ? add_blocks(problem, torn) : add_subdomains(problem, torn);
  const Copies copies = copies_of(torn);

  take_stiffness(torn);
  const SparseRows rows = spread(problem, torn, copies);
  const Vector compliance = law_compliance(problem);
  torn.scale = scale_of(problem, torn, rows, compliance);
  Entries entries;
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it)
      if (it.value() != 0) entries.emplace_back(r, static_cast<int>(it.col()), torn.scale[r] * it.value());
  int row = problem.rows();
  add_gluing(torn, copies, row, entries);
  torn.gluing_rows = row - problem.rows();
  const int first_support = row;
  for (int v = 0; v < torn.copies(); ++v)
    if (torn.unknown[v] < 0) entries.emplace_back(row++, v, std::sqrt(torn.stiffness[v]));
  torn.support_rows = row - first_support;
  const int first_spring = row;
  for (const problem::Subdomain& s : problem.subdomains) row += static_cast<int>(s.spring.size());

  torn.c = torn.compliance = Vector::Zero(row);
  torn.c.head(problem.rows()) = torn.scale.cwiseProduct(problem.c);
  torn.compliance.head(problem.rows()) = torn.scale.cwiseAbs2().cwiseProduct(compliance);
  add_springs(problem, torn, first_spring, entries);
  for (int v = 0, r = first_support; v < torn.copies(); ++v)
    if (torn.unknown[v] < 0) torn.c[r++] = std::sqrt(torn.stiffness[v]) * torn.value[v];
  number_touched(torn, entries);
  return torn;
}

Vector average(const TornProblem& torn, const Vector& v) {
  Vector sum = Vector::Zero(torn.unknowns), weight = Vector::Zero(torn.unknowns);
  for (int k = 0; k < torn.copies(); ++k) {
    if (torn.unknown[k] < 0) continue;
    sum[torn.unknown[k]] += torn.stiffness[k] * v[k];
    weight[torn.unknown[k]] += torn.stiffness[k];
  }
  return sum.cwiseQuotient(weight);
}

}  // namespace dotyk::solver

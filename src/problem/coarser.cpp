#include "problem/coarser.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "algebra/congruent.hpp"
#include "base/parallel.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// The column of a row that is 1 there and has no other entry: a node that the coarser mesh has. Else -1.
int same(const SparseRows& functions, int i) {
  const int begin = functions.outerIndexPtr()[i];
  const bool alone = functions.outerIndexPtr()[i + 1] - begin == 1 && functions.valuePtr()[begin] == 1;
  return alone ? functions.innerIndexPtr()[begin] : -1;
}

/// The columns that have entries; of each column its place among them, or -1.
std::vector<int> places(const SparseRows& functions) {
  std::vector<int> place(functions.cols(), -1);
  for (int i = 0; i < functions.rows(); ++i)
    for (SparseRows::InnerIterator it(functions, i); it; ++it) place[it.col()] = 0;
  int count = 0;
  for (int& p : place) p = p < 0 ? -1 : count++;
  return place;
}

SparseRows with_rows(const SparseRows& functions, const std::vector<int>& place) {
  std::vector<int> rows;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] >= 0) rows.push_back(static_cast<int>(i));
  return algebra::pick_rows(functions, rows);
}

struct CoarserBlock {
  Block block;
  std::shared_ptr<const SparseRows> functions;  ///< the unknowns of the finer block by this one's
};

/// The block without its K. `all`: the functions of all coarser meshes.
CoarserBlock coarser(const Block& fine, std::vector<SparseRows> all) {
  const std::vector<int> place = places(all[0]);
  const auto P = std::make_shared<SparseRows>();  // Eigen's matrices have no move
  algebra::with_columns(all[0], place, *P);
  CoarserBlock out{{}, P};
  const SparseRows& functions = *out.functions;
  if (all.size() > 1) all[1] = with_rows(all[1], place);
  Block& block = out.block;
  block.name = fine.name;
  block.f = functions.transpose() * fine.f;
  block.offset = fine.offset;
  for (std::size_t k = 0; k < place.size(); ++k)
    if (place[k] >= 0) block.node.push_back(static_cast<int>(k) / fine.coarse.dimension);
  block.kernel = at_coarse(functions, fine.kernel);
  block.motions = fine.motions;
  if (fine.rigid) block.rigid = [rigid = fine.rigid, P = out.functions] { return at_coarse(*P, rigid()); };
  all.erase(all.begin());
  const auto rest = std::make_shared<const std::vector<SparseRows>>(std::move(all));
  std::vector<int> nodes;
  for (const SparseRows& next : *rest) nodes.push_back(static_cast<int>(next.cols()) / fine.coarse.dimension);
  block.coarse = {std::move(nodes), fine.coarse.dimension, [rest](int most) { return std::vector<SparseRows>(rest->begin(), rest->begin() + most); }};
  return out;
}

/// The unknown with the greatest factor, or -1.
int greatest(const SparseRows& B, int row) {
  int unknown = -1;
  double factor = 0;
  for (SparseRows::InnerIterator it(B, row); it; ++it)
    if (std::abs(it.value()) > factor) factor = std::abs(it.value()), unknown = static_cast<int>(it.col());
  return unknown;
}

/// Rows whose forces are of one kind: of a group, or one component of the friction of one.
std::vector<std::vector<int>> kinds(const Problem& problem) {
  std::vector<std::vector<int>> all;
  for (const RowGroup& group : problem.groups) {
    std::vector<int>& rows = all.emplace_back(static_cast<std::size_t>(group.count));
    std::iota(rows.begin(), rows.end(), group.first);
  }
  for (const FrictionGroup& group : problem.friction)
    for (int i = 0; i < group.components; ++i) {
      std::vector<int>& rows = all.emplace_back();
      for (int point = 0; point < group.points(); ++point) rows.push_back(group.row(point) + i);
    }
  return all;
}

/// The part of each block.
void take_stiffness(Problem& problem, algebra::SymmetricMatrix all) {
  if (const auto slices = all.shared_slices()) return take_slices(problem, slices);
  if (problem.blocks.size() == 1) return void(problem.blocks[0].K = std::move(all));
  for (Block& block : problem.blocks) block.K = SparseMatrix(all.lower().block(block.first, block.first, block.size(), block.size()));
}

}  // namespace

DenseMatrix at_coarse(const SparseRows& functions, const DenseMatrix& values) {
  DenseMatrix out = DenseMatrix::Zero(functions.cols(), values.cols());
  if (values.cols() == 0) return out;
  for (int i = 0; i < functions.rows(); ++i)
    if (const int column = same(functions, i); column >= 0) out.row(column) = values.row(i);
  return out;
}

int coarser_meshes(const Problem& problem) {
  constexpr double kWorth = 0.7;  // displacements of a mesh, of those of the finer one: bodies without coarser meshes keep theirs
  std::size_t count = 0;
  for (const Block& block : problem.blocks) {
    if (!block.coarse.functions) return 0;
    count = std::max(count, block.coarse.nodes.size());
  }
  const auto size = [&](std::size_t level) {
    double sum = 0;
    for (const Block& block : problem.blocks) {
      const std::vector<int>& nodes = block.coarse.nodes;
      const std::size_t known = std::min(level, nodes.size());
      sum += known == 0 ? block.size() : block.coarse.dimension * nodes[known - 1];
    }
    return sum;
  };
  while (count > 0 && size(count) > kWorth * size(count - 1)) --count;
  return static_cast<int>(count);
}

std::vector<SparseRows> coarse_functions(const Problem& problem) {
  const int levels = coarser_meshes(problem);
  if (levels == 0) return {};
  if (problem.blocks.size() == 1) return problem.blocks.front().coarse.functions(levels);
  std::vector<algebra::Triplets> entries(levels);
  std::vector<Eigen::Index> rows(entries.size(), 0), columns(rows);
  for (const Block& block : problem.blocks) {
    const std::vector<SparseRows> own = block.coarse.functions(levels);
    for (std::size_t l = 0; l < own.size(); ++l) {
      for (int i = 0; i < own[l].rows(); ++i)
        for (SparseRows::InnerIterator it(own[l], i); it; ++it)
          entries[l].emplace_back(static_cast<int>(rows[l] + i), static_cast<int>(columns[l] + it.col()), it.value());
      rows[l] += own[l].rows(), columns[l] += own[l].cols();
    }
  }
  std::vector<SparseRows> all;
  for (std::size_t l = 0; l < entries.size(); ++l) {
    all.push_back(algebra::from_triplets<SparseRows>(rows[l], columns[l], entries[l]));
    entries[l] = {};
  }
  return all;
}

Coarser coarser(const Problem& problem, std::vector<SparseRows> functions, algebra::SymmetricMatrix stiffness) {
  const int levels = coarser_meshes(problem);
  if (levels == 0) throw std::logic_error("coarser: no coarser meshes are known");
  Coarser out;
  algebra::Triplets entries;
  for (const Block& fine : problem.blocks) {
    CoarserBlock coarse = coarser(fine, functions.empty() ? fine.coarse.functions(levels) : std::move(functions));
    coarse.block.first = out.problem.unknowns();
    const SparseRows B = problem.rows_of(fine) * *coarse.functions;
    for (int r = 0; r < B.rows(); ++r)
      for (SparseRows::InnerIterator it(B, r); it; ++it) entries.emplace_back(r, coarse.block.first + static_cast<int>(it.col()), it.value());
    if (stiffness.rows() == 0) coarse.block.K = algebra::congruent(fine.K, *coarse.functions);
    out.problem.blocks.push_back(std::move(coarse.block));
    out.functions.push_back(std::move(coarse.functions));
  }
  if (stiffness.rows() > 0) take_stiffness(out.problem, std::move(stiffness));
  out.problem.B = algebra::from_triplets<SparseRows>(problem.rows(), out.problem.unknowns(), entries);
  out.problem.c = problem.c, out.problem.groups = problem.groups, out.problem.friction = problem.friction;
  out.problem.chains = problem.chains, out.problem.measure = problem.measure, out.problem.row_name = problem.row_name;
  const auto has_node = [&](int row) {  // is it that of a node that both meshes have?
    const int unknown = greatest(problem.B, row);
    if (unknown < 0) return false;
    const std::size_t b = problem.block_of(unknown);
    return same(*out.functions[b], unknown - problem.blocks[b].first) >= 0;
  };
  out.kept.assign(problem.rows(), 1);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count && (group.law->unilateral() || prescribes(group)); ++r) out.kept[r] = has_node(r);
  for (const auto& [group, k, first, n] : problem.friction_points())
    std::fill_n(out.kept.begin() + first, group.components, n >= 0 ? out.kept[n] : char(has_node(first)));
  return out;
}

Vector Coarser::finer_displacement(const Vector& u) const {
  Eigen::Index unknowns = 0;
  for (const auto& P : functions) unknowns += P->rows();
  Vector finer(unknowns);
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < functions.size(); ++b) {
    const SparseRows& P = *functions[b];
    parallel_parts(P.rows(), [&](int begin, int end) {
      finer.segment(first + begin, end - begin) = P.middleRows(begin, end - begin) * u.segment(problem.blocks[b].first, P.cols());
    });
    first += P.rows();
  }
  return finer;
}

Vector Coarser::finer_forces(const Vector& lambda) const {
  Vector finer = Vector::Zero(problem.rows());
  for (const std::vector<int>& rows : kinds(problem)) {
    std::map<int, int> kept_at;  // unknown of the greatest factor → row
    for (const int r : rows)
      if (kept[r]) kept_at[greatest(problem.B, r)] = r;
    const double share = static_cast<double>(kept_at.size()) / static_cast<double>(rows.size());
    for (const int r : rows)
      for (SparseRows::InnerIterator it(problem.B, r); it; ++it)
        if (const auto at = kept_at.find(static_cast<int>(it.col())); at != kept_at.end())
          finer[r] += share * lambda[at->second] * it.value() / problem.B.coeff(at->second, it.col());
  }
  return finer;
}

}  // namespace dotyk::problem

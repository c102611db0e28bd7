#include "problem/coarser.hpp"

#include "algebra/congruent.hpp"
#include "algebra/dense/decompositions.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

struct CoarserBlock {
  Block block;
  algebra::CoarseFunctions functions;  ///< the unknowns of the finer block by this one's
};

/// Motions that are known at some unknowns, and 0 at others, at all of them: as combinations of all rigid motions.
DenseMatrix completed(const DenseMatrix& known, const DenseMatrix& rigid) {
  std::vector<int> rows;
  for (int i = 0; i < known.rows(); ++i)
    if (!known.row(i).isZero(0)) rows.push_back(i);
  return rigid * algebra::least_squares(DenseMatrix(rigid(rows, Eigen::all)), DenseMatrix(known(rows, Eigen::all)));
}

/// The block without its K. `all`: the functions of all coarser meshes.
CoarserBlock coarser(const Block& fine, std::vector<algebra::CoarseFunctions> all) {
  CoarserBlock out{{}, all[0].compact()};
  const algebra::CoarseFunctions& functions = out.functions;
  Block& block = out.block;
  block.name = fine.name;
  block.f = fine.f.isZero(0) ? Vector(Vector::Zero(functions.columns)) : functions.transposed_times(fine.f);
  block.offset = fine.offset;
  for (std::size_t k = 0; k < functions.column.size(); ++k)
    if (functions.column[k] >= 0) block.node.push_back(static_cast<int>(k) / functions.dimension);
  block.kernel = functions.at_coarse(fine.kernel);
  block.motions = fine.motions;
  block.sliced_resultants = fine.sliced_resultants, block.gross_sliced_resultants = fine.gross_sliced_resultants;
  if (fine.rigid) block.rigid = [rigid = fine.rigid, functions] { return functions.at_coarse(rigid()); };
  const std::vector<int>& known = fine.coarse.nodes;  // the last of them is repeated
  const auto nodes_of = [&](std::size_t level) { return known.empty() ? functions.coarse_nodes() : known[std::min(level, known.size() - 1)]; };
  block.hidden = functions.dimension * (nodes_of(0) - functions.coarse_nodes());
  all.erase(all.begin());
  if (!all.empty()) all[0].row = functions.column, all[0].rows = functions.columns;
  std::vector<int> nodes;
  for (std::size_t l = 0; l < all.size(); ++l) nodes.push_back(nodes_of(l + 1));
  block.coarse = {std::move(nodes), functions.dimension, [all = std::move(all)](int most) { return std::vector(all.begin(), all.begin() + most); }};
  if (!fine.coarse.rigid) return out;
  block.coarse.rigid = [rigid = fine.coarse.rigid](int levels) { return rigid(levels + 1); };
  if (block.hidden > 0) return out;
  block.rigid = [rigid = fine.coarse.rigid, functions] {
    const DenseMatrix all = rigid(1);  // empty columns of the functions among its rows
    DenseMatrix motions(functions.columns, all.cols());
    for (std::size_t k = 0; k < functions.column.size(); ++k)
      if (functions.column[k] >= 0) motions.row(functions.column[k]) = all.row(static_cast<Eigen::Index>(k));
    return motions;
  };
  if (fine.kernel.cols() > 0) block.kernel = completed(block.kernel, block.rigid());
  return out;
}

/// The component of its node that an unknown is.
int component_of(const algebra::CoarseFunctions& functions, int node, int unknown) {
  for (int k = 0; k < functions.dimension; ++k)
    if (functions.row[functions.dimension * node + k] == unknown) return k;
  throw std::logic_error("coarser: functions of other nodes than the problem's");
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

void take_load_of_slices(Problem& problem) {
  if (problem.sliced_load == 0 || problem.hides()) return;
  const Vector all = whole_load(problem).get();
  for (Block& block : problem.blocks) block.f = all.segment(block.first, block.size());
  problem.sliced_load = 0;
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
      sum += known == 0 ? block.size() + block.hidden : block.coarse.dimension * nodes[known - 1];
    }
    return sum;
  };
  while (count > 0 && size(count) > kWorth * size(count - 1)) --count;
  return static_cast<int>(count);
}

namespace {

/// Functions of several bodies as those of one.
algebra::CoarseFunctions joined(const std::vector<algebra::CoarseFunctions>& of_blocks) {
  algebra::CoarseFunctions all{of_blocks[0].dimension, nullptr, {}, {}, 0, 0};
  std::vector<int> row, column;
  int nodes = 0;
  for (const algebra::CoarseFunctions& own : of_blocks) {
    for (const int r : own.row) row.push_back(r < 0 ? -1 : all.rows + r);
    for (const int c : own.column) column.push_back(c < 0 ? -1 : all.columns + c);
    nodes += own.nodes(), all.rows += own.rows, all.columns += own.columns;
  }
  all.means = std::make_shared<const Buckets>(nodes, [&](auto&& put) {
    int node = 0, coarse = 0;
    for (const algebra::CoarseFunctions& own : of_blocks) {
      for (int i = 0; i < own.nodes(); ++i, ++node)
        for (const int p : own.of(i)) put(node, coarse + p);
      coarse += own.coarse_nodes();
    }
  });
  all.row = std::move(row), all.column = std::move(column);
  return all;
}

}  // namespace

std::vector<algebra::CoarseFunctions> coarse_functions(const Problem& problem) {
  const auto levels = static_cast<std::size_t>(coarser_meshes(problem));
  if (levels == 0) return {};
  std::vector<std::vector<algebra::CoarseFunctions>> of_level(levels);
  for (const Block& block : problem.blocks) {
    std::vector<algebra::CoarseFunctions> own = block.coarse.functions(static_cast<int>(levels));
    if (problem.blocks.size() == 1) return own;
    for (std::size_t l = 0; l < levels; ++l) of_level[l].push_back(std::move(own[l]));
  }
  std::vector<algebra::CoarseFunctions> all;
  for (const auto& of_blocks : of_level) all.push_back(joined(of_blocks));
  return all;
}

Coarser coarser(const Problem& problem, algebra::SymmetricMatrix stiffness) {
  const int levels = coarser_meshes(problem);
  if (levels == 0) throw std::logic_error("coarser: no coarser meshes are known");
  Coarser out;
  algebra::Triplets entries;
  for (const Block& fine : problem.blocks) {
    CoarserBlock coarse = coarser(fine, fine.coarse.functions(levels));
    coarse.block.first = out.problem.unknowns();
    if (stiffness.rows() == 0) {
      SparseRows P;
      coarse.functions.to_matrix(P);
      coarse.block.K = algebra::congruent(fine.K, P);
    }
    out.problem.blocks.push_back(std::move(coarse.block));
    out.functions.push_back(std::move(coarse.functions));
  }
  if (stiffness.rows() > 0) take_stiffness(out.problem, std::move(stiffness));
  for (int r = 0; r < problem.rows(); ++r)
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it) {
      const std::size_t b = problem.block_of(it.col());
      const int unknown = static_cast<int>(it.col()) - problem.blocks[b].first, node = problem.blocks[b].node[unknown];
      out.functions[b].each_in_row(node, component_of(out.functions[b], node, unknown),
                                   [&](int column, double number) { entries.emplace_back(r, out.problem.blocks[b].first + column, it.value() * number); });
    }
  out.problem.B = algebra::from_triplets<SparseRows>(problem.rows(), out.problem.unknowns(), entries);
  out.problem.sliced_load = problem.sliced_load, out.problem.c = problem.c, out.problem.groups = problem.groups, out.problem.friction = problem.friction;
  out.problem.chains = problem.chains, out.problem.measure = problem.measure, out.problem.row_name = problem.row_name;
  take_load_of_slices(out.problem);
  const auto has_node = [&](int row) {  // is it that of a node that both meshes have?
    const int unknown = greatest(problem.B, row);
    if (unknown < 0) return false;
    const std::size_t b = problem.block_of(unknown);
    return out.functions[b].same(problem.blocks[b].node[unknown - problem.blocks[b].first]) >= 0;
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
  for (const auto& P : functions) unknowns += P.rows;
  Vector finer(unknowns);
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < functions.size(); first += functions[b].rows, ++b)
    finer.segment(first, functions[b].rows) = functions[b].times(u.segment(problem.blocks[b].first, functions[b].columns));
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

// Slices of bodies that the ranks refine, and later visits to their cells.
#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "multigrid/processes/petsc_session.hpp"
#include "multigrid/rank_slices.hpp"
#include "multigrid/shares/messages.hpp"
#include "multigrid/shares/refined_share.hpp"

namespace dotyk::multigrid {

namespace {

/// A rank's cells of the coarse bodies.
struct Given {
  std::vector<int> number, first;  ///< as RefinedShare has them
  Lists lists;
};

/// Sends each rank its cells, the last rank's first, after what `begin(rank)` sends; returns those of rank 0.
template <class MakeShare, class Begin>
Given share_cells(const Ranks& ranks, const Refinement& made, const MakeShare& share, const Begin& begin) {
  Given given{{}, made.first(), {}};
  const Numbering& base = made.base;
  for (int r = ranks.count() - 1; r >= 0; --r) {
    std::vector<char> of_rank(base.slot().size());
    for (std::size_t i = 0; i < of_rank.size(); ++i) of_rank[i] = base.slot()[i] >= base.first(0)[r] && base.slot()[i] < base.first(0)[r + 1];
    Share own = share(of_rank);
    given.number.clear();
    for (std::size_t k = 0; k < own.unknowns.size(); k += made.dimension) given.number.push_back(base.slot()[own.unknowns[k]] / made.dimension);
    given.lists = std::move(own.lists);
    if (r == 0) break;
    begin(r);
    ranks.send(r, given.number), ranks.send(r, given.first);
    send(ranks, r, given.lists);
  }
  return given;
}

Given receive_given(const Ranks& ranks) {
  Given given;
  ranks.receive(0, given.number), ranks.receive(0, given.first);
  given.lists = receive_lists(ranks, 0);
  return given;
}

/// What a rank makes its slice of, once it has refined its share. `prescribed`: rows of each level; `others`: the functions of meshes coarser than its share was.
struct RefinedRows {
  HalfRows rows;
  std::vector<int> idle;
  AllOwnFunctions functions;
  OwnLoad load;
};
RefinedRows refined_rows(const Ranks& ranks, RefinedShare& share, const std::vector<std::vector<int>>& prescribed, const AllOwnFunctions& others, int dimension, bool loaded) {
  auto functions = std::make_shared<std::vector<OwnFunctions>>();
  std::vector<PrescribedBits> bits;
  for (const auto& rows : prescribed) bits.push_back(prescribed_bits(rows, dimension));
  for (std::size_t l = 0; l + 1 < bits.size(); ++l) functions->push_back(share.functions(static_cast<int>(l), bits[l], bits[l + 1]));
  functions->insert(functions->end(), others->begin(), others->end());
  RefinedShare::Assembled assembled = share.assemble(bits[0]);
  RefinedRows out{std::move(assembled.rows), {}, functions, nullptr};
  if (loaded) {
    assembled.load.resize(static_cast<std::size_t>(out.rows.nodes()) * dimension);  // zeros where the rank has no cell with a load
    out.load = std::make_shared<const std::vector<double>>(std::move(assembled.load));
  }
  const std::vector<int>& first = share.first().front();
  for (const int row : prescribed[0])
    if (row / dimension >= first[ranks.own()] && row / dimension < first[ranks.own() + 1]) out.idle.push_back(row);
  return out;
}

/// Rows, by the numbering, of the components that a level does not have as unknowns.
std::vector<int> prescribed_rows(const SharedList<int>& unknown, const std::vector<int>& number, int dimension) {
  std::vector<int> rows;
  for (std::size_t at = 0; at < unknown.size(); ++at)
    if (unknown[at] < 0) rows.push_back(number[at / dimension] * dimension + static_cast<int>(at) % dimension);
  return rows;
}

/// The nodes of a level by the numbers of those whose mean they are.
Rows means_by_number(const algebra::CoarseFunctions& functions, const std::vector<int>& number) {
  Rows means;
  std::vector<int> row;
  for (int i = 0; i < functions.nodes(); ++i) {
    for (const int p : functions.of(i)) row.push_back(number[p]);
    means.append_columns(row);
  }
  return means;
}

/// What a rank needs for a visit, beside its cells.
struct VisitOrder {
  int times = 0, dimension = 0, u = 0, what = 0;
  std::vector<int> rows = {};       ///< of prescribed components that are not 0
  std::vector<double> values = {};  ///< of these
  std::vector<int> nodes = {};      ///< numbers
  Lists said = {};
};

void send(const Ranks& ranks, int to, const VisitOrder& order) {
  ranks.send(to, std::vector<int>{order.times, order.dimension, order.u, order.what});
  ranks.send(to, order.rows), ranks.send(to, order.values), ranks.send(to, order.nodes);
  send(ranks, to, order.said);
}

VisitOrder receive_order(const Ranks& ranks) {
  const std::vector<int> numbers = ranks.received<int>(0);
  VisitOrder order{numbers[0], numbers[1], numbers[2], numbers[3]};
  ranks.receive(0, order.rows), ranks.receive(0, order.values), ranks.receive(0, order.nodes);
  order.said = receive_lists(ranks, 0);
  return order;
}

Lists visit_own(const Ranks& ranks, Given given, const VisitOrder& order, const ShareMakers& makers, VisitCells make, const std::vector<double>& own_u) {
  RefinedShare share(ranks, makers.refinable(std::move(given.lists)), order.dimension, std::move(given.number), std::move(given.first), VisitedCells::kLayers);
  for (int k = 0; k < order.times; ++k) share.refine({});
  std::vector<double> u = share.at_nodes(own_u);
  std::unordered_map<int, double> prescribed;
  for (std::size_t k = 0; k < order.rows.size(); ++k) prescribed.emplace(order.rows[k], order.values[k]);
  for (std::size_t k = 0; k < u.size() && !prescribed.empty(); ++k)
    if (const auto at = prescribed.find(share.number()[k / order.dimension] * order.dimension + static_cast<int>(k) % order.dimension); at != prescribed.end()) u[k] = at->second;
  const std::vector<int>& first = share.first().front();
  return make({share.cells(), share.number(), first[ranks.own()], first[ranks.own() + 1], u, order.nodes, ranks.own()}, order.said);
}

}  // namespace

std::vector<int> Refinement::first() const {
  std::vector<int> first = base.first(0);
  for (int& row : first) row /= dimension;
  return first;
}

std::unique_ptr<Slice> receive_refined_slice(const Ranks& ranks, const ShareMakers& makers) {
  const std::vector<int> sizes = ranks.received<int>(0);
  const int times = sizes[0], dimension = sizes[1];
  const bool loaded = sizes[2] != 0;
  Given given = receive_given(ranks);
  RefinedShare share(ranks, makers.refinable(std::move(given.lists)), dimension, std::move(given.number), std::move(given.first));
  for (int k = 0; k < times; ++k) share.refine({});
  std::vector<std::vector<int>> prescribed(static_cast<std::size_t>(times) + 1);
  for (auto& rows : prescribed) ranks.receive(0, rows);
  const AllOwnFunctions others = receive_own_functions(ranks, 0);
  const Entries added = receive_entries(ranks);
  RefinedRows own = refined_rows(ranks, share, prescribed, others, dimension, loaded);
  add(own.rows, added);
  return told_slice(ranks, std::move(own.rows), own.idle, std::move(own.functions), std::move(own.load));
}

std::unique_ptr<Slice> RankSlices::share_out(const Refined& matrix) {
  const Ranks& ranks = workers_.ranks();
  const auto made = std::make_shared<Refinement>(Refinement{{matrix.base.coupling, ranks.count()}, matrix.times, matrix.coarse.front().dimension, {}});
  const Numbering& base = made->base;
  const int d = made->dimension;
  const std::vector<int> first = made->first();
  workers_.tell(Task::refined_slice);
  Given own = share_cells(ranks, *made, matrix.base.share, [&](int r) { ranks.send(r, std::vector<int>{made->times, d, matrix.loaded}); });
  RefinedShare share(ranks, matrix.base.makers.refinable(std::move(own.lists)), d, std::move(own.number), first);
  std::vector<std::vector<int>> number(1), prescribed;  // by level
  for (std::size_t i = 0; i < base.slot().size(); i += d) number[0].push_back(base.slot()[i] / d);
  for (int level = matrix.times - 1; level >= 0; --level) number.insert(number.begin(), share.refine(means_by_number(matrix.coarse[level], number.front())));
  for (int level = 0; level <= matrix.times; ++level)
    prescribed.push_back(prescribed_rows(level == 0 ? matrix.coarse[0].row : matrix.coarse[level - 1].column, number[level], d));
  made->node = number.front();
  numbering_ = std::make_shared<const Numbering>(share.first(), number, matrix.coarse.front(), made);
  const std::vector of_base(matrix.coarse.begin() + matrix.times, matrix.coarse.end());
  AllOwnFunctions others;
  for (int r = ranks.count() - 1; r >= 0; --r) {
    others = own_functions(of_base, base, r);
    if (r == 0) break;
    for (const auto& rows : prescribed) ranks.send(r, rows);
    send(ranks, r, others);
    send(ranks, r, entries_of(r, matrix.base.added, *numbering_));
  }
  RefinedRows rows = refined_rows(ranks, share, prescribed, others, d, matrix.loaded);
  add(rows.rows, entries_of(0, matrix.base.added, *numbering_));
  return std::make_unique<Slice>(ranks, std::move(rows.rows), rows.idle, std::move(rows.functions), std::move(rows.load));
}

std::vector<Lists> RankVectors::visit(const Visit& visit) {
  const Refinement* refinement = numbering_->refinement();
  if (!refinement) throw std::logic_error("vectors: cells that ranks have not refined are visited");
  const std::lock_guard lock(only_one());
  const Ranks& ranks = workers_.ranks();
  const int d = refinement->dimension;
  VisitOrder order{refinement->times, d, visit.u.number(), static_cast<int>(visit.what), {}, visit.values, {}, visit.said};
  for (const int component : visit.components) order.rows.push_back(refinement->node[component / d] * d + component % d);
  for (const int node : visit.nodes) order.nodes.push_back(refinement->node[node]);
  return ranks.together([&] {
    workers_.tell(Task::visit);
    Given own = share_cells(ranks, *refinement, visit.share, [&](int r) { send(ranks, r, order); });
    std::vector<Lists> told{visit_own(ranks, std::move(own), order, visit.makers, visit.make, own_[visit.u.number()])};
    for (int r = 1; r < ranks.count(); ++r) told.push_back(receive_lists(ranks, r));
    return told;
  });
}

void visit_for_rank_0(const Ranks& ranks, const ShareMakers& makers, algebra::VectorParts& vectors) {
  const VisitOrder order = receive_order(ranks);
  Given given = receive_given(ranks);
  send(ranks, 0, visit_own(ranks, std::move(given), order, makers, makers.visit(static_cast<VisitFor>(order.what)), vectors[order.u]));
}

}  // namespace dotyk::multigrid

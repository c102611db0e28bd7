#include "multigrid/shares/changes.hpp"

#include <algorithm>

namespace dotyk::multigrid {

std::set<int> sharing_unknowns(const Matrix& matrix) {
  constexpr double kStiffer = 2;
  std::set<int> sharing;
  if (!matrix.unknowns) return sharing;
  const algebra::Vector k = matrix.slices ? matrix.slices->diagonal() : algebra::Vector(matrix.displaced->diagonal());
  const algebra::SparseRows S = *matrix.unknowns;
  algebra::Vector brought = algebra::Vector::Zero(k.size()), carried = brought;  // stiffness, to an unknown by rows, and by a row to others
  const auto each_pair = [&](auto&& visit) {
    for (int i = 0; i < S.rows(); ++i)
      for (algebra::SparseRows::InnerIterator it(S, i); it; ++it)
        if (it.col() != i) visit(i, static_cast<int>(it.col()), it.value());
  };
  each_pair([&](int i, int j, double factor) {
    const double whole = S.coeff(i, i), stiffness = k[i] * (factor / whole) * (factor / whole);
    brought[j] += stiffness, carried[i] += stiffness / k[j];
  });
  each_pair([&](int i, int j, double) {
    if (brought[j] > kStiffer * k[j] || carried[i] > kStiffer) sharing.insert({i, j});
  });
  return sharing;
}

std::vector<Change> changes(const algebra::Triplets& changed, const std::vector<char>& held, const std::set<int>& sharing, const Numbering& numbering,
                            int ranks) {
  const std::vector<int>& slot = numbering.slot();
  std::vector<Change> of(static_cast<std::size_t>(ranks));
  const auto put = [&](int row, int column, double value) {
    Change& own = of[numbering.rank_of(row)];
    own.rows.push_back(row), own.columns.push_back(column), own.values.push_back(value);
  };
  for (const auto& entry : changed) {
    const int row = slot[entry.row()], column = slot[entry.col()];
    put(row, column, entry.value());
    if (row != column) put(column, row, entry.value());
  }
  const auto put_local = [&](std::vector<int> Change::*list, int row) {
    const int rank = numbering.rank_of(row);
    (of[rank].*list).push_back(row - numbering.first(0)[rank]);
  };
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) put_local(&Change::empty, slot[i]);
  for (const int row : numbering.idle()) put_local(&Change::empty, row);
  for (const int i : sharing)
    if (!held[i]) put_local(&Change::shared, slot[i]);
  for (Change& own : of) std::sort(own.shared.begin(), own.shared.end());
  return of;
}

}  // namespace dotyk::multigrid

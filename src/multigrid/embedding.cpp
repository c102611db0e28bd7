#include "multigrid/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dotyk::multigrid {

namespace {

/// Sum of the diagonal; NaN where an entry is not positive.
double positive_trace(const algebra::SparseMatrix& lower) {
  const int* begin = lower.outerIndexPtr();
  double sum = 0;
  for (int j = 0; j < lower.cols(); ++j) {
    const bool has = begin[j] < begin[j + 1] && lower.innerIndexPtr()[begin[j]] == j;
    if (!has || !(lower.valuePtr()[begin[j]] > 0)) return std::nan("");
    sum += lower.valuePtr()[begin[j]];
  }
  return sum;
}

}  // namespace

Embedding::Embedding(const algebra::SparseMatrix& lower, const std::vector<int>& node) {
  if (!lower.isCompressed() || static_cast<std::size_t>(lower.rows()) != node.size())
    throw std::runtime_error("multigrid: the matrix is not compressed, or nodes are not given for each unknown");
  number(node);
  lay_out(lower);
  const double trace = positive_trace(lower);
  for (const int i : idle_) values_[starts_[i]] = std::isfinite(trace) ? trace / static_cast<double>(slot_.size()) : 1.0;
}

void Embedding::number(const std::vector<int>& node) {
  std::vector<int> first;  // unknown of each block
  for (std::size_t i = 0; i < node.size(); ++i)
    if (i == 0 || node[i] != node[i - 1]) first.push_back(static_cast<int>(i));
  first.push_back(static_cast<int>(node.size()));
  for (std::size_t b = 0; b + 1 < first.size(); ++b) block_ = std::max(block_, first[b + 1] - first[b]);
  for (std::size_t b = 0; b + 1 < first.size(); ++b) {
    const int begin = static_cast<int>(b) * block_, used = first[b + 1] - first[b];
    for (int k = 0; k < used; ++k) slot_.push_back(begin + k);
    for (int k = used; k < block_; ++k) idle_.push_back(begin + k);
  }
  starts_.assign(slot_.size() + idle_.size() + 1, 0);
}

/// Calls visit(row, column, number, place in values_, place of the mirror image) for each entry of the lower triangle, column by column. Each row of the
/// full matrix so gets its entries by ascending columns: those left of the diagonal belong to earlier columns of the triangle, the others to its own.
template <class Visit>
void Embedding::for_each_entry(const algebra::SparseMatrix& lower, Visit&& visit) {
  const int* begin = lower.outerIndexPtr();
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for (int j = 0; j < lower.cols(); ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      const int i = lower.innerIndexPtr()[k], at = next[slot_[i]]++;
      visit(slot_[i], slot_[j], lower.valuePtr()[k], at, i == j ? at : next[slot_[j]]++);
    }
}

void Embedding::lay_out(const algebra::SparseMatrix& lower) {
  const int* begin = lower.outerIndexPtr();
  const int* inner = lower.innerIndexPtr();
  const int n = static_cast<int>(lower.cols());
  for (int j = 0; j < n; ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      if (inner[k] < j) throw std::runtime_error("multigrid: the matrix is not a lower triangle");
      ++starts_[slot_[inner[k]] + 1];
      if (inner[k] != j) ++starts_[slot_[j] + 1];
    }
  for (const int i : idle_) ++starts_[i + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  columns_.resize(static_cast<std::size_t>(starts_.back()));
  values_.assign(columns_.size(), 0.0);
  for_each_entry(lower, [&](int row, int column, double, int at, int mirror) { columns_[at] = column, columns_[mirror] = row; });
  for (const int i : idle_) columns_[starts_[i]] = i;
}

bool Embedding::fill(const algebra::SparseMatrix& lower, std::vector<char>& changed) {
  const std::size_t entries = slot_.size() + 2 * (static_cast<std::size_t>(lower.nonZeros()) - slot_.size()) + idle_.size();
  if (!lower.isCompressed() || entries != values_.size() || static_cast<std::size_t>(lower.cols()) != slot_.size())
    throw std::runtime_error("multigrid: the matrix has another pattern than the one that the solver was made for");
  if (!std::isfinite(positive_trace(lower))) return false;
  for_each_entry(lower, [&](int row, int column, double value, int at, int mirror) {
    if (values_[at] == value) return;
    values_[at] = values_[mirror] = value;
    changed[row] = changed[column] = 1;
  });
  return true;
}

double Embedding::bytes() const {
  const std::size_t places = slot_.size() + starts_.size() + columns_.size();
  return 4.0 * static_cast<double>(places) + 8.0 * static_cast<double>(values_.size());
}

}  // namespace dotyk::multigrid

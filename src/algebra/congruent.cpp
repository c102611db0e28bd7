#include "algebra/congruent.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include "base/buckets.hpp"
#include "base/counted.hpp"
#include "base/parallel.hpp"

namespace dotyk::algebra {
namespace {

constexpr int kAlike = 3;  ///< columns at a time, at most

std::span<const int> rows_of(const SparseMatrix& A, int j) { return {A.innerIndexPtr() + A.outerIndexPtr()[j], A.innerIndexPtr() + A.outerIndexPtr()[j + 1]}; }
const double* numbers_of(const SparseMatrix& A, int j) { return A.valuePtr() + A.outerIndexPtr()[j]; }

/// Can some columns of PᵀLP from J on be made together, as those of a node's components? The columns of P have the same numbers, each one row further down, and
/// the columns of L have the same rows from their diagonals on.
bool are_alike(const SparseMatrix& lower, const SparseMatrix& P, int J, int count) {
  const auto first = rows_of(P, J);
  for (int c = 1; c < count; ++c) {
    const auto next = rows_of(P, J + c);
    if (next.size() != first.size() || !std::equal(numbers_of(P, J), numbers_of(P, J) + first.size(), numbers_of(P, J + c))) return false;
    for (std::size_t k = 0; k < first.size(); ++k) {
      const int i = first[k];
      if (next[k] != i + c) return false;
      const auto all = rows_of(lower, i), own = rows_of(lower, i + c);
      if (own.empty() || own[0] != i + c || all.size() != own.size() + c || !std::equal(own.begin(), own.end(), all.begin() + c)) return false;
    }
  }
  return true;
}

/// Columns first, first + 1, … of M, rows ascending, without what is above the diagonal.
struct HalfColumns {
  int first = 0;
  std::vector<std::size_t> starts{0};
  std::vector<int> rows;
  std::vector<double> numbers;
  Triplets above;  ///< the rest, transposed

  struct Part {
    std::span<const int> rows;
    const double* numbers;
  };
  Part operator[](int J) const {
    const std::size_t at = starts[J - first];
    return {std::span(rows).subspan(at, starts[J - first + 1] - at), numbers.data() + at};
  }
};

/// Makes columns of M = PᵀLP. `rows`: P once more.
class Product {
 public:
  Product(const SparseMatrix& lower, const SparseMatrix& P, const SparseRows& rows) : lower_(lower), P_(P), rows_(rows), fine_(static_cast<int>(P.rows()), kAlike), coarse_(static_cast<int>(P.cols()), kAlike) {}

  /// Columns J … J + count − 1, which are alike.
  template <int count>
  void append(int J, HalfColumns& to) {
    for (SparseMatrix::InnerIterator p(P_, J); p; ++p) add<count>(static_cast<int>(p.row()), p.value());
    for (std::size_t k = 0; k < fine_.rows().size(); ++k)
      for (SparseRows::InnerIterator p(rows_, fine_.rows()[k]); p; ++p) {
        double* sum = coarse_.at(static_cast<int>(p.col()));
        for (int c = 0; c < count; ++c) sum[c] += p.value() * fine_.numbers(k)[c];
      }
    entries_.clear();
    for (std::size_t k = 0; k < coarse_.rows().size(); ++k) {
      entries_.push_back({coarse_.rows()[k], {}});
      std::copy_n(coarse_.numbers(k), count, entries_.back().numbers);
    }
    fine_.clear(), coarse_.clear();
    std::ranges::sort(entries_, {}, &Entry::row);
    for (int c = 0; c < count; ++c) {
      for (const auto& [I, numbers] : entries_) {
        if (I < J + c) to.above.emplace_back(J + c, I, numbers[c]);
        else to.rows.push_back(I), to.numbers.push_back(I == J + c ? 2 * numbers[c] : numbers[c]);
      }
      to.starts.push_back(to.rows.size());
    }
  }

 private:
  struct Entry {
    int row;
    double numbers[kAlike];
  };

  /// factor × L's columns from i on.
  template <int count>
  void add(int i, double factor) {
    const auto rows = rows_of(lower_, i);
    const double* of[count];
    for (int c = 0; c < count; ++c) of[c] = numbers_of(lower_, i + c) - c;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      double* sum = fine_.at(rows[k]);
      for (int c = 0; c < count; ++c)
        if (rows[k] > i + c) sum[c] += factor * of[c][k];
        else if (rows[k] == i + c) sum[c] += factor * 0.5 * of[c][k];
    }
  }

  const SparseMatrix &lower_, &P_;
  const SparseRows& rows_;
  SomeRows fine_, coarse_;  ///< numbers of the columns at hand
  std::vector<Entry> entries_;
};

/// Visits the entries of a column of M's lower part and of `above`, added up; `of_column`: those of the latter, rows ascending.
template <class Visit>
void each_of_sum(const HalfColumns::Part& below, std::span<const int> of_column, const Triplets& above, const Visit& visit) {
  std::size_t a = 0, b = 0;
  while (a < below.rows.size() || b < of_column.size()) {
    const int of_a = a < below.rows.size() ? below.rows[a] : std::numeric_limits<int>::max();
    const int of_b = b < of_column.size() ? above[of_column[b]].row() : std::numeric_limits<int>::max();
    double value = 0;
    if (of_a <= of_b) value += below.numbers[a++];
    if (of_b <= of_a) value += above[of_column[b++]].value();
    visit(std::min(of_a, of_b), value);
  }
}

// With L = A's lower triangle and half its diagonal, PᵀAP = M + Mᵀ for M = PᵀLP, which is made column by column. `rows`: P once more.
SparseMatrix congruent(const SparseMatrix& lower, const SparseMatrix& P, const SparseRows& rows) {
  constexpr Eigen::Index kFew = 1'000'000;  // entries, for a thread
  const int threads = threads_for(lower.nonZeros(), kFew), count = static_cast<int>(P.cols());
  std::vector<HalfColumns> some(static_cast<std::size_t>(threads));
  parallel_ranges(count, threads, [&](int k, int first, int end) {
    HalfColumns& own = some[k];
    own.first = first;
    const auto about = static_cast<std::size_t>(static_cast<double>(lower.nonZeros()) * (end - first) / static_cast<double>(std::max<Eigen::Index>(1, P.rows())));
    own.rows.reserve(about), own.numbers.reserve(about);
    Product product(lower, P, rows);
    for (int J = first; J < end;) {
      if (J + 3 <= end && are_alike(lower, P, J, 3)) product.append<3>(J, own), J += 3;
      else if (J + 2 <= end && are_alike(lower, P, J, 2)) product.append<2>(J, own), J += 2;
      else product.append<1>(J, own), J += 1;
    }
  });
  Triplets above;
  for (HalfColumns& own : some) above.insert(above.end(), own.above.begin(), own.above.end()), own.above = {};
  const Buckets by_column(count, [&](auto&& put) {
    for (std::size_t e = 0; e < above.size(); ++e) put(above[e].col(), static_cast<int>(e));
  });
  SparseMatrix sum(count, count);
  int* starts = sum.outerIndexPtr();
  const auto each_column = [&](auto&& work) {
    parallel_ranges(count, threads, [&](int k, int first, int end) {
      for (int J = first; J < end; ++J) work(J, [&](auto&& visit) { each_of_sum(some[k][J], by_column[J], above, visit); });
    });
  };
  each_column([&](int J, auto&& each) {
    int entries = 0;
    each([&](int, double) { ++entries; });
    starts[J + 1] = entries;
  });
  counted(std::accumulate(starts, starts + count + 1, std::size_t(0)));
  std::partial_sum(starts, starts + count + 1, starts);
  sum.resizeNonZeros(starts[count]);
  each_column([&](int J, auto&& each) {
    int at = starts[J];
    each([&](int I, double value) { sum.innerIndexPtr()[at] = I, sum.valuePtr()[at++] = value; });
  });
  return sum;
}

}  // namespace

SparseMatrix lower_sum(const SparseMatrix& A, const SparseMatrix& B) {
  SparseMatrix sum(A.rows(), A.cols());
  sum.reserve(A.nonZeros() + B.nonZeros());
  for (int j = 0; j < A.cols(); ++j) {
    sum.startVec(j);
    SparseMatrix::InnerIterator a(A, j), b(B, j);
    while (a || b) {
      const bool take_a = a && (!b || a.row() <= b.row()), take_b = b && (!a || b.row() <= a.row());
      const Eigen::Index i = take_a ? a.row() : b.row();
      const double value = (take_a ? a.value() : 0) + (take_b ? b.value() : 0);
      if (i >= j) sum.insertBack(i, j) = value;
      if (take_a) ++a;
      if (take_b) ++b;
    }
  }
  sum.finalize();
  return sum;
}

SparseMatrix congruent(const SparseMatrix& lower, const SparseMatrix& P) { return congruent(lower, P, SparseRows(P)); }
SparseMatrix congruent(const SparseMatrix& lower, const SparseRows& P) { return congruent(lower, SparseMatrix(P), P); }

SparseMatrix block_diagonal(const std::vector<const SparseMatrix*>& blocks) {
  Eigen::Index size = 0, entries = 0;
  for (const SparseMatrix* block : blocks) size += block->rows(), entries += block->nonZeros();
  SparseMatrix all(size, size);
  all.resizeNonZeros(counted(static_cast<std::size_t>(entries)));
  int first = 0, before = 0;
  for (const SparseMatrix* block : blocks) {
    const auto count = static_cast<int>(block->nonZeros());
    const int *rows = block->innerIndexPtr(), *starts = block->outerIndexPtr();
    std::transform(rows, rows + count, all.innerIndexPtr() + before, [&](int row) { return first + row; });
    std::copy_n(block->valuePtr(), count, all.valuePtr() + before);
    std::transform(starts + 1, starts + block->cols() + 1, all.outerIndexPtr() + first + 1, [&](int end) { return before + end; });
    first += static_cast<int>(block->cols()), before += count;
  }
  return all;
}

void with_columns(const SparseRows& rows, const std::vector<int>& place, SparseRows& out) {
  out.resize(rows.rows(), std::ranges::count_if(place, [](int p) { return p >= 0; }));
  out.resizeNonZeros(rows.nonZeros());
  std::copy_n(rows.outerIndexPtr(), rows.rows() + 1, out.outerIndexPtr());
  parallel_parts(rows.nonZeros(), [&](int first, int end) {
    std::copy(rows.valuePtr() + first, rows.valuePtr() + end, out.valuePtr() + first);
    std::transform(rows.innerIndexPtr() + first, rows.innerIndexPtr() + end, out.innerIndexPtr() + first, [&](int column) { return place[column]; });
  });
}

SparseMatrix part_of(const SparseMatrix& from, const std::vector<int>& place, const std::vector<int>& columns) {
  const auto count = static_cast<Eigen::Index>(columns.size());
  const int rows = place.empty() ? 0 : *std::ranges::max_element(place) + 1;
  SparseMatrix part(rows, count);
  const auto each_of = [&](Eigen::Index J, auto&& visit) {
    for (SparseMatrix::InnerIterator it(from, columns[J]); it; ++it)
      if (const int row = place[it.row()]; row >= 0) visit(row, it.value());
  };
  int* starts = part.outerIndexPtr();
  for (Eigen::Index J = 0; J < count; ++J) {
    int entries = 0;
    each_of(J, [&](int, double) { ++entries; });
    starts[J + 1] = starts[J] + entries;
  }
  part.resizeNonZeros(starts[count]);
  for (Eigen::Index J = 0, at = 0; J < count; ++J)
    each_of(J, [&](int row, double value) { part.innerIndexPtr()[at] = row, part.valuePtr()[at++] = value; });
  return part;
}

StoredMatrix congruent_near(const SparseMatrix& lower, const SparseMatrix& P) {
  std::vector<int> place(static_cast<std::size_t>(P.rows()), -1), met, columns;
  for (int j = 0; j < lower.cols(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) place[it.row()] = place[j] = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] == 0) place[i] = static_cast<int>(met.size()), met.push_back(static_cast<int>(i));
  for (int J = 0; J < P.cols(); ++J) {
    SparseMatrix::InnerIterator it(P, J);
    while (it && place[it.row()] < 0) ++it;
    if (it) columns.push_back(J);
  }
  const SparseMatrix small = congruent(part_of(lower, place, met), part_of(P, place, columns));
  StoredMatrix all;
  all.resize(P.cols(), P.cols());
  all.resizeNonZeros(small.nonZeros());
  std::copy_n(small.valuePtr(), small.nonZeros(), all.valuePtr());
  std::transform(small.innerIndexPtr(), small.innerIndexPtr() + small.nonZeros(), all.innerIndexPtr(), [&](int row) { return columns[row]; });
  for (std::size_t J = 0; J < columns.size(); ++J) all.outerIndexPtr()[columns[J] + 1] = static_cast<int>(small.col(static_cast<Eigen::Index>(J)).nonZeros());
  std::partial_sum(all.outerIndexPtr(), all.outerIndexPtr() + P.cols() + 1, all.outerIndexPtr());
  return all;
}

}  // namespace dotyk::algebra

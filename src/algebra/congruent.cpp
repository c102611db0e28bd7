#include "algebra/congruent.hpp"

#include "base/parallel.hpp"

namespace dotyk::algebra {
namespace {

/// A column of numbers, most of which are 0.
class SparseColumn {
 public:
  explicit SparseColumn(Eigen::Index size) : value_(size, 0.0), in_(size, 0) {}
  void add(int at, double value) {
    if (!in_[at]) in_[at] = 1, places_.push_back(at);
    value_[at] += value;
  }
  /// Visits places and numbers, and forgets them.
  template <class Visit>
  void empty(const Visit& visit) {
    for (const int at : places_) {
      visit(at, value_[at]);
      value_[at] = 0, in_[at] = 0;
    }
    places_.clear();
  }

 private:
  std::vector<double> value_;
  std::vector<char> in_;
  std::vector<int> places_;
};

// With L = A's lower triangle and half its diagonal, PᵀAP = M + Mᵀ for M = PᵀLP, which is made column by column. `rows`: P once more.
SparseMatrix congruent(const SparseMatrix& lower, const SparseMatrix& P, const SparseRows& rows) {
  struct Columns {
    std::vector<int> counts, places;
    std::vector<double> values;
  };
  constexpr Eigen::Index kFew = 1'000'000;  // entries, for a thread
  const int threads = threads_for(lower.nonZeros(), kFew);
  std::vector<Columns> some(static_cast<std::size_t>(threads));
  parallel_ranges(static_cast<int>(P.cols()), threads, [&](int k, int first, int end) {
    Columns& own = some[k];
    SparseColumn fine(P.rows()), coarse(P.cols());
    for (int J = first; J < end; ++J) {
      for (SparseMatrix::InnerIterator p(P, J); p; ++p)
        for (SparseMatrix::InnerIterator l(lower, p.row()); l; ++l) fine.add(static_cast<int>(l.row()), (l.row() == l.col() ? 0.5 : 1) * l.value() * p.value());
      fine.empty([&](int i, double value) {
        for (SparseRows::InnerIterator p(rows, i); p; ++p) coarse.add(static_cast<int>(p.col()), p.value() * value);
      });
      const std::size_t before = own.places.size();
      coarse.empty([&](int I, double value) {
        own.places.push_back(I), own.values.push_back(value);
      });
      own.counts.push_back(static_cast<int>(own.places.size() - before));
    }
  });
  std::vector<int> starts{0}, places;
  std::vector<double> values;
  for (Columns& own : some) {
    for (const int count : own.counts) starts.push_back(starts.back() + count);
    if (places.empty()) {  // not a second copy of all entries where there is one thread
      places.swap(own.places), values.swap(own.values);
      continue;
    }
    places.insert(places.end(), own.places.begin(), own.places.end()), values.insert(values.end(), own.values.begin(), own.values.end());
    own = {};
  }
  const Eigen::Map<const SparseMatrix> M(P.cols(), P.cols(), static_cast<Eigen::Index>(places.size()), starts.data(), places.data(), values.data());
  const SparseMatrix mirrored = M.transpose(), sorted = mirrored.transpose();
  return lower_sum(sorted, mirrored);
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

}  // namespace dotyk::algebra

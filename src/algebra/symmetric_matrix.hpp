#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra/field.hpp"
#include "algebra/types.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

namespace dotyk::algebra {

/// K_jj of a lower triangle, columns sorted; null where there is no such entry.
inline const double* diagonal_entry(const SparseMatrix& lower, int j) {
  const int first = lower.outerIndexPtr()[j];
  return first < lower.outerIndexPtr()[j + 1] && lower.innerIndexPtr()[first] == j ? lower.valuePtr() + first : nullptr;
}

/// Calls visit(place among the numbers, row, column) for the entries of a lower triangle, compressed, columns sorted, in rows or columns of the unknowns that
/// `of` flags by 1, in their order.
/// Columns that end above the first of these unknowns, or begin below the last, are not read: mostly unknowns near each other have numbers near each other.
template <class Visit>
void each_entry_of(const SparseMatrix& lower, const std::vector<char>& of, const Visit& visit) {
  const auto first = static_cast<int>(std::ranges::find(of, 1) - of.begin());
  int last = static_cast<int>(of.size()) - 1;
  while (last >= 0 && !of[last]) --last;
  for (int j = 0; j <= last; ++j) {
    const int begin = lower.outerIndexPtr()[j], end = lower.outerIndexPtr()[j + 1];
    if (begin == end || lower.innerIndexPtr()[end - 1] < first) continue;
    for (int k = begin; k < end; ++k)
      if (const int i = lower.innerIndexPtr()[k]; of[i] || of[j]) visit(k, i, j);
  }
}

/// The product A V of a symmetric matrix A, given as its lower triangle, with a vector V or a row-major matrix V, in V's number type. A is read once, whatever
/// the number of columns. `of` is applied to each entry of A first: with the modulus the result is |A| V. The order of summation, and so rounding, depends on
/// the number of threads.
template <class Numbers, class Of = std::identity>
typename Numbers::PlainObject symmetric_product(const SparseMatrix& lower, const Numbers& V, Of of = {}) {
  using Plain = typename Numbers::PlainObject;
  using Number = typename Numbers::Scalar;
  static_assert(Numbers::ColsAtCompileTime == 1 || Numbers::IsRowMajor);
  const int n = static_cast<int>(lower.cols());
  constexpr Eigen::Index known = Numbers::ColsAtCompileTime;
  const Eigen::Index count = known == Eigen::Dynamic ? V.cols() : known;
  const auto add = [&](Number* to, int from, double a) {
    for (Eigen::Index c = 0; c < count; ++c) to[c] += a * V.data()[from * count + c];
  };
  constexpr Eigen::Index kFew = 1'000'000;  // entries, for a thread
  const int threads = threads_for(lower.nonZeros(), kFew);
  Plain product = Plain::Zero(V.rows(), V.cols());
  std::vector<Plain> beyond(static_cast<std::size_t>(threads));  // what a range of columns adds to the rows after it
  parallel_ranges(n, threads, [&](int k, int first, int end) {
    Plain& after = beyond[k] = Plain::Zero(n - end, V.cols());
    for (int j = first; j < end; ++j)
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
        const int i = static_cast<int>(it.row());
        if (i < j) continue;
        const double a = of(it.value());
        add(i < end ? product.data() + i * count : after.data() + (i - end) * count, j, a);
        if (i != j) add(product.data() + j * count, i, a);
      }
  });
  for (const Plain& after : beyond) product.bottomRows(after.rows()) += after;
  return product;
}

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// A symmetric matrix whose rows are distributed over processes, or one has them all. Products and entries are asked of them.
class SlicedMatrix {
 public:
  virtual ~SlicedMatrix() = default;
  virtual Vector times(const Eigen::Ref<const Vector>& x) const = 0;
  virtual Vector gross_times(const Vector& x) const = 0;                      ///< |A| |x|
  /// Flags so many layers of neighbours in `of` as well, and returns the lower triangle with the entries in rows and columns of flagged unknowns alone.
  /// Throws InputError where there is not enough memory.
  virtual StoredMatrix near(std::vector<char>& of, int layers = 0) const = 0;
  /// Vectors that lie where the rows do; `watched`: unknowns, ascending. A block has none.
  virtual std::shared_ptr<Vectors> vectors(const std::vector<int>& watched) const = 0;
  virtual bool holds(const Vectors& vectors) const = 0;  ///< do they lie there?
  /// from −= A u for such vectors: in extended precision, or in double precision with u.high alone.
  virtual void take_product(const LongField& u, bool precisely, Field& from) const = 0;
  /// Adds, to such a vector, the load that was assembled with the matrix: of hidden unknowns no process has all numbers. Nothing where there was none.
  virtual void add_load(Field& to) const = 0;

  const Vector& diagonal() const { return diagonal_; }
  int most_entries() const { return most_entries_; }  ///< at least as many as any row has
  /// Are there other rows and columns, of unknowns that have no number here? Vectors have numbers at them, zeros where Vectors::put() fills these.
  bool hides() const { return hides_; }

 protected:
  Vector diagonal_;
  int most_entries_ = 0;
  bool hides_ = false;
};

/// A symmetric matrix, stored as its lower triangle or distributed over several processes. It does not change, and copies share it.
class SymmetricMatrix {
 public:
  SymmetricMatrix() = default;
  SymmetricMatrix(SparseMatrix lower) : content_(std::make_shared<Content>()) { content_->lower.swap(lower); }  // NOLINT: taken wherever a triangle is given
  SymmetricMatrix(StoredMatrix lower) : content_(std::make_shared<Content>()) { content_->lower.swap(lower); }  // NOLINT
  SymmetricMatrix(std::shared_ptr<const SlicedMatrix> slices) : content_(std::make_shared<Content>()) { content_->slices = std::move(slices); }  // NOLINT

  /// The lower triangle. A distributed matrix is gathered when this is called first, and is kept. Throws InputError where it hides unknowns.
  const SparseMatrix& lower() const {
    static const SparseMatrix none;
    if (!content_) return none;
    if (slices()) std::call_once(content_->once, [&] {
      if (slices()->hides()) throw InputError("the stiffness cannot be put together: ranks have refined the bodies, and a part of it is known to them alone");
      std::vector<char> all(static_cast<std::size_t>(rows()), 1);
      StoredMatrix whole = slices()->near(all);
      content_->lower.swap(whole);
    });
    return content_->lower;
  }
  operator const SparseMatrix&() const { return lower(); }  // NOLINT
  const SlicedMatrix* slices() const { return content_ ? content_->slices.get() : nullptr; }  ///< null: there are none
  std::shared_ptr<const SlicedMatrix> shared_slices() const { return content_ ? content_->slices : nullptr; }

  Eigen::Index rows() const { return slices() ? slices()->diagonal().size() : lower().rows(); }
  double diagonal(int j) const {
    if (slices()) return slices()->diagonal()[j];
    const double* entry = diagonal_entry(lower(), j);
    return entry ? *entry : 0;
  }
  /// The greatest modulus on the diagonal; NaN where an entry is NaN.
  double greatest_on_diagonal() const {
    if (slices()) return greatest_of(slices()->diagonal());
    Vector all(rows());
    for (int j = 0; j < all.size(); ++j) all[j] = diagonal(j);
    return greatest_of(all);
  }
  /// The product with a vector, in its number type. In extended precision a distributed matrix is gathered: SlicedMatrix::take_product() does without.
  template <class Numbers>
  typename Numbers::PlainObject times(const Numbers& x) const {
    if constexpr (std::is_same_v<typename Numbers::Scalar, double>)
      if (slices()) return slices()->times(x);
    return symmetric_product(lower(), x);
  }
  /// |A| |x|.
  Vector gross_times(const Vector& x) const {
    return slices() ? slices()->gross_times(x) : symmetric_product(lower(), Vector(x.cwiseAbs()), [](double a) { return std::abs(a); });
  }

 private:
  static double greatest_of(const Vector& all) { return all.size() > 0 ? all.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0; }
  struct Content {
    SparseMatrix lower;
    std::shared_ptr<const SlicedMatrix> slices;
    std::once_flag once;
  };
  std::shared_ptr<Content> content_;
};

/// A diagonal block of a matrix in slices: the stiffness of one body, whose unknowns follow one another and are coupled to no others.
class BlockOfSlices final : public SlicedMatrix {
 public:
  BlockOfSlices(std::shared_ptr<const SlicedMatrix> whole, Eigen::Index first, Eigen::Index size) : whole_(std::move(whole)), first_(first) {
    diagonal_ = whole_->diagonal().segment(first, size), most_entries_ = whole_->most_entries(), hides_ = whole_->hides();
  }
  Vector times(const Eigen::Ref<const Vector>& x) const override { return own(whole_->times(padded(x))); }
  Vector gross_times(const Vector& x) const override { return own(whole_->gross_times(padded(x))); }
  StoredMatrix near(std::vector<char>& of, int layers) const override {
    std::vector<char> all(static_cast<std::size_t>(whole_->diagonal().size()), 0);
    const auto begin = all.begin() + first_, end = begin + std::ssize(of);
    std::copy(of.begin(), of.end(), begin);
    const StoredMatrix near = whole_->near(all, layers);
    std::copy(begin, end, of.begin());
    StoredMatrix own;
    own = SparseMatrix(near.block(first_, first_, std::ssize(of), std::ssize(of)));
    return own;
  }

  std::shared_ptr<Vectors> vectors(const std::vector<int>&) const override { throw std::logic_error("a block of slices has no vectors"); }
  bool holds(const Vectors&) const override { return false; }
  void add_load(Field&) const override { throw std::logic_error("a block of slices has no vectors"); }
  void take_product(const LongField&, bool, Field&) const override { throw std::logic_error("a block of slices has no vectors"); }

  const SlicedMatrix& whole() const { return *whole_; }
  Eigen::Index first() const { return first_; }  ///< its first unknown among those of the whole

 private:
  Vector own(const Vector& of_all) const { return of_all.segment(first_, diagonal_.size()); }
  Vector padded(const Eigen::Ref<const Vector>& x) const {
    Vector all = Vector::Zero(whole_->diagonal().size());
    all.segment(first_, x.size()) = x;
    return all;
  }

  std::shared_ptr<const SlicedMatrix> whole_;
  Eigen::Index first_;
};

}  // namespace dotyk::algebra

#pragma once

#include <cmath>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra/entries_of.hpp"
#include "algebra/field.hpp"
#include "algebra/symmetric_product.hpp"
#include "base/error.hpp"

namespace dotyk::algebra {

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

}  // namespace dotyk::algebra

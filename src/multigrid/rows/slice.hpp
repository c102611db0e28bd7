// One rank's rows of a matrix that stays as it is. While a solver has the matrix on loan, each function of a slice first restores the slice's numbers, and at
// its end the solver's. So two of these functions must not run at the same time.
#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/vector_parts.hpp"
#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

/// A matrix that a slice shares with a solver. The slice's numbers are remembered where the solver changes them, so that they can be restored.
class LentMatrix {
 public:
  using Number = std::pair<double*, double>;  ///< a place in the matrix, and what is to be there

  explicit LentMatrix(HalfMatrix matrix) : matrix_(std::move(matrix)) {}
  LentMatrix(const LentMatrix&) = delete;
  LentMatrix& operator=(const LentMatrix&) = delete;

  HalfMatrix& now() { return matrix_; }  ///< as the solver has it; its pattern may be widened before the first change()
  /// For the solver. A place may be named twice, with one number.
  void change(std::vector<Number> numbers) {
    std::ranges::sort(numbers, {}, &Number::first);
    numbers.erase(std::ranges::unique(numbers, {}, &Number::first).begin(), numbers.end());
    std::vector<Number> now = numbers, all;
    for (auto& [place, number] : now) number = *place;
    std::ranges::set_union(before_, now, std::back_inserter(all), {}, &Number::first, &Number::first);  // of one place the elder number
    for (const auto& [place, number] : numbers) *place = number;
    std::erase_if(all, [](const Number& n) { return *n.first == n.second; });
    before_.swap(all);
  }
  /// Calls work(matrix) with the slice's numbers in place, and puts the solver's back.
  template <class Work>
  auto as_before(const Work& work) {
    struct Exchange {
      LentMatrix& of;
      explicit Exchange(LentMatrix& lent) : of(lent) { of.exchange(); }
      ~Exchange() { of.exchange(); }
    } const exchange(*this);
    return work(matrix_);
  }
  void give_back() { exchange(), before_.clear(); }

 private:
  void exchange() {
    for (auto& [place, number] : before_) std::swap(*place, number);
  }

  HalfMatrix matrix_;
  std::vector<Number> before_;  ///< the slice's, by place
};

/// A load of own rows; null, on all ranks: there is none.
using OwnLoad = std::shared_ptr<const std::vector<double>>;

/// multiply() and the constructor are collective.
class Slice {
 public:
  /// `idle`: own rows without unknown. Their diagonal becomes the mean of all others. `functions`: for solvers.
  Slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle, AllOwnFunctions functions, OwnLoad load = nullptr);

  HalfRows rows() const {
    return matrix_->as_before([](HalfMatrix& A) { return A.stored(); });
  }
  /// Lends the matrix to a solver, which changes it by change(). When the last pointer is gone, the slice's numbers are restored. Null while another solver has
  /// the matrix. All ranks give the same answer, because solvers are made and dropped in one order.
  std::shared_ptr<LentMatrix> lend() const {
    if (matrix_.use_count() > 1) return nullptr;
    return {matrix_.get(), [lent = matrix_](LentMatrix*) { lent->give_back(); }};
  }
  const AllOwnFunctions& functions() const { return functions_; }
  const OwnLoad& load() const { return load_; }
  std::vector<double> diagonal() const;
  int most_entries() const;  ///< as in algebra::SlicedMatrix
  double entries() const;    ///< of all own rows
  /// Some own rows, counted from the rank's first. Columns: counted over all ranks, idle ones among them.
  Rows some(const std::vector<int>& rows) const {
    return matrix_->as_before([&](HalfMatrix& A) { return A.full(rows); });
  }

  enum class Product : int { plain, gross, taken, taken_precisely, load };
  /// The vectors of a product, of own rows.
  struct Factors {
    int x, x_low, y;
  };
  /// y = A x; y = |A| x; y −= A x; y −= A (x + x_low) in extended precision; y += load().
  void multiply(Product how, algebra::VectorParts& v, const Factors& of);

 private:
  std::shared_ptr<LentMatrix> matrix_;
  AllOwnFunctions functions_;
  OwnLoad load_;
};

}  // namespace dotyk::multigrid

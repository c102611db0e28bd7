#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "algebra/symmetric_matrix.hpp"

namespace dotyk::algebra {

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

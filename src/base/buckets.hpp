#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "base/counted.hpp"

namespace dotyk {

/// Numbers put into buckets 0 … count − 1, those of a bucket in the order in which they came. Throws as counted().
class Buckets {
 public:
  Buckets() : start_(1, 0) {}
  /// `visit(put)` calls put(bucket, number) for every number. It is called twice: to count, then to fill.
  template <class Visit>
  Buckets(int count, const Visit& visit) : start_(count + 1, 0) {
    std::size_t all = 0;
    visit([&](int bucket, int) { ++start_[bucket + 1], ++all; });
    counted(all);
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    numbers_.resize(start_.back());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    visit([&](int bucket, int number) { numbers_[next[bucket]++] = number; });
  }

  /// How many numbers lie in the buckets before this one.
  int before(int bucket) const { return start_[bucket]; }
  int count() const { return static_cast<int>(start_.size()) - 1; }
  std::size_t bytes() const { return sizeof(int) * (start_.size() + numbers_.size()); }
  std::span<const int> operator[](int bucket) const {
    return std::span(numbers_).subspan(start_[bucket], start_[bucket + 1] - start_[bucket]);
  }

 private:
  std::vector<int> start_, numbers_;
};

/// Lists of numbers of one length, one a row, of which few are used at a time.
class SomeRows {
 public:
  SomeRows() = default;
  SomeRows(int rows, int length) : length_(static_cast<std::size_t>(length)), place_(static_cast<std::size_t>(rows), -1) {}

  /// The numbers of a row, zeros where it has not been used. Valid until the next call.
  double* at(int row) {
    if (place_[row] < 0) {
      place_[row] = static_cast<int>(rows_.size());
      rows_.push_back(row);
      numbers_.resize(rows_.size() * length_, 0.0);
    }
    return numbers_.data() + static_cast<std::size_t>(place_[row]) * length_;
  }
  const std::vector<int>& rows() const { return rows_; }  ///< those that are used, in the order in which they came
  const double* numbers(std::size_t k) const { return numbers_.data() + k * length_; }  ///< of rows()[k]
  void clear() {
    for (const int row : rows_) place_[row] = -1;
    rows_.clear(), numbers_.clear();
  }
  double bytes() const { return 4.0 * static_cast<double>(place_.size()); }

 private:
  std::size_t length_ = 0;
  std::vector<int> place_, rows_;  ///< place_: of a row among rows_, or -1
  std::vector<double> numbers_;
};

}  // namespace dotyk

#pragma once

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

}  // namespace dotyk

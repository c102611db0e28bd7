#pragma once

#include <cstddef>
#include <vector>

namespace dotyk {

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

#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace dotyk {

/// Lists of integers and of real numbers: what one process sends to another.
struct Lists {
  std::vector<std::vector<int>> whole;
  std::vector<std::vector<double>> real;
};

/// What one process assembles its rows of a matrix from.
struct Share {
  Lists lists;
  std::vector<int> unknowns;  ///< of the whole matrix, ascending: the unknowns of the matrix that is assembled from the lists
};

/// Numbers that do not change once they are made. Copies share them, and so do moves.
template <class Number>
class SharedList {
 public:
  SharedList(std::vector<Number> numbers = {}) : numbers_(std::make_shared<const std::vector<Number>>(std::move(numbers))) {}  // NOLINT
  SharedList(const SharedList&) = default;
  SharedList& operator=(const SharedList&) = default;
  std::size_t size() const { return numbers_->size(); }
  const Number& operator[](std::size_t k) const { return (*numbers_)[k]; }
  auto begin() const { return numbers_->begin(); }
  auto end() const { return numbers_->end(); }
  operator const std::vector<Number>&() const { return *numbers_; }  // NOLINT
  bool operator==(const SharedList& other) const { return numbers_ == other.numbers_ || *numbers_ == *other.numbers_; }

 private:
  std::shared_ptr<const std::vector<Number>> numbers_;
};

}  // namespace dotyk

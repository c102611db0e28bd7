// Vectors of a number for each unknown, which lie where the matrix does: in this process, or in parts with the processes that have its slices.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra/vector_parts.hpp"

namespace dotyk::algebra {

/// Where vectors lie. They are known by numbers from 1. Of some unknowns the numbers are told and set at little cost. Those that are `watched` are often asked for.
/// Not safe for several threads at once: even functions that only read a vector may make others.
class Vectors {
 public:
  Vectors(int unknowns, std::vector<int> watched) : unknowns_(unknowns), watched_(std::move(watched)) {}
  virtual ~Vectors() = default;
  int unknowns() const { return unknowns_; }                     ///< numbers of a vector
  const std::vector<int>& watched() const { return watched_; }  ///< ascending
  int next() { return ++last_; }                       ///< the number of a new vector, to be made by Op::make
  virtual double run(const VectorOrder& order) = 0;    ///< what the order tells, else 0
  virtual Vector get(int v) = 0;                       ///< all numbers, in the order of the unknowns
  virtual void put(int v, const Vector& numbers) = 0;  ///< likewise
  virtual Vector some(int v, const std::vector<int>& unknowns) = 0;
  virtual void set_some(int v, const std::vector<int>& unknowns, const Vector& numbers) = 0;

 private:
  const int unknowns_;
  const std::vector<int> watched_;
  int last_ = 0;
};

/// Vectors in this process. `watched`: unknowns, ascending.
std::shared_ptr<Vectors> vectors_here(int unknowns, std::vector<int> watched);

/// A vector of a number for each unknown. Copies are vectors of their own. Those that work together lie in one place.
class Field {
 public:
  Field() = default;
  explicit Field(std::shared_ptr<Vectors> where) : where_(std::move(where)) { make(); }  ///< zeros
  Field(const Field& other) : where_(other.where_) {
    if (where_) make(), run(Op::copy, other.number_);
  }
  Field(Field&& other) noexcept { swap(other); }
  Field& operator=(const Field& other) {
    if (where_ && where_ == other.where_) run(Op::copy, other.number_);
    else Field(other).swap(*this);
    return *this;
  }
  Field& operator=(Field&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Field() {
    if (where_) run(Op::drop);
  }
  void swap(Field& other) noexcept { where_.swap(other.where_), std::swap(number_, other.number_); }

  void add(double factor, const Field& what) { where_->run({Op::add, number_, what.number_, 0, 0, factor}); }
  double dot(const Field& other) const { return run(Op::dot, other.number_); }
  double moduli() const { return run(Op::moduli); }      ///< ‖·‖₁; no number where one is none
  double greatest() const { return run(Op::greatest); }  ///< ‖·‖∞; numbers that are none may go unseen, moduli() shows them
  Vector get() const { return where_->get(number_); }
  void put(const Vector& numbers) { where_->put(number_, numbers); }
  Vector some(const std::vector<int>& unknowns) const { return where_->some(number_, unknowns); }
  void set_some(const std::vector<int>& unknowns, const Vector& numbers) { where_->set_some(number_, unknowns, numbers); }
  Vector watched() const { return some(where_->watched()); }
  void set_watched(const Vector& numbers) { set_some(where_->watched(), numbers); }

  const std::shared_ptr<Vectors>& where() const { return where_; }
  int number() const { return number_; }

 private:
  using Op = VectorOrder::Op;
  void make() { number_ = where_->next(), run(Op::make); }
  double run(Op op, int other = 0) const { return where_->run({op, number_, other}); }

  std::shared_ptr<Vectors> where_;
  int number_ = 0;
};

/// A vector in extended precision: the sum of `high`, which is the sum rounded to double, and `low`, what that lacks.
struct LongField {
  LongField() = default;
  explicit LongField(Field numbers) : high(std::move(numbers)), low(high.where()) {}  ///< `low`: zeros

  Field high, low;

  void add(double factor, const Field& by) { high.where()->run({VectorOrder::Op::add_exactly, high.number(), low.number(), by.number(), 0, factor}); }
  /// Becomes other + part (this − other).
  void go_back(const LongField& other, double part) {
    high.where()->run({VectorOrder::Op::blend, high.number(), low.number(), other.high.number(), other.low.number(), part});
  }
};

}  // namespace dotyk::algebra

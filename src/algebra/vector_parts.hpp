// The numbers behind fields: what one process has of some vectors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "algebra/types.hpp"
#include "base/parallel.hpp"

namespace dotyk::algebra {

/// What is done with vectors where they lie; a, b, c, d are their numbers.
struct VectorOrder {
  enum class Op : int {
    make,         ///< a = 0
    drop,         ///< a is no more
    copy,         ///< a = b
    add,          ///< a += factor b
    add_exactly,  ///< a + b += factor c in extended precision, where a is the sum rounded to double, and b what that lacks
    blend,        ///< a + b becomes c + d + factor (a + b − c − d), likewise
    dot,          ///< tells a · b
    moduli,       ///< tells ‖a‖₁
    greatest      ///< tells ‖a‖∞
  };
  Op op;
  int a = 0, b = 0, c = 0, d = 0;
  double factor = 0;
};

/// Vectors of one length, or what one process has of such vectors.
class VectorParts {
 public:
  /// `threads`: works on all cores; otherwise on one.
  VectorParts(std::ptrdiff_t size, bool threads) : size_(size), few_(threads ? 100'000 : std::numeric_limits<int>::max()) {}

  std::vector<double>& operator[](int v) { return vectors_.at(v); }
  /// What the order tells, of this part; else 0.
  double run(const VectorOrder& order) {
    using Op = VectorOrder::Op;
    if (order.op == Op::make) return vectors_[order.a].assign(static_cast<std::size_t>(size_), 0.0), 0.0;
    if (order.op == Op::drop) return vectors_.erase(order.a), 0.0;
    double* const none = nullptr;
    const auto of = [&](int v) { return v > 0 ? vectors_.at(v).data() : none; };
    double *const a = of(order.a), *const b = of(order.b), *const c = of(order.c), *const d = of(order.d);
    const auto part = [](double* v, int first, int end) { return Eigen::Map<Vector>(v + first, end - first); };
    const double factor = order.factor;
    switch (order.op) {
      case Op::make:
      case Op::drop: break;
      case Op::copy: each([&](int first, int end) { part(a, first, end) = part(b, first, end); }); break;
      case Op::add: each([&](int first, int end) { part(a, first, end) += factor * part(b, first, end); }); break;
      case Op::add_exactly:
        each([&](int first, int end) {
          for (int i = first; i < end; ++i) split(sum(a[i], b[i]) + static_cast<long double>(factor) * c[i], a[i], b[i]);
        });
        break;
      case Op::blend:
        each([&](int first, int end) {
          for (int i = first; i < end; ++i) split(sum(c[i], d[i]) + factor * (sum(a[i], b[i]) - sum(c[i], d[i])), a[i], b[i]);
        });
        break;
      case Op::dot: return parallel_sum(size_, few_, [&](int first, int end) { return part(a, first, end).dot(part(b, first, end)); });
      case Op::moduli: return parallel_sum(size_, few_, [&](int first, int end) { return part(a, first, end).template lpNorm<1>(); });
      case Op::greatest: return parallel_sum(size_, few_, [&](int first, int end) { return Greatest{size_ > 0 ? part(a, first, end).template lpNorm<Eigen::Infinity>() : 0}; }).of_all;
    }
    return 0;
  }
  std::vector<double> some(int v, const std::vector<int>& places) const {
    const std::vector<double>& all = vectors_.at(v);
    std::vector<double> numbers;
    for (const int i : places) numbers.push_back(all[i]);
    return numbers;
  }
  void set_some(int v, const std::vector<int>& places, const std::vector<double>& numbers) {
    std::vector<double>& all = vectors_.at(v);
    for (std::size_t k = 0; k < places.size(); ++k) all[places[k]] = numbers[k];
  }

 private:
  struct Greatest {
    double of_all = 0;
    void operator+=(const Greatest& other) { of_all = std::max(of_all, other.of_all); }
  };

  static long double sum(double high, double low) { return static_cast<long double>(high) + low; }
  static void split(long double sum, double& high, double& low) {
    high = static_cast<double>(sum);
    low = static_cast<double>(sum - high);
  }
  /// Calls work(first, end) for ranges.
  template <class Work>
  void each(const Work& work) const {
    parallel_ranges(static_cast<int>(size_), threads_for(size_, few_), [&](int, int first, int end) { work(first, end); });
  }

  std::ptrdiff_t size_;
  std::int64_t few_;  ///< numbers for a thread
  std::map<int, std::vector<double>> vectors_;
};

}  // namespace dotyk::algebra

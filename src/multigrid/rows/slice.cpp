#include "multigrid/rows/slice.hpp"

#include <cmath>
#include <functional>

#include "multigrid/rows/own_rows.hpp"

namespace dotyk::multigrid {

namespace {

HalfRows with_idle(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle) {
  fill_idle(rows, idle, 0);
  double sum = 0;
  for (int row = 0; row < rows.nodes() * rows.block; ++row) sum += rows.diagonal[static_cast<std::size_t>(row) * rows.block + row % rows.block];
  const double count = ranks.sum(static_cast<double>(rows.nodes()) * rows.block - static_cast<double>(idle.size()));
  fill_idle(rows, idle, ranks.sum(sum) / count);
  return rows;
}

/// A x in x's number type; `of` is applied to each entry of A first. `theirs`: x at the nodes that are other ranks'.
/// `rows`: of a node, as a constant for the compiler; 0: A's are used.
template <int rows, class Number, class Of>
std::vector<Number> product_of(const HalfMatrix& A, const std::vector<Number>& x, const std::vector<Number>& theirs, const Of& of) {
  const int n = rows > 0 ? rows : A.block();
  std::vector<Number> y(x.size(), 0);
  for (int node = 0; node < A.nodes(); ++node) {
    const Number* own = x.data() + static_cast<std::size_t>(node) * n;
    Number* to = y.data() + static_cast<std::size_t>(node) * n;
    A.each_own_block(node, [&](int other, const double* block) {
      const bool here = other < A.nodes();
      const Number* from = here ? x.data() + static_cast<std::size_t>(other) * n : theirs.data() + static_cast<std::size_t>(other - A.nodes()) * n;
      Number* across = here && other != node ? y.data() + static_cast<std::size_t>(other) * n : nullptr;
      for (int r = 0; r < n; ++r) {
        Number sum = 0;
        for (int c = 0; c < n; ++c) {
          const double a = of(block[r * n + c]);
          sum += a * from[c];
          if (across) across[c] += a * own[r];
        }
        to[r] += sum;
      }
    });
  }
  return y;
}

template <class Number, class Of>
std::vector<Number> product(const HalfMatrix& A, const std::vector<Number>& x, const std::vector<Number>& theirs, const Of& of) {
  return A.block() == 3 ? product_of<3>(A, x, theirs, of) : product_of<0>(A, x, theirs, of);
}

std::vector<long double> sum(const std::vector<double>& high, const std::vector<double>& low) {
  std::vector<long double> all(high.begin(), high.end());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] += low[i];
  return all;
}

}  // namespace

Slice::Slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle, AllOwnFunctions functions, OwnLoad load)
    : matrix_(std::make_shared<LentMatrix>(HalfMatrix(ranks, with_idle(ranks, std::move(rows), idle)))), functions_(std::move(functions)), load_(std::move(load)) {}

std::vector<double> Slice::diagonal() const {
  return matrix_->as_before([](HalfMatrix& A) {
    std::vector<double> all;
    for (int row = 0; row < A.rows(); ++row) all.push_back(A.diagonal(row));
    return all;
  });
}

int Slice::most_entries() const {
  const HalfMatrix& A = matrix_->now();
  int most = 0;
  for (int node = 0; node < A.nodes(); ++node) {
    int blocks = 0;
    A.each_block(node, [&](int, const double*, HalfMatrix::Read) { ++blocks; });
    most = std::max(most, blocks * A.block());
  }
  return most;
}

double Slice::entries() const {
  const HalfRows& rows = matrix_->now().stored();
  return static_cast<double>(2 * rows.below.size() + rows.diagonal.size() + rows.other.size());
}

void Slice::multiply(Product how, algebra::VectorParts& v, const Factors& of) {
  std::vector<double>& y = v[of.y];
  if (how == Product::load) {
    if (load_) std::ranges::transform(y, *load_, y.begin(), std::plus());
    return;
  }
  const std::vector<double>& x = v[of.x];
  matrix_->as_before([&](HalfMatrix& A) {
    switch (how) {
      case Product::plain: return A.times(x.data(), y.data());
      case Product::gross: y = product(A, x, A.theirs(x.data()), [](double a) { return std::abs(a); }); return;
      case Product::taken: {
        std::vector<double> times(x.size());
        A.times(x.data(), times.data());
        for (std::size_t i = 0; i < y.size(); ++i) y[i] -= times[i];
        return;
      }
      case Product::taken_precisely: {
        const std::vector<double>&low = v[of.x_low], theirs = A.theirs(x.data());
        const auto times = product(A, sum(x, low), sum(theirs, A.theirs(low.data())), [](double a) { return a; });
        for (std::size_t i = 0; i < y.size(); ++i) y[i] = static_cast<double>(y[i] - times[i]);
        return;
      }
      case Product::load: return;
    }
  });
}

}  // namespace dotyk::multigrid

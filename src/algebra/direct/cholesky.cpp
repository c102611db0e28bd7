#include "algebra/direct/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "algebra/dense/dense.hpp"
#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/cholmod_handle.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/memory.hpp"

namespace dotyk::algebra {
namespace {

/// CHOLMOD notes status and memory in its cholmod_common even where it only reads a factor: each thread that sweeps
/// has one of its own.
CholmodCommon& common_of_this_thread() {
  thread_local CholmodCommon common;
  return common;
}

/// Calls visit(column, rows, values, count) for every column of a supernodal factor: its entries from the diagonal down.
template <class Visit>
void each_column(const cholmod_factor& f, const Visit& visit) {
  for (std::size_t s = 0; s < f.nsuper; ++s) {
    const Supernode node(f, s);
    for (int k = 0; k < node.width; ++k)
      visit(node.first + k, node.rows + k, node.values + static_cast<std::ptrdiff_t>(k) * (node.height + 1), node.height - k);
  }
}

}  // namespace

ReachedSweep::ReachedSweep(const cholmod_factor& factor, const SparseRows& rows, const std::vector<int>& also)
    : factor_(factor), rows_(rows), place_(factor.n, -1) {
  std::vector<std::size_t> supernode(factor.n);  // of a position
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const Supernode node(factor, s);
    std::fill_n(supernode.begin() + node.first, node.width, s);
  }
  std::vector<int> position(factor.n);  // of an unknown
  for (std::size_t p = 0; p < factor.n; ++p) position[static_cast<int*>(factor.Perm)[p]] = static_cast<int>(p);
  std::vector<char> reached(factor.nsuper, 0);
  const auto climb = [&](int p) {
    for (std::size_t s = supernode[p]; !reached[s];) {
      reached[s] = 1;
      const Supernode node(factor, s);
      if (node.height > node.width) s = supernode[node.rows[node.width]];
    }
  };
  for (const int p : also) climb(p);
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it) climb(position[it.col()]);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    if (!reached[s]) continue;
    const Supernode node(factor, s);
    supernodes_.push_back(static_cast<int>(s));
    entries_ += static_cast<double>(node.width) * node.height;
    for (int p = node.first; p < node.first + node.width; ++p) {
      place_[p] = static_cast<int>(positions_.size());
      positions_.push_back(p);
    }
  }
}

DenseMatrix ReachedSweep::values() const {
  DenseMatrix Y = DenseMatrix::Zero(static_cast<Eigen::Index>(positions_.size()), rows());
  std::vector<int> place_of_unknown(factor_.n);
  for (std::size_t p = 0; p < factor_.n; ++p) place_of_unknown[static_cast<int*>(factor_.Perm)[p]] = place_[p];
  for (int r = 0; r < rows(); ++r)
    for (SparseRows::InnerIterator it(rows_, r); it; ++it) Y(place_of_unknown[it.col()], r) += it.value();
  for (const int s : supernodes_) {
    ask_to_stop();
    const Supernode node(factor_, s);
    const Eigen::Map<const DenseMatrix, 0, Eigen::OuterStride<>> L(node.values, node.height, node.width, Eigen::OuterStride<>(node.height));
    const auto own = Y.middleRows(place_[node.first], node.width);
    solve_lower(L.topRows(node.width), own);
    const DenseMatrix update = product(L.bottomRows(node.height - node.width), own);
    for (Eigen::Index j = 0; j < update.cols(); ++j)
      for (Eigen::Index i = 0; i < update.rows(); ++i) Y(place_[node.rows[node.width + i]], j) -= update(i, j);
  }
  return Y;
}

struct Cholesky::Implementation {
  CholmodCommon common;
  cholmod_factor* factor = nullptr;  ///< null for a matrix without unknowns, which CHOLMOD does not take
  std::vector<int> boundary;   ///< unknowns of Γ in the factor's order
  std::vector<int> position;   ///< where they stand in the factor's order
  double flops = 0;
  std::string method;
  ~Implementation() { cholmod_free_factor(&factor, common.get()); }

  DenseMatrix sweep(int system, const DenseMatrix& b) const {
    return factor && b.cols() > 0 ? solution(system, factor, b, common_of_this_thread()) : b;
  }
};

SparseMatrix with_block(const SparseMatrix& lower, const std::vector<int>& unknowns, const std::function<double(int, int)>& entry) {
  SparseMatrix block(lower.rows(), lower.cols());
  const int size = static_cast<int>(unknowns.size());
  block.reserve(static_cast<Eigen::Index>(size) * (size + 1) / 2);
  int j = 0;
  for (int column = 0; column < lower.cols(); ++column) {
    block.startVec(column);
    if (j == size || unknowns[j] != column) continue;
    for (int i = j; i < size; ++i) block.insertBack(unknowns[i], column) = entry(i, j);
    ++j;
  }
  block.finalize();
  return lower + block;
}

Cholesky::Cholesky(const SparseMatrix& lower, const std::vector<int>& node, const std::vector<int>& last, Ordering ordering,
                   bool full_boundary)
    : it_(std::make_unique<Implementation>()) {
  Permutation permutation = order(lower, node, last, ordering);
  it_->flops = permutation.flops;
  it_->method = permutation.method;
  if (node.empty()) return;
  std::vector<char> is_last(node.back() + 1, 0);
  for (const int n : last)
    if (n < static_cast<int>(is_last.size())) is_last[n] = 1;
  std::vector<int> gamma;
  for (int k = 0; k < static_cast<int>(node.size()); ++k)
    if (is_last[node[k]]) gamma.push_back(k);

  cholmod_common* c = it_->common.get();
  c->nmethods = 1;
  c->method[0].ordering = CHOLMOD_GIVEN;
  c->postorder = true;
  const SparseMatrix full = full_boundary ? with_block(lower, gamma, [](int, int) { return 1; }) : SparseMatrix();
  cholmod_sparse a = view(full_boundary ? full : lower);
  it_->factor = cholmod_analyze_p(&a, permutation.order.data(), nullptr, 0, c);
  it_->common.check("symbolic factorisation");

  // The postordering moves Γ among the rest, but keeps it closed under "ancestor in the
  // elimination tree", so L[I,Γ] = 0 and L[Γ,Γ] is still the Schur complement's factor.
  const int* perm = static_cast<int*>(it_->factor->Perm);
  for (int k = 0; k < static_cast<int>(node.size()) && !gamma.empty(); ++k)
    if (is_last[node[perm[k]]]) {
      it_->boundary.push_back(perm[k]);
      it_->position.push_back(k);
    }
}

Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

bool Cholesky::factor(const SparseMatrix& lower) {
  if (!it_->factor) return true;
  require_memory(bytes(), text("the factor of ", lower.rows(), " unknowns"));
  const BlasThreads threads(it_->flops);
  cholmod_sparse a = view(lower);
  stoppable([&] { cholmod_factorize(&a, it_->factor, it_->common.get()); });
  if (it_->common.get()->status == CHOLMOD_NOT_POSDEF) return false;
  it_->common.check("factorisation");
  return it_->factor->minor == it_->factor->n;
}

int Cholesky::failed_unknown() const {
  if (!it_->factor || it_->factor->minor >= it_->factor->n) return -1;
  return static_cast<int*>(it_->factor->Perm)[it_->factor->minor];
}

Vector Cholesky::pivots() const {
  if (!it_->factor) return {};
  Vector result(it_->factor->n);
  each_column(*it_->factor, [&](int column, const int*, const double* values, int) {
    result[static_cast<int*>(it_->factor->Perm)[column]] = std::pow(values[0], 2);
  });
  return result;
}

DenseMatrix Cholesky::solve(const DenseMatrix& b) const { return it_->sweep(CHOLMOD_A, b); }
const std::vector<int>& Cholesky::boundary() const { return it_->boundary; }

DenseMatrix Cholesky::boundary_factor() const {
  const int m = static_cast<int>(it_->position.size());
  DenseMatrix l = DenseMatrix::Zero(m, m);
  if (m == 0) return l;
  std::vector<int> rank(it_->factor->n, -1);
  for (int k = 0; k < m; ++k) rank[it_->position[k]] = k;
  each_column(*it_->factor, [&](int column, const int* rows, const double* values, int count) {
    for (int k = 0; rank[column] >= 0 && k < count; ++k)
      if (rank[rows[k]] >= 0) l(rank[rows[k]], rank[column]) = values[k];
  });
  return l;
}

Vector Cholesky::forward(const Vector& b) const { return it_->sweep(CHOLMOD_L, it_->sweep(CHOLMOD_P, b)); }
Vector Cholesky::boundary_part(const Vector& swept) const { return swept(it_->position); }
void Cholesky::set_boundary_part(Vector& swept, const Vector& part) const { swept(it_->position) = part; }
Vector Cholesky::backward(const Vector& swept) const { return it_->sweep(CHOLMOD_Pt, it_->sweep(CHOLMOD_Lt, swept)); }

ReachedSweep Cholesky::sweep(const SparseRows& rows) const { return {*it_->factor, rows, it_->position}; }

DenseMatrix Cholesky::boundary_part(const ReachedSweep& sweep, const DenseMatrix& values) const {
  std::vector<int> places;
  auto place = sweep.positions().begin();
  for (const int position : it_->position) {
    place = std::lower_bound(place, sweep.positions().end(), position);
    places.push_back(static_cast<int>(place - sweep.positions().begin()));
  }
  return values(places, Eigen::all);
}

double Cholesky::flops() const { return it_->flops; }
double Cholesky::bytes() const { return it_->factor ? 8.0 * it_->factor->xsize : 0; }
const std::string& Cholesky::method() const { return it_->method; }

}  // namespace dotyk::algebra

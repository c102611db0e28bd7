#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "algebra/types.hpp"
#include "base/buckets.hpp"
#include "base/parallel.hpp"
#include "base/lists.hpp"

namespace dotyk::algebra {

/// P: what displacements of a coarser mesh are on the mesh that refines it. A component of a node is the mean of that component of a few coarse nodes.
/// Prescribed components have neither row nor column.
struct CoarseFunctions {
  int dimension = 1;                             ///< components of a node
  std::shared_ptr<const Buckets> means;          ///< node → coarse nodes; null: each node is a coarse one
  SharedList<int> row;                           ///< node × dimension + component → row of P, or −1; they ascend
  SharedList<int> column;                        ///< the same of coarse nodes and columns
  int rows = 0, columns = 0;                     ///< of P; columns may be empty

  int nodes() const { return static_cast<int>(row.size()) / dimension; }
  int coarse_nodes() const { return static_cast<int>(column.size()) / dimension; }
  /// Of a node. It must outlive the span.
  std::span<const int> of(const int& node) const { return means ? (*means)[node] : std::span(&node, 1); }
  /// Calls visit(column, number) for the row of a node's component.
  template <class Visit>
  void each_in_row(int node, int component, const Visit& visit) const {
    const auto coarse = of(node);
    for (const int p : coarse)
      if (const int c = column[dimension * p + component]; c >= 0) visit(c, 1.0 / static_cast<double>(coarse.size()));
  }
  /// The coarse node that a node is, or −1.
  int same(int node) const {
    const auto coarse = of(node);
    return coarse.size() == 1 ? coarse[0] : -1;
  }

  /// Calls visit(row, component) for the rows of a node.
  template <class Visit>
  void each_row_of(int node, const Visit& visit) const {
    for (int k = 0; k < dimension; ++k)
      if (const int r = row[dimension * node + k]; r >= 0) visit(r, k);
  }
  /// Several threads call visit(row, node, component), once for each row of P.
  template <class Visit>
  void each_row(const Visit& visit) const {
    constexpr int kFew = 50'000;
    parallel_ranges(nodes(), threads_for(nodes(), kFew), [&](int, int first, int end) {
      for (int i = first; i < end; ++i) each_row_of(i, [&](int r, int k) { visit(r, i, k); });
    });
  }

  /// P x.
  Vector times(const Eigen::Ref<const Vector>& x) const {
    Vector product = Vector::Zero(rows);
    each_row([&](int r, int node, int k) { each_in_row(node, k, [&](int c, double number) { product[r] += number * x[c]; }); });
    return product;
  }
  /// Pᵀ x.
  Vector transposed_times(const Eigen::Ref<const Vector>& x) const {
    Vector product = Vector::Zero(columns);
    for (int i = 0; i < nodes(); ++i)
      each_row_of(i, [&](int r, int k) { each_in_row(i, k, [&](int c, double number) { product[c] += number * x[r]; }); });
    return product;
  }
  /// Of values in rows (one each) those of components that coarse nodes have, by columns; 0 in empty columns.
  DenseMatrix at_coarse(const DenseMatrix& values) const {
    DenseMatrix out = DenseMatrix::Zero(columns, values.cols());
    if (values.cols() == 0) return out;
    each_row([&](int r, int node, int k) {
      if (const int p = same(node); p >= 0 && column[dimension * p + k] >= 0) out.row(column[dimension * p + k]) = values.row(r);
    });
    return out;
  }

  /// P as a matrix.
  void to_matrix(SparseRows& P) const {
    P.resize(rows, columns);
    int* starts = P.outerIndexPtr();
    each_row([&](int r, int node, int k) { each_in_row(node, k, [&](int, double) { ++starts[r + 1]; }); });
    std::partial_sum(starts, starts + rows + 1, starts);
    P.resizeNonZeros(starts[rows]);
    each_row([&](int r, int node, int k) {
      int* const begin = P.innerIndexPtr() + starts[r];
      int* end = begin;
      each_in_row(node, k, [&](int c, double number) { *end = c, P.valuePtr()[end++ - P.innerIndexPtr()] = number; });
      std::sort(begin, end);  // all numbers are the same
    });
  }

  /// Without empty columns: those that are left are numbered anew.
  CoarseFunctions compact() const {
    CoarseFunctions out = *this;
    std::vector<int> number;
    out.columns = 0;
    for (const int c : column) number.push_back(c < 0 ? -1 : out.columns++);
    out.column = std::move(number);
    return out;
  }
};

/// Cells of some bodies that one process refines and assembles.
class Refinable {
 public:
  virtual ~Refinable() = default;
  /// Refines all cells once. Returns, for each node of the refined cells, the nodes of the cells before whose mean it is.
  virtual Buckets refine() = 0;
  /// Keeps the cells that have a flagged node, and `layers` − 1 more layers of their neighbours. Returns, for each node left, its number before; ascending.
  virtual std::vector<int> keep(const std::vector<char>& flagged, int layers) = 0;
  struct Assembled {
    StoredMatrix lower;        ///< triangle of the stiffness
    std::vector<double> load;  ///< of forces per volume; empty: there are none
  };
  /// Assembles these cells. The unknowns are node × dimension without the components flagged in `fixed`. The cells are gone afterwards.
  virtual Assembled assemble(const std::vector<char>& fixed) = 0;
};

}  // namespace dotyk::algebra

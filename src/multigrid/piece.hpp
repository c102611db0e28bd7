// What one process works on.
#pragma once

#include <vector>

#include "multigrid/numbering.hpp"
#include "multigrid/ranks.hpp"

namespace dotyk::multigrid {

/// Rows of a sparse matrix, columns ascending in each.
struct Rows {
  std::vector<int> starts{0}, columns;
  std::vector<double> values;
};

/// The rows of one rank, by the numbers of Numbering.
struct Piece {
  int block = 1, dimension = 3;  ///< unknowns of a node: on the finest level, on coarser meshes
  int motions = 0;               ///< columns of `modes`
  std::vector<int> own;          ///< how many rows of each level are this rank's
  Rows matrix;                   ///< the full one, which the lower triangle stands for; idle rows have the mean of its diagonal
  std::vector<Rows> functions;   ///< of each coarser mesh
  Rows coarser;                  ///< the matrix of the next coarser mesh, as `matrix`, idle where functions are empty. No rows where it is not known
  Rows displaced;                ///< as in Matrix, full, where there are no coarser meshes; idle rows as in `matrix`
  Rows unknowns;                 ///< as in Matrix; idle rows as in the identity. No rows where it has none
  std::vector<double> modes;     ///< near kernel, by columns: on the finest level, or the coarsest mesh
};

/// The entries of a lower triangle that one rank's rows of the full matrix are made from, by the numbers of Numbering.
struct Triangle {
  int first = 0, count = 0;                   ///< those rows
  std::vector<int> columns, starts{0}, rows;  ///< of entries; columns one after the other
  std::vector<double> values;
  std::vector<int> idle;                      ///< rows without unknown
  double mean = 0;                            ///< their diagonal
};

/// A piece on its way: half the entries are sent, and none of the rows takes memory of the sender.
struct Parcel {
  Piece piece;  ///< without matrices
  Triangle matrix, coarser, displaced;
};

/// Shares a matrix out. The matrix and the numbering must outlive this object.
class Pieces {
 public:
  /// Throws std::runtime_error where no pieces can be made: a diagonal that is not positive, more entries than an int counts.
  Pieces(const Matrix& matrix, const Numbering& numbering);
  Piece of(int rank) const;
  Parcel parcel(int rank) const;

 private:
  /// A lower triangle of one level.
  struct Source {
    const algebra::SparseMatrix* lower = nullptr;
    int level = 0;
    std::vector<int> slot, idle;  ///< number of each row of the triangle; numbers of the rows without unknown
    double mean = 0;              ///< of the diagonal
  };
  static Source source(const algebra::SparseMatrix& lower, int level, std::vector<int> slot, std::vector<int> idle);
  Source coarser() const;
  Rows rows_of(int rank, const Source& source) const;
  Triangle triangle_of(int rank, const Source& source) const;
  Piece without_matrices(int rank) const;

  const Matrix& matrix_;
  const Numbering& numbering_;
  Source finest_, coarser_, displaced_;  // the third where aggregates are made of it
};
void send(const Ranks& ranks, int to, Parcel& parcel);
Piece receive_piece(const Ranks& ranks, int from);

/// How a matrix differs from the one before, as far as one rank's rows of the finest level are concerned.
struct Change {
  std::vector<int> rows, columns;  ///< of entries with other numbers, by the numbers of Numbering
  std::vector<double> values;      ///< of these entries
  std::vector<int> empty;          ///< rows, counted from the rank's first, where all coarse functions vanish
  std::vector<int> shared;         ///< rows, counted likewise, at which the smoother solves exactly
};

void send(const Ranks& ranks, int to, Change& change);
Change receive_change(const Ranks& ranks, int from);

}  // namespace dotyk::multigrid

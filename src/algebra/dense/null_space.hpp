#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// Columns of a matrix that rows join, directly or through others, and the rows that act on them; both ascending.
struct Piece {
  std::vector<int> columns, rows;
};
/// The pieces of A by its graph, in the order of their first columns; a column of zeros is one of its own.
std::vector<Piece> pieces(const SparseMatrix& A);
/// A's entries in the piece.
DenseMatrix dense(const SparseMatrix& A, const Piece& piece);

/// A basis of all x, split in two: A x ≠ 0 on every combination of `seen`, and A x = 0 on `unseen`.
struct RangeAndNull {
  SparseMatrix seen;    ///< columns of A × rank
  SparseMatrix unseen;  ///< columns of A × the rest, orthonormal
};

/// `tolerance` is relative to the greatest norm of a column, or to 1 where that is less. A is taken to pieces. In one of up to some dozens of
/// columns singular values decide, and both bases together are orthonormal; in a larger one a sparse QR factorisation that sets aside columns
/// nearly in the span of those before (SuiteSparseQR; T. A. Davis 2011, after M. T. Heath 1982): `seen`
/// are then the unit vectors of the columns that are left. Asks, between pieces, whether to stop (see ask_to_stop()).
RangeAndNull range_and_null(const SparseMatrix& A, double tolerance);

/// Their number in `seen` alone.
int rank(const SparseMatrix& A, double tolerance);

/// An orthonormal basis of the span of linearly independent columns, as sparse as its pieces allow.
SparseMatrix orthonormal(const SparseMatrix& columns);

}  // namespace dotyk::algebra

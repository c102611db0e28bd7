// What one process works on.
#pragma once

#include <memory>
#include <vector>

#include "multigrid/processes/ranks.hpp"
#include "multigrid/rows/own_functions.hpp"
#include "multigrid/rows/rows.hpp"
#include "multigrid/rows/slice.hpp"
#include "multigrid/shares/numbering.hpp"

namespace dotyk::multigrid {

/// How a matrix differs from the one before, as far as one rank's rows of the finest level are concerned.
struct Change {
  std::vector<int> rows, columns;  ///< of entries with other numbers, by the numbers of Numbering
  std::vector<double> values;      ///< of these entries
  std::vector<int> empty;          ///< rows, counted from the rank's first, where all coarse functions vanish
  std::vector<int> shared;         ///< rows, counted likewise, at which the smoother solves exactly
};

/// What one rank is given. Rows and columns are numbered as in Numbering.
struct Piece {
  int block = 1, dimension = 3;  ///< unknowns of a node: on the finest level, on coarser meshes
  int motions = 0;               ///< columns of `modes`
  int coarser = 0;               ///< the number of the slices that the matrix of the next coarser mesh becomes; 0: nobody asks for it
  int shared_levels = 0;         ///< how many levels ranks share, the finest one here being the last of them; 0: this is no rest of a hierarchy. It is not sent
  std::vector<int> own;          ///< how many rows of each level are this rank's
  HalfRows matrix;               ///< idle rows have the mean of its diagonal
  int slices = 0;                ///< the number of the slices that have the matrix; 0: it is given
  std::shared_ptr<LentMatrix> lent = nullptr;  ///< the slice's, in place of `matrix`; it is not sent
  Change beside;                 ///< entries in which the matrix differs from the slice's, whose pattern may lack them
  Change first;                  ///< with which the matrix is positive definite
  AllOwnFunctions functions;     ///< of each coarser mesh; the slices', where they have the matrix: these are not sent
  OwnLoad load = nullptr;        ///< the slice's; it is not sent
  HalfRows displaced;            ///< as in Matrix, where there are no coarser meshes; idle rows as in `matrix`
  Rows unknowns;                 ///< as in Matrix; idle rows as in the identity. No rows where it has none
  std::vector<double> modes;     ///< near kernel, by columns: on the finest level, or the coarsest mesh
};

/// Do aggregates follow the coarsest mesh? Otherwise it is solved by a factor. Aggregates converge more slowly than meshes. A factor of n unknowns takes some
/// 8 n² operations in space. With Coulomb friction on 76³ cells, whose coarsest mesh has 19³, a factor needs 30 iterations and aggregates 37.
bool aggregates_follow(double coarsest_unknowns, double finest_unknowns);

/// Shares a matrix out. The matrix and the numbering must outlive this object.
class Pieces {
 public:
  /// Throws std::runtime_error where no pieces can be made: a diagonal that is not positive, a matrix that is no lower triangle.
  Pieces(const Matrix& matrix, const Numbering& numbering, int ranks);
  Piece of(int rank);  ///< once for each rank, from several threads

 private:
  /// A lower triangle of the finest level.
  struct Source {
    const algebra::SparseMatrix* lower = nullptr;
    double mean = 0;              ///< of the diagonal
  };
  Source source(const algebra::SparseMatrix& lower) const;
  HalfRows rows_of(int rank, const Source& source) const;

  const Matrix& matrix_;
  const Numbering& numbering_;
  std::vector<Change> beside_, first_;   // of each rank
  Source finest_, displaced_;            // the second where aggregates are made of it
  algebra::DenseMatrix near_kernel_;     // no columns where there are no aggregates
};
void send(const Ranks& ranks, int to, Piece& piece);
Piece receive_piece(const Ranks& ranks, int from);
/// Takes the slice's functions, and its matrix, on loan if no other solver has it.
void take_matrix(Piece& piece, const Slice& slice);

void send(const Ranks& ranks, int to, Change& change);
Change receive_change(const Ranks& ranks, int from);

}  // namespace dotyk::multigrid

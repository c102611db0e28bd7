// Matrices and interpolations of all levels.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "multigrid/embedding.hpp"
#include "multigrid/galerkin.hpp"
#include "multigrid/multigrid.hpp"
#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

class Hierarchy {
 public:
  explicit Hierarchy(const Matrix& matrix);

  /// New numbers, and the coarse matrices for them. False where they are seen not to be positive definite.
  bool set(const algebra::SparseMatrix& lower, const std::vector<char>& held);

  int levels() const { return static_cast<int>(matrices_.size()); }
  Mat matrix(int level) const { return matrices_[level]; }                ///< from 0, the finest
  Mat interpolation(int level) const { return interpolations_[level]; }   ///< from `level` + 1 to `level`
  const Embedding& embedding() const { return embedding_; }
  /// Slots, ascending, that are not held and are coupled strongly by a row that has become an unknown: of a jump between two bodies, one much stiffer than
  /// the other, or of a mean of many displacements. The slot of the row is among them.
  std::vector<PetscInt> shared() const;
  double bytes() const;

 private:
  void coarsen(const Matrix& matrix);
  /// Levels of coarser meshes. S: the unknowns, of displacements, all slots; null where they are the same.
  void take_functions(const Matrix& matrix, Mat S);
  /// Levels of aggregates below `finest`, which has the modes in the given slots.
  void take_aggregates(Mat finest, const algebra::DenseMatrix& modes, const std::vector<int>& slots);
  /// Interpolations from coarse displacements to the unknowns, and coarse matrices of these.
  void take_unknowns(Mat S);
  /// The numbers of coarse matrices, as far as they depend on the changed rows of the finest.
  void fill_coarse(std::vector<char> changed);
  void find_shared(const Matrix& matrix);
  void truncate(const std::vector<char>& held, std::vector<char>& changed);

  Embedding embedding_;
  std::vector<OwnedMat> matrices_, interpolations_;
  std::vector<Galerkin> products_;            // of each interpolation
  std::vector<char> empty_;                   // rows of the finest interpolation that are empty now
  std::map<int, std::vector<double>> emptied_;  // the numbers that they had
  std::set<int> shared_;                      // slots that shared() picks from
  bool fresh_ = true;                         // no coarse matrix is ours yet
};

}  // namespace dotyk::multigrid

#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dotyk::algebra {

using Vector = Eigen::VectorXd;
using DenseMatrix = Eigen::MatrixXd;

/// Column-major sparse matrix. A symmetric one is stored as its lower triangle
/// wherever a function says "lower".
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Row-major sparse matrix: interface rows (B).
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

}  // namespace dotyk::algebra

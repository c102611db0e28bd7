#pragma once

#include <memory>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A split preconditioner M = C Cᵀ of a sparse symmetric positive definite K (n × n), and the system it turns
/// K x = b into:
///   Â x̂ = b̂,   Â = C⁻¹ K C⁻ᵀ,   x̂ = Cᵀ x,   b̂ = C⁻¹ b,   r̂ = C⁻¹ r.
/// Conjugate gradients on Â have the iterates of those on K preconditioned by M, and their Lanczos vectors are those
/// of Â. All functions take blocks of columns.
class Preconditioner {
 public:
  /// `lower`: K's lower triangle; it is not copied and must live as long. Throws InputError where a diagonal entry is
  /// missing or not positive: K is then not positive definite.
  explicit Preconditioner(const SparseMatrix& lower);
  virtual ~Preconditioner() = default;
  Preconditioner(const Preconditioner&) = delete;
  Preconditioner& operator=(const Preconditioner&) = delete;

  Eigen::Index size() const { return K_.rows(); }
  /// K v.
  DenseMatrix times(const Eigen::Ref<const DenseMatrix>& v) const;
  /// Â v.
  virtual DenseMatrix apply(const Eigen::Ref<const DenseMatrix>& v) const { return forward(times(backward(v))); }
  /// C⁻¹ b: to the right-hand side and the residual of the system with Â.
  virtual DenseMatrix forward(const Eigen::Ref<const DenseMatrix>& b) const = 0;
  /// C⁻ᵀ x̂: back to x.
  virtual DenseMatrix backward(const Eigen::Ref<const DenseMatrix>& x) const = 0;
  /// C r̂: back to the residual of K x = b.
  virtual DenseMatrix lift(const Eigen::Ref<const DenseMatrix>& r) const = 0;
  /// Memory beside K.
  virtual double bytes() const = 0;

 protected:
  const SparseMatrix& K_;
};

/// C = I.
class NoPreconditioner final : public Preconditioner {
 public:
  using Preconditioner::Preconditioner;
  DenseMatrix forward(const Eigen::Ref<const DenseMatrix>& b) const override { return b; }
  DenseMatrix backward(const Eigen::Ref<const DenseMatrix>& x) const override { return x; }
  DenseMatrix lift(const Eigen::Ref<const DenseMatrix>& r) const override { return r; }
  double bytes() const override { return 0; }
};

/// C = (diag(d) + L) diag(r)⁻¹, L strictly lower triangular.
class Triangular : public Preconditioner {
 public:
  using Preconditioner::Preconditioner;
  DenseMatrix forward(const Eigen::Ref<const DenseMatrix>& b) const override;
  DenseMatrix backward(const Eigen::Ref<const DenseMatrix>& x) const override;
  DenseMatrix lift(const Eigen::Ref<const DenseMatrix>& r) const override;

 protected:
  /// A lower triangle that has L below its diagonal, which does not count.
  virtual const SparseMatrix& below() const = 0;
  Vector d_, root_;  ///< d and r; r is 1 where it is empty
};

/// Symmetric successive over-relaxation, 0 < ω < 2: with K = L + D + Lᵀ and E = D/ω + L,
///   C = E (D/ω)^{-1/2},   M = E (D/ω)⁻¹ Eᵀ
/// (up to a factor, which changes nothing). Â v costs one forward and one backward sweep and no product with K
/// (Eisenstat 1981): K = E + Eᵀ − (2/ω − 1) D, so that
///   E⁻¹ K E⁻ᵀ w = t + E⁻¹ (w − (2/ω − 1) D t),   t = E⁻ᵀ w.
/// Of its own it keeps two numbers an unknown.
class Ssor final : public Triangular {
 public:
  explicit Ssor(const SparseMatrix& lower, double omega = 1);
  DenseMatrix apply(const Eigen::Ref<const DenseMatrix>& v) const override;
  double bytes() const override { return 16.0 * static_cast<double>(size()); }

 private:
  const SparseMatrix& below() const override { return K_; }
  double omega_;
};

/// Incomplete Cholesky factorisation on K's pattern, IC(0): C = L lower triangular with (L Lᵀ)_ij = K_ij wherever
/// K_ij is stored. It may not exist (a pivot may turn out to be less than 1e-8 of K's diagonal entry); then
/// K + σ diag(K) is factored, σ = 1e-3, doubled until it exists (Manteuffel 1980). As much memory as K.
class IncompleteCholesky final : public Triangular {
 public:
  explicit IncompleteCholesky(const SparseMatrix& lower);
  double bytes() const override;
  double shift() const { return shift_; }          ///< σ, 0 where none was needed
  const SparseMatrix& factor() const { return l_; }

 private:
  const SparseMatrix& below() const override { return l_; }
  SparseMatrix l_;
  double shift_ = 0;
};

enum class Preconditioning { none, ssor, incomplete_cholesky };

/// `omega` is SSOR's.
std::unique_ptr<Preconditioner> make_preconditioner(Preconditioning kind, const SparseMatrix& lower, double omega = 1);

}  // namespace dotyk::algebra

#pragma once

#include "algebra/dense/decompositions.hpp"
#include "program/kkt.hpp"

namespace dotyk::program {

/// KKT systems [P A_Wᵀ; A_W 0] (p, y) = (f, h) of a working set W that changes row by row. One regularised
/// factor serves many working sets: rows that came or went since border it, and the small Schur
/// complement of the border is solved densely (Gill, Murray, Saunders and Wright 1990).
class WorkingKkt {
 public:
  explicit WorkingKkt(const QuadraticProgram& program);

  struct Solution {
    Vector p, y;      ///< n; m, zero outside W
    bool consistent;  ///< the system, singular or not, is solved
    bool singular;    ///< the KKT matrix has an eigenvalue of 1e-9 or less
  };

  /// m flags; factored anew at the next solve.
  void set(const std::vector<char>& taken) { taken_ = taken, stale_ = true; }
  void change(int row, bool in);

  /// Corrects multipliers: [P A_Wᵀ; A_W 0] (p, y) = (f, h), y as near to `y0` (m) as the rows allow; f: n,
  /// h: m (entries outside W are ignored). Where the system is inconsistent, p is the solution of the
  /// regularised one: large, and nearly in the kernel of P and A_W (algorithm 3.1 of Netuka, step 2).
  Solution solve(const Vector& f, const Vector& h, const Vector& y0);
  /// The point nearest to x0 that satisfies the rows of W as well as they can be: x0 + result.
  Vector restore(const Vector& h);

  int factorisations() const { return factorisations_; }

 private:
  struct Border {
    int row;
    bool in;
    Vector column;  ///< factor⁻¹ border
    /// The border's row times z (n + m).
    double times(const QuadraticProgram& p, const Vector& z) const {
      return in ? p.A.row(row).dot(z.head(p.unknowns())) : z[p.unknowns() + row];
    }
  };
  void factor(double least);
  void form_schur();
  Vector regularised(const Vector& b) const;
  Vector rhs(const Vector& f, const Vector& h) const;
  bool probe() const;

  const QuadraticProgram& p_;
  int n_, m_;
  Kkt kkt_;
  std::vector<char> taken_;
  std::vector<Border> border_;  ///< rows that came or went since the matrix was factored
  algebra::Lu schur_;
  bool stale_ = true;
  double delta_ = 0, least_ = 0;  ///< regularisation of the factor, and where to begin the next time
  int factorisations_ = 0;
  Vector random_;
};

}  // namespace dotyk::program

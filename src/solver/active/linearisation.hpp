#pragma once

#include <vector>

#include "problem/measure.hpp"

namespace dotyk::solver {

/// The laws linearised at y = λ + ρx, row by row:
///   λ = P(y) + D (λ' + ρ x' − y)   for the new λ', x'.
/// Rows with D = 0 have λ' = P(y); rows with D = 1 have x' = (y − P(y))/ρ.
struct Linearisation {
  /// A friction point that slips along e = y/‖y‖ under the bound b:
  ///   λ = P(y) + e b' (λ_n' − λ_n) + k (x' − e eᵀx'),   k = ρb/(‖y‖ − b),
  /// since its derivative acts across e alone.
  struct Slip {
    int row, components, normal;  ///< normal: -1 where the bound is given
    Eigen::VectorXd along;        ///< e
    double by_normal, pressed;    ///< b', and the λ_n of P(y)
    double across;                ///< k

    /// The force less P(y), for the slip x' and a normal multiplier that exceeds the one of P(y) by `pressed_more`.
    algebra::Vector beyond(const algebra::Vector& slip, double pressed_more) const;
    /// Adds the lower triangle of k (1 − e eᵀ) at the unknowns that the point's rows hold.
    void add_stiffness(const std::vector<int>& unknown_of_row, algebra::Triplets& entries) const;
  };
  explicit Linearisation(int rows = 0)
      : y(algebra::Vector::Zero(rows)), value(y), slope(y), active(rows, 0), slipping(rows, 0) {}

  algebra::Vector y, value, slope;
  std::vector<char> active;  ///< D > 0; of friction points: do they stick?
  std::vector<char> slipping;
  std::vector<Slip> slips;
  double off = 1;  ///< how far (λ, x) is off its laws, of its forces; 1 where that says nothing

  void set(int row, double at, problem::Projection p) { y[row] = at, value[row] = p.lambda, slope[row] = p.slope, active[row] = p.slope > 0; }
  /// (1 − D)/(Dρ), the compliance that an active row's law adds; 0 for D = 1.
  double added_compliance(int row, double rho) const {
    return (1 - slope[row]) / (slope[row] * rho);
  }
  /// (D y − P)/(Dρ): an active row's law is x' = added_compliance λ' + offset.
  double offset(int row, double rho) const {
    return (slope[row] * y[row] - value[row]) / (slope[row] * rho);
  }
  /// Is the row on the same piece of its law? Pieces have different slopes, or where that is 0 different values.
  bool same_piece(const Linearisation& other, int row) const;
  /// The rows that are not.
  std::vector<int> changed(const Linearisation& other) const;
  /// A hash of all rows' pieces.
  std::size_t fingerprint() const;
  int active_count() const;
};

/// Linearises at (λ, x). With `previous`, (λ, x) solves it: of a unilateral row one of λ and x is zero but
/// for rounding, which ρ must not blow up, so the other one alone decides. A row at a kink of its law, up to `rounding`, keeps its
/// branch, for touching without force it would flip.
Linearisation linearise(const problem::Problem& problem, const algebra::Vector& lambda, const algebra::Vector& x, const algebra::Vector& rho,
                        const Linearisation* previous = nullptr, const problem::Nothing& rounding = {});

/// Has the row a branch that bears nothing, which a flag of a start can name: is it unilateral, or one-sided with springs or a
/// greatest force?
bool may_open(const problem::Law& law, int row);

/// The rows that an iteration begins with as active: those flagged or, where there are no flags, those that touch at rest up to 1e-12 of the
/// greatest gap; besides all that cannot open, and the friction of active normal rows.
std::vector<char> first_active(const problem::Problem& problem, const std::vector<char>& flags);

/// The linearisation whose rows that may open are active as flagged (others: at y = 0).
Linearisation from_flags(const problem::Problem& problem, const std::vector<char>& active,
                         const algebra::Vector& rho);

}  // namespace dotyk::solver

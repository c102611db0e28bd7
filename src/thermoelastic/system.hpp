#pragma once

#include <optional>

#include "algebra/direct/indefinite.hpp"
#include "thermoelastic/model.hpp"

namespace dotyk::thermoelastic {

/// Do the laws of this part's supports have reactions that statics alone gives? Then its stress does not depend on its
/// temperature, and the heat equation can be solved without the displacement: the decomposition of P4. So it is in the six
/// exceptional cases (simply supported, cantilever, simply supported and guided, rigid or elastic), and wherever a
/// condition of solvability forces one of them (theorems 2 to 5): with as many laws as motions that these notice.
bool determinate(const Part& part);

/// What statics gives for the loads.
struct Static {
  algebra::Vector reactions;  ///< of Part::held, on w
  algebra::Vector w;          ///< displacements that the laws answer with these
  OnCells stress;
};
/// Nothing where a law does not give its reaction at one displacement alone: at a limit, or where there is no solution.
std::optional<Static> by_statics(const Part& part, const Forces& forces);

/// The displacement of these strains with the laws' displacements w, and no part in motions that no law notices.
algebra::Vector displacement(const Part& part, const OnCells& strain, const algebra::Vector& w);

/// u less its part in the motions that no law of the part notices.
void remove_unnoticed(const Part& part, Eigen::Ref<algebra::Vector> u);

/// A symmetric quasidefinite system A x = b with the unknowns off Γ eliminated, once for many b:
///   S = A_ΓΓ − A_ΓI A_II⁻¹ A_IΓ,   S x_Γ = g,   x_I = A_II⁻¹ b_I + W x_Γ,   W = −A_II⁻¹ A_IΓ,   g = b_Γ + Wᵀ b_I.
class Condensation {
 public:
  /// `lower`: A's lower triangle; A_II must be regular.
  Condensation(const algebra::SparseMatrix& lower, std::vector<int> gamma);
  const std::vector<int>& gamma() const { return gamma_; }
  const algebra::DenseMatrix& schur() const { return S_; }
  algebra::Vector condensed(const algebra::Vector& b) const;
  algebra::Vector recovered(const algebra::Vector& b, const algebra::Vector& on_gamma) const;

 private:
  std::vector<int> gamma_, inner_;
  std::optional<algebra::QuasiDefinite> factor_;  ///< of A_II
  algebra::DenseMatrix W_, S_;
};

/// Displacements, temperatures and reactions of a model at a time.
struct Fields {
  algebra::Vector u, theta;
  std::vector<algebra::Vector> reactions;  ///< part by part as Part::held, on w
};

/// The linear systems of steps of one length. An implicit stage asks for (C + τL) ϑ − Gᵀu = b together with K u + Gϑ = f +
/// reactions and the laws: symmetric and quasidefinite,
///   [K  G; Gᵀ  −(C + τL)] [u; ϑ] = [f + reactions; −b],
/// and condensed to the supports' unknowns a problem of the same kind as the beam's without heat. The displacement of a part
/// that is decomposed is left out: with its stress S from statics, ε(u) = Π(S/C) + βΠϑ (Π onto the strains), so that
/// (C + β²·modulus·Π + τL) ϑ = b − β∫Sη: the same ϑ to rounding, then u by integration.
class System {
 public:
  /// `decomposed`: of each part.
  System(const Model& model, std::vector<char> decomposed, double tau);
  double tau() const { return tau_; }

  /// b: C ϑ − Gᵀu of the last stages and τr. `displaced`: is u of decomposed parts asked for? Nothing where statics does not do
  /// (by_statics); throws as Interface::solve().
  std::optional<Fields> solve(const Forces& forces, const algebra::Vector& b, double t, bool displaced,
                              const solver::Method& method, Work& work, Monitor& monitor);

 private:
  void number();
  algebra::SparseMatrix matrix() const;
  bool update_statics(const Forces& forces);
  void add_decomposed(Fields& fields) const;

  const Model& model_;
  std::vector<char> decomposed_;
  double tau_;
  std::vector<int> coupled_;  ///< parts that are not decomposed
  std::vector<int> place_;    ///< of every u among the system's unknowns; −1: left out
  int heat_ = 0;              ///< of the first ϑ
  std::vector<int> gamma_;    ///< all u at supports and ends of coupled parts
  std::optional<Condensation> condensation_;
  std::optional<Interface> interface_;
  algebra::Vector f_;            ///< that, with driven_, the following belong to
  SupportsDriven driven_;
  std::vector<Static> statics_;  ///< of decomposed parts
  algebra::Vector heating_;      ///< −β∫Sη, on all ϑ
};

/// The displacement under the temperatures theta, without any step: K u = f − Gϑ + reactions.
Fields at_rest(const Model& model, const Forces& forces, algebra::Vector theta, double t, const solver::Method& method,
               Work& work, Monitor& monitor);

}  // namespace dotyk::thermoelastic

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problem/law.hpp"

namespace dotyk::problem {

/// What a support does about one displacement v (of a beam's end, its rotation, a node along a direction), with its
/// reaction r on the body (P4, figures 1 to 17). "One-sided" supports push towards v > 0 alone: r ≥ 0.
/// Of a part of a solid's boundary v and r are those of its points, r, stiffness, bound and limit per length or area.
struct SupportLaw {
  enum class Kind {
    free,                ///< r = 0
    prescribed,          ///< v = value
    load,                ///< r = value
    elastic,             ///< r = −value v
    one_sided_elastic,   ///< r = value v⁻
    signorini,           ///< v ≥ 0, r ≥ 0, rv = 0
    friction,            ///< rigid friction: |r| ≤ value; where v ≠ 0 it is value, against v
    one_sided_friction,  ///< the same for v < 0, nothing for v > 0: 0 ≤ r ≤ value
    capped_elastic,      ///< r = −value v, cut off at ±limit
    unequal_elastic,     ///< r = −value v for v < 0, r = −pull v for v > 0
    compliance,          ///< r = value (v⁻)^power: asperities that are pressed flat
    coulomb,             ///< tangential, of parts only: |r| ≤ value r_normal⁺, against the slip where there is any
    breaking             ///< one-sided elastic up to r = limit; beyond it is broken and r = 0: not monotone
  };
  Kind kind = Kind::free;
  double value = 0;  ///< displacement, force, stiffness, bound or coefficient; of the last three ≥ 0
  double limit = 0;  ///< force, ≥ 0; of capped_elastic and breaking
  double pull = 0;   ///< stiffness, ≥ 0; of unequal_elastic
  double power = 1;  ///< ≥ 1; of compliance
  bool operator==(const SupportLaw&) const = default;
};

/// "one-sided elastic".
const char* support_name(SupportLaw::Kind kind);

/// "elastic 100", "capped elastic 100, at most 2", "unequal elastic 100 pushed, 20 pulled".
std::string describe(const SupportLaw& law);

/// Pushes it towards v > 0 alone?
bool one_sided(SupportLaw::Kind kind);

/// Tells v < 0 from v > 0, so that it matters which way v is counted: one-sided, or elastic with two stiffnesses.
bool directed(SupportLaw::Kind kind);

/// Friction of two tangential components, whose bound is given or follows the normal force: problem::Friction rather than a Law.
bool rubs(SupportLaw::Kind kind);

/// What a law does at a node: it `follows` while its λ follows the displacement (or is any), and `bears` while λ is not 0. Open where it bears nothing, closed
/// where it holds or springs back, slip where it bears what it gives at most; friction or a capped spring that does not slip sticks.
Status status_of(SupportLaw::Kind kind, bool follows, bool bears);

/// Throws InputError where a number is not finite, or negative where it must not be.
void require_valid(const SupportLaw& law);

/// The law of rows x = −w (`prescribed`: x = value·unit − w), w = v·unit, whose multipliers are λ = r/unit: with a
/// length for unit, rotations and moments are told as displacements and forces. A breaking support is one that has
/// not broken yet: one-sided elastic. Null for `free` and `load`, which have no row, and for `coulomb`.
///
/// One row for each of `shares`, the length or area that it stands for where the law's numbers are per length or area:
/// stiffnesses, bound and limit are multiplied by it. A share of 0 bears nothing, but where the law is rigid.
std::shared_ptr<const Law> row_law(const SupportLaw& law, double unit = 1, const std::vector<double>& shares = {1});

/// The displacement at which the law gives this reaction, where there is one only; nothing at its limits and beyond them.
std::optional<double> sole_displacement(const SupportLaw& law, double reaction);

}  // namespace dotyk::problem

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "problem/law_table.hpp"

namespace dotyk::problem {

/// A law of the table with its numbers: what a support does about one displacement v (of a beam's end, its rotation, a node along a direction), with
/// its reaction r on the body. Of a part of a solid's boundary v and r are those of its points; r, stiffness and bound are per length or area.
struct LawChoice {
  const LawSpec* spec = &laws::free;
  std::array<double, 4> numbers{};

  const LawTraits* operator->() const { return &spec->traits; }
  bool is(const LawSpec& other) const { return spec == &other; }
  /// The number of this role; `otherwise` where the law has none.
  double number(LawNumber::Role role, double otherwise = 0) const;
  double displacement() const { return number(LawNumber::Role::displacement); }
  double force() const { return number(LawNumber::Role::force); }
  double stiffness() const { return number(LawNumber::Role::stiffness); }
  double bound() const { return number(LawNumber::Role::bound, Law::kUnbounded); }
  /// Multiplies what it gives: a load, a prescribed displacement.
  void scale(double factor) {
    if (spec->traits.load || spec->traits.prescribes) numbers[0] *= factor;
  }
  bool operator==(const LawChoice&) const = default;
};

/// A row's law and the length or area that it stands for where the law's numbers are per length or area.
struct LawRow {
  LawChoice law;
  double share = 1;
};

/// One law along a part: its numbers at each place, or the same at all.
struct LawAlong {
  LawChoice law;
  std::vector<std::array<double, 4>> at = {};  ///< by place; empty: alike

  const LawTraits* operator->() const { return &law.spec->traits; }
  LawChoice operator[](std::size_t place) const { return at.empty() ? law : LawChoice{law.spec, at[place]}; }
  void scale(double factor);
  /// Does it prescribe any displacement but 0?
  bool moves() const;
  bool operator==(const LawAlong&) const = default;
};
std::string describe(const LawAlong& law);

/// "elastic 100", "capped elastic 100, at most 2", "unequal elastic 100 pushed, 20 pulled".
std::string describe(const LawChoice& law);

/// What a law does at a node: it `follows` while its λ follows the displacement (or is any), and `bears` while λ is not 0. Open where it bears nothing,
/// closed where it holds or springs back, slip where it bears what it gives at most; one that yields sticks where it does not slip.
Status status_of(const LawTraits& law, bool follows, bool bears);

/// Throws InputError where a number is not finite (an infinite bound of friction: no slip) or less than it may be; `where` is told with it.
void require_valid(const LawChoice& law, const std::string& where = "");

/// The law of rows x = −w (`prescribed`: x = value·unit − w), w = v·unit, whose multipliers are λ = r/unit: with a
/// length for unit, rotations and moments are told as displacements and forces. A breaking support is one that has
/// not broken yet: one-sided elastic. Null for `free` and `load`, which have no row, and for `coulomb`.
///
/// All rows are of one entry of the table. Stiffnesses and bounds are multiplied by the share; a share of 0 bears nothing, but where the law is rigid.
std::shared_ptr<const Law> row_law(std::span<const LawRow> rows, double unit = 1);
std::shared_ptr<const Law> row_law(const LawChoice& law);

/// By its numbers: can its rows bear a force; and is it a spring that bears towards one side alone?
bool bears(const LawChoice& law);
bool one_sided_spring(const LawChoice& law);

/// The displacement at which the law gives this reaction, where there is one only; nothing at its limits and beyond them.
std::optional<double> sole_displacement(const LawChoice& law, double reaction);

/// −g/k, where a breaking support breaks, and ±g/k, where a capped one yields: g/k; infinite where k = 0, and for all others.
double yield_displacement(const LawChoice& law);

/// ½g²/k, what breaking takes of a law's energy, force·length per length or area; 0 where nothing springs back.
double breaking_energy(const LawChoice& law);

}  // namespace dotyk::problem

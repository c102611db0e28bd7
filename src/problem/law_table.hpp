#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "problem/law.hpp"

namespace dotyk::problem {

struct LawRow;

/// A number of a law: how it is named, told and checked.
struct LawNumber {
  enum class Role { none, displacement, force, stiffness, pull, bound, coefficient, factor, power };
  const char* name = nullptr;
  Role role = Role::none;
  const char* help = "";
  const char* unit = "";
  const char* example = "";
  double least = 0;
  std::optional<double> usual = {};  ///< where it is left out; without one it must be given
  const char* before = "";           ///< "at most 2", "20 pulled": how describe() tells it
  const char* after = "";
};

/// What rules, plans and figures ask of a law. With v the displacement and r the reaction on the body:
struct LawTraits {
  bool load = false;        ///< r is a number of the law, whatever v: forces, not rows
  bool prescribes = false;  ///< v is a number of the law
  bool rigid = false;       ///< it holds v by any force that its bounds allow, rather than by a spring
  bool pushes = false;      ///< r > 0 is possible
  bool pulls = false;       ///< r < 0 is possible
  bool bounded = false;     ///< a number of the law is the greatest |r|
  bool uneven = false;      ///< v < 0 and v > 0 are told apart, though it pushes and pulls
  bool breaks = false;      ///< beyond the bound r = 0: not monotone
  bool follows = false;     ///< the bound is a coefficient times the normal force

  constexpr bool acts() const { return pushes || pulls; }
  constexpr bool elastic() const { return acts() && !rigid && !load; }
  /// Pushes towards v > 0 alone.
  constexpr bool one_sided() const { return pushes && !pulls; }
  /// v < 0 and v > 0 are told apart, so that it matters which way v is counted.
  constexpr bool directed() const { return one_sided() || uneven; }
  /// Signorini's: v ≥ 0 by whatever force.
  constexpr bool stop() const { return rigid && one_sided() && !bounded; }
  /// Gives way at its bound and bears on.
  constexpr bool yields() const { return bounded && !breaks; }
  /// Friction of two tangential components: problem::Friction rather than a Law.
  constexpr bool rubs() const { return rigid && bounded && pushes && pulls; }
  /// Such friction of a given bound.
  constexpr bool tresca() const { return rubs() && !follows; }
};

/// One law of the table: its name, its numbers, its traits, and the Law of its rows.
struct LawSpec {
  const char* name;  ///< in Lua: "one_sided_elastic"
  const char* words; ///< "one-sided elastic"
  const char* help;
  LawTraits traits;
  std::array<LawNumber, 4> numbers = {};  ///< those without a name are none
  /// See row_law(); null where it has no rows of its own.
  std::shared_ptr<const Law> (*rows)(std::span<const LawRow> rows, double unit) = nullptr;
  bool named = false;  ///< in Lua its numbers are given by name, in a table

  int count() const;
};

/// All laws, in the order of help.
std::span<const LawSpec* const> law_table();

/// Those that the program itself states. r is the reaction, v the displacement; "pushes" is r ≥ 0 (P4, figures 1 to 17).
namespace laws {
extern const LawSpec free;                ///< r = 0
extern const LawSpec prescribed;          ///< v = value
extern const LawSpec load;                ///< r = value
extern const LawSpec elastic;             ///< r = −k v
extern const LawSpec one_sided_elastic;   ///< r = k v⁻
extern const LawSpec signorini;           ///< v ≥ 0, r ≥ 0, rv = 0
extern const LawSpec friction;            ///< rigid friction: |r| ≤ g; where v ≠ 0 it is g, against v
extern const LawSpec one_sided_friction;  ///< the same for v < 0, nothing for v > 0: 0 ≤ r ≤ g
extern const LawSpec capped_elastic;      ///< r = −k v, cut off at ±g
extern const LawSpec unequal_elastic;     ///< r = −k v for v < 0, r = −pull v for v > 0
extern const LawSpec compliance;          ///< r = c (v⁻)^m: asperities that are pressed flat
extern const LawSpec coulomb;             ///< tangential, of parts only: |r| ≤ μ r_normal⁺, against the slip where there is any
extern const LawSpec breaking;            ///< one-sided elastic up to r = g; beyond it is broken and r = 0
}  // namespace laws

}  // namespace dotyk::problem

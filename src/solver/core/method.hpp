#pragma once

#include <functional>
#include <optional>

#include "solver/core/treatable.hpp"
#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Any method with its options, by value: what a model needs to know of it. Made of anything derived
/// from Settings for which there is a solve(problem, settings, monitor). Empty: none named.
class Method {
 public:
  Method() = default;
  template <class Chosen>
    requires std::derived_from<Chosen, Settings>
  Method(Chosen chosen)  // NOLINT: a method is taken wherever its options are given
      : ordering_(chosen.ordering),
        begins_anew_(Chosen::begins_anew),
        takes_linear_(Chosen::takes_linear),
        takes_slices_(takes_slices(chosen)),
        decomposition_(decomposition_of(chosen)),
        run_([chosen](const problem::Problem& problem, Beginning from, Monitor& monitor) {
          Chosen started = chosen;
          if (from.start.empty()) from.start = chosen.start;
          static_cast<Beginning&>(started) = std::move(from);
          return ended(problem, solve(problem, started, monitor), started.tol, monitor);
        }),
        with_tol_([chosen](double tol) {
          Chosen other = chosen;
          other.tol = tol;
          return Method(other);
        }) {
    if constexpr (std::derived_from<Chosen, RowMethod>) on_rows_ = std::make_shared<const Chosen>(chosen);
  }

  explicit operator bool() const { return static_cast<bool>(run_); }
  algebra::Ordering ordering() const { return ordering_; }
  bool begins_anew() const { return begins_anew_; }
  bool takes_linear() const { return takes_linear_; }
  /// Does the method take a stiffness that is in slices without putting it together?
  bool takes_slices() const { return takes_slices_; }
  /// The same method with another tol.
  Method with_tol(double tol) const { return with_tol_(tol); }
  /// How the method wants bodies cut into subdomains; nothing where it has no use for them.
  const std::optional<problem::Decomposition>& decomposition() const { return decomposition_; }
  Result run(const problem::Problem& problem, Beginning from, Monitor& monitor) const {
    return run_(problem, std::move(from), monitor);
  }
  /// On a problem already condensed. Throws InputError for a method that works on bodies.
  Result run(const problem::Problem& problem, const problem::CondensedProblem& condensed, Monitor& monitor) const;
  /// The method, where it works on the condensed problem alone; else null.
  const std::shared_ptr<const RowMethod>& on_rows() const { return on_rows_; }

 private:
  /// With what the method's tol explains, and advice where it has failed: that there may be no solution, where the load is on a motion that friction
  /// alone stops and the state's pressures have less friction than it asks for; and a method to try next, one that can treat the problem and that
  /// neither failed nor, by the reason, was tried.
  static Result ended(const problem::Problem& problem, Result result, double tol, Monitor& monitor);

  template <class Chosen>
  static std::optional<problem::Decomposition> decomposition_of(const Chosen& chosen) {
    if constexpr (requires { chosen.decomposition; }) return chosen.decomposition;
    return std::nullopt;
  }

  template <class Chosen>
  static bool takes_slices(const Chosen& chosen) {
    if constexpr (requires { chosen.linear.takes_slices; }) return chosen.linear.takes_slices && !chosen.reduced;
    return false;
  }

  algebra::Ordering ordering_ = algebra::Ordering::automatic;
  bool begins_anew_ = false, takes_linear_ = false, takes_slices_ = false;
  std::optional<problem::Decomposition> decomposition_;
  std::function<Result(const problem::Problem&, Beginning, Monitor&)> run_;
  std::function<Method(double)> with_tol_;
  std::shared_ptr<const RowMethod> on_rows_;
};

}  // namespace dotyk::solver

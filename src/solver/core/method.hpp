#pragma once

#include <functional>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "solver/core/advice.hpp"
#include "solver/rows/row_iteration.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {

/// What a run begins with; see Settings.
struct Beginning {
  std::vector<char> start;  ///< empty: the method's own choice
  std::shared_ptr<problem::Condenser> condenser = nullptr;
  std::shared_ptr<const problem::State> from = nullptr;
};

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
        decomposition_(decomposition_of(chosen)),
        run_([chosen](const problem::Problem& problem, Beginning from, Monitor& monitor) {
          Chosen started = chosen;
          if (!from.start.empty()) started.start = std::move(from.start);
          started.from = std::move(from.from);
          started.condenser = std::move(from.condenser);
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
  /// The same method with another tol.
  Method with_tol(double tol) const { return with_tol_(tol); }
  /// How the method wants bodies cut into subdomains; nothing where it has no use for them.
  const std::optional<problem::Decomposition>& decomposition() const { return decomposition_; }
  Result run(const problem::Problem& problem, Beginning from, Monitor& monitor) const {
    return run_(problem, std::move(from), monitor);
  }
  /// On a problem already condensed. Throws InputError for a method that works on bodies.
  Result run(const problem::Problem& problem, const problem::CondensedProblem& condensed, Monitor& monitor) const {
    if (!on_rows_) throw InputError(text("this method works on scenes alone; on rows alone work ", kRowMethods));
    return ended(problem, solve(problem, condensed, *on_rows_, monitor), on_rows_->tol, monitor);
  }
  /// The method, where it works on the condensed problem alone; else null.
  const std::shared_ptr<const RowMethod>& on_rows() const { return on_rows_; }

 private:
  /// The residuals that a scene measures are no more than so many times the natural residual that tol is about.
  static constexpr double kMost = 1e4;
  static Result ended(const problem::Problem& problem, Result result, double tol, Monitor& monitor) {
    result.asked = kMost * tol;
    if (!result.converged && !monitor.stop()) result.reason += advice(problem, result);
    return result;
  }

  template <class Chosen>
  static std::optional<problem::Decomposition> decomposition_of(const Chosen& chosen) {
    if constexpr (requires { chosen.decomposition; }) return chosen.decomposition;
    return std::nullopt;
  }

  algebra::Ordering ordering_ = algebra::Ordering::automatic;
  bool begins_anew_ = false;
  std::optional<problem::Decomposition> decomposition_;
  std::function<Result(const problem::Problem&, Beginning, Monitor&)> run_;
  std::function<Method(double)> with_tol_;
  std::shared_ptr<const RowMethod> on_rows_;
};

}  // namespace dotyk::solver

#pragma once

#include <functional>

#include "solver/solver.hpp"

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
        run_([chosen = std::move(chosen)](const problem::Problem& problem, std::vector<char> start, Monitor& monitor) {
          Chosen started = chosen;
          if (!start.empty()) started.start = std::move(start);
          return solve(problem, started, monitor);
        }) {}

  explicit operator bool() const { return static_cast<bool>(run_); }
  algebra::Ordering ordering() const { return ordering_; }
  /// `start`: rows that start active, one flag a row; empty: the method's own choice.
  Result run(const problem::Problem& problem, std::vector<char> start, Monitor& monitor) const {
    return run_(problem, std::move(start), monitor);
  }

 private:
  algebra::Ordering ordering_ = algebra::Ordering::automatic;
  std::function<Result(const problem::Problem&, std::vector<char>, Monitor&)> run_;
};

}  // namespace dotyk::solver

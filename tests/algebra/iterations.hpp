#pragma once

#include "algebra/krylov/preconditioner.hpp"
#include "base/monitor.hpp"

namespace dotyk::test {

inline constexpr algebra::Preconditioning kPreconditionings[] = {algebra::Preconditioning::none, algebra::Preconditioning::ssor,
                                                                 algebra::Preconditioning::incomplete_cholesky};

/// Stops when asked for the n-th time.
struct Stop final : Monitor {
  explicit Stop(int n) : left(n) {}
  bool stop() override { return --left < 0; }
  int left;
};

}  // namespace dotyk::test

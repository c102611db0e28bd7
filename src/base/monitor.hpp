#pragma once

#include <limits>
#include <string>

#include "base/error.hpp"

namespace dotyk {

/// What one outer iteration of a method did; also the row of `s.history`.
struct IterationInfo {
  int step = 0;           ///< of a history, from 1; 0 without one
  int iteration = 0;
  int active = 0;         ///< rows closed (or otherwise carrying their law's active branch)
  int stick = 0;          ///< friction points that stick
  int slip = 0;           ///< friction points that slip
  int inner = 0;          ///< steps of an inner method so far, where there is one
  int changed = 0;        ///< rows whose branch differs from the last iteration
  double residual = 0.0;  ///< relative natural residual, as the method defines it
  double seconds = 0.0;   ///< since the method started
  /// Least singular value of the derivative that led here, where the method knows it; else NaN.
  double singular_value = std::numeric_limits<double>::quiet_NaN();
  double contraction = 0.0;  ///< of an outer loop: its change against the last step's; 0 where there is none
};

/// Who watches a long computation: told of its phases and iterations, asked
/// whether to stop. The default watches nothing and never stops.
class Monitor {
 public:
  virtual ~Monitor() = default;
  virtual void phase(const std::string& /*what*/) {}
  virtual void iteration(const IterationInfo& /*info*/) {}
  virtual bool stop() { return false; }

  /// Throws Interrupted where the user asked to stop and nothing can be returned.
  void check() {
    if (stop()) throw Interrupted();
  }
};

/// For a method within another: of its phases and iterations only a stop reaches the watcher of the other.
class InnerMonitor final : public Monitor {
 public:
  explicit InnerMonitor(Monitor& outer) : outer_(outer) {}
  bool stop() override { return outer_.stop(); }

 private:
  Monitor& outer_;
};

}  // namespace dotyk

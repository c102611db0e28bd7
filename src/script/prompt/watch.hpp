#pragma once
// A script's eye on long work in the numerical rooms: the progress line, the
// user's on_iteration, Ctrl-C.
#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "script/bridge/call.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::script {

// A row of s.history, and what on_iteration gets.
Record iteration_record(const IterationInfo& info);

// What was said of a line counts no more: the next input at the prompt begins.
void forget_judged();

// Lives on the stack of a binding while the work runs. Asks to stop after
// Ctrl-C, or when on_iteration returned false. An error inside on_iteration is a
// Lua error that passes through the numerical code.
class Watch : public Monitor {
 public:
  // `on_iteration` is empty or one function, called as f(k, info); `verbose`
  // leaves a line on standard error for each iteration. Throws Interrupted where
  // Ctrl-C was answered in this input already, by another work's partial result.
  Watch(lua_State* L, std::string work, std::vector<Function> on_iteration = {}, bool verbose = false);
  ~Watch() override;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // From now on, asks to stop after so many seconds.
  void limit(double seconds);

  void phase(const std::string& what) override;
  void iteration(const IterationInfo& info) override;
  bool stop() override;

  // Says on standard error of a result that has not converged that it is none to rely on: once for each line of a
  // script (at the prompt, of an input), so that a map of failures is not drowned; see forget_judged().
  void judge(const solver::Result& result);

  // To be called with the result in hand, partial or not. At the prompt, and in
  // functions called there, a request to stop is thereby answered and the user gets
  // the result to look at; in a script it goes on to end the script.
  // `advice` ends what is said of a partial one.
  void answer(const char* advice = "look at it or leave it");

 private:
  lua_State* L_;
  std::string work_;
  std::vector<Function> on_iteration_;
  bool verbose_, refused_ = false;
  std::atomic<bool> told_ = false;  // the work of a request to stop
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  std::optional<IterationInfo> last_;
};

}  // namespace dotyk::script

#include "script/prompt/watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/bridge/position.hpp"
#include "script/prompt/terminal.hpp"

namespace dotyk::script {

namespace {
std::set<std::string> judged;  // places of which judge() has told
}  // namespace

void forget_judged() { judged.clear(); }

Record iteration_record(const IterationInfo& info) {
  Record record{"iteration",
                {{"active", info.active}, {"stick", info.stick}, {"slip", info.slip}, {"changed", info.changed},
                 {"residual", info.residual}, {"time", info.seconds}}};
  if (info.inner > 0) record.add({{"inner", info.inner}});
  if (info.step > 0) record.add({{"step", info.step}});
  if (!std::isnan(info.singular_value)) record.add({{"singular_value", info.singular_value}});
  if (info.contraction > 0) record.add({{"contraction", info.contraction}});
  return record;
}

Watch::Watch(lua_State* L, std::string work, std::vector<Function> on_iteration, bool verbose)
    : L_(L), work_(std::move(work)), on_iteration_(std::move(on_iteration)), verbose_(verbose) {
  if (!interrupt_answered()) return;
  request_interrupt();  // so that no pcall goes on
  throw Interrupted();
}

Watch::~Watch() { clear_progress(); }

void Watch::phase(const std::string& what) { show_progress(work_ + ": " + what + " …"); }

void Watch::iteration(const IterationInfo& info) {
  const auto line = text(work_, info.step > 0 ? text(": step ", info.step, ", iteration ") : ": iteration ", info.iteration, ", residual ",
                         std::setprecision(3), info.residual, ", ", info.active, " active, ", info.changed, " changed, ", info.stick,
                         " stick, ", info.slip, " slip, ", info.inner > 0 ? text(info.inner, " inner, ") : "", std::fixed,
                         std::setprecision(1), info.seconds, " s");
  last_ = info;
  if (verbose_) {
    clear_progress();
    std::fprintf(stderr, "%s\n", line.c_str());
  } else {
    show_progress(line);
  }
  if (on_iteration_.empty()) return;
  try {
    if (!on_iteration_.front()(info.iteration, iteration_record(info))) refused_ = true;
  } catch (const Interrupted&) {
    refused_ = true;  // the method ends with the state so far
  }
}

void Watch::limit(double seconds) {
  // No clock counts longer than this, a century.
  const std::chrono::duration<double> length(std::min(seconds, 3e9));
  deadline_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(length);
}

bool Watch::stop() {
  if (interrupted()) told_ = true;
  return refused_ || interrupted() || (deadline_ && std::chrono::steady_clock::now() > *deadline_);
}

void Watch::judge(const solver::Result& result) {
  if (result.converged) told_ = false;  // what was left out after it is in its reason
  if (result.converged || interrupted()) return;  // of an interruption answer() tells
  const std::string place = position(L_);
  if (!judged.insert(place).second) return;
  clear_progress();
  std::fprintf(stderr, "%snot converged (%s): %s (said once for this line)\n", place.c_str(), result.method.c_str(), result.reason.c_str());
}

void Watch::answer(const char* advice) {
  if (!runs_for_prompt(L_) || called_by_own(L_)) return;  // dotyk's own functions in Lua have results of their own
  if (interrupted() && !told_) {
    clear_progress();
    std::fputs("it had ended before it could be stopped: the result is whole\n", stderr);
  } else if (interrupted()) {
    clear_progress();
    const std::string place = !last_ ? "" : last_->step > 0 ? text(" in step ", last_->step, " after iteration ", last_->iteration) : text(" after iteration ", last_->iteration);
    std::fprintf(stderr, "stopped%s: the result is the state so far; %s\n", place.c_str(), advice);
  }
  answer_interrupt();
}

}  // namespace dotyk::script

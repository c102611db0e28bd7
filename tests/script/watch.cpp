#include <doctest/doctest.h>

#include "bench.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/prompt/watch.hpp"

using namespace dotyk::script;

namespace {

// dotyk.test.work{ on_iteration = f }: up to five iterations; gives how many.
void add_work(Bench& bench) {
  bench.interpreter.library().function(
      {.name = "dotyk.test.work",
       .help = "Works.",
       .example = "dotyk.test.work{}",
       .arguments = {key::table({key::function("on_iteration", "called after each iteration")})},
       .run = [](Call& call) {
         std::vector<Function> callback;
         if (call.has("on_iteration")) callback.push_back(call.function("on_iteration"));
         Watch watch(call.state(), "work", callback);
         int done = 0;
         while (done < 5 && !watch.stop()) {
           dotyk::IterationInfo info;
           info.iteration = ++done;
           info.residual = 1.0 / done;
           watch.iteration(info);
         }
         watch.answer();
         return call.give(done);
       }});
}

}  // namespace

TEST_CASE("on_iteration sees each iteration and can stop") {
  Bench bench;
  add_work(bench);
  CHECK(bench.error("assert(dotyk.test.work{} == 5)") == "");
  CHECK(bench.error("local seen = {}\nassert(dotyk.test.work{ on_iteration = function(k, info) seen[k] = "
                    "info.residual end } == 5)\nassert(#seen == 5 and seen[2] == 0.5)") == "");
  CHECK(bench.error("assert(dotyk.test.work{ on_iteration = function(k) return k < 3 end } == 3)") == "");
  CHECK(bench.error("\ndotyk.test.work{ on_iteration = function(k) error 'oh' end }") ==
        "t.lua:2: oh (in 'on_iteration' of work at t.lua:2)");
}

TEST_CASE("Ctrl-C ends a script, but at the prompt the partial result is kept") {
  Bench bench;
  add_work(bench);
  watch_interrupts(bench.interpreter.state());
  const auto run = [&](const std::string& chunk) {
    request_interrupt();
    // Lua's own hook would fire first; only the polling of C++ is looked at here.
    lua_sethook(bench.interpreter.state(), nullptr, 0, 0);
    bench.interpreter.run_text("done = dotyk.test.work{}", chunk);
    const bool left = interrupted();
    clear_interrupt();
    return left;
  };
  CHECK(run("t.lua"));
  CHECK_FALSE(run("prompt"));
  CHECK(bench.error("assert(done == 0)") == "");
}

TEST_CASE("after a partial result the next work of the same input is one too many") {
  Bench bench;
  add_work(bench);
  watch_interrupts(bench.interpreter.state());
  const auto run = [&] {
    request_interrupt();
    lua_sethook(bench.interpreter.state(), nullptr, 0, 0);
    const auto error = bench.interpreter.run_text("rounds = 0\nfor i = 1, 100 do done = dotyk.test.work{} rounds = i pcall(dotyk.test.work, {}) end", "prompt").value_or("");
    clear_interrupt();
    return error;
  };
  CHECK(run().find("interrupted") != std::string::npos);
  CHECK(bench.error("assert(done == 0 and rounds == 1)") == "");  // the state so far stays
  CHECK(bench.interpreter.run_text("for i = 1, 3 do assert(dotyk.test.work{} == 5) end", "prompt").value_or("") == "");
}

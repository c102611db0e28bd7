#pragma once
// One interpreter that runs what the fuzzers write, statement by statement, and keeps the script of the
// last program where a signal handler can save it.
#include <memory>
#include <string>

#include "script/interpreter.hpp"
#include "script/bridge/library.hpp"

namespace dotyk::fuzz {

class Machine {
 public:
  // Messages and saved scripts go where standard output pointed; what scripts print goes nowhere.
  explicit Machine(std::string failures);

  script::Library& library() { return interpreter_->library(); }
  lua_State* state() { return interpreter_->state(); }

  // A new program: an empty script, every object of the last one released.
  void begin(const std::string& name);
  // Runs one statement; a failure saves the script as failures/<name>.lua, says so and counts.
  // `before` is written into the script alone.
  void run(const std::string& statement, const std::string& before = "");

  long executions() const { return executions_; }
  int failures() const { return failures_; }
  // "0.3 s in seed_17": the longest statement.
  std::string slowest() const;
  void say(const std::string& line) const;

 private:
  void fail(const std::string& what);
  void renew();

  std::unique_ptr<script::Interpreter> interpreter_;
  std::string folder_, name_, script_;
  long executions_ = 0, begun_ = 0;
  int failures_ = 0;
  double longest_ = 0;
  std::string longest_in_;
};

// Megabytes of memory in use.
double resident();

}  // namespace dotyk::fuzz

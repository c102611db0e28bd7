#pragma once
// A Lua state with everything dotyk offers in it.
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct lua_State;

namespace dotyk::script {

class Library;

class Interpreter {
 public:
  // Opens Lua's libraries, registers the bindings, runs lua/init.lua, makes
  // globals strict. Throws std::runtime_error when dotyk's Lua files are missing.
  Interpreter();
  ~Interpreter();
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;

  lua_State* state() const { return L_; }
  Library& library() const { return *library_; }

  // Error messages carry the stack of calls from now on.
  void trace(bool wanted) { trace_ = wanted; }

  // The local variables of the scripts run from now on stay, as global ones, when they end.
  void keep_locals() { keep_locals_ = true; }

  // The global `arg`: [0] the script, [1] … its arguments.
  void set_arguments(const std::string& script, const std::vector<std::string>& arguments);

  // Runs a text, whose name in messages is `chunk`, or, of a file's text, "@" and the file. Returns the error message, or
  // nothing when all went well.
  std::optional<std::string> run_text(const std::string& text, const std::string& chunk);

  // Calls the function below its `count` arguments on the Lua stack, leaving its
  // results there (all of them for LUA_MULTRET), or nothing after an error.
  std::optional<std::string> call(int count, int results);

 private:
  lua_State* L_;
  std::unique_ptr<Library> library_;
  bool trace_ = false, keep_locals_ = false;
};

}  // namespace dotyk::script

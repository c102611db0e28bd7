#pragma once
// Every entry from Lua into C++ goes through here: a C++ exception becomes a
// Lua error at the user's line.
#include <exception>
#include <new>
#include <string>

#include "script/bridge/position.hpp"

namespace dotyk::script {

// Runs body(), which returns a number of Lua results. The Lua error is raised
// after the handler is left, so that no exception is in flight when Lua throws
// its own. Lua's errors are no std::exception and pass through untouched.
template <class Body>
int guarded(lua_State* L, const std::string& callee, Body&& body) {
  std::string message;
  try {
    return body();
  } catch (const std::bad_alloc&) {
    message = "out of memory";  // short enough to need no allocation
  } catch (const std::exception& error) {
    message = error.what();
  }
  raise(L, callee, message);
}

}  // namespace dotyk::script

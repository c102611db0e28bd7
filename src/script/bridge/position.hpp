#pragma once
// Where in the user's script are we? And the way from Lua into C++, where an exception becomes a Lua error there.
#include <exception>
#include <new>
#include <string>

struct lua_State;

namespace dotyk::script {

// Chunk names of dotyk's own Lua files begin so; errors never point into them.
inline constexpr char own_chunk[] = "=(dotyk)";

// What lines typed at the prompt are called in messages: "prompt:1: …".
inline constexpr char prompt_chunk[] = "prompt";

// "hertz.lua:3: ", the innermost running line that belongs to a user's chunk,
// or "" when there is none. With a name, "hertz.lua:3: contact: ".
std::string position(lua_State* L, const std::string& callee = "");

// Is what runs an input of the prompt, with no script (dofile, require) running in between?
bool runs_for_prompt(lua_State* L);

// Is the innermost function in Lua one of dotyk's own?
bool called_by_own(lua_State* L);

// What a value is, to a person: "nil", "the number 3", "a body", "a function".
std::string describe_value(lua_State* L, int index);

// Raises the Lua error "place: callee: message"; does not return.
[[noreturn]] void raise(lua_State* L, const std::string& callee, const std::string& message);

// Every entry from Lua into C++ goes through here. Runs body(), which returns a number of Lua results. The Lua error is raised
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

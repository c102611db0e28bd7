#pragma once
// Where in the user's script are we?
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

}  // namespace dotyk::script

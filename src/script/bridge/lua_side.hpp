#pragma once
// What dotyk's own Lua files, in lua/, get from C++: one table of functions.
//   fail(text)      raises an error at the user's line
//   load(name)      runs lua/<name>.lua with this table, once; returns its value
//   terminal(name)  is "stdin", "stdout" or "stderr" a terminal
//   progress(text)  shows the text on the progress line; progress() takes it away
//   write(f, text)  writes a file whole or not at all
//   check_figure(file, title, label)  raises what drawing would, but for a call of dotyk.work_precision; all may be nil
//   clock()         seconds, of a clock that never jumps
//   unless_interrupted(f, kept)  calls f(); true where it returns, false where Ctrl-C at the prompt ended it and kept()
//                   says what is left of it to look at; nil from kept() and any other error go on
//   getinfo(…)      debug.getinfo, which scripts lack under --safe
//   inputs          what was typed at the prompt and has functions: { typed = text, compiled = text } each
//   read_own(name)  the text of lua/<name>.lua
//   signature(f)    of a callable of dotyk's, else nil
//   written(f)      its name and, where it is written in Lua (Descriptor::in_lua), file and function
//   folder          where these files are
//   type_name(v)    "body", "mesh", … or what type() says
// Global names these files use are Lua's own, whatever a script or a line at the prompt has called `type` or `table`;
// print alone is the user's.
struct lua_State;

namespace dotyk::script {

// Runs lua/init.lua with the table above. Throws std::runtime_error with the
// reason when a file is missing or wrong.
void load_lua_side(lua_State* L);

// In the registry: core.inputs.
inline constexpr char inputs_of_prompt[] = "dotyk.inputs";

// Pushes a function of lua/<file>.lua, which is loaded if need be. May raise a Lua error.
void push_own_function(lua_State* L, const char* file, const char* name);

// The folder of dotyk's Lua files: $DOTYK_LUA, ../share/dotyk/lua beside an
// installed program, or the source folder the program was built from.
const char* lua_folder();

}  // namespace dotyk::script

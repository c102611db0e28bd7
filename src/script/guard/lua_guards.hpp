#pragma once
// Functions of Lua's own libraries that would run for ever beyond the reach of Ctrl-C, or let a script break what C++
// relies on, replaced by ones that do the same and do not.
struct lua_State;

namespace dotyk::script {

// Patterns (guard_patterns); string.rep of nothing; table.move, insert and remove over any number of places; of debug what
// would change functions and values that are not written in Lua, which is refused, or look into them, which finds nothing;
// load, loadfile, dofile and require of compiled chunks, which are refused: a wrong one ends the program.
void guard_lua(lua_State* L);

// string.find, match, gmatch and gsub: the same as Lua's, whose matching is one call of C, but Ctrl-C can stop them.
void guard_patterns(lua_State* L);

}  // namespace dotyk::script

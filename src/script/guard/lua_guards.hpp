#pragma once
// Functions of Lua's own libraries that would run for ever beyond the reach of Ctrl-C, or let a script break what C++
// relies on, replaced by ones that do the same and do not.
struct lua_State;

namespace dotyk::script {

// Patterns (guard_patterns); string.rep of nothing; table.move, insert and remove over any number of places; of debug what would change functions
// and values that are not written in Lua, which is refused.
void guard_lua(lua_State* L);

// string.find, match, gmatch and gsub that Ctrl-C can stop, however long a pattern takes.
// Lua's own matching is one call of C, without a look at anything. Where it may take long (the length of the text to the
// power of what repeats in the pattern), the same functions of Lua run in a Lua state of their own, which has copies of text
// and pattern and nothing else: on Ctrl-C it is left where it is and thrown away (see abandonable() in interrupt.hpp), and the
// script's state knows nothing of it.
void guard_patterns(lua_State* L);

}  // namespace dotyk::script

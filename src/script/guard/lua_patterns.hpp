#pragma once
// string.find, match, gmatch and gsub that Ctrl-C can stop, however long a pattern takes.
struct lua_State;

namespace dotyk::script {

// Lua's own matching is one call of C, without a look at anything. Where it may take long (the length of the text to the
// power of what repeats in the pattern), the same functions of Lua run in a Lua state of their own, which has copies of text
// and pattern and nothing else: on Ctrl-C it is left where it is and thrown away (see abandonable() in interrupt.hpp), and the
// script's state knows nothing of it.
void guard_patterns(lua_State* L);

}  // namespace dotyk::script

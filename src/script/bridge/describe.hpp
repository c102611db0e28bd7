#pragma once
// Descriptions written in Lua, as tables.
#include "script/bridge/descriptor.hpp"

struct lua_State;

namespace dotyk::script {

// Reads { name =, help =, setup =, example =, returns =, arguments = {…} } where each
// argument is { name =, kind =, help =, unit =, default =, required =, choices =,
// type =, above =, at_least =, at_most =, fewest =, most =, written =, keys = {…}, item = {…} };
// `keys` (and `item`) in place of `arguments` describe a single table argument.
// Throws std::runtime_error on anything else.
Descriptor read_descriptor(lua_State* L, int index);

}  // namespace dotyk::script

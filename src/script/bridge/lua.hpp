#pragma once
// The Lua C API. dotyk links liblua5.4-c++, the interpreter compiled as C++:
// its errors are C++ throws and run the destructors of the frames they leave.
// Never write catch (...) around these functions: it would swallow them.
extern "C" {
#include <lua.h>
#include <lauxlib.h>
#include <lualib.h>
}

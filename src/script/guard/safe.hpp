#pragma once
// Scripts from strangers: what of Lua's own libraries they get. A script can compute, print, call dotyk
// and use files below one folder. It cannot start programs, load machine code or compiled Lua, read the
// environment, or reach what the interpreter keeps for itself.
#include <string>
#include <vector>

#include "base/place.hpp"

struct lua_State;

namespace dotyk::script {

// From here on the kernel lets this thread, those it starts, and programs that they start open, make, rename and
// remove files below the folder only, and beside it read and run what lies below the folders of the system (/usr,
// /etc, /proc, …) and those named in `own`. Threads that run already (OpenBLAS's, which compute) and open files stay
// as they are. False where the kernel has no Landlock (Linux before 5.13, or it is switched off): then nothing has
// changed. Source: landlock(7).
bool confine(const Folder& folder, const std::vector<std::string>& own);

// Before the script runs: Lua's functions of files look at the folder of make_safe, and count for the limit of all files'
// bytes (base/whole_file.hpp). What goes to standard output does not count.
void watch_files(lua_State* L);

// Before the script runs, after everything is loaded; with watch_files. From then on, below the folder only:
// io.open, lines, input, output; os.remove, rename; loadfile, dofile, require (Lua files alone), and all
// of dotyk's arguments of Kind::file. debug keeps traceback alone. What is refused raises at the script's line.
void make_safe(lua_State* L, const Folder& folder);

// Raises where the file named at that stack index is not below the folder of a run with --safe; for functions that replace
// Lua's own (lua_guards.hpp).
void require_below(lua_State* L, int index);

// What could undo a count of instructions: debug keeps traceback alone, and files their metatable, whose __gc would run
// where nothing counts. `option` is the one that asks for it, named where a script tries.
void close_debug(lua_State* L, const char* option);

}  // namespace dotyk::script

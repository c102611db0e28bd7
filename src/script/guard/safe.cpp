#include "script/guard/safe.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "base/whole_file.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/position.hpp"
#include "script/guard/lua_guards.hpp"

namespace dotyk::script {
namespace {

constexpr std::uint64_t execute = LANDLOCK_ACCESS_FS_EXECUTE, write_file = LANDLOCK_ACCESS_FS_WRITE_FILE;
constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t removing = LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR;
constexpr std::uint64_t making = LANDLOCK_ACCESS_FS_MAKE_REG, of_version_1 = (1 << 13) - 1;
constexpr std::uint64_t refer = 1 << 13, truncate_file = 1 << 14;  // of versions 2 and 3, newer than some headers

void allow(int rules, const std::string& place, std::uint64_t access) {
  const int parent = open(place.c_str(), O_PATH | O_CLOEXEC);
  if (parent < 0) return;  // not there
  struct stat info {};
  const bool folder = fstat(parent, &info) == 0 && S_ISDIR(info.st_mode);
  const auto of_a_file = execute | write_file | LANDLOCK_ACCESS_FS_READ_FILE | truncate_file;
  const landlock_path_beneath_attr rule{folder ? access : access & of_a_file, parent};
  syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(parent);
}

// Of the bytes of all files together.
void count_bytes(lua_State* L, double bytes) {
  guarded(L, lua_tostring(L, lua_upvalueindex(2)), [bytes] {
    count_file_bytes(bytes);
    return 0;
  });
}

// file:write and io.write.
int write_counted(lua_State* L) {
  const auto* file = static_cast<luaL_Stream*>(luaL_testudata(L, 1, LUA_FILEHANDLE));
  const int first = file ? 2 : 1, last = lua_gettop(L);
  lua_getfield(L, LUA_REGISTRYINDEX, "_IO_output");
  if (!file) file = static_cast<luaL_Stream*>(luaL_testudata(L, -1, LUA_FILEHANDLE));
  lua_pop(L, 1);
  double bytes = 0;
  constexpr double most_of_a_number = 32;
  for (int k = first; k <= last; ++k)
    bytes += lua_type(L, k) == LUA_TSTRING ? static_cast<double>(lua_rawlen(L, k)) : most_of_a_number;
  if (!file || (file->f != stdout && file->f != stderr)) count_bytes(L, bytes);
  return original(L);
}

// io.open and io.output, which may make a file.
int open_file(lua_State* L) {
  if (!lua_isstring(L, 1)) return original(L);
  require_below(L, 1);
  const bool output = std::strcmp(lua_tostring(L, lua_upvalueindex(2)), "output") == 0;
  if (std::strpbrk(output ? "w" : luaL_optstring(L, 2, "r"), "wa+")) count_bytes(L, kLeastFileBytes);
  return original(L);
}

// A function whose first argument names a file, or two of which do. Without one it takes a default (io.input()).
int with_file(lua_State* L) {
  if (lua_isstring(L, 1)) require_below(L, 1);
  return original(L);
}
int with_two_files(lua_State* L) {
  for (const int index : {1, 2}) {
    luaL_checkstring(L, index);
    require_below(L, index);
  }
  return original(L);
}

// Upvalue 1 is the name of what is refused, upvalue 2 the option that refuses it.
int refuse(lua_State* L) {
  raise(L, lua_tostring(L, lua_upvalueindex(1)), std::string("not for scripts run with ") + lua_tostring(L, lua_upvalueindex(2)));
}

int no_variable(lua_State* L) {
  luaL_checkstring(L, 1);
  lua_pushnil(L);
  return 1;
}

void take_away(lua_State* L, const char* library, const char* name, const char* option = "--safe") {
  lua_getglobal(L, library);
  lua_pushfstring(L, "%s.%s", library, name);
  lua_pushstring(L, option);
  lua_pushcclosure(L, refuse, 2);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
}

void keep_lua_searchers(lua_State* L) {
  lua_getglobal(L, "package");
  lua_getfield(L, -1, "searchers");
  for (int k = 3; k <= 4; ++k) {  // those of machine code
    lua_pushnil(L);
    lua_rawseti(L, -2, k);
  }
  lua_pop(L, 1);
  set_field(L, "cpath", "");
  lua_pop(L, 1);
}

}  // namespace

bool confine(const Folder& folder, const std::vector<std::string>& own) {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  const std::uint64_t handled = of_version_1 | (version >= 2 ? refer : 0) | (version >= 3 ? truncate_file : 0);
  landlock_ruleset_attr ruleset{};
  ruleset.handled_access_fs = handled;
  const int rules = static_cast<int>(syscall(SYS_landlock_create_ruleset, &ruleset, sizeof ruleset, 0));
  if (rules < 0) return false;
  allow(rules, folder.place(), handled & (write_file | reading | removing | making | refer | truncate_file));
  for (const char* system : {"/usr", "/lib", "/lib64", "/bin", "/etc", "/proc", "/sys", "/var/cache/fontconfig"})
    allow(rules, system, execute | reading);
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/random", "/dev/urandom", "/dev/tty"})
    allow(rules, device, reading | write_file);
  for (const std::string& place : own) allow(rules, place, execute | reading);
  const bool done = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return done;
}

void require_below(lua_State* L, int index) {
  const auto& folder = Library::of(L).folder;
  if (!folder) return;
  const std::string name = lua_tostring(L, index);
  guarded(L, lua_tostring(L, lua_upvalueindex(2)), [&] {
    folder->require(name);
    return 0;
  });
}

void close_debug(lua_State* L, const char* option) {
  lua_getglobal(L, "debug");
  for (const auto& name : string_keys(L, -1))
    if (name != "traceback") take_away(L, "debug", name.c_str(), option);
  luaL_getmetatable(L, LUA_FILEHANDLE);
  set_field(L, "__metatable", "a file");
  lua_pop(L, 2);
}

void watch_files(lua_State* L) {
  replace(L, {{"io", "open", open_file}, {"io", "output", open_file}, {"io", "write", write_counted},
              {"io", "lines", with_file}, {"io", "input", with_file}, {"os", "remove", with_file}, {"os", "rename", with_two_files}});
  luaL_getmetatable(L, LUA_FILEHANDLE);
  lua_getfield(L, -1, "__index");
  replace_field(L, "write", write_counted);
  lua_pop(L, 2);
}

void make_safe(lua_State* L, const Folder& folder) {
  Library::of(L).folder = folder;
  replace(L, {{"os", "getenv", no_variable}});
  for (const char* name : {"popen", "tmpfile"}) take_away(L, "io", name);
  for (const char* name : {"execute", "tmpname"}) take_away(L, "os", name);
  for (const char* name : {"loadlib", "searchpath"}) take_away(L, "package", name);
  close_debug(L, "--safe");
  keep_lua_searchers(L);
}

}  // namespace dotyk::script

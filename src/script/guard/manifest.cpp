#include "script/guard/manifest.hpp"

#include <ctime>
#include <fstream>
#include <utility>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "script/commit.hpp"
#include "script/bridge/library.hpp"
#include "script/guard/sha256.hpp"

namespace dotyk::script {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

// A value of one line.
std::string line(const std::string& name, std::string value) {
  for (char& c : value)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return name + ": " + value + "\n";
}

// Of a solution: the method as it was given, else by name, and how it ended.
std::string about_solution(lua_State* L, int object) {
  const auto* type = Library::of(L).type_at(L, object);
  if (!type || !type->field("converged")) return "";
  luaL_checkstack(L, 8, nullptr);
  const int top = lua_gettop(L);
  std::string lines;
  if (lua_getiuservalue(L, object, 1) == LUA_TTABLE && lua_getfield(L, -1, "solver") != LUA_TNIL)
    lines += line("solver", luaL_tolstring(L, -1, nullptr));
  lua_settop(L, top);
  for (const char* name : {"method", "converged", "reason", "iterations", "unknowns", "rows"}) {
    const auto* field = type->field(name);
    if (!field) continue;
    field->read(L, checked_object(L, object, type->name.c_str()));
    lines += line(std::string("solution ") + name, luaL_tolstring(L, -1, nullptr));
    lua_settop(L, top);
  }
  return lines;
}

std::string beside(const std::string& file) { return file + ".manifest"; }

}  // namespace

Manifest::Manifest(std::string script, std::optional<std::string> text, std::vector<std::string> arguments)
    : script_(std::move(script)), hash_(text ? sha256(*text) : "not known"), arguments_(std::move(arguments)) {}

void Manifest::require_place(lua_State* L, const std::string& file) {
  if (const auto& folder = Library::of(L).folder) folder->require(beside(file));
  place_to_write(beside(file));
}

void Manifest::write(lua_State* L, const std::string& file, const std::string& call, int object) const {
  std::string lines = line("file", file) + line("call", call) + line("script", script_) + line("script sha256", hash_);
  for (const auto& argument : arguments_) lines += line("argument", argument);
  if (object > 0) lines += about_solution(L, object);
  lines += line("dotyk", DOTYK_VERSION) + line("commit", commit) + line("processor", processor()) +
           line("cores", std::to_string(cores())) + line("date", date()) +
           line("seconds", text(clock_.seconds()));
  require_place(L, file);
  write_whole_file(beside(file), lines);
}

}  // namespace dotyk::script

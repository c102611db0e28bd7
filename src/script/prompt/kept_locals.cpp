#include "script/prompt/kept_locals.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <vector>

#include "script/bridge/lua.hpp"
#include "script/guard/strict.hpp"

namespace dotyk::script {
namespace {

constexpr char kept[] = "dotyk.kept";  // in the registry: { the function, NAME = true of what is <close> }
constexpr char first_name[] = "__keep_locals";

// Reads Lua from left to right and blanks out <const>, wherever it stands: line for line the text stays what it was.
class Declarations {
 public:
  explicit Declarations(const std::string& text) : text_(text) {
    while (at_ < text_.size()) step();
  }
  std::string text_;
  std::vector<std::string> closing;
  std::size_t first_local = std::string::npos;  // where the text begins with "local", the place
  bool first_is_given = false, first_closes = false;  // … = value, or a function; one of them is <close>

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  bool long_bracket(std::size_t from) {
    auto end = from + 1;
    while (end < text_.size() && text_[end] == '=') ++end;
    if (from >= text_.size() || text_[from] != '[' || end >= text_.size() || text_[end] != '[') return false;
    const auto closing_bracket = "]" + std::string(end - from - 1, '=') + "]";
    const auto found = text_.find(closing_bracket, end);
    at_ = found == std::string::npos ? text_.size() : found + closing_bracket.size();
    return true;
  }

  void blanks() {
    for (;;) {
      if (std::isspace(static_cast<unsigned char>(peek()))) ++at_;
      else if (peek() == '-' && peek(1) == '-') comment();
      else return;
    }
  }

  void comment() {
    if (long_bracket(at_ + 2)) return;
    at_ = std::min(text_.find('\n', at_), text_.size());
  }

  void quoted(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_) at_ += text_[at_] == '\\' ? 1 : 0;
    at_ = std::min(at_ + 1, text_.size());
  }

  std::string name() {
    const auto from = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '_') ++at_;
    return text_.substr(from, at_ - from);
  }

  void step() {
    const char c = peek();
    const bool first = begins_;
    if (c == '-' && peek(1) == '-') return comment();
    if (std::isspace(static_cast<unsigned char>(c))) return void(++at_);
    begins_ = false;
    if (c == '"' || c == '\'') return quoted(c);
    if (c == '[' && long_bracket(at_)) return;
    const auto word = name();
    if (word.empty()) ++at_;
    else if (word == "local") names(first);
  }

  void names(bool first) {
    if (first) first_local = at_ - std::strlen("local");
    for (;;) {
      blanks();
      const auto variable = name();
      blanks();
      if (peek() == '<') attribute(variable, first);
      blanks();
      if (first) first_is_given = variable == "function" || (peek() == '=' && peek(1) != '=');
      if (peek() != ',') return;
      ++at_;
    }
  }

  void attribute(const std::string& variable, bool first) {
    const auto from = at_++;
    blanks();
    const auto word = name();
    blanks();
    if (peek() != '>') return;
    ++at_;
    if (word == "const") {
      for (auto k = from; k < at_; ++k)
        if (text_[k] != '\n') text_[k] = ' ';
    } else if (word == "close") {
      closing.push_back(variable);
      first_closes = first_closes || first;
    }
  }

  std::size_t at_ = 0;
  bool begins_ = true;
};

// The frame's variables as global ones; the table of the registry is at index.
void keep(lua_State* L, const lua_Debug& frame, int index) {
  if (!lua_checkstack(L, 8)) return;
  lua_pushglobaltable(L);
  for (int i = 1; const char* name = lua_getlocal(L, &frame, i); ++i) {
    lua_getfield(L, index, name);
    const bool closed = lua_toboolean(L, -1);
    lua_pop(L, 1);
    if (name[0] == '(' || closed || std::strcmp(name, first_name) == 0 || std::strcmp(name, "_ENV") == 0) {
      lua_pop(L, 1);
      continue;
    }
    if (lua_isnil(L, -1)) declare_global(L, name);
    lua_pushstring(L, name);
    lua_insert(L, -2);
    lua_rawset(L, -3);
  }
  lua_pop(L, 1);
}

// Each lua_getstack counts from the innermost: of a stack that overflows there are too many to try them all.
bool outermost(lua_State* L, lua_Debug& frame) {
  int known = -1, beyond = 1;
  while (lua_getstack(L, beyond - 1, &frame)) {
    known = beyond - 1;
    beyond *= 2;
  }
  for (beyond -= 1; beyond - known > 1;) {
    const int middle = known + (beyond - known) / 2;
    (lua_getstack(L, middle, &frame) ? known : beyond) = middle;
  }
  return known >= 0 && lua_getstack(L, known, &frame);
}

// __close of the first variable, while the frame that ends still stands. After an error it does not.
int keep_at_end(lua_State* L) {
  lua_Debug frame;
  if (!lua_isnil(L, 2) || !lua_getstack(L, 1, &frame)) return 0;
  keep(L, frame, 1);
  return 0;
}

// The first variable's value, upvalue 1. The name by which the text calls this function goes again.
int first_value(lua_State* L) {
  lua_pushglobaltable(L);
  lua_pushstring(L, first_name);
  lua_pushnil(L);
  lua_rawset(L, -3);
  lua_pushvalue(L, lua_upvalueindex(1));
  return 1;
}

}  // namespace

std::string as_globals(const std::string& text) {
  const Declarations declared(text);
  if (declared.first_local == std::string::npos || !declared.first_is_given || declared.first_closes) return text;
  auto global = declared.text_;
  return global.replace(declared.first_local, std::strlen("local"), std::strlen("local"), ' ');
}

std::string keep_locals(lua_State* L, const std::string& text, const std::string& chunk) {
  const Declarations declared(text);
  const auto whole = std::string("local ") + first_name + " <close> = " + first_name + "() " + declared.text_;
  if (luaL_loadbufferx(L, whole.data(), whole.size(), chunk.c_str(), "t") != LUA_OK) {
    lua_pop(L, 1);
    return text;
  }
  lua_remove(L, -2);
  lua_newtable(L);
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, keep_at_end);
  lua_setfield(L, -2, "__close");
  lua_setmetatable(L, -2);
  for (const auto& name : declared.closing) {
    lua_pushboolean(L, true);
    lua_setfield(L, -2, name.c_str());
  }
  lua_pushvalue(L, -2);
  lua_rawseti(L, -2, 1);
  lua_pushvalue(L, -1);
  lua_setfield(L, LUA_REGISTRYINDEX, kept);
  lua_pushglobaltable(L);
  lua_pushstring(L, first_name);
  lua_pushvalue(L, -3);
  lua_pushcclosure(L, first_value, 1);
  lua_rawset(L, -3);
  lua_pop(L, 2);
  return whole;
}

void keep_locals_after_error(lua_State* L) {
  if (!lua_checkstack(L, 8)) return;
  if (lua_getfield(L, LUA_REGISTRYINDEX, kept) != LUA_TTABLE) return lua_pop(L, 1);
  lua_rawgeti(L, -1, 1);
  lua_Debug frame;
  if (outermost(L, frame)) {
    lua_getinfo(L, "f", &frame);
    const bool same = lua_rawequal(L, -1, -2);
    lua_pop(L, 1);
    if (same) keep(L, frame, lua_absindex(L, -2));
  }
  lua_pop(L, 2);
}

}  // namespace dotyk::script

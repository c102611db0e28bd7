#include "script/prompt/kept_locals.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "script/bridge/push.hpp"
#include "script/complete/complete_context.hpp"
#include "script/guard/lua_guards.hpp"

namespace dotyk::script {
namespace {

constexpr char first_name[] = "__keep_locals";  // of a variable that comes before all others: a table, NAME = true of what is <close>

// Reads Lua from left to right and blanks out <const>, wherever it stands: line for line the text stays what it was.
class Declarations {
 public:
  explicit Declarations(const std::string& text) : text_(text) {
    for (Token token = next(); token.kind != Token::end; token = next()) {
      const bool first = at_ == 0;
      at_ = token.after;
      if (word(token) == "local") names(first ? token.begin : std::string::npos);
    }
  }
  std::string text_;
  std::vector<std::string> closing;
  std::size_t first_local = std::string::npos;  // where the text begins with "local", the place
  bool first_is_given = false, first_closes = false;  // … = value, or a function; one of them is <close>

 private:
  Token next() const { return next_token(text_, at_); }
  std::string word(const Token& token) const { return text_.substr(token.begin, token.after - token.begin); }

  bool take(const char* sign) {
    if (word(next()) != sign) return false;
    at_ = next().after;
    return true;
  }

  std::string take_name() {
    const Token token = next();
    if (token.kind != Token::name && token.kind != Token::keyword) return "";
    at_ = token.after;
    return word(token);
  }

  // `first`: where the text begins with this declaration.
  void names(std::size_t first) {
    const bool is_first = first != std::string::npos;
    if (is_first) first_local = first;
    do {
      const auto variable = take_name();
      attribute(variable, is_first);
      if (is_first) first_is_given = variable == "function" || word(next()) == "=";
    } while (take(","));
  }

  void attribute(const std::string& variable, bool first) {
    const auto from = next().begin;
    if (!take("<")) return;
    const auto kind = take_name();
    if (!take(">")) return;
    if (kind == "const") {
      for (auto k = from; k < at_; ++k)
        if (text_[k] != '\n') text_[k] = ' ';
    } else if (kind == "close") {
      closing.push_back(variable);
      first_closes = first_closes || first;
    }
  }

  std::size_t at_ = 0;
};

// The variables of the chunk of that frame as global ones, where it is one of keep_locals().
void keep(lua_State* L, const lua_Debug& chunk) {
  if (!lua_checkstack(L, 8)) return;
  const char* first = lua_getlocal(L, &chunk, 1);
  if (!first) return;
  lua_pushglobaltable(L);
  for (int i = 2; std::strcmp(first, first_name) == 0; ++i) {
    const char* name = lua_getlocal(L, &chunk, i);
    if (!name) break;
    lua_getfield(L, -3, name);
    const bool closed = lua_toboolean(L, -1);
    lua_pop(L, 1);
    if (name[0] == '(' || closed || std::strcmp(name, "_ENV") == 0) {
      lua_pop(L, 1);
      continue;
    }
    if (lua_isnil(L, -1)) declare_global(L, name);
    lua_pushstring(L, name);
    lua_insert(L, -2);
    lua_rawset(L, -3);
  }
  lua_pop(L, 2);
}

// __close of the first variable, while the frame that ends still stands. After an error it does not.
int keep_at_end(lua_State* L) {
  lua_Debug frame;
  if (lua_isnil(L, 2) && lua_getstack(L, 1, &frame)) keep(L, frame);
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

std::string keep_locals(lua_State* L, const std::string& text, const std::string& name) {
  const Declarations declared(text);
  const auto whole = std::string("local ") + first_name + " <close> = " + first_name + "() " + declared.text_;
  if (luaL_loadbufferx(L, whole.data(), whole.size(), name.c_str(), "t") != LUA_OK) {
    lua_pop(L, 1);
    return text;
  }
  lua_remove(L, -2);
  lua_pushglobaltable(L);
  lua_pushstring(L, first_name);
  lua_newtable(L);
  lua_createtable(L, 0, 1);
  set_field(L, "__close", keep_at_end);
  lua_setmetatable(L, -2);
  for (const auto& name : declared.closing) set_field(L, name.c_str(), true);
  lua_pushcclosure(L, first_value, 1);
  lua_rawset(L, -3);
  lua_pop(L, 1);
  return whole;
}

void keep_locals_after_error(lua_State* L) {
  lua_Debug frame;
  int inside = -1, beyond = 1;  // the chunk's frame is the outermost one
  while (lua_getstack(L, beyond - 1, &frame)) inside = beyond - 1, beyond *= 2;
  for (int outside = beyond - 1; outside - inside > 1;) {
    const int middle = (inside + outside) / 2;
    (lua_getstack(L, middle, &frame) ? inside : outside) = middle;
  }
  if (inside >= 0 && lua_getstack(L, inside, &frame)) keep(L, frame);
}

}  // namespace dotyk::script

#include "script/complete.hpp"

#include <algorithm>
#include <utility>

#include "script/complete_context.hpp"
#include "script/enter.hpp"
#include "script/library.hpp"

namespace dotyk::script {
namespace {

// What a chain stands for: a value on top of the Lua stack, or, behind a call,
// only the class that the call returns.
struct Meaning {
  bool value = false;
  const Type* type = nullptr;
  const Descriptor* callable = nullptr;
};

void push_member(lua_State* L, const std::string& name) {
  push(L, name);
  lua_rawget(L, -2);
  if (!lua_isnil(L, -1)) return;
  if (luaL_getmetafield(L, -2, "__index") == LUA_TNIL) return;
  if (lua_istable(L, -1)) {
    push(L, name);
    lua_rawget(L, -2);
  } else {
    lua_pushnil(L);
  }
}

Meaning of_value(lua_State* L, const Library& library) {
  Meaning meaning;
  meaning.value = !lua_isnil(L, -1);
  meaning.type = library.type_at(L, -1);
  meaning.callable = descriptor_at(L, -1);
  return meaning;
}

Meaning of_type(const Type* type) {
  Meaning meaning;
  meaning.type = type;
  return meaning;
}

Meaning of_method(const Type* type, const std::string& name) {
  Meaning meaning;
  meaning.callable = type ? type->method(name) : nullptr;
  return meaning;
}

Meaning advance(lua_State* L, const Library& library, const Meaning& from, const Step& step) {
  if (step.kind == Step::call)
    return of_type(from.callable ? library.find_type(from.callable->returns) : nullptr);
  if (step.kind == Step::method && from.type) return of_method(from.type, step.text);
  if (from.type) {
    const auto* field = from.type->field(step.text);
    if (!field) return of_method(from.type, step.text);
    if (!from.value) return of_type(library.find_type(field->type));
    field->read(L, checked_object(L, -1, from.type->name.c_str()));
    return of_value(L, library);
  }
  if (!from.value || !lua_istable(L, -1)) return {};
  push_member(L, step.text);
  return of_value(L, library);
}

Meaning resolve(lua_State* L, const Library& library, const Chain& chain) {
  luaL_checkstack(L, 4 * static_cast<int>(chain.size()) + 8, nullptr);
  if (chain.empty()) return {};
  lua_pushglobaltable(L);
  push_member(L, chain.front().text);
  auto meaning = of_value(L, library);
  for (std::size_t i = 1; i < chain.size(); ++i) meaning = advance(L, library, meaning, chain[i]);
  return meaning;
}

// The table description the cursor stands in, or null.
const Key* table_around(lua_State* L, const Library& library, const std::vector<Bracket>& brackets) {
  std::vector<std::string> path;
  auto bracket = brackets.rbegin();
  if (bracket == brackets.rend() || bracket->sign != '{') return nullptr;
  while (bracket != brackets.rend() && bracket->callee.empty()) {
    path.push_back(bracket->key);
    ++bracket;
  }
  if (bracket == brackets.rend()) return nullptr;
  const auto meaning = resolve(L, library, bracket->callee);
  if (!meaning.callable) return nullptr;
  const Key* table = nullptr;
  for (const auto& argument : meaning.callable->arguments) {
    if (argument.kind == Kind::table && !table) table = &argument;
  }
  if (bracket->sign == '(' && !path.empty()) path.pop_back();
  for (auto name = path.rbegin(); table && name != path.rend(); ++name) {
    const Key* inner = nullptr;
    if (name->empty() && !table->items.empty()) inner = &table->items.front();
    for (const auto& key : table->keys) {
      if (key.name == *name && !name->empty()) inner = &key;
    }
    table = inner;
  }
  return table;
}

void add_table_members(lua_State* L, std::vector<std::string>& words, bool functions_only) {
  const auto add = [&] {
    for (const auto& name : string_keys(L, -1)) {
      push(L, name);
      const bool fits = lua_rawget(L, -2) == LUA_TFUNCTION || !functions_only;
      lua_pop(L, 1);
      if (fits && name.rfind("__", 0) != 0) words.push_back(name);
    }
  };
  add();
  if (luaL_getmetafield(L, -1, "__index") == LUA_TNIL) return;
  if (lua_istable(L, -1)) add();
  lua_pop(L, 1);
}

std::vector<std::string> members(lua_State* L, const Library& library, const Context& context) {
  std::vector<std::string> words;
  const auto meaning = resolve(L, library, context.chain);
  const bool methods = context.joint == Step::method;
  if (meaning.type) {
    for (const auto& field : meaning.type->fields) {
      if (!methods) words.push_back(field.name);
    }
    for (const auto& method : meaning.type->methods) {
      if (methods) words.push_back(method.short_name());
    }
  } else if (meaning.value && lua_istable(L, -1)) {
    add_table_members(L, words, methods);
  } else if (meaning.value && lua_type(L, -1) == LUA_TSTRING && methods) {
    lua_getglobal(L, "string");
    if (lua_istable(L, -1)) add_table_members(L, words, true);
  }
  return words;
}

std::vector<std::string> free_names(lua_State* L) {
  std::vector<std::string> words = {"and", "break",    "do",     "else", "elseif", "end",   "false",
                                    "for", "function", "if",     "in",   "local",  "nil",   "not",
                                    "or",  "repeat",   "return", "then", "true",   "until", "while"};
  lua_pushglobaltable(L);
  add_table_members(L, words, false);
  return words;
}

std::vector<std::string> choices_of(const Key& key) {
  auto words = key.choices;
  if (key.kind == Kind::either) {
    for (const auto& one : key.keys) words.insert(words.end(), one.choices.begin(), one.choices.end());
  }
  return words;
}

bool takes_file(const Key& key) {
  return key.kind == Kind::file || key.kind == Kind::any || std::any_of(key.keys.begin(), key.keys.end(), takes_file);
}

Completion in_string(lua_State* L, const Library& library, const Context& context) {
  Completion result;
  result.start = context.start;
  bool files = true;  // what is not dotyk's to know may be one
  const auto* table = table_around(L, library, context.brackets);
  for (std::size_t i = 0; table && i < table->keys.size(); ++i) {
    if (table->keys[i].name != context.value_of) continue;
    result.words = choices_of(table->keys[i]);
    files = takes_file(table->keys[i]);
  }
  const bool bracketed =
      context.chain.empty() && !context.brackets.empty() && context.brackets.back().sign == '(';
  const auto& callee = bracketed ? context.brackets.back().callee : context.chain;  // fix "x, fix("x
  const auto called = resolve(L, library, callee);
  if (called.callable && called.callable->name == "help") result.words = library.names();
  if (called.callable && !called.callable->arguments.empty()) {
    const auto& first = called.callable->arguments.front();
    const auto words = choices_of(first);
    files = takes_file(first.kind == Kind::table && !first.keys.empty() ? first.keys.front() : first);
    result.words.insert(result.words.end(), words.begin(), words.end());
  }
  result.file_names = files && result.words.empty();
  return result;
}

Completion candidates(lua_State* L, const Library& library, const Context& context) {
  if (context.in_string) return in_string(L, library, context);
  Completion result;
  result.start = context.start;
  if (context.joint != Step::name) {
    result.words = members(L, library, context);
    return result;
  }
  const auto* table = context.key_position ? table_around(L, library, context.brackets) : nullptr;
  for (std::size_t i = 0; table && i < table->keys.size(); ++i)
    result.words.push_back(table->keys[i].name + " = ");
  const bool keys_only = table && (table->items.empty() || context.word.empty());
  if (keys_only && !result.words.empty()) return result;
  const auto names = free_names(L);
  result.words.insert(result.words.end(), names.begin(), names.end());
  return result;
}

struct Request {
  const std::string& text;
  Completion result;
};

int run(lua_State* L) {
  auto& request = *static_cast<Request*>(lua_touserdata(L, 1));
  const auto context = read_context(request.text);
  try {
    request.result = candidates(L, Library::of(L), context);
  } catch (const std::exception&) {
    request.result = {};  // a released object, say: nothing to offer
  }
  request.result.start = context.start;
  request.result.in_string = context.in_string;
  auto& words = request.result.words;
  std::erase_if(words, [&](const std::string& word) { return word.rfind(context.word, 0) != 0; });
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return 0;
}

}  // namespace

Completion complete(lua_State* L, const std::string& text) {
  Request request{text, {}};
  lua_pushcfunction(L, run);
  lua_pushlightuserdata(L, &request);
  if (lua_pcall(L, 1, 0, 0) != LUA_OK) lua_pop(L, 1);
  return request.result;
}

}  // namespace dotyk::script

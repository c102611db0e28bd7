#include "script/complete/complete.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include "script/complete/complete_context.hpp"
#include "script/complete/complete_meaning.hpp"
#include "script/complete/lua_tokens.hpp"
#include "script/bridge/library.hpp"

namespace dotyk::script {
namespace {

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

std::vector<std::string> members(lua_State* L, const Library& library, const Chain& chain, Step::Kind joint) {
  std::vector<std::string> words;
  const auto meaning = resolve(L, library, chain);
  const bool methods = joint == Step::method;
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
  std::vector<std::string> words;
  lua_pushglobaltable(L);
  add_table_members(L, words, false);
  std::erase_if(words, std::not_fn(is_name));
  std::copy_if(lua_keywords().begin(), lua_keywords().end(), std::back_inserter(words), [](const std::string& word) { return word != "goto"; });
  return words;
}

bool takes_file(const Key& key) {
  return key.kind == Kind::file || key.kind == Kind::any || std::any_of(key.keys.begin(), key.keys.end(), takes_file);
}

// What a string given here may be; either one of several kinds, or of one.
void add_strings(lua_State* L, const Place& place, const Key& key, std::vector<std::string>& words) {
  words.insert(words.end(), key.choices.begin(), key.choices.end());
  if (const int self = place.callee.self; key.names && self) {
    const auto* type = Library::of(L).type_at(L, self);
    const auto names = key.names(checked_object(L, self, type->name.c_str()).get());
    words.insert(words.end(), names.begin(), names.end());
  }
  if (key.kind != Kind::either) return;
  for (const auto& one : key.keys) add_strings(L, place, one, words);
}

Completion in_string(lua_State* L, const Library& library, const Context& context) {
  Completion result;
  const bool index = context.chain.empty() && !context.brackets.empty() && context.brackets.back().sign == '[';
  if (index) {
    result.words = members(L, library, context.brackets.back().callee, Step::field);
    return result;
  }
  const auto place = value_at(L, library, context);
  bool files = true;  // what is not dotyk's to know may be one
  if (place.callee.callable && place.callee.callable->name == "help") {
    result.words = library.names();
    result.words.push_back("prompt");
  }
  else if (place.key) {
    const auto& key = place.key->kind == Kind::table && !place.key->keys.empty() ? place.key->keys.front() : *place.key;
    add_strings(L, place, key, result.words);
    files = takes_file(key);
  }
  result.file_names = files && result.words.empty();
  return result;
}

bool is_of(const Key& key, const std::string& type) {
  if (key.kind == Kind::object) return key.type == type;
  return key.kind == Kind::either &&
         std::any_of(key.keys.begin(), key.keys.end(), [&](const Key& one) { return is_of(one, type); });
}

// The variables that hold what is asked for; else the functions that make it, and
// the methods of what the variables hold.
std::vector<std::string> objects(lua_State* L, const Library& library, const Key& key) {
  std::vector<std::string> held, makers;
  for (const auto& one : library.functions()) {
    if (is_of(key, one.returns)) makers.push_back(one.name);
  }
  lua_pushglobaltable(L);
  for (const auto& name : string_keys(L, -1)) {
    push(L, name);
    lua_rawget(L, -2);
    const auto* type = library.type_at(L, -1);
    lua_pop(L, 1);
    if (!type || name == "_" || !is_name(name)) continue;
    if (is_of(key, type->name)) held.push_back(name);
    for (const auto& method : type->methods) {
      if (is_of(key, method.returns)) makers.push_back(name + ":" + method.short_name());
    }
  }
  return held.empty() ? makers : held;
}

// What may begin at the cursor where a value is wanted and nothing of it typed.
std::vector<std::string> values(lua_State* L, const Library& library, const Context& context) {
  const auto place = value_at(L, library, context);
  if (!place.key) return {};
  if (place.key->kind == Kind::boolean) return {"true", "false"};
  std::vector<std::string> words;
  add_strings(L, place, *place.key, words);
  for (auto& word : words) word = '"' + word + '"';
  const auto more = objects(L, library, *place.key);
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Completion candidates(lua_State* L, const Library& library, const Context& context) {
  if (context.in_string) return in_string(L, library, context);
  Completion result;
  if (context.joint != Step::name) {
    result.words = members(L, library, context.chain, context.joint);
    std::erase_if(result.words, std::not_fn(is_name));  // which only an index in brackets reaches
    return result;
  }
  const auto* table = context.key_position ? table_around(L, library, context).key : nullptr;
  for (std::size_t i = 0; table && i < table->keys.size(); ++i)
    result.words.push_back(table->keys[i].name + " = ");
  if (context.word.empty() && (context.value_position || context.key_position)) {
    const auto fitting = values(L, library, context);
    result.words.insert(result.words.end(), fitting.begin(), fitting.end());
  }
  const bool chosen = context.word.empty() || (table && table->items.empty());
  if (chosen && !result.words.empty()) return result;
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
  if (context.start == 1 && request.text[0] == '%') request.result.words = {"time "};
  request.result.start = context.start;
  request.result.in_string = context.in_string;
  if (context.in_string && !request.result.file_names) request.result.quote = request.text[context.start - 1];
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

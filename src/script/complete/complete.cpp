#include "script/complete/complete.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include "script/complete/complete_context.hpp"
#include "script/bridge/library.hpp"

namespace dotyk::script {
namespace {

// ------------------------------------------------------------ what names before the cursor mean

// What a chain stands for: a value on top of the Lua stack, or, behind a call,
// only the class that the call returns.
struct Meaning {
  bool value = false;
  const Type* type = nullptr;
  const Descriptor* callable = nullptr;
  int self = 0;  // stack index of the object whose method the callable is; 0: not known
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
  return {.value = !lua_isnil(L, -1), .type = library.type_at(L, -1), .callable = descriptor_at(L, -1)};
}

Meaning of_method(lua_State* L, const Meaning& owner, const std::string& name) {
  return {.callable = owner.type ? owner.type->method(name) : nullptr, .self = owner.value ? lua_gettop(L) : 0};
}

Meaning of_item(lua_State* L, const Library& library, const Meaning& from, const std::string& index) {
  if (!from.value || !lua_istable(L, -1) || index.empty()) return {};
  lua_rawgeti(L, -1, std::stoll(index));
  return of_value(L, library);
}

Meaning advance(lua_State* L, const Library& library, const Meaning& from, const Step& step) {
  if (step.kind == Step::call) return {.type = from.callable ? library.find_type(from.callable->returns) : nullptr};
  if (step.kind == Step::item) return of_item(L, library, from, step.text);
  if (step.kind == Step::method && from.type) return of_method(L, from, step.text);
  if (from.type) {
    const auto* field = from.type->field(step.text);
    if (!field) return of_method(L, from, step.text);
    if (!from.value) return {};
    field->read(L, checked_object(L, -1, from.type->name.c_str()));
    return of_value(L, library);
  }
  if (!from.value || !lua_istable(L, -1)) return {};
  push_member(L, step.text);
  return of_value(L, library);
}

// What a table here is to be: the key itself, or the one of its kinds that is a table; its own keys rather than its items.
const Key* as_table(const Key* key) {
  if (!key || key->kind != Kind::either) return key;
  for (const auto kind : {Kind::table, Kind::list})
    for (const auto& one : key->keys)
      if (one.kind == kind) return &one;
  return nullptr;
}

// The table among the arguments that stands after `before` others.
const Key* table_argument(const Descriptor& callable, std::size_t before) {
  const auto& all = callable.arguments;
  if (before < all.size() && all[before].kind == Kind::table) return &all[before];
  for (const auto& argument : all)
    if (argument.kind == Kind::table) return &argument;
  return nullptr;
}

const Key* find_key(const Key& table, const std::string& name) {
  for (const auto& key : table.keys)
    if (key.name == name && !name.empty()) return &key;
  return nullptr;
}

// Leaves values on the stack; no script code is run.
Meaning resolve(lua_State* L, const Library& library, const Chain& chain) {
  luaL_checkstack(L, 4 * static_cast<int>(chain.size()) + 8, nullptr);
  if (chain.empty() || chain.front().kind != Step::name) return {};
  lua_pushglobaltable(L);
  push_member(L, chain.front().text);
  auto meaning = of_value(L, library);
  for (std::size_t i = 1; i < chain.size(); ++i) meaning = advance(L, library, meaning, chain[i]);
  return meaning;
}

// What the value at the cursor may be, as described by the callable it is given
// to, and the object that the callable is a method of.
struct Place {
  const Key* key = nullptr;
  const Meaning callee = {};
};

// Of the table that the cursor stands in.
Place table_around(lua_State* L, const Library& library, const Context& context) {
  std::vector<std::string> path;
  auto bracket = context.brackets.rbegin();
  const auto end = context.brackets.rend();
  if (bracket == end || bracket->sign != '{') return {};
  for (; bracket != end && bracket->callee.empty() && bracket->sign != '['; ++bracket) path.push_back(bracket->key);
  if (bracket == end || bracket->sign == '[') return {};
  const auto meaning = resolve(L, library, bracket->callee);
  if (!meaning.callable) return {};
  const bool in_parentheses = bracket->sign == '(';
  const Key* table = table_argument(*meaning.callable, in_parentheses ? bracket->finished : 0);
  if (in_parentheses && !path.empty()) path.pop_back();
  for (auto name = path.rbegin(); table && name != path.rend(); ++name) {
    const bool item = name->empty() && !table->items.empty();
    table = as_table(item ? &table->items.front() : find_key(*table, *name));
  }
  return {table, meaning};
}

// Of the value: of a key, an item, an argument, or the string in f "…".
Place value_at(lua_State* L, const Library& library, const Context& context) {
  const bool called_at_once = context.in_string && !context.chain.empty();  // f "…
  if (!called_at_once && !context.brackets.empty() && context.brackets.back().sign == '{') {
    const auto [table, callee] = table_around(L, library, context);
    if (!table) return {nullptr, callee};
    if (!context.value_of.empty()) return {find_key(*table, context.value_of), callee};
    return {table->items.empty() ? nullptr : &table->items.front(), callee};
  }
  const bool in_parentheses = !context.brackets.empty() && context.brackets.back().sign == '(';
  if (!called_at_once && !in_parentheses) return {};
  const auto callee = resolve(L, library, called_at_once ? context.chain : context.brackets.back().callee);
  const std::size_t number = called_at_once ? 0 : context.brackets.back().finished;
  if (!callee.callable || number >= callee.callable->arguments.size()) return {nullptr, callee};
  return {&callee.callable->arguments[number], callee};
}

// ------------------------------------------------------------ what fits

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
    for (const auto& field : meaning.type->fields)
      if (!methods) words.push_back(field.name);
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
  for (const auto& one : library.functions())
    if (is_of(key, one.returns)) makers.push_back(one.name);
  lua_pushglobaltable(L);
  for (const auto& name : string_keys(L, -1)) {
    push(L, name);
    lua_rawget(L, -2);
    const auto* type = library.type_at(L, -1);
    lua_pop(L, 1);
    if (!type || name == "_" || !is_name(name)) continue;
    if (is_of(key, type->name)) held.push_back(name);
    for (const auto& method : type->methods)
      if (is_of(key, method.returns)) makers.push_back(name + ":" + method.short_name());
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

Request* asked = nullptr;  // while it is answered; not an argument, for a hook finds the function and may call it with any

int run(lua_State* L) {
  if (!asked) return 0;
  auto& request = *asked;
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
  asked = &request;
  lua_pushcfunction(L, run);
  if (lua_pcall(L, 0, 0, 0) != LUA_OK) lua_pop(L, 1);
  asked = nullptr;
  return request.result;
}

}  // namespace dotyk::script

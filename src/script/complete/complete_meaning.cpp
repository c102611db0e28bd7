#include "script/complete/complete_meaning.hpp"

#include "script/bridge/enter.hpp"
#include "script/bridge/library.hpp"

namespace dotyk::script {
namespace {

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

Meaning of_type(const Type* type) { return {.type = type}; }

Meaning of_method(lua_State* L, const Meaning& owner, const std::string& name) {
  return {.callable = owner.type ? owner.type->method(name) : nullptr, .self = owner.value ? lua_gettop(L) : 0};
}

Meaning of_item(lua_State* L, const Library& library, const Meaning& from, const std::string& index) {
  if (!from.value || !lua_istable(L, -1) || index.empty()) return {};
  lua_rawgeti(L, -1, std::stoll(index));
  return of_value(L, library);
}

Meaning advance(lua_State* L, const Library& library, const Meaning& from, const Step& step) {
  if (step.kind == Step::call)
    return of_type(from.callable ? library.find_type(from.callable->returns) : nullptr);
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
  for (const auto kind : {Kind::table, Kind::list}) {
    for (const auto& one : key->keys) {
      if (one.kind == kind) return &one;
    }
  }
  return nullptr;
}

// The table among the arguments that stands after `before` others.
const Key* table_argument(const Descriptor& callable, std::size_t before) {
  const auto& all = callable.arguments;
  if (before < all.size() && all[before].kind == Kind::table) return &all[before];
  for (const auto& argument : all) {
    if (argument.kind == Kind::table) return &argument;
  }
  return nullptr;
}

const Key* find_key(const Key& table, const std::string& name) {
  for (const auto& key : table.keys) {
    if (key.name == name && !name.empty()) return &key;
  }
  return nullptr;
}

}  // namespace

Meaning resolve(lua_State* L, const Library& library, const Chain& chain) {
  luaL_checkstack(L, 4 * static_cast<int>(chain.size()) + 8, nullptr);
  if (chain.empty() || chain.front().kind != Step::name) return {};
  lua_pushglobaltable(L);
  push_member(L, chain.front().text);
  auto meaning = of_value(L, library);
  for (std::size_t i = 1; i < chain.size(); ++i) meaning = advance(L, library, meaning, chain[i]);
  return meaning;
}

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

}  // namespace dotyk::script

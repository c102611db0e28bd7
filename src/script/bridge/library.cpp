#include "script/bridge/library.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/guard/manifest.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {
namespace {

// The one of that name, by name_of(one); null if there is none.
template <class All, class NameOf>
auto* find_named(All& all, const std::string& name, NameOf name_of) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return std::invoke(name_of, one) == name; });
  return found == all.end() ? nullptr : &*found;
}

// Puts the absent keys' fallbacks into the table at index.
void fill_in(lua_State* L, int index, const Key& table) {
  for (const auto& key : table.keys) {
    lua_getfield(L, index, key.name.c_str());
    const bool absent = lua_isnil(L, -1);
    lua_pop(L, 1);
    if (!absent || std::holds_alternative<std::monostate>(key.default_value)) continue;
    const auto* number = std::get_if<double>(&key.default_value);
    if (number && key.kind == Kind::integer) push(L, static_cast<lua_Integer>(*number));
    else std::visit([L](const auto& value) { push(L, value); }, key.default_value);
    lua_setfield(L, index, key.name.c_str());
  }
}

// A callable written in Lua, called with the checked arguments.
int run_lua(lua_State* L, const Descriptor& descriptor) {
  const int given = lua_gettop(L);
  { const Call call(L, descriptor); }
  const int first = descriptor.owner().empty() ? 1 : 2;
  lua_settop(L, descriptor.takes_table() ? first : given);
  if (descriptor.takes_table()) {
    lua_newtable(L);
    for (lua_pushnil(L); lua_next(L, first);) {
      lua_pushvalue(L, -2);
      lua_insert(L, -2);
      lua_rawset(L, -4);
    }
    fill_in(L, lua_gettop(L), descriptor.arguments[0]);
    lua_replace(L, first);
  }
  push_own_function(L, descriptor.in_lua.file.c_str(), descriptor.in_lua.name.c_str());
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

// The files that the call is to write, as far as they are named.
std::vector<std::string> output_files(const Call& call, const Descriptor& descriptor) {
  std::vector<std::string> out;
  for (const auto& key : descriptor.keys())
    if (key.output && call.has(key.name) && !call.text(key.name).empty()) out.push_back(call.text(key.name));
  return out;
}

int enter(lua_State* L) {
  const auto& descriptor = *static_cast<const Descriptor*>(lua_touserdata(L, lua_upvalueindex(1)));
  return guarded(L, descriptor.short_name(), [&] {
    if (!descriptor.run) return run_lua(L, descriptor);
    Call call(L, descriptor);
    const auto manifest = Library::of(L).manifest;
    const auto files = manifest ? output_files(call, descriptor) : std::vector<std::string>();
    for (const auto& file : files) Manifest::require_place(L, file);  // before the call, so that no file is left without its manifest
    const int results = descriptor.run(call);
    for (const auto& file : files)
      if (std::filesystem::exists(file)) manifest->write(L, file, descriptor.name, descriptor.owner().empty() ? 0 : 1);
    return results;
  });
}

const Type& type_upvalue(lua_State* L) { return *static_cast<const Type*>(lua_touserdata(L, lua_upvalueindex(1))); }

int index_object(lua_State* L) {
  const auto& type = type_upvalue(L);
  return guarded(L, type.name, [&] {
    const auto object = checked_object(L, 1, type.name.c_str());
    if (lua_type(L, 2) != LUA_TSTRING)
      throw ArgumentError(describe_value(L, 2) + " names no field or method of " + with_article(type.name));
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
    const std::string name = lua_tostring(L, 2);
    const auto* field = type.field(name);
    if (!field) throw ArgumentError(unknown_name("field or method", name, type.member_names()));
    field->read(L, object);
    return 1;
  });
}

int set_object(lua_State* L) { raise(L, type_upvalue(L).name, "its fields cannot be set"); }

int show_object(lua_State* L) {
  const auto& type = type_upvalue(L);
  return guarded(L, type.name, [&] {
    const auto* holder = object_at(L, 1, type.name.c_str());
    if (!holder) throw ArgumentError("expected " + with_article(type.name) + ", got " + describe_value(L, 1));
    if (!holder->pointer) push(L, "<released " + type.name + ">");
    else push(L, type.text ? type.text(holder->pointer.get()) : "<" + type.name + ">");
    return 1;
  });
}

// Makes the metatable of a class.
void make_metatable(lua_State* L, const Type& type) {
  luaL_newmetatable(L, type.name.c_str());
  add_object_metamethods(L, type.name);
  lua_newtable(L);
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, "__methods");
  for (const auto& [event, function] : {luaL_Reg{"__index", index_object}, {"__newindex", set_object}, {"__tostring", show_object}}) {
    lua_pushlightuserdata(L, const_cast<Type*>(&type));
    lua_pushvalue(L, -2);
    lua_pushcclosure(L, function, 2);
    lua_setfield(L, -3, event);
  }
  lua_pop(L, 2);
}

void push_function(lua_State* L, const Descriptor& descriptor) {
  lua_pushlightuserdata(L, const_cast<Descriptor*>(&descriptor));
  lua_pushcclosure(L, enter, 1);
}

}  // namespace

const Descriptor* descriptor_at(lua_State* L, int index) {
  if (lua_tocfunction(L, index) != enter || !lua_getupvalue(L, index, 1)) return nullptr;
  const auto* descriptor = static_cast<const Descriptor*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return descriptor;
}

std::vector<std::string> Type::member_names() const {
  std::vector<std::string> names;
  for (const auto& one : fields) names.push_back(one.name);
  for (const auto& one : methods) names.push_back(one.short_name());
  return names;
}

const Descriptor* Type::method(const std::string& method_name) const { return find_named(methods, method_name, &Descriptor::short_name); }

const TypeField* Type::field(const std::string& field_name) const { return find_named(fields, field_name, &TypeField::name); }

Library::Library(lua_State* L) : L_(L) { *static_cast<Library**>(lua_getextraspace(L)) = this; }

Library& Library::of(lua_State* L) { return **static_cast<Library**>(lua_getextraspace(L)); }

void Library::function(Descriptor descriptor) {
  const auto dot = descriptor.name.rfind('.');
  auto& kept = functions_.emplace_back(std::move(descriptor));
  if (kept.returns.empty()) kept.returns = kept.run.returns();
  if (dot == std::string::npos) lua_pushglobaltable(L_);
  else open_module(kept.name.substr(0, dot));
  push(L_, kept.short_name());
  push_function(L_, kept);
  lua_rawset(L_, -3);
  lua_pop(L_, 1);
}

void Library::module(std::string name, std::string help) {
  open_module(name);
  lua_pop(L_, 1);
  modules_.push_back({std::move(name), std::move(help)});
}

// Leaves the table of that dotted name on the stack, making it if need be. A
// module is a table whose metatable has __module, its name.
void Library::open_module(const std::string& path) {
  lua_pushglobaltable(L_);
  std::string whole;
  for (std::size_t start = 0; start <= path.size();) {
    const auto end = std::min(path.find('.', start), path.size());
    const auto name = path.substr(start, end - start);
    whole += (whole.empty() ? "" : ".") + name;
    push(L_, name);
    if (lua_rawget(L_, -2) == LUA_TNIL) {
      lua_pop(L_, 1);
      lua_newtable(L_);
      make_strict(L_, whole);
      lua_getmetatable(L_, -1);
      set_field(L_, "__module", whole);
      lua_pop(L_, 1);
      push(L_, name);
      lua_pushvalue(L_, -2);
      lua_rawset(L_, -4);
    }
    lua_remove(L_, -2);
    start = end + 1;
  }
}

Type& Library::add_type(const char* name, std::string help) {
  auto& type = types_.emplace_back();
  type.name = name;
  type.help = std::move(help);
  make_metatable(L_, type);
  return type;
}

Type& Library::known_type(const std::string& name) {
  if (auto* type = find_named(types_, name, &Type::name)) return *type;
  throw std::logic_error("class '" + name + "' is extended before it is described");
}

void Library::add_method(Type& type, Descriptor descriptor) {
  auto& kept = type.methods.emplace_back(std::move(descriptor));
  if (kept.setup.empty()) kept.setup = type.setup;
  if (kept.returns.empty()) kept.returns = kept.run.returns() == ":" ? type.name : kept.run.returns();
  luaL_getmetatable(L_, type.name.c_str());
  lua_getfield(L_, -1, "__methods");
  push_function(L_, kept);
  lua_setfield(L_, -2, kept.short_name().c_str());
  lua_pop(L_, 2);
}

const Type* Library::find_type(const std::string& name) const { return find_named(types_, name, &Type::name); }

const Descriptor* Library::find(const std::string& name) const {
  if (const auto* function = find_named(functions_, name, &Descriptor::name)) return function;
  for (const auto& type : types_)
    if (const auto* method = find_named(type.methods, name, &Descriptor::name)) return method;
  return nullptr;
}

std::vector<std::string> Library::names() const {
  std::vector<std::string> names;
  const auto add = [&](const std::deque<Descriptor>& callables) {
    for (const auto& one : callables) names.insert(names.end(), {one.name, one.short_name()});
  };
  add(functions_);
  for (const auto& type : types_) {
    names.push_back(type.name);
    add(type.methods);
  }
  for (const auto& one : modules_) names.push_back(one.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

const Type* Library::type_at(lua_State* L, int index) const {
  if (lua_type(L, index) != LUA_TUSERDATA) return nullptr;
  const auto* type = find_type(meta_text(L, index, "__name"));
  return type && object_at(L, index, type->name.c_str()) ? type : nullptr;
}

std::string Library::module_at(lua_State* L, int index) const {
  return lua_type(L, index) == LUA_TTABLE ? meta_text(L, index, "__module") : "";
}

}  // namespace dotyk::script

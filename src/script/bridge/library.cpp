#include "script/bridge/library.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "script/bridge/enter.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {

namespace {

// The one of that name, by name_of(one); null if there is none.
template <class All, class NameOf>
auto* find_named(All& all, const std::string& name, NameOf name_of) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return std::invoke(name_of, one) == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

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
  push_function(L_, kept);
  if (dot == std::string::npos) {
    lua_pushglobaltable(L_);
  } else {
    open_module(kept.name.substr(0, dot));
  }
  lua_insert(L_, -2);
  lua_pushstring(L_, kept.short_name().c_str());
  lua_insert(L_, -2);
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
  push_metatable(L_, type);
  lua_pop(L_, 1);
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
  push_function(L_, kept);
  add_method_to_metatable(L_, type.name.c_str(), kept.short_name().c_str());
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
  for (const auto& one : functions_) {
    names.push_back(one.name);
    if (one.name.find('.') != std::string::npos) names.push_back(one.short_name());
  }
  for (const auto& type : types_) {
    names.push_back(type.name);
    for (const auto& one : type.methods) {
      names.push_back(one.name);
      names.push_back(one.short_name());
    }
  }
  for (const auto& one : modules_) names.push_back(one.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

const Type* Library::type_at(lua_State* L, int index) const {
  if (lua_type(L, index) != LUA_TUSERDATA) return nullptr;
  const int kind = luaL_getmetafield(L, index, "__name");
  const std::string name = kind == LUA_TSTRING ? lua_tostring(L, -1) : "";
  if (kind != LUA_TNIL) lua_pop(L, 1);
  const auto* type = find_type(name);
  return type && object_at(L, index, type->name.c_str()) ? type : nullptr;
}

std::string Library::module_at(lua_State* L, int index) const {
  if (lua_type(L, index) != LUA_TTABLE || luaL_getmetafield(L, index, "__module") == LUA_TNIL) return "";
  const std::string name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return name;
}

}  // namespace dotyk::script

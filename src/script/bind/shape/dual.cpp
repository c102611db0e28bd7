#include "script/bind/shape/bind_shape.hpp"

#include <stdexcept>

#include "script/bind/bind.hpp"
#include "script/bridge/descriptor.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/bridge/push.hpp"

namespace dotyk::script {

void push(lua_State* L, const Dual& dual) {
  luaL_checkstack(L, 8, nullptr);
  push_own_function(L, "dual", "make");
  push(L, dual.value);
  push(L, std::vector<double>(dual.gradient.begin(), dual.gradient.end()));
  lua_call(L, 2, 1);
}

namespace {

bool is_dual(lua_State* L) {
  if (luaL_getmetafield(L, -1, "__name") == LUA_TNIL) return false;
  const bool named = lua_type(L, -1) == LUA_TSTRING && std::string(lua_tostring(L, -1)) == "dual number";
  lua_pop(L, 1);
  return named;
}

double number_field(lua_State* L, const char* name) {
  lua_pushstring(L, name);
  lua_rawget(L, -2);
  const double x = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return x;
}

}  // namespace

Dual take_dual(lua_State* L, Eigen::Index size, const std::string& what) {
  if (size > 0 && lua_type(L, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1)))
    throw std::runtime_error(what + " returned the number " + number_text(lua_tonumber(L, -1)) + ", which has no derivatives: compute with the design's dual numbers, "
                             "not with what .value and design.solution give, or let dotyk.shape take differences");
  const auto fail = [&](const std::string& why) { throw std::runtime_error(what + why); };
  Dual dual{0, algebra::Vector::Zero(size)};
  if (lua_type(L, -1) == LUA_TNUMBER) {
    dual.value = lua_tonumber(L, -1);
  } else if (is_dual(L)) {
    dual.value = number_field(L, "value");
    lua_pushstring(L, "gradient");
    lua_rawget(L, -2);
    if (lua_type(L, -1) != LUA_TTABLE || static_cast<Eigen::Index>(lua_rawlen(L, -1)) != size)
      fail(text(" returned a dual number with another number of derivatives than ", size));
    for (Eigen::Index i = 0; i < size; ++i) {
      lua_rawgeti(L, -1, static_cast<lua_Integer>(i) + 1);
      dual.gradient[i] = lua_tonumber(L, -1);
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
  } else {
    fail(" returned " + describe_value(L, -1) + ", expected a number or a dual number (what the design's fields and methods give)");
  }
  if (!std::isfinite(dual.value)) fail(std::isnan(dual.value) ? std::string(" returned nan (not a number)") : text(" returned ", dual.value, "; it must be finite"));
  for (Eigen::Index i = 0; i < size; ++i)
    if (!std::isfinite(dual.gradient[i]))
      fail(text(" returned ", dual.value, ", whose derivative by design variable ", i + 1, " is ", std::isnan(dual.gradient[i]) ? "not a number" : "infinite"));
  lua_pop(L, 1);
  return dual;
}

}  // namespace dotyk::script

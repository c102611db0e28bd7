#pragma once
// What a key gives to the member of a struct that takes its value (Key::into), by the type of the member.
#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "script/bridge/arguments.hpp"

namespace dotyk::script {

inline void take(const Arguments& from, const std::string& name, double& into) { into = from.number(name); }
inline void take(const Arguments& from, const std::string& name, bool& into) { into = from.is_choice(name) ? from.choice<bool>(name) : from.boolean(name); }
inline void take(const Arguments& from, const std::string& name, std::string& into) { into = from.text(name); }
inline void take(const Arguments& from, const std::string& name, std::vector<double>& into) { into = from.vector(name); }
template <std::size_t size>
void take(const Arguments& from, const std::string& name, std::array<double, size>& into) {
  std::copy_n(from.vector(name).begin(), size, into.begin());
}
template <std::integral Integer>
void take(const Arguments& from, const std::string& name, Integer& into) {
  into = static_cast<Integer>(std::min<long long>(from.integer(name), std::numeric_limits<Integer>::max()));
}
template <class Enum>
requires std::is_enum_v<Enum>
void take(const Arguments& from, const std::string& name, Enum& into) {
  into = from.choice<Enum>(name);
}
template <class Value>
void take(const Arguments& from, const std::string& name, std::optional<Value>& into) {
  take(from, name, into.emplace());
}

template <class Struct, class Member>
Key& Key::into(Member member) {
  Struct standard{};
  const auto own = member(standard);  // the default
  using Value = std::remove_const_t<decltype(own)>;
  if (!needed && default_text.empty()) {
    if constexpr (std::is_same_v<Value, bool>) {
      kind == Kind::choice ? choice_fallback(own) : fallback(own);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      if (in_range(own)) fallback(static_cast<double>(own));
    } else if constexpr (requires { fallback(own); }) {
      fallback(own);
    }
  }
  const auto set = [key = name, member](const Arguments& from, void* all) { from.read(key, member(*static_cast<Struct*>(all))); };
  targets.push_back({&typeid(Struct), set});
  return *this;
}

}  // namespace dotyk::script

#pragma once
// Keys that know which member of a struct takes their value: described, checked and read in one place.
#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "script/bridge/arguments.hpp"

namespace dotyk::script {

inline void take(const Arguments& from, const std::string& name, double& into) { into = from.number(name); }
inline void take(const Arguments& from, const std::string& name, bool& into) { into = from.boolean(name); }
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

template <class Struct>
class Bound {
 public:
  struct Entry {
    // `member` is a member of the struct, or a function of it that gives a reference. What no value is given for stays as the
    // struct has it: that is the default which help shows, unless the key is required or says otherwise.
    template <class Member>
    Entry(Key described, Member member) : key(std::move(described)) {
      Struct standard{};
      const bool own = !key.needed && key.default_text.empty();
      using Value = std::remove_reference_t<decltype(std::invoke(member, standard))>;
      if constexpr (std::is_same_v<Value, int>) {
        if (own) key.fallback(static_cast<double>(std::invoke(member, standard)));
      } else if constexpr (requires { key.fallback(std::invoke(member, standard)); }) {
        if (own) key.fallback(std::invoke(member, standard));
      }
      read = [name = key.name, member](const Arguments& from, Struct& into) {
        from.read(name, std::invoke(member, into));
      };
    }
    Entry(Key described) : key(std::move(described)) {}  // read elsewhere
    Key key;
    std::function<void(const Arguments&, Struct&)> read;
  };
  Bound(std::initializer_list<Entry> entries) : entries_(entries) {}

  std::vector<Key> keys() const {
    std::vector<Key> all;
    for (const Entry& entry : entries_) all.push_back(entry.key);
    return all;
  }
  void read(const Arguments& from, Struct& into) const {
    for (const Entry& entry : entries_)
      if (entry.read) entry.read(from, into);
  }
  Struct read(const Arguments& from) const {
    Struct into{};
    read(from, into);
    return into;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace dotyk::script

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string_view>
#include <utility>

#include "script/prompt/interrupt.hpp"
#include "script/guard/lua_guards.hpp"

namespace dotyk::script {
namespace {

std::string_view text_at(lua_State* L, int index) {
  std::size_t size = 0;
  const char* text = luaL_checklstring(L, index, &size);
  return {text, size};
}

struct Match {
  const char *begin = nullptr, *end = nullptr;  // null: none
};

// Patterns (Lua's manual, 6.4.1) by the rules of its own lstrlib.c, and with its errors, but with a look at Ctrl-C at every
// item. `s` is a place in the text, `p` one in the pattern; behind both there is a zero.
class Matcher {
 public:
  // The strings at 1 and 2 of the stack, which outlive it.
  Matcher(lua_State* L, bool anchors) : L_(L), text_(text_at(L, 1)), pattern_(text_at(L, 2)), anchored_(anchors && pattern_.starts_with('^')) {
    if (anchored_) pattern_.remove_prefix(1);
  }

  // The first match that begins at `from` or behind it and does not end at `last`, the end of the one before; an anchored
  // pattern has one at `from` or none.
  Match find(const char* from, const char* last = nullptr) {
    if (anchored_ && last) return {};
    for (const char* begin = from; begin <= text_end(); ++begin) {
      level_ = depth_ = 0;
      const char* end = match(begin, pattern_.data());
      if (end && end != last) return {begin, end};
      if (anchored_) break;
    }
    return {};
  }

  // Capture k of the last match, from 0; the whole is capture -1, and 0 where the pattern has none.
  void push_capture(int k, const Match& whole) {
    if (k >= level_ && k > 0) luaL_error(L_, "invalid capture index %%%d", k + 1);
    const Capture one = k >= 0 && k < level_ ? captures_[k] : Capture{whole.begin, whole.end - whole.begin};
    if (one.size == kOpen) luaL_error(L_, "unfinished capture");
    if (one.size == kPlace) lua_pushinteger(L_, one.begin - text_.data() + 1);
    else lua_pushlstring(L_, one.begin, static_cast<std::size_t>(one.size));
  }

  int push_captures(const Match& whole) {  // all; how many
    const int count = level_ == 0 && whole.begin ? 1 : level_;
    luaL_checkstack(L_, count, "too many captures");
    for (int k = 0; k < count; ++k) push_capture(k, whole);
    return count;
  }

 private:
  static constexpr std::ptrdiff_t kOpen = -1, kPlace = -2;
  static constexpr int kMostCaptures = 32, kDeepest = 200;
  struct Capture {
    const char* begin;
    std::ptrdiff_t size;  // or kOpen, or kPlace of "()"
  };

  const char* text_end() const { return text_.data() + text_.size(); }
  const char* pattern_end() const { return pattern_.data() + pattern_.size(); }

  // The end of the match of the pattern from p on that begins at s; null: none.
  const char* match(const char* s, const char* p) {
    if (++depth_ > kDeepest) luaL_error(L_, "pattern too complex");
    s = match_items(s, p);
    --depth_;
    return s;
  }

  const char* match_items(const char* s, const char* p) {
    while (s && p != pattern_end()) {
      raise_if_interrupted(L_);
      const char kind = *p == '%' ? p[1] : 0;
      if (*p == '(') return p[1] == ')' ? match_capture(s, p + 2, kPlace) : match_capture(s, p + 1, kOpen);
      if (*p == ')') return close_capture(s, p + 1);
      if (*p == '$' && p + 1 == pattern_end()) return s == text_end() ? s : nullptr;
      if (kind == 'b') {
        s = after_balanced(s, p + 2);
        p += 4;
      } else if (kind == 'f') {
        if (p[2] != '[') luaL_error(L_, "missing '[' after '%%f' in pattern");
        const char* set = p + 2;
        p = after_item(set);
        if (in_set(s == text_.data() ? '\0' : s[-1], set, p - 1) || !in_set(*s, set, p - 1)) return nullptr;
      } else if (std::isdigit(letter(kind))) {
        s = after_repeated(s, kind);
        p += 2;
      } else {
        const char *after = after_item(p), sign = after == pattern_end() ? '\0' : *after;
        const bool fits = fits_item(s, p, after);
        if (fits && (sign == '*' || sign == '+')) return match_most(sign == '+' ? s + 1 : s, p, after);
        if (fits && sign == '-') return match_fewest(s, p, after);
        if (fits && sign == '?')
          if (const char* end = match(s + 1, after + 1)) return end;
        const bool optional = sign == '?' || (!fits && (sign == '*' || sign == '-'));
        if (!optional) s = fits ? s + 1 : nullptr;
        p = optional ? after + 1 : after;
      }
    }
    return s;
  }

  const char* match_most(const char* s, const char* p, const char* after) {
    const char* end = s;
    while (fits_item(end, p, after)) ++end;
    for (; end >= s; --end)
      if (const char* found = match(end, after + 1)) return found;
    return nullptr;
  }

  const char* match_fewest(const char* s, const char* p, const char* after) {
    for (;; ++s) {
      if (const char* found = match(s, after + 1)) return found;
      if (!fits_item(s, p, after)) return nullptr;
    }
  }

  const char* match_capture(const char* s, const char* p, std::ptrdiff_t size) {
    if (level_ >= kMostCaptures) luaL_error(L_, "too many captures");
    captures_[level_++] = {s, size};
    const char* end = match(s, p);
    if (!end) --level_;
    return end;
  }

  const char* close_capture(const char* s, const char* p) {
    int k = level_ - 1;
    while (k >= 0 && captures_[k].size != kOpen) --k;
    if (k < 0) luaL_error(L_, "invalid pattern capture");
    captures_[k].size = s - captures_[k].begin;
    const char* end = match(s, p);
    if (!end) captures_[k].size = kOpen;
    return end;
  }

  // %1 to %9
  const char* after_repeated(const char* s, char digit) {
    const int k = digit - '1';
    if (k < 0 || k >= level_ || captures_[k].size == kOpen) luaL_error(L_, "invalid capture index %%%d", k + 1);
    const auto [begin, size] = captures_[k];
    const bool same = size != kPlace && size <= text_end() - s && std::memcmp(begin, s, static_cast<std::size_t>(size)) == 0;
    return same ? s + size : nullptr;
  }

  // %bxy, the two letters at p
  const char* after_balanced(const char* s, const char* p) {
    if (p >= pattern_end() - 1) luaL_error(L_, "malformed pattern (missing arguments to '%%b')");
    if (*s != *p) return nullptr;
    int open = 1;
    while (++s < text_end()) {
      if (*s == p[1]) {
        if (--open == 0) return s + 1;
      } else if (*s == *p) {
        ++open;
      }
    }
    return nullptr;
  }

  const char* after_item(const char* p) {
    if (*p == '%') {
      if (p + 1 == pattern_end()) luaL_error(L_, "malformed pattern (ends with '%%')");
      return p + 2;
    }
    if (*p != '[') return p + 1;
    p += p[1] == '^' ? 2 : 1;
    do {  // a ']' that comes first stands for itself
      if (p == pattern_end()) luaL_error(L_, "malformed pattern (missing ']')");
      if (*p++ == '%' && p < pattern_end()) ++p;
    } while (*p != ']');
    return p + 1;
  }

  bool fits_item(const char* s, const char* p, const char* after) const {
    if (s >= text_end()) return false;
    if (*p == '[') return in_set(*s, p, after - 1);
    return *p == '.' || (*p == '%' ? in_class(*s, p[1]) : *s == *p);
  }

  // [set], whose brackets are at p and `end`.
  static bool in_set(char c, const char* p, const char* end) {
    const bool inside = p[1] != '^';
    if (!inside) ++p;
    while (++p < end) {
      if (*p == '%') {
        if (in_class(c, *++p)) return inside;
      } else if (p[1] == '-' && p + 2 < end) {
        if (letter(*p) <= letter(c) && letter(c) <= letter(p[2])) return inside;
        p += 2;
      } else if (*p == c) {
        return inside;
      }
    }
    return !inside;
  }

  static bool in_class(char c, char name) {
    static constexpr std::pair<char, int (*)(int)> classes[] = {
        {'a', std::isalpha}, {'c', std::iscntrl}, {'d', std::isdigit}, {'g', std::isgraph}, {'l', std::islower},
        {'p', std::ispunct}, {'s', std::isspace}, {'u', std::isupper}, {'w', std::isalnum}, {'x', std::isxdigit},
        {'z', [](int letter) { return static_cast<int>(letter == 0); }}};
    for (const auto& [known, holds] : classes)
      if (known == std::tolower(letter(name))) return (holds(letter(c)) != 0) == (std::isupper(letter(name)) == 0);
    return name == c;
  }

  static unsigned char letter(char c) { return static_cast<unsigned char>(c); }

  lua_State* L_;
  std::string_view text_, pattern_;
  bool anchored_;
  Capture captures_[kMostCaptures];
  int level_ = 0, depth_ = 0;
};

// Where argument 3 says to begin, from 0 on, in the text of argument 1; beyond its end: size + 1.
std::size_t first_place(lua_State* L) {
  const auto size = static_cast<lua_Integer>(text_at(L, 1).size());
  const lua_Integer given = luaL_optinteger(L, 3, 1);
  const lua_Integer from = given > 0 ? given : given == 0 || given < -size ? 1 : size + given + 1;
  return static_cast<std::size_t>(std::min(from - 1, size + 1));
}

// Where text is looked for as it stands, the C library does it in linear time; Lua does not.
Match find_plain(lua_State* L, std::size_t from) {
  const std::string_view text = text_at(L, 1), wanted = text_at(L, 2);
  const auto* found = static_cast<const char*>(memmem(text.data() + from, text.size() - from, wanted.data(), wanted.size()));
  return found ? Match{found, found + wanted.size()} : Match();
}

int find(lua_State* L) {
  Matcher matcher(L, true);
  const std::string_view text = text_at(L, 1);
  const std::size_t from = first_place(L);
  const bool plain = lua_toboolean(L, 4) || text_at(L, 2).find_first_of("^$*+?.([%-") == std::string_view::npos;
  const Match found = from > text.size() ? Match() : plain ? find_plain(L, from) : matcher.find(text.data() + from);
  if (!found.begin) return lua_pushnil(L), 1;
  lua_pushinteger(L, found.begin - text.data() + 1);
  lua_pushinteger(L, found.end - text.data());
  return 2 + matcher.push_captures({});
}

int match(lua_State* L) {
  Matcher matcher(L, true);
  const Match found = matcher.find(text_at(L, 1).data() + first_place(L));
  if (!found.begin) return lua_pushnil(L), 1;
  return matcher.push_captures(found);
}

// Where gmatch looks on, and where its last match ended.
struct Progress {
  const char *from, *last;
};

// Upvalues: text, pattern, Progress.
int next_match(lua_State* L) {
  lua_settop(L, 0);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_pushvalue(L, lua_upvalueindex(2));
  auto& progress = *static_cast<Progress*>(lua_touserdata(L, lua_upvalueindex(3)));
  Matcher matcher(L, false);
  const Match found = matcher.find(progress.from, progress.last);
  if (!found.begin) return 0;
  progress = {found.end, found.end};
  return matcher.push_captures(found);
}

int gmatch(lua_State* L) {
  const char* from = text_at(L, 1).data();
  text_at(L, 2);
  from += first_place(L);
  lua_settop(L, 2);
  *static_cast<Progress*>(lua_newuserdatauv(L, sizeof(Progress), 0)) = {from, nullptr};
  lua_pushcclosure(L, next_match, 3);
  return 1;
}

// A text in place of a match: % and a digit stand for a capture, %0 for the whole.
void add_replacement(lua_State* L, luaL_Buffer& out, Matcher& matcher, const Match& found) {
  const std::string_view text = text_at(L, 3);
  for (const char* at = text.data(); at != text.data() + text.size(); ++at) {
    if (*at == '%' && std::isdigit(static_cast<unsigned char>(at[1]))) {
      matcher.push_capture(*++at - '1', found);
      luaL_addvalue(&out);
    } else {
      if (*at == '%' && *++at != '%') luaL_error(L, "invalid use of '%c' in replacement string", '%');
      luaL_addchar(&out, *at);
    }
  }
}

// The value of a table, or what a function gives, in place of a match, which stays where that is false or nil.
void add_value(lua_State* L, luaL_Buffer& out, Matcher& matcher, const Match& found) {
  if (lua_istable(L, 3)) {
    matcher.push_capture(0, found);
    lua_gettable(L, 3);
  } else {
    lua_pushvalue(L, 3);
    lua_call(L, matcher.push_captures(found), 1);
  }
  if (!lua_toboolean(L, -1)) {
    lua_pop(L, 1);
    matcher.push_capture(-1, found);
  } else if (!lua_isstring(L, -1)) {
    luaL_error(L, "invalid replacement value (a %s)", luaL_typename(L, -1));
  }
  luaL_addvalue(&out);
}

int gsub(lua_State* L) {
  Matcher matcher(L, true);
  const std::string_view text = text_at(L, 1);
  const lua_Integer most = luaL_optinteger(L, 4, LUA_MAXINTEGER);
  luaL_argexpected(L, lua_isstring(L, 3) || lua_istable(L, 3) || lua_isfunction(L, 3), 3, "string/function/table");
  luaL_Buffer out;
  luaL_buffinit(L, &out);
  const char *copied = text.data(), *last = nullptr;
  lua_Integer count = 0;
  for (; count < most; ++count) {
    const Match found = matcher.find(copied, last);
    if (!found.begin) break;
    luaL_addlstring(&out, copied, static_cast<std::size_t>(found.begin - copied));
    (lua_isstring(L, 3) ? add_replacement : add_value)(L, out, matcher, found);
    copied = last = found.end;
  }
  luaL_addlstring(&out, copied, static_cast<std::size_t>(text.data() + text.size() - copied));
  luaL_pushresult(&out);
  lua_pushinteger(L, count);
  return 2;
}

}  // namespace

void guard_patterns(lua_State* L) {
  replace(L, {{"string", "find", find}, {"string", "match", match}, {"string", "gmatch", gmatch}, {"string", "gsub", gsub}});
}

}  // namespace dotyk::script

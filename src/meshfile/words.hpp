#pragma once

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/in_quotes.hpp"
#include "base/text.hpp"

namespace dotyk::meshfile {

/// The words of a mesh file, without comments (# to the end of the line), and bytes between them. Where something else is
/// there, it throws InputError: `what`, the line, unless `binary()`, and what was expected.
class Words {
 public:
  Words(std::string_view all, std::string what) : all_(all), left_(all), what_(std::move(what)) {}

  /// Empty at the end.
  std::string_view next() {
    skip_spaces();
    std::size_t n = 0;
    while (n < left_.size() && !space(left_[n]) && left_[n] != '#') ++n;
    return take(n);
  }
  /// What is left of the line, with the end of which it goes on.
  std::string_view line() {
    const std::string_view rest = take(std::min(left_.find('\n'), left_.size()));
    take(!left_.empty());
    return rest.ends_with('\r') ? rest.substr(0, rest.size() - 1) : rest;
  }

  template <class Number>
  Number number(const char* of) {
    const std::string_view word = next();
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty()) fail(text("it ends where ", of, " should be"));
    if (error != std::errc() || end != word.data() + word.size()) fail(text(in_quotes(word), " where ", of, " should be"));
    return value;
  }
  void bytes(void* to, std::size_t size, const char* of) {
    if (size > left_.size()) fail(text("it ends where ", of, " should be"));
    std::memcpy(to, take(size).data(), size);
  }

  /// Returns n, a number of things that take two characters each at least.
  long long count(long long n, const char* of) const {
    if (n < 0 || n > static_cast<long long>(left_.size())) fail(text(n, " as ", of, "; the file is too short for that"));
    return n;
  }
  int count(const char* of) { return static_cast<int>(count(number<int>(of), of)); }

  /// Do these characters come next, after spaces?
  bool ahead(std::string_view these) {
    const std::string_view before = left_;
    skip_spaces();
    const bool here = left_.starts_with(these);
    left_ = before;
    return here;
  }
  /// Goes beyond the next place of these characters, where there is one.
  bool skip_beyond(std::string_view these) {
    const std::size_t at = left_.find(these);
    if (at != std::string_view::npos) take(at + these.size());
    return at != std::string_view::npos;
  }
  void binary() { lines_ = false; }

  [[noreturn]] void fail(const std::string& why) const {
    const std::string_view before = all_.substr(0, all_.size() - left_.size());
    throw InputError(text(what_, lines_ ? text(", line ", 1 + std::count(before.begin(), before.end(), '\n')) : "", ": ", why));
  }

 private:
  static bool space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip_spaces() {
    while (!left_.empty() && (space(left_.front()) || left_.front() == '#'))
      left_.remove_prefix(left_.front() == '#' ? std::min(left_.find('\n'), left_.size()) : 1);
  }
  std::string_view take(std::size_t n) {
    const std::string_view taken = left_.substr(0, n);
    left_.remove_prefix(n);
    return taken;
  }

  std::string_view all_, left_;
  std::string what_;
  bool lines_ = true;
};

}  // namespace dotyk::meshfile

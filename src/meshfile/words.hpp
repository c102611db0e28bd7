#pragma once

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/listed.hpp"

namespace dotyk::meshfile {

/// The words of a mesh file, without comments (# to the end of the line), and bytes between them. Where something else is there
/// than was expected, it throws InputError: `what`, the line and what was expected.
class Words {
 public:
  Words(std::string_view all, std::string what) : all_(all), left_(all), what_(std::move(what)) {}

  /// Empty at the end.
  std::string_view next() {
    skip_spaces();
    return take(std::min(left_.find_first_of(" \t\n\r#"), left_.size()));
  }
  /// What is left of the line; the next word is on the next one.
  std::string_view line() {
    const std::string_view rest = take(std::min(left_.find('\n'), left_.size()));
    take(std::min<std::size_t>(1, left_.size()));
    return rest.substr(0, rest.size() - rest.ends_with('\r'));
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
  /// n, a number of things that take two characters each at least.
  long long count(long long n, const char* of) const {
    if (n < 0 || n > static_cast<long long>(left_.size())) fail(text(n, " as ", of, "; the file is too short for that"));
    return n;
  }
  int count(const char* of) { return static_cast<int>(count(number<int>(of), of)); }
  void bytes(void* to, std::size_t size, const char* of) {
    if (size > left_.size()) fail(text("it ends where ", of, " should be"));
    std::memcpy(to, take(size).data(), size);
  }
  /// Do these characters come next, after spaces?
  bool ahead(std::string_view these) const {
    return left_.substr(std::min(left_.find_first_not_of(" \t\n\r"), left_.size())).starts_with(these);
  }
  /// Goes beyond the next place of these characters, where there is one.
  bool skip_beyond(std::string_view these) {
    const std::size_t at = left_.find(these);
    take(at == std::string_view::npos ? 0 : at + these.size());
    return at != std::string_view::npos;
  }
  [[noreturn]] void fail(const std::string& why) const {
    const std::string_view before = all_.substr(0, all_.size() - left_.size());
    const bool lines = all_.find('\0') == std::string_view::npos;  // not of binary files
    throw InputError(text(what_, lines ? text(", line ", 1 + std::count(before.begin(), before.end(), '\n')) : "", ": ", why));
  }

 private:
  void skip_spaces() {
    for (std::size_t n; (n = std::min(left_.find_first_not_of(" \t\n\r"), left_.size())) > 0 || left_.starts_with('#');)
      take(n > 0 ? n : std::min(left_.find('\n'), left_.size()));
  }
  std::string_view take(std::size_t n) {
    const std::string_view taken = left_.substr(0, n);
    left_.remove_prefix(n);
    return taken;
  }

  std::string_view all_, left_;
  std::string what_;
};

}  // namespace dotyk::meshfile

#include "script/guard/harmless_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <new>

namespace dotyk::script {
namespace {

// Bytes of the letter of UTF-8 that begins with `first`; 1 where none of several does.
std::size_t length_of(unsigned char first) {
  if (first < 0xc2 || first > 0xf4) return 1;
  return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

// The least second byte: none of U+0080 to U+009F, and no letter with more bytes than it needs.
unsigned char least_second(unsigned char first) {
  return first == 0xc2 || first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
}

bool is_plain(unsigned char c) { return c == '\n' || c == '\t' || (c >= ' ' && c < 0x7f); }

struct Output {
  int file;
  std::string rest;
};

ssize_t write_harmless(void* to, const char* bytes, std::size_t size) {
  auto& output = *static_cast<Output*>(to);
  const std::string text = harmless(output.rest + std::string(bytes, size), output.rest);
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = ::write(output.file, text.data() + at, text.size() - at);
    if (n < 0 && errno != EINTR) return 0;
    if (n > 0) at += static_cast<std::size_t>(n);
  }
  return static_cast<ssize_t>(size);
}

std::FILE* harmless_stream(int file, int buffering) {
  cookie_io_functions_t functions{};
  functions.write = write_harmless;
  std::FILE* stream = fopencookie(new Output{file, ""}, "w", functions);  // needed until the program ends
  if (!stream) throw std::bad_alloc();
  std::setvbuf(stream, nullptr, buffering, 1 << 16);
  return stream;
}

}  // namespace

std::string harmless(std::string_view text, std::string& rest) {
  std::string out;
  rest.clear();
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = length_of(first);
    std::size_t known = 1;
    for (; known < length && i + known < text.size(); ++known) {
      const auto next = static_cast<unsigned char>(text[i + known]);
      if (next < (known == 1 ? least_second(first) : 0x80) || next > 0xbf) break;
    }
    const auto bytes = text.substr(i, known);
    i += known;
    if (known < length && i == text.size()) {
      rest = bytes;
    } else if (length > 1 ? known == length : is_plain(first)) {
      out += bytes;
    } else {
      for (const char c : bytes) {
        char hex[8];
        std::snprintf(hex, sizeof hex, "\\x%02x", static_cast<unsigned char>(c));
        out += hex;
      }
    }
  }
  return out;
}

void make_output_harmless() {
  stdout = harmless_stream(STDOUT_FILENO, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF);
  stderr = harmless_stream(STDERR_FILENO, _IONBF);
}

}  // namespace dotyk::script

#pragma once
// What a reader's process hands over: numbers of this machine and sequences of them, one after the other, then a word
// that says that the answer is whole.

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace dotyk::reader {

constexpr std::uint64_t kWhole = 0x646f74796b6d6573;  // "dotykmes"
constexpr int kNoMemory = 3;                          ///< status of a reader that memory did not suffice for

/// Throws std::runtime_error where it cannot be written.
template <class T>
void put(std::FILE* out, const T& value) {
  if (std::fwrite(&value, sizeof value, 1, out) != 1) throw std::runtime_error("what was read could not be handed over");
}

template <class Sequence>
void put_all(std::FILE* out, const Sequence& values) {
  put(out, static_cast<std::uint64_t>(values.size()));
  if (!values.empty() && std::fwrite(values.data(), sizeof values[0], values.size(), out) != values.size())
    throw std::runtime_error("what was read could not be handed over");
}

inline void put_end(std::FILE* out) {
  put(out, kWhole);
  if (std::fflush(out) != 0) throw std::runtime_error("what was read could not be handed over");
}

/// The other side; throws std::runtime_error where the bytes are not whole.
class Answer {
 public:
  explicit Answer(std::string_view bytes) : left_(bytes) {}

  template <class T>
  T get() {
    T value;
    take(&value, sizeof value);
    return value;
  }
  template <class Sequence>
  Sequence get_all() {
    const auto count = get<std::uint64_t>();
    if (count > left_.size() / sizeof(typename Sequence::value_type)) fail();
    Sequence values(count, typename Sequence::value_type{});
    take(values.data(), count * sizeof(typename Sequence::value_type));
    return values;
  }
  void end() {
    if (get<std::uint64_t>() != kWhole) fail();
  }

 private:
  [[noreturn]] static void fail() { throw std::runtime_error("the reader's answer is not whole"); }
  void take(void* to, std::size_t size) {
    if (size > left_.size()) fail();
    if (size) std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }

  std::string_view left_;
};

}  // namespace dotyk::reader

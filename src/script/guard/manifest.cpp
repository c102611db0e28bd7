#include "script/guard/manifest.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <utility>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "script/bridge/library.hpp"
#include "script/commit.hpp"

namespace dotyk::script {
namespace {

using State = std::array<std::uint32_t, 8>;

// The first 32 bits of the fractional part of a root, whose digits these constants are (4.2.2, 5.3.3). A
// long double has 64 bits, of which at most 5 are before the point.
std::uint32_t fraction(long double root) {
  return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
}

struct Constants {
  State start{};                      // square roots of the first 8 primes
  std::array<std::uint32_t, 64> k{};  // cube roots of the first 64
  Constants() {
    int found = 0;
    for (int n = 2; found < 64; ++n) {
      bool prime = true;
      for (int d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
      if (!prime) continue;
      if (found < 8) start[static_cast<std::size_t>(found)] = fraction(std::sqrt(static_cast<long double>(n)));
      k[static_cast<std::size_t>(found++)] = fraction(std::cbrt(static_cast<long double>(n)));
    }
  }
};

// One block of 64 bytes (6.2.2).
void add_block(State& state, const unsigned char* block, const Constants& constants) {
  std::array<std::uint32_t, 64> w;
  for (std::size_t t = 0; t < 16; ++t)
    w[t] = static_cast<std::uint32_t>(block[4 * t] << 24 | block[4 * t + 1] << 16 | block[4 * t + 2] << 8 | block[4 * t + 3]);
  for (std::size_t t = 16; t < 64; ++t) {
    const auto a = w[t - 15], b = w[t - 2];
    w[t] = w[t - 16] + w[t - 7] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const auto first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + ((e & f) ^ (~e & g)) + constants.k[t] + w[t];
    const auto second = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + first, d = c, c = b, b = a, a = first + second;
  }
  const State sum = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state[i] += sum[i];
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

// A value of one line.
std::string line(const std::string& name, std::string value) {
  for (char& c : value)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return name + ": " + value + "\n";
}

// Of a solution: the method as it was given, else by name, and how it ended.
std::string about_solution(lua_State* L, int object) {
  const auto* type = Library::of(L).type_at(L, object);
  if (!type || !type->field("converged")) return "";
  luaL_checkstack(L, 8, nullptr);
  const int top = lua_gettop(L);
  std::string lines;
  if (lua_getiuservalue(L, object, 1) == LUA_TTABLE && lua_getfield(L, -1, "solver") != LUA_TNIL)
    lines += line("solver", luaL_tolstring(L, -1, nullptr));
  lua_settop(L, top);
  for (const char* name : {"method", "converged", "reason", "iterations", "unknowns", "rows"}) {
    const auto* field = type->field(name);
    if (!field) continue;
    field->read(L, checked_object(L, object, type->name.c_str()));
    lines += line(std::string("solution ") + name, luaL_tolstring(L, -1, nullptr));
    lua_settop(L, top);
  }
  return lines;
}

std::string beside(const std::string& file) { return file + ".manifest"; }

}  // namespace

std::string sha256(const std::string& bytes) {
  static const Constants constants;
  std::string padded = bytes + '\x80';  // then zeros up to the length in bits (5.1.1)
  padded.append((120 - padded.size() % 64) % 64, '\0');
  for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>(static_cast<std::uint64_t>(bytes.size()) * 8 >> shift);
  State state = constants.start;
  for (std::size_t at = 0; at < padded.size(); at += 64)
    add_block(state, reinterpret_cast<const unsigned char*>(padded.data()) + at, constants);
  std::string digits;
  for (const auto word : state)
    for (int shift = 28; shift >= 0; shift -= 4) digits += "0123456789abcdef"[word >> shift & 15];
  return digits;
}

Manifest::Manifest(std::string script, std::optional<std::string> text, std::vector<std::string> arguments)
    : script_(std::move(script)), hash_(text ? sha256(*text) : "not known"), arguments_(std::move(arguments)) {}

void Manifest::require_place(lua_State* L, const std::string& file) {
  if (const auto& folder = Library::of(L).folder) folder->require(beside(file));
  place_to_write(beside(file));
}

void Manifest::write(lua_State* L, const std::string& file, const std::string& call, int object) const {
  std::string lines = line("file", file) + line("call", call) + line("script", script_) + line("script sha256", hash_);
  for (const auto& argument : arguments_) lines += line("argument", argument);
  if (object > 0) lines += about_solution(L, object);
  lines += line("dotyk", DOTYK_VERSION) + line("commit", commit) + line("processor", processor()) +
           line("cores", std::to_string(cores())) + line("date", date()) +
           line("seconds", text(clock_.seconds()));
  require_place(L, file);
  write_whole_file(beside(file), lines);
}

}  // namespace dotyk::script

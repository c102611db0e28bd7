#pragma once
// What a figure or result came from, written beside it on request.
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "script/bridge/lua.hpp"

namespace dotyk::script {

// SHA-256 of some bytes as 64 hexadecimal digits (FIPS 180-4).
std::string sha256(const std::string& bytes);

class Manifest {
 public:
  // The script by name, its text where it is known before it runs, and its arguments. Seconds count from here.
  Manifest(std::string script, std::optional<std::string> text, std::vector<std::string> arguments);

  // Throws where FILE.manifest cannot be written: asked before the file is made.
  static void require_place(lua_State* L, const std::string& file);

  // Writes FILE.manifest, whole or not at all: lines "name: value" of the script and its SHA-256, its
  // arguments, the call that wrote the file, dotyk's version and commit, the machine, date and seconds; and,
  // where the value at index `object` (0: none) is a solution, its method with options and how it ended.
  // Throws InputError where it cannot be written.
  void write(lua_State* L, const std::string& file, const std::string& call, int object) const;

 private:
  std::string script_, hash_;
  std::vector<std::string> arguments_;
  Stopwatch clock_;
};

}  // namespace dotyk::script

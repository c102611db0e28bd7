#pragma once
// Completion at the prompt: globals, fields, methods after a colon, keys inside
// the table argument of a known callable, what a key or an argument may be
// (choices, names that the object knows, variables that hold such an object),
// file names in strings.
#include <cstddef>
#include <string>
#include <vector>

struct lua_State;

namespace dotyk::script {

struct Completion {
  std::size_t start = 0;           // the words replace the text from here on
  std::vector<std::string> words;  // sorted
  bool in_string = false;          // the cursor stands in a string
  char quote = 0;                  // that begins the string, where words are all it may hold
  bool file_names = false;         // file names fit instead
};

// `text` is everything typed before the cursor, earlier lines of an unfinished
// input included. No script code is run; fields of dotyk's own objects are read.
Completion complete(lua_State* L, const std::string& text);

}  // namespace dotyk::script

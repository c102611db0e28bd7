#pragma once
// Lines of help, as long as a person likes to read or as the terminal has room.
#include <string>

namespace dotyk::script {

// Letters in a line; where there is room, so many more.
std::size_t line_width(std::size_t more = 0);

// Letters, where bytes 10xxxxxx go on with one.
std::size_t letters(const std::string& text);

// With blanks behind it, `count` letters or more.
std::string padded(const std::string& text, std::size_t count);

// Text broken into lines: the first begins with `start`, the others with `indent`.
std::string wrapped(const std::string& text, const std::string& start, const std::string& indent);
std::string wrapped(const std::string& text, const std::string& indent);

// "  name      the first sentence".
std::string summary_line(const std::string& name, const std::string& help);

// The same on one line: of a long sentence the first clause.
std::string short_line(const std::string& name, const std::string& help);

}  // namespace dotyk::script

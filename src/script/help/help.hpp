#pragma once
// Help and the reference page, written from the descriptions.
#include <string>

#include "script/bridge/library.hpp"

namespace dotyk::script {

// Letters in a line, as long as a person likes to read or as the terminal has room; where there is room, so many more.
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

// Everything callable, by what it is for, one line each; and help_on_prompt.
std::string help_index(const Library& library);
// Keys, signs and words that work at the prompt.
std::string help_on_prompt();

std::string help_text(const Descriptor& descriptor);
std::string help_text(const Library& library, const Type& type);
std::string help_text(const Library& library, const Module& module);

// What is called by the word, or has it in its name or its text: names first, one line each; where one thing alone has
// that very name, its help and then the lines. A word of a text is found by its beginning. Empty where nothing fits.
std::string help_search(const Library& library, const std::string& word);

// The whole reference as a Markdown page.
std::string reference_page(const Library& library);

}  // namespace dotyk::script

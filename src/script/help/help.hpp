#pragma once
// Help and the reference page, written from the descriptions.
#include <string>

#include "script/bridge/library.hpp"

namespace dotyk::script {

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

#pragma once
#include <string>

namespace dotyk::script {

// Prints the text; through $PAGER, or less, where a person sits at a terminal with fewer lines than the text.
void show_paged(const std::string& text);

}  // namespace dotyk::script

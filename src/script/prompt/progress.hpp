#pragma once
// One line on the terminal that tells how far long work is.
#include <string>

namespace dotyk::script {

// Shows the text in place of the last one, on standard error when that is a
// terminal; at most ten times a second, and not in the first half second of work.
void show_progress(const std::string& text);

// Takes the line away; the work is over.
void clear_progress();

}  // namespace dotyk::script

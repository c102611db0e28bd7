#pragma once
// The terminal: its size, one line on it that tells how far long work is, long texts through a pager.
#include <string>

#include <sys/ioctl.h>

namespace dotyk::script {

// Rows (ws_row) and columns (ws_col) of the terminal that a file of the process is; 0 where it is none, or does not say.
winsize terminal_size(int file);

// Shows the text in place of the last one, on standard error when that is a
// terminal; at most ten times a second, and not in the first half second of work.
void show_progress(const std::string& text);

// Takes the line away; the work is over.
void clear_progress();

// Prints the text; through $PAGER, or less, where a person sits at a terminal with fewer lines than the text.
void show_paged(const std::string& text);

}  // namespace dotyk::script

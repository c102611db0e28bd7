#pragma once
// The lines typed at earlier prompts.
#include <string>

namespace dotyk::script {

// $XDG_STATE_HOME/dotyk_history, else ~/.dotyk_history, else (no home folder) "".
std::string history_file();

// Reads the file into readline's history; a missing one is no error.
void load_history();

// Adds a line, to the file as well: a crash loses nothing. Repeats are skipped;
// a file that cannot be written is no error.
void add_to_history(const std::string& line);

}  // namespace dotyk::script

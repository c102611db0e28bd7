#pragma once
// What was typed at earlier prompts; an input of several lines is one entry.
#include <string>

namespace dotyk::script {

// $XDG_STATE_HOME/dotyk_history, else ~/.dotyk_history, else (no home folder) "".
std::string history_file();

// Reads the file into readline's history; a missing one is no error.
void load_history();

// Why inputs will not be in the file, as "file: reason"; "" where they will, and where there is no home folder.
std::string why_no_history();

// Adds an input, to the file as well: a crash loses nothing. Repeats are skipped;
// a file that cannot be written is no error.
void add_to_history(const std::string& input);

}  // namespace dotyk::script

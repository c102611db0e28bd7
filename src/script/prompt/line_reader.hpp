#pragma once
// Lines from a person or from a pipe, and what was typed at earlier prompts.
#include <functional>
#include <string>

#include "script/complete/complete.hpp"

namespace dotyk::script {

enum class Read { line, cleared, end };  // cleared: Ctrl-C

// Reads a line with readline: editing, history, completion. `complete_line` gets
// the text before the cursor. Ctrl-C clears what was typed.
Read read_edited(const char* prompt, std::string& line,
                 const std::function<Completion(const std::string&)>& complete_line);

// Reads a line as it comes.
Read read_plain(std::string& line);

// Reads earlier inputs, an entry each whatever their lines, from $XDG_STATE_HOME/dotyk_history, else ~/.dotyk_history, which
// its owner alone can read, once a program. Returns why this session's will not be kept there, as "file: reason"; "" where
// they will, or there is no home folder.
const std::string& load_history();

// Adds an input, to the file as well: a crash loses nothing. Repeats are skipped; a file that cannot be written is no error.
void add_to_history(const std::string& input);

}  // namespace dotyk::script

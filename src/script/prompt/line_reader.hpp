#pragma once
// Lines from a person or from a pipe.
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

}  // namespace dotyk::script

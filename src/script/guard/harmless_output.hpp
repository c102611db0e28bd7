#pragma once
// What strangers' scripts print, without what a terminal would obey.
#include <string>
#include <string_view>

namespace dotyk::script {

// The text with line ends, tabs and whole letters of UTF-8 as they are, and every byte of anything else as \xHH:
// control characters, those of U+0080 to U+009F too, and what is no UTF-8. Where the text ends within a letter, its
// bytes go to `rest`, for the text that follows.
std::string harmless(std::string_view text, std::string& rest);

// From here on everything written to stdout and stderr of the C library, by Lua or by C++, passes through harmless(), also
// into files and pipes, since a terminal may stand at the end of a pipe. These streams then have no file number
// (fileno() fails). To be called before Lua is opened.
void make_output_harmless();

}  // namespace dotyk::script

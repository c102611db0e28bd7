// The program dotyk: a script, or the prompt.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include "script/interpreter.hpp"
#include "script/interrupt.hpp"
#include "script/prompt.hpp"

namespace {

constexpr char usage[] =
    "dotyk: a scripting host for unilateral contact problems\n"
    "\n"
    "  dotyk                      the prompt\n"
    "  dotyk FILE.lua ARGS…       run a script; its arguments are in the table arg\n"
    "  dotyk -e CODE ARGS…        run a text\n"
    "  dotyk -i FILE.lua ARGS…    run a script, then the prompt\n"
    "  dotyk - ARGS…              run a script from standard input\n"
    "  dotyk --traceback …        errors with the stack of calls (also DOTYK_TRACEBACK=1)\n"
    "  dotyk --version\n"
    "  dotyk --help\n"
    "\n"
    "Exit status: 0 all went well, 1 the script had an error, 2 wrong use.\n";

struct Command {
  std::optional<std::string> file, code;
  std::vector<std::string> arguments;
  bool prompt = false, traceback = std::getenv("DOTYK_TRACEBACK") != nullptr;
};

int misuse(const std::string& what) {
  std::fprintf(stderr, "dotyk: %s (dotyk --help tells more)\n", what.c_str());
  return 2;
}

// Reads the command line; returns an exit status when there is nothing to run.
std::optional<int> read_command(const std::vector<std::string>& words, Command& command) {
  std::size_t i = 0;
  for (; i < words.size(); ++i) {
    const auto& word = words[i];
    if (word == "--traceback") {
      command.traceback = true;
    } else if (word == "--help" || word == "-h") {
      std::fputs(usage, stdout);
      return 0;
    } else if (word == "--version" || word == "-v") {
      std::printf("dotyk %s\n", DOTYK_VERSION);
      return 0;
    } else if (word == "-i") {
      command.prompt = true;
    } else if (word == "-e") {
      if (++i == words.size()) return misuse("-e needs a text to run");
      command.code = words[i++];
      break;
    } else if (word.size() > 1 && word[0] == '-') {
      return misuse("unknown option '" + word + "'");
    } else {
      command.file = word;
      ++i;
      break;
    }
  }
  if (command.prompt && !command.file && !command.code) return misuse("-i needs a file");
  if (!command.file && !command.code) command.prompt = true;
  command.arguments.assign(words.begin() + static_cast<std::ptrdiff_t>(std::min(i, words.size())),
                           words.end());
  return std::nullopt;
}

/// The exit status, or 1 with a message where what was printed did not arrive (a full disk, a closed output).
int after_printing(int status) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  std::fprintf(stderr, "dotyk: standard output could not be written%s%s\n", errno ? ": " : "", errno ? std::strerror(errno) : "");
  return status == 0 ? 1 : status;
}

int run(const Command& command) {
  if (command.file && *command.file != "-" && access(command.file->c_str(), R_OK) != 0) {
    std::fprintf(stderr, "dotyk: cannot open %s: %s\n", command.file->c_str(), std::strerror(errno));
    return 2;
  }
  dotyk::script::Interpreter interpreter;
  interpreter.trace(command.traceback);
  interpreter.set_arguments(command.file.value_or(command.code ? "-e" : "dotyk"), command.arguments);
  dotyk::script::watch_interrupts(interpreter.state());

  std::optional<std::string> error;
  if (command.code) error = interpreter.run_text(*command.code, "-e");
  if (command.file) error = interpreter.run_file(*command.file);
  dotyk::script::clear_interrupt();
  if (error) {
    std::fflush(stdout);
    std::fprintf(stderr, "dotyk: %s\n", error->c_str());
    if (!command.prompt) return 1;
  }
  return command.prompt ? run_prompt(interpreter) : 0;
}

}  // namespace

int main(int count, char** words) {
  try {
    Command command;
    if (const auto status = read_command({words + 1, words + count}, command)) return after_printing(*status);
    return after_printing(run(command));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dotyk: %s\n", error.what());
    return 1;
  }
}

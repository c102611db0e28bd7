// The program dotyk: a script, or the prompt.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <locale>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "elasticity/share.hpp"
#include "figure/compose/compose.hpp"
#include "multigrid/multigrid.hpp"
#include "scene/result/inner_cells.hpp"
#include "script/interpreter.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/prompt/line_reader.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/guard/harmless_output.hpp"
#include "script/guard/manifest.hpp"
#include "script/guard/process_limits.hpp"
#include "script/prompt/prompt.hpp"
#include "script/guard/safe.hpp"

namespace {

constexpr char usage[] =
    "dotyk: a scripting host for unilateral contact problems\n"
    "\n"
    "  dotyk                      the prompt\n"
    "  dotyk FILE.lua ARGS…       run a script; its arguments are in the table arg\n"
    "  dotyk -e CODE ARGS…        run a text\n"
    "  dotyk -i FILE.lua ARGS…    run a script, then the prompt, which has the script's local variables, too\n"
    "  dotyk - ARGS…              run a script from standard input\n"
    "  dotyk --ranks N …          N processes for multigrid, as dotyk.ranks(N)\n"
    "  dotyk --traceback …        errors with the stack of calls (also DOTYK_TRACEBACK=1)\n"
    "  dotyk --safe FOLDER …      a script from a stranger: files below FOLDER only, which the kernel sees to as well\n"
    "                             (Landlock), of 1 GB at most; no other programs, no environment, text only to load;\n"
    "                             control characters printed as \\xHH; unless said otherwise at most 1e9 instructions,\n"
    "                             600 s of processors, 3600 s (not at the prompt), half of the machine's memory and\n"
    "                             4 GB in all files together\n"
    "  dotyk --instructions N …   at most N instructions of Lua (what dotyk computes meanwhile counts for none)\n"
    "  dotyk --seconds N …        at most N seconds of processors' time, whatever runs (mpirun: rank 0's)\n"
    "  dotyk --clock N …          at most N seconds from the start, whether it computes or waits\n"
    "  dotyk --files SIZE …       at most so many bytes written to all files together: 500M, 2G\n"
    "  dotyk --memory SIZE …      at most this address space: 500M, 2G (mpirun: that of rank 0)\n"
    "  dotyk --manifest …         beside every figure and result FILE, FILE.manifest: script and its hash,\n"
    "                             arguments, method, version, machine, date, seconds\n"
    "  dotyk --version\n"
    "  dotyk --help\n"
    "\n"
    "Exit status: 0 all went well, 1 the script had an error, 2 wrong use.\n";

struct Command {
  std::optional<std::string> file, code;
  std::vector<std::string> arguments;
  std::optional<std::string> safe;
  std::optional<double> instructions;
  int ranks = 1;
  dotyk::script::ProcessLimits limits;
  bool prompt = false, manifest = false, traceback = std::getenv("DOTYK_TRACEBACK") != nullptr;
};

int misuse(const std::string& what) {
  std::fprintf(stderr, "dotyk: %s (dotyk --help tells more)\n", what.c_str());
  return 2;
}

// A number of at least 1, for memory in bytes with the letter K, M or G of powers of 1000 behind it; 0 where it is none.
double read_limit(const std::string& word, bool letters) {
  std::istringstream in(word);
  in.imbue(std::locale::classic());
  double value = 0;
  if (!(in >> value)) return 0;
  const char letter = static_cast<char>(in.get());
  if (letters && in) value *= letter == 'K' ? 1e3 : letter == 'M' ? 1e6 : letter == 'G' ? 1e9 : 0;
  const bool whole = in.eof() || (letters && in.peek() == std::char_traits<char>::eof());
  return whole && value >= 1 && value <= 1e18 ? value : 0;
}

// The option among those with a number after them that sets a limit; null: none of them.
std::optional<double>* limit_of(const std::string& option, Command& command) {
  auto& limits = command.limits;
  for (const auto& [name, limit] :
       {std::pair{"--instructions", &command.instructions}, {"--seconds", &limits.seconds}, {"--clock", &limits.clock},
        {"--memory", &limits.memory}, {"--files", &limits.files}})
    if (option == name) return limit;
  return nullptr;
}

// --safe, --ranks or one of limit_of() and the word after it; returns an exit status where they are wrong.
std::optional<int> read_limits(const std::string& option, const std::string* next, Command& command) {
  const bool size = option == "--memory" || option == "--files";
  if (!next) return misuse(option + (option == "--safe" ? " needs a folder" : " needs a number"));
  if (option == "--safe") {
    command.safe = *next;
    return std::nullopt;
  }
  const double value = read_limit(*next, size);
  if (value == 0) return misuse(option + " needs a number of at least 1" + (size ? ", as 500M or 2G" : "") + ", got '" + *next + "'");
  if (option == "--ranks") {
    if (value != std::floor(value) || value > 4096) return misuse("--ranks needs a whole number of at most 4096, got '" + *next + "'");
    command.ranks = static_cast<int>(value);
    return std::nullopt;
  }
  *limit_of(option, command) = value;
  return std::nullopt;
}

// Reads the command line; returns an exit status when there is nothing to run.
std::optional<int> read_command(const std::vector<std::string>& words, Command& command) {
  std::size_t i = 0;
  for (; i < words.size() && !command.file && !command.code; ++i) {
    const auto& word = words[i];
    if (word == "--traceback") {
      command.traceback = true;
    } else if (word == "--manifest") {
      command.manifest = true;
    } else if (word == "--help" || word == "-h") {
      std::fputs(usage, stdout);
      return 0;
    } else if (word == "--version" || word == "-v") {
      std::printf("dotyk %s\n", DOTYK_VERSION);
      return 0;
    } else if (word == "--safe" || word == "--ranks" || limit_of(word, command)) {
      const auto status = read_limits(word, i + 1 < words.size() ? &words[i + 1] : nullptr, command);
      if (status) return status;
      ++i;
    } else if (word == "-i") {
      command.prompt = true;
    } else if (word == "-e") {
      if (++i == words.size()) return misuse("-e needs a text to run");
      command.code = words[i];
    } else if (word.size() > 1 && word[0] == '-') {
      return misuse("unknown option '" + word + "'");
    } else {
      command.file = word;
    }
  }
  if (command.prompt && !command.file && !command.code) return misuse("-i needs a file");
  if (command.safe && command.ranks > 1) return misuse("--safe starts no other programs, so --ranks does not go with it");
  if (!command.file && !command.code) command.prompt = true;
  command.arguments.assign(words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
  if (std::count(command.arguments.begin(), command.arguments.end(), "--safe"))
    std::fputs("dotyk: --safe after the script is an argument of its own; dotyk's come before it\n", stderr);
  return std::nullopt;
}

/// The exit status, or 1 with a message where what was printed did not arrive (a full disk, a closed output).
int after_printing(int status) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  std::fprintf(stderr, "dotyk: standard output could not be written%s%s\n", errno ? ": " : "", errno ? std::strerror(errno) : "");
  return status == 0 ? 1 : status;
}

// What a file holds; "-": standard input.
std::string whole_text(const std::string& file) {
  if (file == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  if (std::filesystem::is_directory(file)) throw std::runtime_error("cannot read " + file + ": Is a directory");
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The Lua of a file: without what may stand before it where the system starts it, a byte order mark and a first line with '#'.
std::string script_in(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with('#')) text.erase(0, std::min(text.find('\n'), text.size()));
  return text;
}

// What dotyk reads and runs of its own: the program, its libraries, its Lua.
std::vector<std::string> own_folders() {
  const std::string here = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  return {here, here + "/../lib/dotyk", here + "/../" DOTYK_LIBDIR "/dotyk", DOTYK_BUILD, dotyk::script::lua_folder()};
}

// The last step before a stranger's script; the prompt's history is open by then, wherever it lies.
void keep_to(const std::string& folder, bool prompt) {
  if (prompt && isatty(STDIN_FILENO) && isatty(STDOUT_FILENO)) dotyk::script::load_history();
  if (!dotyk::script::confine(dotyk::Folder(folder), own_folders()))
    std::fputs("dotyk: this kernel has no Landlock: that files stay below the folder is up to dotyk alone\n", stderr);
}

int run(const Command& command) {
  if (command.file && *command.file != "-" && access(command.file->c_str(), R_OK) != 0) {
    std::fprintf(stderr, "dotyk: cannot open %s: %s\n", command.file->c_str(), std::strerror(errno));
    return 2;
  }
  if (command.safe) dotyk::script::make_output_harmless();
  dotyk::script::Interpreter interpreter;
  dotyk::script::set_limits(command.limits);
  if (command.ranks > 1) dotyk::multigrid::start_ranks(command.ranks);  // which inherit the limits
  interpreter.trace(command.traceback);
  interpreter.set_arguments(command.file.value_or(command.code ? "-e" : "dotyk"), command.arguments);
  dotyk::script::watch_interrupts(interpreter.state());
  if (command.safe || command.limits.files) dotyk::script::watch_files(interpreter.state());
  if (command.safe) dotyk::script::make_safe(interpreter.state(), dotyk::Folder(*command.safe));
  else if (command.instructions) dotyk::script::close_debug(interpreter.state(), "--instructions");
  if (command.safe || command.instructions)
    dotyk::script::limit_instructions(interpreter.state(), static_cast<long long>(command.instructions.value_or(1e9)));

  const std::string file = command.file.value_or("");
  const std::optional<std::string> text = command.file ? whole_text(file) : command.code;
  const std::string name = command.code ? "-e" : !command.file ? "prompt" : file == "-" ? "standard input" : file;
  if (command.manifest) interpreter.library().manifest = std::make_shared<dotyk::script::Manifest>(name, text, command.arguments);

  if (command.prompt) interpreter.keep_locals();
  if (command.safe) keep_to(*command.safe, command.prompt);
  std::optional<std::string> error;
  if (command.code) error = interpreter.run_text(*text, "-e");
  if (command.file) error = interpreter.run_text(script_in(*text), file == "-" ? "stdin" : "@" + file);
  dotyk::script::clear_interrupt();
  if (error) {
    std::fflush(stdout);
    std::fprintf(stderr, "dotyk: %s\n", error->c_str());
  }
  const int status = command.prompt ? run_prompt(interpreter) : error ? 1 : 0;
  std::fflush(stdout);  // finalizers come, which Ctrl-C cannot stop: it ends the program
  dotyk::script::leave_interrupts();
  return status;
}

/// What any rank makes of its cells when rank 0 visits them.
dotyk::multigrid::VisitCells visit(dotyk::multigrid::VisitFor what) {
  using enum dotyk::multigrid::VisitFor;
  switch (what) {
    case estimate: return dotyk::scene::estimate_cells;
    case point: return dotyk::scene::values_at_point;
    case write: return dotyk::figure::write_cells;
  }
  throw std::logic_error("a visit for nothing known");
}

}  // namespace

int main(int count, char** words) {
  try {
    const dotyk::multigrid::RankAmong place = dotyk::multigrid::rank_by_mpirun();
    const bool spawned = count == 2 && std::string(words[1]) == "--worker";  // by dotyk.ranks
    if (place.rank > 0 || spawned) {
      std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of whoever writes it
      dotyk::multigrid::work_for_rank_0(spawned, {dotyk::elasticity::assemble_share, dotyk::elasticity::refinable_share, visit});
      return 0;
    }
    dotyk::multigrid::take_word_worker();
    Command command;
    const auto status = read_command({words + 1, words + count}, command);
    if (command.safe) command.limits.fill_in_for_safe(command.prompt);
    if (!status) dotyk::script::leave_threads_if_tight(command.limits, words);
    if (place.ranks > 0) dotyk::multigrid::meet_ranks();
    return after_printing(status ? *status : run(command));
  } catch (const std::bad_alloc&) {
    std::fputs("dotyk: out of memory\n", stderr);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dotyk: %s\n", error.what());
    return 1;
  }
}

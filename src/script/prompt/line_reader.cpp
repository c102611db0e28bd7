#include "script/prompt/line_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>

#include <readline/history.h>
#include <readline/readline.h>

#include "script/prompt/interrupt.hpp"

namespace dotyk::script {
namespace {

// readline calls plain functions, so what they need stands here while a line
// is being read.
struct {
  const std::function<Completion(const std::string&)>* complete = nullptr;
  Completion found;
  std::string line;
  bool done = false, ended = false;
} editing;

char* next_word(const char*, int state) {
  static std::size_t next;
  if (state == 0) next = 0;
  if (next >= editing.found.words.size()) return nullptr;
  return strdup(editing.found.words[next++].c_str());
}

void look() {
  editing.found = (*editing.complete)(std::string(rl_line_buffer, static_cast<std::size_t>(rl_point)));
}

// Inside a string a word is all of it; elsewhere a name. readline asks for them where something stands before the cursor.
char* word_breaks() {
  look();
  static char in_string[] = "\"'";
  static char in_code[] = " \t\n\"'`@$><=;|&{}(),.:[]+-*/%#~^";
  return editing.found.in_string ? in_string : in_code;
}

char** attempt(const char* text, int, int) {
  if (rl_point == 0) look();
  rl_completion_append_character = '\0';
  if (editing.found.file_names) {
    rl_filename_completion_desired = 1;
    rl_variable_bind("expand-tilde", "on");  // files are opened as written, by no shell
    return nullptr;  // readline's own file names
  }
  rl_attempted_completion_over = 1;
  if (editing.found.quote) rl_completion_append_character = editing.found.quote;
  return rl_completion_matches(text, next_word);
}

void got_line(char* line) {
  editing.done = true;
  editing.ended = line == nullptr;
  if (line) editing.line = line;
  std::free(line);
  rl_callback_handler_remove();
}

void set_up() {
  static bool ready = false;
  if (ready) return;
  ready = true;
  rl_readline_name = "dotyk";
  if (fileno(stdout) < 0) rl_outstream = fdopen(STDOUT_FILENO, "w");  // which moves the cursor, under --safe too
  rl_catch_signals = 0;  // Ctrl-C is ours
  rl_persistent_signal_handlers = 1;
  rl_attempted_completion_function = attempt;
  rl_completion_word_break_hook = word_breaks;
  rl_variable_bind("show-all-if-ambiguous", "on");  // the first Tab lists; an inputrc may say otherwise
  // What was typed so far selects from the history; an inputrc may say otherwise.
  rl_bind_keyseq("\\e[A", rl_history_search_backward);
  rl_bind_keyseq("\\e[B", rl_history_search_forward);
  rl_bind_keyseq("\\eOA", rl_history_search_backward);
  rl_bind_keyseq("\\eOB", rl_history_search_forward);
}

void abandon() {
  clear_interrupt();
  rl_free_line_state();
  rl_callback_sigcleanup();
  rl_point = rl_end;
  rl_redisplay();
  std::fputs("^C\n", stdout);
  rl_callback_handler_remove();
}

// "" where there is no folder for it.
std::string history_file() {
  const auto folder = [](const char* variable) {
    const char* path = std::getenv(variable);
    std::error_code error;
    return path && *path && std::filesystem::is_directory(path, error) ? std::string(path) : std::string();
  };
  if (const auto state = folder("XDG_STATE_HOME"); !state.empty()) return state + "/dotyk_history";
  if (const auto home = folder("HOME"); !home.empty()) return home + "/.dotyk_history";
  return "";
}

std::FILE* kept_history = nullptr;  // open from the start: later --safe may not open it

std::string open_history() {
  constexpr int most_lines = 5000;
  using_history();
  history_comment_char = '#';  // "#1700000000" before each entry: it may have several lines
  history_write_timestamps = 1;
  stifle_history(most_lines);
  const auto path = history_file();
  if (path.empty()) return "";
  if (read_history(path.c_str()) == 0 && history_length >= most_lines) history_truncate_file(path.c_str(), most_lines / 2);
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return path + ": " + std::strerror(errno);
  fchmod(file, 0600);  // of one that others could read
  kept_history = fdopen(file, "a");
  return "";
}

}  // namespace

Read read_edited(const char* prompt, std::string& line,
                 const std::function<Completion(const std::string&)>& complete_line) {
  set_up();
  editing.complete = &complete_line;
  editing.done = editing.ended = false;
  rl_callback_handler_install(prompt, got_line);
  while (!editing.done) {
    if (interrupted()) {
      abandon();
      return Read::cleared;
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, -1) > 0) rl_callback_read_char();
    else rl_check_signals();
  }
  line = editing.line;
  return editing.ended ? Read::end : Read::line;
}

Read read_plain(std::string& line) { return std::getline(std::cin, line) ? Read::line : Read::end; }

const std::string& load_history() {
  static const std::string reason = open_history();
  return reason;
}

void add_to_history(const std::string& input) {
  const bool blank = input.find_first_not_of(" \t\n") == std::string::npos;
  const auto* last = history_length > 0 ? history_get(history_base + history_length - 1) : nullptr;
  if (blank || (last && input == last->line)) return;
  add_history(input.c_str());
  if (!kept_history) return;
  std::fprintf(kept_history, "#%lld\n%s\n", static_cast<long long>(std::time(nullptr)), input.c_str());
  std::fflush(kept_history);
}

}  // namespace dotyk::script

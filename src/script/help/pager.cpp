#include "script/help/pager.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "script/prompt/terminal.hpp"

namespace dotyk::script {
namespace {

bool fits(const std::string& text) {
  const int rows = terminal_size(STDOUT_FILENO).ws_row;
  return rows == 0 || !isatty(STDIN_FILENO) || std::count(text.begin(), text.end(), '\n') < rows;
}

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

std::string pager() {
  if (const char* wish = std::getenv("PAGER")) return wish;
  return on_path("less") ? "less -FRX" : "";
}

// While it lives, Ctrl-C is the pager's, and that it has gone ends nothing.
class Ignored {
 public:
  Ignored() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGINT, &ignore, &interrupt_);
    sigaction(SIGPIPE, &ignore, &pipe_);
  }
  ~Ignored() {
    sigaction(SIGINT, &interrupt_, nullptr);
    sigaction(SIGPIPE, &pipe_, nullptr);
  }
  Ignored(const Ignored&) = delete;
  Ignored& operator=(const Ignored&) = delete;

 private:
  struct sigaction interrupt_ {}, pipe_ {};
};

}  // namespace

void show_paged(const std::string& text) {
  std::fflush(stdout);
  const auto program = fits(text) ? std::string() : pager();
  if (!program.empty()) {
    const Ignored ignored;
    if (FILE* pipe = popen(program.c_str(), "w")) {
      std::fputs(text.c_str(), pipe);
      constexpr int not_found = 127;
      const int status = pclose(pipe);
      if (!WIFEXITED(status) || WEXITSTATUS(status) != not_found) return;
    }
  }
  std::fputs(text.c_str(), stdout);
}

}  // namespace dotyk::script

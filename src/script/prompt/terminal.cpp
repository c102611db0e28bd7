#include "script/prompt/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "script/guard/harmless_output.hpp"

namespace dotyk::script {
namespace {

using Clock = std::chrono::steady_clock;

struct {
  bool working = false, shown = false;
  Clock::time_point next;
} progress_line;

int columns() {
  const int width = terminal_size(STDERR_FILENO).ws_col;
  return width > 0 ? width : 80;
}

bool fits(const std::string& text) {
  const int rows = terminal_size(STDOUT_FILENO).ws_row;
  return rows == 0 || !isatty(STDIN_FILENO) || std::count(text.begin(), text.end(), '\n') < rows;
}

constexpr int not_found = 127;  // what a shell says of a program that is not there

std::string pager() {
  const char* wish = std::getenv("PAGER");
  return wish ? wish : "command -v less >/dev/null || exit 127; less -FRX";
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

winsize terminal_size(int file) {
  winsize size{};
  if (!isatty(file) || ioctl(file, TIOCGWINSZ, &size) != 0) return {};
  return size;
}

void show_progress(const std::string& text) {
  const auto now = Clock::now();
  if (!progress_line.working) {
    progress_line.working = true;
    progress_line.next = now + std::chrono::milliseconds(500);
  }
  if (now < progress_line.next || !isatty(STDERR_FILENO)) return;
  progress_line.next = now + std::chrono::milliseconds(100);
  progress_line.shown = true;
  std::string rest;
  dprintf(STDERR_FILENO, "\r%.*s\033[K", std::max(1, columns() - 3), harmless(text, rest).c_str());  // "^C" is echoed after it
}

void clear_progress() {
  if (progress_line.shown) dprintf(STDERR_FILENO, "\r\033[K");  // stderr may pass no such signs (--safe)
  progress_line.working = progress_line.shown = false;
}

void show_paged(const std::string& text) {
  std::fflush(stdout);
  const auto program = fits(text) ? std::string() : pager();
  if (!program.empty()) {
    const Ignored ignored;
    if (FILE* pipe = popen(program.c_str(), "w")) {
      std::fputs(text.c_str(), pipe);
      const int status = pclose(pipe);
      if (!WIFEXITED(status) || WEXITSTATUS(status) != not_found) return;
    }
  }
  std::fputs(text.c_str(), stdout);
}

}  // namespace dotyk::script

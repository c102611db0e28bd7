#include "script/prompt/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "script/prompt/terminal.hpp"

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

}  // namespace

void show_progress(const std::string& text) {
  const auto now = Clock::now();
  if (!progress_line.working) {
    progress_line.working = true;
    progress_line.next = now + std::chrono::milliseconds(500);
  }
  if (now < progress_line.next || !isatty(STDERR_FILENO)) return;
  progress_line.next = now + std::chrono::milliseconds(100);
  progress_line.shown = true;
  std::fprintf(stderr, "\r%.*s\033[K", std::max(1, columns() - 3), text.c_str());  // "^C" is echoed after it
  std::fflush(stderr);
}

void clear_progress() {
  if (progress_line.shown) std::fputs("\r\033[K", stderr);
  progress_line.working = progress_line.shown = false;
}

}  // namespace dotyk::script

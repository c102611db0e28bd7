#include "script/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "script/terminal.hpp"

namespace dotyk::script {
namespace {

using Clock = std::chrono::steady_clock;

struct {
  bool working = false, shown = false;
  Clock::time_point next;
} line;

int columns() {
  const int width = terminal_size(STDERR_FILENO).ws_col;
  return width > 0 ? width : 80;
}

}  // namespace

void show_progress(const std::string& text) {
  const auto now = Clock::now();
  if (!line.working) {
    line.working = true;
    line.next = now + std::chrono::milliseconds(500);
  }
  if (now < line.next || !isatty(STDERR_FILENO)) return;
  line.next = now + std::chrono::milliseconds(100);
  line.shown = true;
  std::fprintf(stderr, "\r%.*s\033[K", std::max(1, columns() - 3), text.c_str());  // "^C" is echoed after it
  std::fflush(stderr);
}

void clear_progress() {
  if (line.shown) std::fputs("\r\033[K", stderr);
  line.working = line.shown = false;
}

}  // namespace dotyk::script

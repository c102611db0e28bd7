#pragma once
#include <sys/ioctl.h>
#include <unistd.h>

namespace dotyk::script {

// Rows (ws_row) and columns (ws_col) of the terminal that a file of the process is; 0 where it is none, or does not say.
inline winsize terminal_size(int file) {
  winsize size{};
  if (!isatty(file) || ioctl(file, TIOCGWINSZ, &size) != 0) return {};
  return size;
}

}  // namespace dotyk::script

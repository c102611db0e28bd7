#include "script/prompt/history.hpp"

#include <cstdio>

#include <readline/history.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>

namespace dotyk::script {
namespace {
constexpr int most_lines = 5000;
}

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

void load_history() {
  using_history();
  history_comment_char = '#';  // "#1700000000" before each entry: it may have several lines
  history_write_timestamps = 1;
  stifle_history(most_lines);
  const auto file = history_file();
  if (file.empty() || read_history(file.c_str()) != 0) return;
  if (history_length >= most_lines) history_truncate_file(file.c_str(), most_lines / 2);
}

std::string why_no_history() {
  const auto path = history_file();
  if (path.empty()) return "";
  FILE* file = std::fopen(path.c_str(), "a");
  if (!file) return path + ": " + std::strerror(errno);
  std::fclose(file);
  return "";
}

void add_to_history(const std::string& input) {
  const bool blank = input.find_first_not_of(" \t\n") == std::string::npos;
  const auto* last = history_length > 0 ? history_get(history_base + history_length - 1) : nullptr;
  if (blank || (last && input == last->line)) return;
  add_history(input.c_str());
  const auto path = history_file();
  if (path.empty()) return;
  if (FILE* file = std::fopen(path.c_str(), "a")) {
    std::fprintf(file, "#%lld\n%s\n", static_cast<long long>(std::time(nullptr)), input.c_str());
    std::fclose(file);
  }
}

}  // namespace dotyk::script

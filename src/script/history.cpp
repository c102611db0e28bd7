#include "script/history.hpp"

#include <cstdio>

#include <readline/history.h>

#include <cstdlib>
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
  stifle_history(most_lines);
  const auto file = history_file();
  if (file.empty() || read_history(file.c_str()) != 0) return;
  if (history_length >= most_lines) history_truncate_file(file.c_str(), most_lines / 2);
}

void add_to_history(const std::string& line) {
  const bool blank = line.find_first_not_of(" \t") == std::string::npos;
  const auto* last = history_length > 0 ? history_get(history_base + history_length - 1) : nullptr;
  if (blank || (last && line == last->line)) return;
  add_history(line.c_str());
  const auto path = history_file();
  if (path.empty()) return;
  if (FILE* file = std::fopen(path.c_str(), "a")) {
    std::fprintf(file, "%s\n", line.c_str());
    std::fclose(file);
  }
}

}  // namespace dotyk::script

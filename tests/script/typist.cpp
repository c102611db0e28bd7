// Types at a program on a pseudo-terminal, then shows what was on the screen:
//
//   typist COMMAND [KEYS …]
//
// COMMAND is for sh. KEYS are typed when the prompt ("> ") asks for them, however long that takes; they may hold \n, \r,
// \t, \\ and octal \033. KEYS that are one Ctrl-C (\003) are typed 0.3 s after the line before them has been taken; empty
// KEYS let 0.3 s go by. Ctrl-D comes last. Exit status 1: for a minute nothing came that had to; 77: there are no
// pseudo-terminals.
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds moment{300}, patience{60000};

class Screen {
 public:
  explicit Screen(int terminal) : terminal_(terminal) {}

  bool ended() const { return ended_; }
  const std::string& text() const { return text_; }
  std::size_t size() const { return text_.size(); }
  void type(std::string_view keys) const {
    while (!keys.empty()) {
      const ssize_t written = write(terminal_, keys.data(), keys.size());
      if (written <= 0) return;
      keys.remove_prefix(written);
    }
  }

  /// Reads until nothing comes for that long, or the program ends; true if something came.
  bool settle(milliseconds quiet = moment) {
    bool came = false;
    const auto last = steady_clock::now() + patience;
    while (steady_clock::now() < last && read_within(quiet)) came = true;
    return came;
  }

  /// Reads for that long.
  void watch(milliseconds time) {
    const auto end = steady_clock::now() + time;
    for (auto rest = time; !ended_ && rest.count() > 0; rest = std::chrono::ceil<milliseconds>(end - steady_clock::now()))
      read_within(rest);
  }

  /// Reads until there is more than at `before` and that holds, or the program ends; false after a minute.
  template <class Holds>
  bool await(std::size_t before, const Holds& holds) {
    for (const auto last = steady_clock::now() + patience; !ended_; read_within(milliseconds(50))) {
      if (text_.size() > before && holds()) return true;
      if (steady_clock::now() > last) return false;
    }
    return true;
  }
  bool await_echo(std::size_t before) { return await(before, [] { return true; }); }
  bool await_prompt(std::size_t before) { return await(before, [&] { return asks() && !settle(milliseconds(100)); }); }
  /// Until readline has given the line away (its terminal takes lines again), or asks for the next.
  bool await_taken(std::size_t before) {
    return await(before, [&] {
      termios modes;
      return asks() || (tcgetattr(terminal_, &modes) == 0 && (modes.c_lflag & ICANON));
    });
  }

 private:
  bool asks() const { return text_.ends_with("> "); }

  bool read_within(milliseconds time) {
    pollfd waiting{terminal_, POLLIN, 0};
    if (ended_ || poll(&waiting, 1, static_cast<int>(time.count())) <= 0) return false;
    char part[4096];
    const ssize_t count = read(terminal_, part, sizeof part);
    ended_ = count <= 0;  // EIO: nobody is at the other end
    for (ssize_t k = 0; k < count; ++k)
      if (part[k] != '\r' && part[k] != '\0') text_ += part[k];
    return !ended_;
  }

  int terminal_;
  std::string text_;
  bool ended_ = false;
};

std::string unescaped(std::string_view keys) {
  std::string out;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k] != '\\' || ++k == keys.size()) {
      out += keys[k];
    } else if (keys[k] >= '0' && keys[k] <= '7') {
      out += static_cast<char>(std::stoi(std::string(keys.substr(k, 3)), nullptr, 8));
      k += 2;
    } else {
      out += keys[k] == 'n' ? '\n' : keys[k] == 'r' ? '\r' : keys[k] == 't' ? '\t' : keys[k];
    }
  }
  return out;
}

const std::string expected = "\001", interrupt = "\003", leave = "\004";

/// False: what had to come did not.
bool type_all(Screen& screen, char** words) {
  std::size_t before = 0;  // of the screen, when the last keys were typed
  bool answer_due = true;
  for (; *words && !screen.ended(); ++words) {
    const std::string keys = unescaped(*words);
    if (keys.empty()) {
      screen.watch(moment);
      continue;
    }
    if (keys.starts_with(expected)) {
      if (!screen.await(before, [&] { return screen.text().find(keys.substr(1), before) != std::string::npos; })) return false;
      continue;
    }
    if (answer_due && keys != interrupt && !screen.await_prompt(before)) return false;
    before = screen.size();
    screen.type(keys);
    const bool entered = keys.ends_with('\n') || keys.ends_with('\r');
    if (!(entered ? screen.await_taken(before) : screen.await_echo(before))) return false;
    answer_due = entered || keys == interrupt;
    if (answer_due) screen.watch(moment); else screen.settle();
  }
  if (!answer_due) return true;  // in the midst of a line Ctrl-D does not end it
  if (!screen.await_prompt(before)) return false;
  for (int times = 0; times < 3 && !screen.ended(); ++times) {  // an unfinished input takes one of its own
    screen.type(leave);
    screen.watch(milliseconds(3000));
  }
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  int terminal = -1;
  const pid_t program = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (program < 0) {
    std::perror("typist: no pseudo-terminal");
    return 77;
  }
  if (program == 0) {
    for (const int each : {SIGINT, SIGQUIT}) std::signal(each, SIG_DFL);  // a shell has them ignored in the background
    execl("/bin/sh", "sh", "-c", arguments[1], nullptr);
    _exit(127);
  }
  Screen screen(terminal);
  const bool came = type_all(screen, arguments + 2);
  std::fwrite(screen.text().data(), 1, screen.size(), stdout);
  if (!came) std::puts("\ntypist: this is all that came in a minute");
  close(terminal);
  if (!screen.ended()) kill(program, SIGKILL);
  waitpid(program, nullptr, 0);
  return came ? 0 : 1;
}

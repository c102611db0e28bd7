#include "machine.hpp"

#include <execinfo.h>
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif

#include "../support/file.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/bridge/lua.hpp"

namespace dotyk::fuzz {
namespace {

constexpr unsigned long_enough = 5, too_long = 10;  // seconds of one statement: it is asked to stop, it hangs

// For the signal handler, which may allocate nothing.
const std::string* running = nullptr;
char crash_file[512];
int terminal = 1;

const char* prelude() {
  // For ever: leaks are reported after all that is static has ended.
  static const auto* const text = new std::string(test::bytes_of(DOTYK_FUZZ_DIR "/prelude.lua"));
  return text->c_str();
}

void put(int file, const char* text, std::size_t length) {
  while (length > 0) {
    const auto written = write(file, text, length);
    if (written <= 0) return;
    text += written;
    length -= static_cast<std::size_t>(written);
  }
}

void save_script() {
  const int file = open(crash_file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  put(file, prelude(), std::strlen(prelude()));
  if (running) put(file, running->data(), running->size());
  close(file);
}

void save_and_leave(int signal) {
  save_script();
  char line[700];
  const int length = std::snprintf(line, sizeof line, "FAILED: %s: %s\n", signal == SIGALRM ? "hangs" : strsignal(signal), crash_file);
  put(terminal, line, static_cast<std::size_t>(length));
  void* calls[40];
  backtrace_symbols_fd(calls, backtrace(calls, 40), terminal);
  _exit(1);
}

volatile std::sig_atomic_t asked = 0;

// What is just long heeds Ctrl-C.
void ask_or_leave(int signal) {
  if (asked) save_and_leave(signal);
  asked = 1;
  script::request_interrupt();
  alarm(too_long - long_enough);
}

}  // namespace

Machine::Machine(std::string failures) : folder_(std::move(failures)) {
  terminal = dup(STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  prelude();
  std::signal(SIGALRM, ask_or_leave);
#ifdef __SANITIZE_ADDRESS__
  __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::intptr_t>(terminal)));
  __sanitizer_set_death_callback(save_script);
#else
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, save_and_leave);
#endif
  renew();
}

void Machine::renew() {
  interpreter_.reset();
  interpreter_ = std::make_unique<script::Interpreter>();
  script::watch_interrupts(state());
  interpreter_->run_text("granted = setmetatable", "fuzz");  // with __gc, as in a host that counts no instructions
  script::limit_instructions(state(), 20000000);
  const auto error = interpreter_->run_text(prelude(), "prelude.lua");
  if (error) say("the prelude: " + *error);
}

void Machine::begin(const std::string& name) {
  alarm(0);
  if (++begun_ % 500 == 0) renew();
  name_ = name;
  script_.clear();
  script_ += "-- " + name + "\n";
  running = &script_;
  std::snprintf(crash_file, sizeof crash_file, "%s/%s.lua", folder_.c_str(), name.c_str());
  script::clear_interrupt();  // counts instructions anew
  interpreter_->run_text("V = {}", "fuzz");
  if (begun_ % 20 == 0) lua_gc(state(), LUA_GCCOLLECT);
}

void Machine::run(const std::string& statement, const std::string& before) {
  script_ += before + statement + "\n";
  ++executions_;
  asked = 0;
  alarm(long_enough);
  const Stopwatch clock;
  const auto error = interpreter_->run_text(statement, "fuzz");
  alarm(0);
  if (clock.seconds() > longest_) longest_ = clock.seconds(), longest_in_ = name_;
  if (asked) script::clear_interrupt();
  if (error && !asked && error->find("(--instructions)") == std::string::npos) fail(*error);
}

std::string Machine::slowest() const { return text("the slowest ", longest_, " s in ", longest_in_); }

void Machine::fail(const std::string& what) {
  ++failures_;
  write_whole_file(crash_file, prelude() + script_);
  say("FAILED: " + what + "\n  " + crash_file);
}

void Machine::say(const std::string& line) const { put(terminal, (line + "\n").c_str(), line.size() + 1); }

double resident() {
  std::ifstream in("/proc/self/statm");
  double all = 0, used = 0;
  in >> all >> used;
  return used * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

}  // namespace dotyk::fuzz

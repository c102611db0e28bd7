// libFuzzer on scripts: the bytes are a Lua script, run as by dotyk --safe in a scratch folder. Errors are what most
// end in; a crash, what the sanitizers see, or what goes on for longer than -timeout is a finding.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "script/interpreter.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/guard/safe.hpp"

namespace {

using namespace dotyk;

constexpr long long instructions = 2'000'000;

// Where scripts may write: a folder of its own, emptied before each, where the process runs.
void enter_scratch() {
  static const auto folder = std::filesystem::temp_directory_path() / ("dotyk_fuzz_" + std::to_string(getpid()));
  std::error_code ignored;
  std::filesystem::create_directories(folder / "images");
  std::filesystem::current_path(folder);
  static const int registered = std::atexit([] {
    std::error_code gone;
    std::filesystem::remove_all(folder, gone);
  });
  static_cast<void>(registered);
}

// What scripts print goes nowhere.
void silence_output() {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  silence_output();
  const rlimit files{1 << 24, 1 << 24};
  setrlimit(RLIMIT_FSIZE, &files);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  enter_scratch();
  script::Interpreter interpreter;
  interpreter.set_arguments("fuzz", {});
  script::watch_interrupts(interpreter.state());
  script::make_safe(interpreter.state(), Folder("."));
  script::limit_instructions(interpreter.state(), instructions);
  script::clear_interrupt();
  interpreter.run_text({reinterpret_cast<const char*>(data), size}, "fuzz");
  return 0;
}

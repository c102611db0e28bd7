#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "bench.hpp"
#include "script/guard/harmless_output.hpp"
#include "script/guard/safe.hpp"
#include "script/prompt/interrupt.hpp"

using dotyk::script::Bench;

TEST_CASE("C++ exceptions become errors at the user's line") {
  Bench bench;
  CHECK(bench.error("\ndotyk.test.fail 'memory'") == "t.lua:2: fail: out of memory");
  CHECK(bench.error("\n\ndotyk.test.fail 'runtime'") == "t.lua:3: fail: it broke");
  CHECK(bench.error("dotyk.test.fail 'given'") == "t.lua:1: fail: given");
  CHECK(bench.error("assert(not pcall(dotyk.test.fail, 'memory'))\nassert(not pcall(dotyk.test.fail, "
                    "'runtime'))\nassert(1 + 1 == 2)") == "");
}

TEST_CASE("a real failure to allocate is an error, not the end") {
  Bench bench;
  CHECK(bench.error("string.rep('x', 1 << 62)") != "");
  CHECK(bench.error("assert(1 + 1 == 2)") == "");
}

TEST_CASE("endless recursion through C++ ends in an error") {
  Bench bench;
  const auto message = bench.error("local function f() dotyk.test.each(f) end\nf()");
  CHECK(message.find("overflow") != std::string::npos);
  CHECK(bench.error("assert(1 + 1 == 2)") == "");
}

TEST_CASE("a request to stop stops what runs, pcall or not, and is answered once") {
  Bench bench;
  dotyk::script::watch_interrupts(bench.interpreter.state());
  dotyk::script::request_interrupt();
  CHECK(bench.error("while true do pcall(function() while true do end end) end") == "t.lua:1: interrupted");
  dotyk::script::clear_interrupt();
  CHECK(bench.error("for i = 1, 1000 do end") == "");
}

TEST_CASE("the kernel keeps files below the folder, and lets the system's be read") {
  namespace fs = std::filesystem;
  fs::remove_all("kept");
  fs::create_directories("kept/inside/deeper");
  std::ofstream("kept/secret") << "a secret";
  fs::create_symlink("../secret", "kept/inside/link");
  const auto opens = [](const std::string& file, std::ios::openmode mode) { return std::fstream(file, mode).is_open(); };
  const pid_t child = fork();
  if (child == 0) {
    if (!dotyk::script::confine(dotyk::Folder("kept/inside"), {})) _exit(77);
    int k = 0;
    const auto expect = [&k](bool holds) {
      ++k;
      if (!holds) _exit(k);
    };
    expect(!opens("kept/secret", std::ios::in));
    expect(!opens("kept/inside/link", std::ios::in));
    expect(!opens("kept/inside/../secret", std::ios::out | std::ios::in));
    expect(!opens("kept/new", std::ios::out));
    expect(std::rename("kept/secret", "kept/inside/secret") != 0 && std::remove("kept/secret") != 0);
    std::ofstream("kept/inside/a") << "#!/bin/sh\nexit 99\n";
    expect(opens("kept/inside/a", std::ios::in));
    fs::permissions("kept/inside/a", fs::perms::owner_all);
    expect(execl("kept/inside/a", "a", nullptr) != 0);
    expect(opens("/dev/null", std::ios::out) && opens("/etc/passwd", std::ios::in) && !opens("/etc/new", std::ios::out));
    expect(std::rename("kept/inside/a", "kept/inside/deeper/b") == 0 || errno == EXDEV);  // before Linux 5.19 not across folders
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) MESSAGE("skipped: this kernel has no Landlock");
  else CHECK(WEXITSTATUS(status) == 0);  // else which of the expectations failed
  CHECK(fs::file_size("kept/secret") == 8);
  fs::remove_all("kept");
}

TEST_CASE("what a terminal would obey is written out, and letters stay") {
  std::string rest;
  const auto harmless = [&](std::string_view text) { return dotyk::script::harmless(text, rest); };
  CHECK(harmless("a\tb\n~ é – \xf0\x9f\x98\x80") == "a\tb\n~ é – \xf0\x9f\x98\x80");
  CHECK(harmless("\x1b[0m\r\b\x7f") == "\\x1b[0m\\x0d\\x08\\x7f");
  CHECK(harmless("\xc2\x9b \xc2\xa0") == "\\xc2\\x9b \xc2\xa0");
  CHECK(harmless("\x9b \xe0\x82\x9b \xf0\x82\x82\x9b \xc1\x9b \xff") == "\\x9b \\xe0\\x82\\x9b \\xf0\\x82\\x82\\x9b \\xc1\\x9b \\xff");
  CHECK(harmless("\xc3(") == "\\xc3(");
  CHECK(rest == "");
  CHECK(harmless("a\xe2\x80") == "a");
  CHECK(harmless(rest + "\x93") == "–");
}

#include "base/whole_file.hpp"

#include <doctest/doctest.h>
#include <sys/socket.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <filesystem>

#include "../support/file.hpp"

using namespace dotyk;
namespace fs = std::filesystem;

namespace {

/// An empty folder to work in, gone at the end.
class Scratch {
 public:
  Scratch() : before_(fs::current_path()) {
    fs::remove_all("places");
    fs::create_directories("places/elsewhere");
    fs::current_path("places");
  }
  ~Scratch() {
    fs::current_path(before_);
    fs::remove_all("places");
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator("."), {}); }

 private:
  fs::path before_;
};

}  // namespace

TEST_CASE("a link is followed, and what it leads to is replaced, or made") {
  const Scratch scratch;
  write_whole_file("elsewhere/a", "old");
  fs::create_symlink("elsewhere/a", "a");
  fs::create_symlink("a", "b");
  fs::create_symlink("elsewhere/new", "dangling");
  write_whole_file("b", "new");
  write_whole_file("dangling", "made");
  CHECK(test::bytes_of("elsewhere/a") == "new");
  CHECK(test::bytes_of("elsewhere/new") == "made");
  for (const char* link : {"a", "b", "dangling"}) CHECK(fs::is_symlink(link));
  CHECK(std::distance(fs::directory_iterator("elsewhere"), {}) == 2);
  fs::create_symlink("round", "round");
  CHECK_THROWS_WITH_AS(write_whole_file("round", ""), doctest::Contains("too many symbolic links"), std::runtime_error);
}

TEST_CASE("what is no file stays where it is") {
  const Scratch scratch;
  REQUIRE(mkfifo("pipe", 0600) == 0);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{AF_UNIX, "socket"};
  REQUIRE(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  fs::create_symlink("pipe", "link");
  const auto refused = [&](const std::string& file, const std::string& what) {
    CHECK_THROWS_WITH_AS(write_whole_file(file, "x"), ("cannot write '" + file + "': it " + what + "; results are written to files").c_str(), InputError);
  };
  refused("pipe", "is a pipe");
  refused("socket", "is a socket");
  refused("elsewhere", "is a folder");
  refused("link", "leads to '" + fs::absolute("pipe").string() + "', a pipe");
  close(socket);
  CHECK(fs::is_fifo("pipe"));
  CHECK(fs::is_symlink("link"));
  CHECK(scratch.files() == 4);
  if (mknod("full", S_IFCHR | 0666, makedev(1, 7)) != 0) {
    MESSAGE("skipped: no device can be made here");
    return;
  }
  refused("full", "is a device");
  CHECK(fs::is_character_file("full"));
}

TEST_CASE("what lies where the file is prepared is not written through") {
  const Scratch scratch;
  write_whole_file("kept", "old");
  fs::create_symlink("kept", "a.part-" + std::to_string(getpid()));
  write_whole_file("a", "new");
  CHECK(test::bytes_of("kept") == "old");
  CHECK(test::bytes_of("a") == "new");
  CHECK(scratch.files() == 3);
}

TEST_CASE("a file that is begun is gone where a signal ends the program, and what was there stays") {
  const Scratch scratch;
  write_whole_file("a", "old");
  for (const int signal : {SIGTERM, SIGHUP, SIGXCPU}) {
    CAPTURE(signal);
    const pid_t child = fork();
    if (child == 0) {
      std::signal(signal, SIG_DFL);
      PartFile part("a");
      part.write("new", 3);
      raise(signal);
      _exit(7);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
    CHECK(test::bytes_of("a") == "old");
    CHECK(scratch.files() == 2);
  }
  // Handlers: one that goes on, and one that gives the signal back and raises it, as of a second Ctrl-C; one that ends here.
  const auto goes_on = [](int) {};
  const auto gives_back = [](int signal) {
    std::signal(signal, SIG_DFL);
    raise(signal);
  };
  const auto ends = [](int) { _exit(3); };
  const auto left_by = [&](int signal, void (*handler)(int)) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(signal, handler);
      PartFile part("a");
      raise(signal);
      part.write("new", 3);
      part.finish();
      _exit(7);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(scratch.files() == 2);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  };
  CHECK(left_by(SIGINT, SIG_DFL) == -SIGINT);
  CHECK(left_by(SIGINT, gives_back) == -SIGINT);
  CHECK(left_by(SIGXCPU, ends) == 3);
  CHECK(left_by(SIGALRM, ends) == 3);
  CHECK(test::bytes_of("a") == "old");
  CHECK(left_by(SIGINT, goes_on) == 7);
  CHECK(test::bytes_of("a") == "new");
  write_whole_file("a", "old");
  // Those who ignore a signal (nohup) go on.
  const auto before = std::signal(SIGHUP, SIG_IGN);
  {
    PartFile part("a");
    raise(SIGHUP);
    part.write("new", 3);
    part.finish();
  }
  CHECK((std::signal(SIGHUP, before) == SIG_IGN));
  CHECK(test::bytes_of("a") == "new");
}

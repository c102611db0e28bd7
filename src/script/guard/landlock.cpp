#include "script/guard/landlock.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace dotyk::script {
namespace {

// Of <linux/landlock.h>, which older systems do not have; glibc has no functions for it.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
constexpr unsigned version_flag = 1, rule_path_beneath = 1;
constexpr std::uint64_t execute = 1 << 0, write_file = 1 << 1, read_file = 1 << 2, read_dir = 1 << 3;
constexpr std::uint64_t remove_dir = 1 << 4, remove_file = 1 << 5, make_reg = 1 << 8;
constexpr std::uint64_t refer = 1 << 13, truncate_file = 1 << 14, of_version_1 = (1 << 13) - 1;
struct Ruleset {
  std::uint64_t handled;
};
struct __attribute__((packed)) Beneath {
  std::uint64_t allowed;
  std::int32_t parent;
};

void allow(int rules, const std::string& place, std::uint64_t access) {
  const int parent = open(place.c_str(), O_PATH | O_CLOEXEC);
  if (parent < 0) return;  // not there
  struct stat info {};
  const bool folder = fstat(parent, &info) == 0 && S_ISDIR(info.st_mode);
  const Beneath rule{folder ? access : access & (execute | write_file | read_file | truncate_file), parent};
  syscall(add_rule, rules, rule_path_beneath, &rule, 0);
  close(parent);
}

}  // namespace

bool confine(const Folder& folder, const std::vector<std::string>& own) {
  const long version = syscall(create_ruleset, nullptr, 0, version_flag);
  if (version < 1) return false;
  const std::uint64_t handled = of_version_1 | (version >= 2 ? refer : 0) | (version >= 3 ? truncate_file : 0);
  const Ruleset ruleset{handled};
  const int rules = static_cast<int>(syscall(create_ruleset, &ruleset, sizeof ruleset, 0));
  if (rules < 0) return false;
  allow(rules, folder.place(),
        handled & (write_file | read_file | read_dir | remove_dir | remove_file | make_reg | refer | truncate_file));
  for (const char* system : {"/usr", "/lib", "/lib64", "/bin", "/etc", "/proc", "/sys", "/var/cache/fontconfig"})
    allow(rules, system, execute | read_file | read_dir);
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/random", "/dev/urandom", "/dev/tty"})
    allow(rules, device, read_file | write_file);
  for (const std::string& place : own) allow(rules, place, execute | read_file | read_dir);
  const bool done = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(restrict_self, rules, 0) == 0;
  close(rules);
  return done;
}

}  // namespace dotyk::script

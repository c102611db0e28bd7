#include "script/guard/landlock.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace dotyk::script {
namespace {

constexpr std::uint64_t execute = LANDLOCK_ACCESS_FS_EXECUTE, write_file = LANDLOCK_ACCESS_FS_WRITE_FILE;
constexpr std::uint64_t reading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t removing = LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR;
constexpr std::uint64_t making = LANDLOCK_ACCESS_FS_MAKE_REG, of_version_1 = (1 << 13) - 1;
constexpr std::uint64_t refer = 1 << 13, truncate_file = 1 << 14;  // of versions 2 and 3, newer than some headers

void allow(int rules, const std::string& place, std::uint64_t access) {
  const int parent = open(place.c_str(), O_PATH | O_CLOEXEC);
  if (parent < 0) return;  // not there
  struct stat info {};
  const bool folder = fstat(parent, &info) == 0 && S_ISDIR(info.st_mode);
  const auto of_a_file = execute | write_file | LANDLOCK_ACCESS_FS_READ_FILE | truncate_file;
  const landlock_path_beneath_attr rule{folder ? access : access & of_a_file, parent};
  syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(parent);
}

}  // namespace

bool confine(const Folder& folder, const std::vector<std::string>& own) {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  const std::uint64_t handled = of_version_1 | (version >= 2 ? refer : 0) | (version >= 3 ? truncate_file : 0);
  landlock_ruleset_attr ruleset{};
  ruleset.handled_access_fs = handled;
  const int rules = static_cast<int>(syscall(SYS_landlock_create_ruleset, &ruleset, sizeof ruleset, 0));
  if (rules < 0) return false;
  allow(rules, folder.place(), handled & (write_file | reading | removing | making | refer | truncate_file));
  for (const char* system : {"/usr", "/lib", "/lib64", "/bin", "/etc", "/proc", "/sys", "/var/cache/fontconfig"})
    allow(rules, system, execute | reading);
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/random", "/dev/urandom", "/dev/tty"})
    allow(rules, device, reading | write_file);
  for (const std::string& place : own) allow(rules, place, execute | reading);
  const bool done = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  return done;
}

}  // namespace dotyk::script

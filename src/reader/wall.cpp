#include "reader/reader_main.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cstddef>
#include <vector>

namespace dotyk::reader {
namespace {

#if defined(__x86_64__)
constexpr unsigned machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned machine = AUDIT_ARCH_AARCH64;
#endif

#if defined(__x86_64__) || defined(__aarch64__)  // both little-endian, which first_half says
using Program = std::vector<sock_filter>;

constexpr unsigned allow = SECCOMP_RET_ALLOW, deny = SECCOMP_RET_ERRNO | EPERM, unknown = SECCOMP_RET_ERRNO | ENOSYS;

sock_filter load(std::size_t offset) { return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset)); }
sock_filter give(unsigned answer) { return BPF_STMT(BPF_RET | BPF_K, answer); }
sock_filter skip_unless_equal(unsigned value, unsigned char steps) { return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, steps); }
sock_filter skip_unless_any(unsigned bits, unsigned char steps) { return BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, steps); }
std::size_t first_half(int argument) { return offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(argument); }

void answer(Program& program, long call, unsigned what) {
  program.push_back(skip_unless_equal(static_cast<unsigned>(call), 1));
  program.push_back(give(what));
}

/// Where any of the bits is set in the argument one answer, else the other.
void answer_by_bits(Program& program, long call, int argument, unsigned bits, unsigned where_set, unsigned otherwise) {
  program.push_back(skip_unless_equal(static_cast<unsigned>(call), 4));
  program.push_back(load(first_half(argument)));
  program.push_back(skip_unless_any(bits, 1));
  program.push_back(give(where_set));
  program.push_back(give(otherwise));
}

Program wall() {
  static constexpr long harmless[] = {
      SYS_read, SYS_readv, SYS_pread64, SYS_write, SYS_writev, SYS_close, SYS_lseek, SYS_fstat, SYS_newfstatat, SYS_statx, SYS_faccessat,
      SYS_readlinkat, SYS_getdents64, SYS_getcwd, SYS_fcntl, SYS_flock, SYS_dup, SYS_dup3, SYS_ioctl,
      SYS_mmap, SYS_munmap, SYS_mremap, SYS_mprotect, SYS_madvise, SYS_brk,
      SYS_futex, SYS_set_robust_list, SYS_set_tid_address, SYS_rseq, SYS_sched_yield, SYS_sched_getaffinity, SYS_getcpu,
      SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_sigaltstack, SYS_restart_syscall,
      SYS_clock_gettime, SYS_clock_getres, SYS_clock_nanosleep, SYS_nanosleep, SYS_gettimeofday, SYS_times, SYS_getrusage,
      SYS_getpid, SYS_gettid, SYS_getuid, SYS_geteuid, SYS_getgid, SYS_getegid, SYS_uname, SYS_sysinfo, SYS_prlimit64, SYS_getrandom,
      SYS_exit, SYS_exit_group,
#ifdef __x86_64__
      SYS_stat, SYS_lstat, SYS_access, SYS_readlink, SYS_dup2, SYS_getrlimit, SYS_time, SYS_arch_prctl,
#endif
  };
  constexpr unsigned writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | (O_TMPFILE & ~O_DIRECTORY);
  Program program{load(offsetof(seccomp_data, arch)), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, machine, 1, 0), give(deny),
                  load(offsetof(seccomp_data, nr))};
  answer_by_bits(program, SYS_openat, 2, writing, deny, allow);
#ifdef __x86_64__
  answer_by_bits(program, SYS_open, 1, writing, deny, allow);
#endif
  answer_by_bits(program, SYS_clone, 0, CLONE_THREAD, allow, deny);
  answer(program, SYS_clone3, unknown);  // its flags cannot be seen here; the C library goes on with clone
  for (const long call : harmless) answer(program, call, allow);
  program.push_back(give(deny));
  return program;
}
#endif

}  // namespace

void wall_in() {
#if defined(__x86_64__) || defined(__aarch64__)
  Program calls = wall();
  const sock_fprog program{static_cast<unsigned short>(calls.size()), calls.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
#endif
}

}  // namespace dotyk::reader

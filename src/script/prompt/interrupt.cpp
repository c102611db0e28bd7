#include "script/prompt/interrupt.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>

#include <link.h>
#include <pthread.h>
#include <setjmp.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <ucontext.h>
#include <unistd.h>

#include "script/bridge/lua.hpp"
#include "script/bridge/position.hpp"
#include "script/guard/replaced.hpp"

namespace dotyk::script {
namespace {

// The signal handler may touch nothing but these.
std::atomic<bool> pending{false};
std::atomic<lua_State*> running{nullptr};
std::atomic<double> warned_at{0};
std::atomic<bool> session{false};

bool answered = false;  // by a result so far, and its input goes on

// Instructions of Lua that may run (0: any number), that ran, and that run between two looks at them.
long long allowed = 0, used = 0;
int interval = 0;

bool spent() { return allowed > 0 && used >= allowed; }

void stop_here(lua_State* L, lua_Debug* event);

void arm(lua_State* L) {
  if (L) lua_sethook(L, stop_here, LUA_MASKCALL | LUA_MASKRET | LUA_MASKLINE | LUA_MASKCOUNT, 1);
}

void disarm(lua_State* L) {
  if (allowed > 0) lua_sethook(L, stop_here, LUA_MASKCOUNT, interval);
  else lua_sethook(L, nullptr, 0, 0);
}

// A message handler runs without hooks after a hook's error, so the innermost xpcall gets one that passes the message on.
// (No wrapper around every handler: it would stand in their stack of calls.)
lua_CFunction lua_xpcall = nullptr;

void pass_handler_over(lua_State* L) {
  constexpr int most = 5000;  // levels: lua_getstack counts from the innermost each time
  lua_Debug frame;
  for (int level = 0; level < most && lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "f", &frame);
    const bool handled = lua_xpcall && lua_tocfunction(L, -1) == lua_xpcall;
    lua_pop(L, 1);
    if (!handled) continue;
    lua_pushcfunction(L, [](lua_State*) { return 1; });
    lua_setlocal(L, &frame, 2);  // where xpcall keeps it
    return;
  }
}

// What closes variables of a chunk that has ended by an error has no frame in Lua beneath it. That error names the place; one
// raised here would take its place, and could not.
bool closes_after_error(lua_State* L, lua_Debug* event) {
  lua_getinfo(L, "S", event);
  return event->what[0] == 'C' && position(L).empty();
}

// Raises in whatever code runs next, again and again until the request is
// answered, so that a pcall in a loop cannot swallow it.
void stop_here(lua_State* L, lua_Debug* event) {
  const bool counting = lua_gethookmask(L) == LUA_MASKCOUNT;
  if (counting && event->event == LUA_HOOKCOUNT) used += interval;
  if (pending || spent()) {
    if (closes_after_error(L, event)) return;
    pass_handler_over(L);
  }
  if (pending) raise(L, "", "interrupted");
  if (!spent()) {
    if (!counting) disarm(L);
    return;
  }
  if (counting) arm(L);
  raise(L, "", "the limit of " + std::to_string(allowed) + " instructions is reached (--instructions)");
}

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void warn() {
  constexpr char message[] = "\ndotyk: still computing; press Ctrl-C again within 2 s to end dotyk and lose the session\n";
  if (::write(STDERR_FILENO, message, sizeof message - 1) < 0) return;
}

// Is this one to end the program? Where there is a session to lose only after a warning.
bool ends(double time) {
  if (!pending) return false;
  if (!session) return true;
  if (time - warned_at < 2) return true;
  warned_at = time;
  warn();
  return false;
}

// Work that can be left: where to, on which thread, and the code of Lua's library.
std::atomic<sigjmp_buf*> way_out{nullptr};
pthread_t worker;
std::uintptr_t library_begin = 0, library_end = 0;

std::uintptr_t interrupted_at([[maybe_unused]] const void* context) {
#if defined(__x86_64__)
  return static_cast<std::uintptr_t>(static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
  return static_cast<const ucontext_t*>(context)->uc_mcontext.pc;
#else
  return 0;
#endif
}

// Where the work is elsewhere for a moment (the C library compares letters), again in a millisecond.
void leave_work(const void* context) {
  sigjmp_buf* const place = way_out;
  if (!place) return;
  if (!pthread_equal(pthread_self(), worker)) {
    pthread_kill(worker, SIGALRM);
    return;
  }
  const std::uintptr_t at = interrupted_at(context);
  if (library_begin <= at && at < library_end) siglongjmp(*place, 1);
  const itimerval soon{{0, 0}, {0, 1000}};
  setitimer(ITIMER_REAL, &soon, nullptr);
}

void on_signal(int signal, siginfo_t*, void* context) {
  const double time = now();
  if (ends(time)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  pending = true;
  arm(running);
  leave_work(context);
}

void on_alarm(int, siginfo_t*, void* context) { leave_work(context); }

// The stack of the processor: where it begins, and how much of it is for one another's coroutines. Lua counts nested
// calls of C anew in a coroutine that is being closed, so without end.
const char* stack_begin = nullptr;
double stack_share = 0;

void measure_stack() {
  stack_begin = static_cast<const char*>(__builtin_frame_address(0));
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  stack_share = 0.5 * (limited ? std::min(static_cast<double>(limit.rlim_cur), 64e6) : 8e6);
}

void check_stack(lua_State* L) {
  const auto* here = static_cast<const char*>(__builtin_frame_address(0));
  if (stack_begin && static_cast<double>(std::abs(stack_begin - here)) > stack_share) raise(L, "", "C stack overflow");
}

// While it lives, `running` is the thread that runs in place of its caller. Lua, compiled as C++, ends it on errors too.
class Running {
 public:
  Running(lua_State* caller, lua_State* thread) : caller_(caller) {
    check_stack(caller);
    running = thread;
    if (pending || spent()) arm(thread);
  }
  ~Running() {
    running = caller_;
    if (pending || spent()) arm(caller_);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  lua_State* caller_;
};

// coroutine.resume and coroutine.close.
int with_thread(lua_State* L) {
  lua_State* thread = lua_tothread(L, 1);
  const Running now(L, thread ? thread : L);
  return original(L);
}

// A function that coroutine.wrap makes, upvalue 1; its thread is upvalue 2.
int call_wrapped(lua_State* L) {
  const Running now(L, lua_tothread(L, lua_upvalueindex(2)));
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

// A coroutine begins to count afresh: what it might do before the first look is counted at once.
int create(lua_State* L) {
  used += interval;
  return original(L);
}

// coroutine.wrap: the function Lua makes has its thread as first upvalue.
int wrap(lua_State* L) {
  used += interval;
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, 1);
  lua_getupvalue(L, -1, 1);
  lua_pushcclosure(L, call_wrapped, 2);
  return 1;
}

int set_metatable_without_gc(lua_State* L) {
  if (lua_istable(L, 2)) {
    lua_pushliteral(L, "__gc");
    if (lua_rawget(L, 2) != LUA_TNIL) raise(L, "setmetatable", "no __gc where instructions are counted (--instructions)");
    lua_pop(L, 1);
  }
  return original(L);
}

}  // namespace

bool interrupted() { return pending; }
void clear_interrupt() {
  pending = answered = false;
  warned_at = 0;
  used = 0;
}

void answer_interrupt() {
  const bool was = pending || answered;
  clear_interrupt();
  answered = was;
}

bool interrupt_answered() { return answered; }

void raise_if_interrupted(lua_State* L) {
  if (pending) raise(L, "", "interrupted");
}

bool abandonable(void (*work)(void*), void* data) {
  sigjmp_buf place;
  worker = pthread_self();
  if (sigsetjmp(place, 1) != 0) {
    way_out = nullptr;
    return false;
  }
  way_out = &place;
  const bool begun = !pending;
  if (begun) work(data);
  way_out = nullptr;
  return begun;
}

void let_abandon(std::uintptr_t function) {
  library_begin = function;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void*) {
        for (int k = 0; k < info->dlpi_phnum; ++k) {
          const auto& part = info->dlpi_phdr[k];
          const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr, end = begin + part.p_memsz;
          if (part.p_type != PT_LOAD || library_begin < begin || library_begin >= end) continue;
          library_begin = begin, library_end = end;
          return 1;
        }
        return 0;
      },
      nullptr);
}

void leave_interrupts() { std::signal(SIGINT, SIG_DFL); }

void keep_session() { session = true; }

void request_interrupt() {
  pending = true;
  arm(running);
}

void limit_instructions(lua_State* L, long long count) {
  allowed = count;
  interval = static_cast<int>(std::clamp(count, 1LL, 1000LL));
  replace(L, {{"_G", "setmetatable", set_metatable_without_gc}});
  disarm(L);
}

void watch_interrupts(lua_State* L) {
  running = L;
  measure_stack();
  constexpr const char* threads = "coroutine";
  replace(L, {{threads, "resume", with_thread}, {threads, "close", with_thread}, {threads, "wrap", wrap}, {threads, "create", create}});
  lua_getglobal(L, "xpcall");
  lua_xpcall = lua_tocfunction(L, -1);
  lua_pop(L, 1);
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  action.sa_sigaction = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_flags = SA_SIGINFO;
  action.sa_sigaction = on_signal;
  sigaction(SIGINT, &action, nullptr);
}

}  // namespace dotyk::script

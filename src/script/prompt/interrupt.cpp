#include "script/prompt/interrupt.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include <sys/resource.h>
#include <unistd.h>

#include "script/bridge/position.hpp"
#include "script/guard/lua_guards.hpp"

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
lua_CFunction lua_xpcall = nullptr, lua_coroutine_resume = nullptr;

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

// Is this one to end the program? Where there is a session to lose only after a warning.
bool ends() {
  if (!pending) return false;
  const double time = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  if (!session || time - warned_at < 2) return true;
  warned_at = time;
  constexpr char message[] = "\ndotyk: still computing; press Ctrl-C again within 2 s to end dotyk and lose the session\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
  return false;
}

void on_signal(int signal) {
  if (ends()) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  pending = true;
  arm(running);
}

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

// What coroutine.wrap makes; upvalue 1 is the thread. Lua's own function is called nowhere: a hook would find it.
int call_wrapped(lua_State* L) {
  lua_State* thread = lua_tothread(L, lua_upvalueindex(1));
  const Running now(L, thread);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  const int count = lua_coroutine_resume(L);
  if (lua_toboolean(L, -count)) return count - 1;
  if (lua_status(thread) > LUA_YIELD) {  // it has ended by an error: its variables are closed
    lua_resetthread(thread);
    lua_xmove(thread, L, 1);
  }
  return lua_error(L);
}

// A coroutine begins to count afresh: what it might do before the first look is counted at once.
int create(lua_State* L) {
  used += interval;
  return original(L);
}

// coroutine.wrap: the function Lua makes has its thread as first upvalue.
int wrap(lua_State* L) {
  used += interval;
  original(L);
  lua_getupvalue(L, -1, 1);
  lua_pushcclosure(L, call_wrapped, 1);
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
  lua_getglobal(L, threads);
  lua_getfield(L, -1, "resume");
  lua_coroutine_resume = lua_tocfunction(L, -1);
  lua_pop(L, 2);
  replace(L, {{threads, "resume", with_thread}, {threads, "close", with_thread}, {threads, "wrap", wrap}, {threads, "create", create}});
  lua_getglobal(L, "xpcall");
  lua_xpcall = lua_tocfunction(L, -1);
  lua_pop(L, 1);
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
}

}  // namespace dotyk::script

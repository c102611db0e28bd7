#pragma once

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace dotyk {

/// Those that this process may use: mpirun binds each to one.
inline int cores() {
  cpu_set_t own;
  return sched_getaffinity(0, sizeof own, &own) == 0 ? std::max(1, CPU_COUNT(&own)) : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// Calls work(0), …, work(count − 1), each once, on as many threads as there are cores, or `most`; an idle thread takes
/// the next number. The calls must not touch what another one writes. Serial on one core and for count ≤ 1.
///
/// Where calls throw, no further ones begin, and the exception of the least number that threw is rethrown:
/// the one that a serial loop would meet, since every lesser number had begun before.
inline void parallel_for(int count, const std::function<void(int)>& work, int most = cores()) {
  const int workers = std::min(count, most);
  if (workers <= 1) {
    for (int k = 0; k < count; ++k) work(k);
    return;
  }
  std::atomic<int> next{0};
  std::mutex failing;
  int failed = count;
  std::exception_ptr failure;
  const auto run = [&] {
    for (int k; (k = next++) < count;) try {
        work(k);
      } catch (...) {  // thrown on in the calling thread
        next = count;
        const std::lock_guard lock(failing);
        if (k < failed) failed = k, failure = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < workers; ++t) try {
        others.emplace_back(run);
      } catch (const std::system_error&) {  // no more threads to be had: those there are do it
        break;
      }
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Into how many like shares work is cut for threads, none of which gets less than `least`.
inline int shares_of(std::int64_t work, std::int64_t least) { return static_cast<int>(std::clamp<std::int64_t>(work / least, 1, cores())); }

/// Calls work(k, first, end) for so many shares first … end − 1 of the numbers below `count`, each on a thread, as parallel_for() does.
inline void parallel_shares(int count, int shares, const std::function<void(int, int, int)>& work) {
  const auto begin = [&](int k) { return static_cast<int>(static_cast<std::int64_t>(count) * k / shares); };
  parallel_for(shares, [&](int k) { work(k, begin(k), begin(k + 1)); });
}

}  // namespace dotyk

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
#include <utility>
#include <vector>

namespace dotyk {

/// The number of cores that this process may use. Under mpirun it can be one, as mpirun binds processes to cores.
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

/// The number of threads for an amount of work: at most one a core, and each with at least the amount `least`.
inline int threads_for(std::int64_t work, std::int64_t least) {
  return work < 2 * least ? 1 : static_cast<int>(std::min<std::int64_t>(work / least, cores()));
}

/// Cuts the numbers 0 … count − 1 into ranges of nearly equal length and calls work(k, first, end) for the k-th range, first … end − 1. Each range has a
/// thread of its own; exceptions are treated as in parallel_for().
inline void parallel_ranges(int count, int ranges, const std::function<void(int, int, int)>& work) {
  const auto begin = [&](int k) { return static_cast<int>(static_cast<std::int64_t>(count) * k / ranges); };
  parallel_for(ranges, [&](int k) { work(k, begin(k), begin(k + 1)); }, ranges);
}

/// Cuts the numbers 0 … count − 1 into ranges and calls work(first, end) for each, on all cores where there are many numbers.
template <class Work>
void parallel_parts(std::ptrdiff_t count, const Work& work) {
  constexpr std::int64_t kFew = 100'000;
  parallel_ranges(static_cast<int>(count), threads_for(count, kFew), [&](int, int first, int end) { work(first, end); });
}

/// The sum of what term(first, end) gives for ranges of the numbers 0 … count − 1, on all cores; a thread has at least `few` of them. The last digit depends on
/// the number of threads.
template <class Term>
auto parallel_sum(std::ptrdiff_t count, std::int64_t few, const Term& term) {
  std::vector<decltype(term(0, 0))> parts(static_cast<std::size_t>(threads_for(count, few)));
  parallel_ranges(static_cast<int>(count), static_cast<int>(parts.size()), [&](int k, int first, int end) { parts[k] = term(first, end); });
  auto sum = std::move(parts[0]);
  for (std::size_t k = 1; k < parts.size(); ++k) sum += parts[k];
  return sum;
}

}  // namespace dotyk

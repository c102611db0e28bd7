#include "base/parallel.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

using namespace dotyk;

TEST_CASE("every number is worked on once") {
  for (int count : {0, 1, 2, 3, 1000}) {
    std::vector<int> calls(count, 0);
    parallel_for(count, [&](int k) { ++calls[k]; });
    CHECK(calls == std::vector<int>(count, 1));
  }
}

TEST_CASE("ranges are of like length, follow one another and leave nothing out") {
  for (int count : {0, 1, 2, 3, 1000, 2'000'000'000})
    for (int ranges : {1, 2, 3, 7}) {
      std::vector<std::pair<int, int>> of(ranges);
      parallel_ranges(count, ranges, [&](int k, int first, int end) { of[k] = {first, end}; });
      int from = 0;
      for (const auto& [first, end] : of) {
        CHECK(first == from);
        CHECK(std::abs(end - first - count / ranges) <= 1);
        from = end;
      }
      CHECK(from == count);
    }
}

TEST_CASE("the sum of ranges is that of all numbers, however many threads there are") {
  for (const int count : {0, 1, 10, 1000})
    for (const int few : {1, 7, 2000}) {
      const auto sum = [](int first, int end) {
        std::string all;
        for (int k = first; k < end; ++k) all += std::to_string(k) + " ";
        return all;
      };
      CHECK(parallel_sum(count, few, sum) == sum(0, count));  // in their order
    }
}

TEST_CASE("threads work side by side where there are cores") {
  if (cores() < 2) return;
  // Two calls that wait for each other end only if both are under way at once.
  std::atomic<int> begun{0};
  std::set<std::thread::id> who;
  std::mutex guard;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  parallel_for(2, [&](int) {
    ++begun;
    while (begun < 2 && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
    const std::lock_guard lock(guard);
    who.insert(std::this_thread::get_id());
  });
  CHECK(who.size() == 2);
}

TEST_CASE("of several exceptions the one of the least number comes out, and no call begins after it") {
  for (int trial = 0; trial < 50; ++trial) {
    std::atomic<int> calls{0};
    std::string message;
    try {
      parallel_for(100000, [&](int k) {
        ++calls;
        if (k >= 17) throw std::runtime_error(std::to_string(k));
        if (k >= 10) std::this_thread::yield();
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    CHECK(message == "17");
    CHECK(calls >= 18);
    CHECK(calls <= 17 + cores());
  }
}

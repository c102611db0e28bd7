#include <doctest/doctest.h>
#include <sys/resource.h>

#include "base/buckets.hpp"
#include "base/memory.hpp"

using namespace dotyk;

TEST_CASE("counts are ints as long as they fit into one") {
  CHECK(counted(0) == 0);
  CHECK(counted(2147483647) == 2147483647);
  CHECK_THROWS_WITH_AS(counted(2147483648), "a matrix, graph or message of 2147483648 entries: 2147483647 are the most in one process; take fewer cells, or more ranks", InputError);
  const Buckets buckets(3, [](auto&& put) { put(2, 7), put(0, 5), put(2, 1); });
  CHECK(buckets.before(2) == 1);
  CHECK(std::vector<int>(buckets[2].begin(), buckets[2].end()) == std::vector<int>{7, 1});
}

#ifndef __SANITIZE_ADDRESS__  // which takes all of the address space
TEST_CASE("the stated limit of memory stays, whatever is left of it") {
  const double stated = memory_limit();
  CHECK(stated <= static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)));
  CHECK(stated > 0);
  rlimit own{};
  getrlimit(RLIMIT_AS, &own);
  rlimit tight = own;
  tight.rlim_cur = static_cast<rlim_t>(address_space_taken() + 1e8);
  setrlimit(RLIMIT_AS, &tight);
  const double left = available_memory(), then = memory_limit();
  setrlimit(RLIMIT_AS, &own);
  CHECK(left <= 1e8);
  CHECK(then == stated);
}
#endif

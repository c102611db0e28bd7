#include "algebra/direct/blas_threads.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>

#include "base/error.hpp"

using namespace dotyk;

namespace {

constexpr double kThreads = 1e9, kSerial = 1;  // flops of each: worth threads, and not

struct Told : Monitor {
  std::vector<std::string> phases;
  int most = 1 << 30;  ///< phases before it asks to stop
  void phase(const std::string& what) override { phases.push_back(what); }
  bool stop() override { return static_cast<int>(phases.size()) >= most; }
};

}  // namespace

TEST_CASE("each is factored once, and told before, the greatest first") {
  for (const double flops : {kThreads, kSerial})
    for (const double first : {1.0, 100.0}) {  // times as much: more than two thirds of the work
      Told told;
      std::atomic<int> times[5] = {};
      algebra::factor_in_threads({flops, 2 * flops, first * 4 * flops, 3 * flops, flops}, [](int k, int) { return std::to_string(k); }, told,
                                 [&](int k) { ++times[k]; });
      for (const auto& count : times) CHECK(count == 1);
      CHECK(told.phases.size() == 5);
      if (flops == kSerial) CHECK(told.phases == std::vector<std::string>{"2", "3", "1", "0", "4"});
    }
  Told told;
  algebra::factor_in_threads({}, [](int, int) { return ""; }, told, [](int) { FAIL("of nothing"); });
  CHECK(told.phases.empty());
}

TEST_CASE("what a factorisation throws arrives, of several the greatest one's; a stop begins no further ones") {
  for (const double flops : {kThreads, kSerial}) {
    Told told;
    const auto fail = [&] {
      algebra::factor_in_threads({flops, 3 * flops, 2 * flops}, [](int, int) { return ""; }, told, [](int k) { throw InputError(std::to_string(k)); });
    };
    CHECK_THROWS_WITH_AS(fail(), "1", InputError);
    Told stops;
    stops.most = 2;
    std::atomic<int> begun = 0;
    CHECK_THROWS_AS(algebra::factor_in_threads(std::vector<double>(8, flops), [](int, int) { return ""; }, stops, [&](int) { ++begun; }), Interrupted);
    CHECK(begun == 2);
  }
}

#include <doctest/doctest.h>

#include "../support/meshes.hpp"
#include "base/error.hpp"

using namespace dotyk;

TEST_CASE("graded ticks follow the map and keep the ends exactly") {
  const auto t = mesh::ticks(
      2, 5, 10, [](double s) { return s * s; }, "x");
  REQUIRE(t.size() == 11);
  CHECK(t.front() == 2);
  CHECK(t.back() == 5);
  for (int i = 0; i <= 10; ++i) CHECK(t[i] == doctest::Approx(2 + 3 * i * i / 100.0));
}

TEST_CASE("a graded rectangle keeps its area and its cells positive") {
  const double from[2] = {0, 0}, to[2] = {2, 1};
  const int cells[2] = {12, 9};
  const mesh::Grading grading[2] = {[](double s) { return (std::exp(3 * s) - 1) / (std::exp(3.0) - 1); },
                                    [](double s) { return s * s * (3 - 2 * s); }};
  for (const auto family : test::kAllFamilies) {
    const auto m = mesh::rectangle(from, to, cells, family, grading);
    CHECK(test::measure(m) == doctest::Approx(2).epsilon(1e-14));
    CHECK_NOTHROW(mesh::check(m, "graded"));
  }
}

TEST_CASE("gradings that do not increase, miss the ends or give no number are refused") {
  const auto refused = [](const mesh::Grading& g, const char* message) {
    CHECK_THROWS_WITH_AS(mesh::ticks(0, 1, 4, g, "y"), doctest::Contains(message), InputError);
  };
  refused([](double s) { return s * (1 - s); }, "grading.y must increase and be finite; at s = 0.75");
  refused([](double s) { return s == 0.5 ? NAN : s; }, "grading.y must increase and be finite; at s = 0.5");
  refused([](double s) { return 2 * s; }, "grading.y must map 0 to 0 and 1 to 1; it gives 0 and 2");
  refused([](double s) { return 0.1 + 0.9 * s; }, "must map 0 to 0");
  refused([](double) { return 0.5; }, "must increase");
}

TEST_CASE("where the numbers have no room for the cells that is said, not that the grading is wrong") {
  const auto refused = [](double a, double b, const mesh::Grading& g, const char* message) {
    CHECK_THROWS_WITH_AS(mesh::ticks(a, b, 100, g, "y"), doctest::Contains(message), InputError);
  };
  for (const mesh::Grading& g : {mesh::Grading(), mesh::Grading([](double s) { return s * s; })}) {
    refused(-1e308, 1e308, g, "the extent along y, from -1e+308 to 1e+308, is beyond the range of numbers; choose another unit of length");
    refused(1e16, 1e16 + 100, g, "the 100 cells along y, from 1e+16, are so narrow that their nodes coincide in rounding");
  }
}

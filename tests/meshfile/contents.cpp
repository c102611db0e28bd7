#include "meshfile/contents.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace dotyk::meshfile;

namespace {

std::string bytes(const Contents& contents) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  write(out, contents);
  std::fclose(out);
  std::string result(text, size);
  std::free(text);
  return result;
}

}  // namespace

TEST_CASE("contents are handed over as they are; what is cut off anywhere is refused") {
  Contents c;
  c.points = {0, 0, 0, 1, 0, 0, 0, 1.5, 0};
  c.groups = {{2, "a region"}, {1, ""}};
  c.blocks = {{Shape::triangle, {0}, {0, 1, 2}}, {Shape::segment, {1}, {0, 1, 1, 2}}, {Shape::pyramid, {}, {}}, {Shape::triangle, {0}, {0, 1, 2}, 2, {1, -1, 2}}};
  const std::string whole = bytes(c);
  const Contents back = read(whole);
  CHECK(back.points == c.points);
  REQUIRE(back.groups.size() == 2);
  CHECK(back.groups[0].name == "a region");
  CHECK(back.groups[1].dimension == 1);
  REQUIRE(back.blocks.size() == 4);
  CHECK(back.blocks[0].order == 1);
  CHECK(back.blocks[3].order == 2);
  CHECK(back.blocks[3].between == std::vector<int>{1, -1, 2});
  CHECK(back.blocks[1].shape == Shape::segment);
  CHECK(back.blocks[1].groups == std::vector<int>{1});
  CHECK(back.blocks[1].nodes == std::vector<int>{0, 1, 1, 2});
  for (std::size_t n = 0; n < whole.size(); ++n) CHECK_THROWS(read(whole.substr(0, n)));
}

TEST_CASE("contents that name places beyond their lists are refused") {
  Contents c;
  c.points = {0, 0, 0, 1, 0, 0, 0, 1.5, 0};
  c.blocks = {{Shape::triangle, {}, {0, 1, 3}}};
  CHECK_THROWS(read(bytes(c)));
  c.blocks = {{Shape::triangle, {0}, {0, 1, 2}}};
  CHECK_THROWS(read(bytes(c)));
  c.blocks = {{static_cast<Shape>(7), {}, {0, 1, 2}}};
  CHECK_THROWS(read(bytes(c)));
  c.blocks = {{Shape::triangle, {}, {0, 1, 2}}};
  CHECK(read(bytes(c)).blocks.size() == 1);
}

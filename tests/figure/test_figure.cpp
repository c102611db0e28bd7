// How pictures become files, and what is refused.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

ChartPicture small_chart(const std::string& file) {
  ChartPicture chart;
  chart.file = file;
  chart.width = 320, chart.height = 240;
  SeriesPicture s;
  s.x = {0, 1, 2}, s.y = {0, 1, 4};
  chart.series = {s};
  return chart;
}

ScenePicture one_triangle(const std::string& file) {
  ScenePicture scene;
  scene.file = file;
  scene.width = 320, scene.height = 240;
  BodyPicture body;
  body.name = "wedge";
  body.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  body.cells = {0, 1, 2};
  scene.bodies = {body};
  return scene;
}

}  // namespace

TEST_CASE("a picture is a whole PNG of the size asked for, and nothing else is left") {
  const std::filesystem::path folder = "whole";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  draw(small_chart("whole/a.png"));
  draw(one_triangle("whole/b.png"));
  for (const char* file : {"whole/a.png", "whole/b.png"}) {
    const Pixels p = read_png(file);
    CHECK(p.width == 320);
    CHECK(p.height == 240);
    CHECK(white_rim(p));
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  CHECK(files == 2);
}

TEST_CASE("equal pictures give equal bytes, also after others") {
  draw(small_chart("same1.png"));
  draw(one_triangle("other.png"));
  draw(small_chart("same2.png"));
  draw(one_triangle("other2.png"));
  CHECK(bytes_of("same1.png") == bytes_of("same2.png"));
  CHECK(bytes_of("other.png") == bytes_of("other2.png"));
}

TEST_CASE("a folder that is missing is named, and nothing is made") {
  const std::string why = message_of([] { draw(small_chart("no/such/folder/a.png")); });
  CHECK(contains(why, "no/such/folder"));
  CHECK(contains(why, "No such file or directory"));
  CHECK_FALSE(std::filesystem::exists("no"));
}

TEST_CASE("a folder that cannot be written is named, and the old file stays") {
  std::filesystem::create_directory("locked");
  draw(small_chart("locked/a.png"));
  const std::string before = bytes_of("locked/a.png");
  ChartPicture other = small_chart("locked/a.png");
  other.series[0].y = {4, 1, 0};
  chmod("locked", 0555);
  const std::string why = message_of([&] { draw(other); });
  chmod("locked", 0755);
  if (geteuid() != 0) {  // the superuser may write anywhere
    CHECK(contains(why, "locked"));
    CHECK(bytes_of("locked/a.png") == before);
  }
  std::filesystem::create_directory("whole.png");
  CHECK(contains(message_of([] { draw(small_chart("whole.png")); }), "it is a folder"));
  std::filesystem::create_directory("file");
  draw(small_chart("file/x.png"));
  CHECK(contains(message_of([] { draw(small_chart("file/x.png/y.png")); }), "is not a folder"));
}

TEST_CASE("what is refused, and with which words") {
  CHECK(contains(message_of([] { draw(small_chart("a.eps")); }), "must end in .png, .pdf or .svg"));
  ChartPicture chart = small_chart("refused.png");
  chart.width = 20;
  CHECK(contains(message_of([&] { draw(chart); }), "expected 160 to 8192"));
  chart = small_chart("refused.png");
  chart.series[0].name = "pdas";
  chart.series[0].y.pop_back();
  CHECK(message_of([&] { draw(chart); }) == "series \"pdas\": 3 x for 2 y");

  ScenePicture scene = one_triangle("refused.png");
  scene.bodies[0].cells = {0, 1, 3};
  CHECK(message_of([&] { draw(scene); }) == "body \"wedge\", cells: node 3 does not exist, there are 3");
  scene = one_triangle("refused.png");
  scene.bodies[0].displacement = {0, 0};
  CHECK(contains(message_of([&] { draw(scene); }), "2 displacement components for 3 nodes"));
  scene = one_triangle("refused.png");
  scene.bodies[0].points[4] = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(message_of([&] { draw(scene); }), "a coordinate is not finite"));
  scene.bodies.clear();
  CHECK(contains(message_of([&] { draw(scene); }), "shows no body"));
  CHECK_FALSE(exists("refused.png"));
}

TEST_CASE("colours of statuses are those of Okabe and Ito, and differ") {
  CHECK(std::string(status_name(Status::slip)) == "slip");
  const Status all[] = {Status::open, Status::closed, Status::stick, Status::slip};
  for (const Status a : all)
    for (const Status b : all) CHECK((status_colour(a) == status_colour(b)) == (a == b));
}

// Gmsh's files: an element is of the group that it says; counts that are not those of the file are refused.
#include "meshfile/formats.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>

#include "../support/file.hpp"
#include "base/error.hpp"
#include "meshfile/assemble.hpp"

using namespace dotyk;
using namespace dotyk::meshfile;

namespace {

std::string refusal(const std::string& all) {
  try {
    assemble(read_msh(all, "f.msh"), {}, "f.msh");
  } catch (const InputError& e) {
    return e.what();
  }
  return "not refused";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A square of two triangles in version 2.2. Elements are lines of numbers, "0" for their entity.
std::string square(const std::string& names, const std::vector<std::string>& elements) {
  std::string all = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n" +
                    std::to_string(elements.size()) + "\n";
  for (std::size_t k = 0; k < elements.size(); ++k) all += std::to_string(k + 1) + " " + elements[k] + "\n";
  return all + "$EndElements\n";
}

/// The same file with another count: that of the section, `place` numbers after its name.
std::string with_count(std::string all, const std::string& section, int place, int more) {
  std::size_t at = all.find(section) + section.size() + 1;
  const std::size_t format = all.find("$MeshFormat\n") + 12;
  if (all[all.find(' ', format) + 1] == '1' && all[format] == '4') {  // version 4, binary
    std::uint64_t count = 0;
    at += 8 * static_cast<std::size_t>(place);
    std::memcpy(&count, &all[at], sizeof count);
    count += static_cast<std::uint64_t>(more);
    std::memcpy(&all[at], &count, sizeof count);
    return all;
  }
  for (; place > 0; --place) at = all.find(' ', at) + 1;
  const std::size_t end = all.find_first_of(" \n", at);
  return all.replace(at, end - at, std::to_string(std::stoi(all.substr(at, end - at)) + more));
}

}  // namespace

TEST_CASE("elements are of the physical group that they name, whatever entity they share") {
  const Contents c = read_msh(square("$PhysicalNames\n3\n1 11 \"bottom\"\n1 13 \"the top\"\n2 1 \"soft\"\n$EndPhysicalNames\n",
                                     {"1 2 11 0 1 2", "1 2 12 0 2 3", "1 2 13 0 3 4", "1 2 -14 0 4 1", "15 2 1 0 1", "2 2 1 0 1 2 3", "2 2 2 0 1 3 4"}),
                              "f");
  const Loaded all = assemble(c, {}, "f");
  std::vector<std::string> parts;
  for (const auto& [name, facets] : all.mesh.parts) {
    parts.push_back(name);
    CHECK(facets.size() == 1);
  }
  CHECK(parts == std::vector<std::string>{"12", "14", "bottom", "the top"});
  CHECK(all.mesh.facet_centre(all.mesh.parts.at("12")[0])[0] == 1);
  CHECK(all.regions == std::vector<std::string>{"2", "soft"});
  CHECK(assemble(c, {.regions = {"soft"}}, "f").mesh.cell_count() == 1);
}

TEST_CASE("a group may have every number of 32 bits") {
  for (const char* number : {"2147483647", "-2147483647", "-2147483648"})
    CHECK(assemble(read_msh(square("", {std::string("1 2 ") + number + " 0 1 2", "2 2 1 0 1 2 3", "2 2 1 0 1 3 4"}), "f"), {}, "f").mesh.parts.size() == 1);
}

TEST_CASE("groups of one name keep it: a part is all of them, and the notes say so") {
  const Loaded all = assemble(read_msh(square("$PhysicalNames\n4\n1 11 \"side\"\n1 12 \"side\"\n2 1 \"side\"\n0 5 \"tip\"\n$EndPhysicalNames\n",
                                              {"1 2 11 0 1 2", "1 2 12 0 2 3", "15 2 5 0 1", "2 2 1 0 1 2 3", "2 2 1 0 1 3 4"}),
                                       "f"), {}, "f");
  CHECK(all.mesh.parts.at("side").size() == 2);
  CHECK(all.regions == std::vector<std::string>{"side"});
  CHECK(all.notes == std::vector<std::string>{"group 'tip' is of points; it is neither a region nor a part of the boundary",
                                              "part 'side': 2 groups of the file have this name; it is all of them"});
}

TEST_CASE("a file with another number of nodes or elements than it says is refused, in every version and encoding") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DOTYK_TEST_DIR "/files")) {
    const std::string all = test::bytes_of(entry.path());
    const bool blocks = all[all.find("$MeshFormat\n") + 12] == '4';
    CHECK(refusal(all) == "not refused");
    ++files;
    for (const auto& [section, things] : std::map<std::string, std::string>{{"$Nodes", "nodes"}, {"$Elements", "elements"}})
      for (const int place : blocks ? std::vector<int>{0, 1} : std::vector<int>{0})
        for (const int more : {-1, 1}) {
          const std::string why = refusal(with_count(all, section, place, more));
          CHECK_MESSAGE(why != "not refused", entry.path().filename().string() << " " << section << " " << place << " " << more);
          if (place == 1) CHECK_MESSAGE(has(why, "it says that it has "), why);
        }
  }
  CHECK(files == 15);
  const std::vector<std::string> cells{"2 2 1 0 1 2 3", "2 2 1 0 1 3 4"};
  CHECK(refusal(with_count(square("", cells), "$Elements", 0, -1)) == "f.msh, line 14: it says that it has 1 elements, and more follow");
  CHECK(refusal(with_count(square("", cells), "$Elements", 0, 1)) == "f.msh, line 14: it says that it has 3 elements, and has 2");
  CHECK(refusal(with_count(square("", cells), "$Nodes", 0, -1)) == "f.msh, line 9: it says that it has 3 nodes, and more follow");
}

TEST_CASE("what makes no mesh is refused where it stands") {
  CHECK(has(refusal(square("", {"2 2 1 0 1 2 5"})), "f.msh, line 13: node 5 of an element is not there"));
  CHECK(has(refusal(square("", {"34 2 1 0 1 2 3"})), "elements of type 34 are not read"));
  CHECK(has(refusal(square("", {"2 2 1 0 1 2 x"})), "line 13: 'x' where a node of an element should be"));
  CHECK(has(refusal(square("$Periodic\n1\n", {"2 2 1 0 1 2 3"})), "section '$Periodic' does not end"));
  CHECK(has(refusal(square("$PhysicalNames\n1\n1 11 bottom\n$EndPhysicalNames\n", {})), "a name in double quotes is expected"));
  std::string twice = square("", {"2 2 1 0 1 2 3"});
  twice.replace(twice.find("\n2 1 0 0"), 8, "\n1 1 0 0");
  CHECK(has(refusal(twice), "node 1 is there twice"));
}

TEST_CASE("a binary file of the other byte order is the same mesh") {
  std::string all = test::bytes_of(DOTYK_TEST_DIR "/files/triangles_22_binary.msh");
  const Contents here = read_msh(all, "f");
  const auto turn = [&](std::size_t at, int size) { std::reverse(all.begin() + static_cast<std::ptrdiff_t>(at), all.begin() + static_cast<std::ptrdiff_t>(at) + size); };
  turn(all.find("2.2 1 8\n") + 8, 4);
  std::size_t at = all.find('\n', all.find("$Nodes\n") + 7) + 1;
  for (std::size_t n = here.points.size() / 3; n > 0; --n) {
    turn(at, 4), at += 4;
    for (int i = 0; i < 3; ++i) turn(at, 8), at += 8;
  }
  at = all.find('\n', all.find("$Elements\n") + 10) + 1;
  for (; all.compare(at, 5, "\n$End") != 0; at += 4) turn(at, 4);
  const Contents there = read_msh(all, "f");
  CHECK(there.points == here.points);
  REQUIRE(there.blocks.size() == here.blocks.size());
  for (std::size_t b = 0; b < here.blocks.size(); ++b) CHECK(there.blocks[b].nodes == here.blocks[b].nodes);
}

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "../support/file.hpp"
#include "base/error.hpp"
#include "program/lcp.hpp"
#include "program/program_file.hpp"
#include "programs.hpp"

using namespace dotyk;

namespace {

// minimise x² + y² − 2x − 5y + 0.5 where x + y ≤ 2, x ≥ 0, y ≥ 0: the solution is (1/4, 7/4).
const std::string kFile = DOTYK_TEST_DIR "/../fuzz/files/small.mat";

program::QuadraticProgram read_bytes(const std::string& bytes) {
  { std::ofstream("made.mat", std::ios::binary) << bytes; }
  Monitor quiet;
  return program::read_mat("made.mat", quiet);
}

/// Tells where this dotyk was built without libmatio.
bool readable() {
  Monitor quiet;
  try {
    program::read_mat(kFile, quiet);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    MESSAGE("skipped: " << error.what());
    return false;
  }
  return true;
}

/// The variables of kFile, with their tags.
std::vector<std::string> variables() {
  const std::string whole = test::bytes_of(kFile);
  std::vector<std::string> all;
  for (std::size_t at = 128; at < whole.size(); at += all.back().size()) {
    std::uint32_t size = 0;
    std::memcpy(&size, &whole[at + 4], 4);
    all.push_back(whole.substr(at, 8 + size));
  }
  return all;
}

std::string tag(std::uint32_t type, std::size_t size) {
  const std::uint32_t words[] = {type, static_cast<std::uint32_t>(size)};
  return {reinterpret_cast<const char*>(words), sizeof words};
}

/// As zlib has it that stores and does not compress.
std::string compressed(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const unsigned char c : bytes) a = (a + c) % 65521, b = (b + a) % 65521;
  const auto n = static_cast<std::uint16_t>(bytes.size()), not_n = static_cast<std::uint16_t>(~n);
  std::string z = "\x78\x01\x01";
  for (const std::uint16_t word : {n, not_n}) z += static_cast<char>(word & 0xff), z += static_cast<char>(word >> 8);
  z += bytes;
  for (const std::uint32_t word : {b, a}) z += static_cast<char>(word >> 8), z += static_cast<char>(word & 0xff);
  return tag(15, z.size()) + z;
}

}  // namespace

TEST_CASE("a MATLAB file of sparse and full matrices") {
  if (!readable()) return;
  Monitor quiet;
  const auto p = program::read_mat(kFile, quiet);
  CHECK(p.name == "small");
  CHECK(p.r == 0.5);
  CHECK(std::isinf(p.low[0]));
  CHECK(std::isinf(p.high[1]));
  const auto r = program::solve(p, test::one(), quiet);
  REQUIRE(r.status == program::Status::solved);
  CHECK(r.x[0] == doctest::Approx(0.25));
  CHECK(r.x[1] == doctest::Approx(1.75));
  CHECK(r.objective == doctest::Approx(-5.625));
}

TEST_CASE("a MATLAB file cut short anywhere is refused") {
  if (!readable()) return;
  const std::string whole = test::bytes_of(kFile);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    CAPTURE(size);
    CHECK_THROWS_AS(read_bytes(whole.substr(0, size)), InputError);
  }
}

TEST_CASE("a damaged MATLAB file is refused by the name of what is wrong") {
  if (!readable()) return;
  const auto refused = [](const std::string& from, const std::string& to, const std::string& message) {
    std::string bytes = test::bytes_of(kFile);
    REQUIRE(bytes.find(from) != std::string::npos);
    bytes.replace(bytes.find(from), from.size(), to);
    CHECK_THROWS_WITH_AS(read_bytes(bytes), doctest::Contains(message.c_str()), InputError);
  };
  const std::string letter("\1\0\1\0", 4);  // before a name of one
  refused(letter + "u", letter + "v", "'made.mat': variable 'u' is missing; it must have P, q, A, l and u");
  Monitor quiet;
  CHECK_THROWS_WITH_AS(program::read_mat("/nowhere/a.mat", quiet), "cannot read '/nowhere/a.mat': No such file or directory", InputError);
  CHECK_THROWS_WITH_AS(program::read_mat(".", quiet), "cannot read '.': it is a folder", InputError);
}

TEST_CASE("compressed variables are read as others are; what is damaged or missing in them is not taken for zeros") {
  if (!readable()) return;
  const std::string head = test::bytes_of(kFile).substr(0, 128);
  const std::vector<std::string> each = variables();
  const auto file = [&](std::size_t changed, const std::string& to) {
    std::string bytes = head;
    for (std::size_t k = 0; k < each.size(); ++k) bytes += k == changed ? to : compressed(each[k]);
    return bytes;
  };
  const auto as_it_is = read_bytes(test::bytes_of(kFile)), p = read_bytes(file(each.size(), ""));
  CHECK(p.q == as_it_is.q);
  CHECK(p.r == as_it_is.r);
  CHECK(p.low == as_it_is.low);
  CHECK((p.A - as_it_is.A).norm() == 0);
  CHECK((p.P - as_it_is.P).norm() == 0);
  for (std::size_t k = 0; k < each.size(); ++k) {
    CAPTURE(k);
    const std::string short_one = each[k].substr(0, each[k].size() - 8);
    CHECK_THROWS_WITH_AS(read_bytes(file(k, compressed(short_one))), "'made.mat': a compressed variable is damaged or cut short", InputError);
    std::string z = compressed(each[k]);
    z.back() = static_cast<char>(z.back() ^ 1);
    CHECK_THROWS_WITH_AS(read_bytes(file(k, z)), "'made.mat': a compressed variable is damaged or cut short", InputError);
    z = tag(15, each[k].size()) + compressed(each[k]).substr(8, each[k].size());
    CHECK_THROWS_WITH_AS(read_bytes(file(k, z)), "'made.mat': a compressed variable is damaged or cut short", InputError);
    // Compressed twice, it is no variable; r may be missing.
    if (k != 2) CHECK_THROWS_WITH_AS(read_bytes(file(k, compressed(compressed(each[k])))), doctest::Contains("is missing"), InputError);
    // Sizes of the matrix: not those of what is there, or beyond all that can be treated.
    for (const std::int32_t size : {7, 1'000'000'000, -1}) {
      std::string other = each[k];
      std::memcpy(&other[8 + 16 + 8], &size, 4);
      CHECK_THROWS_AS(read_bytes(file(k, compressed(other))), InputError);
      CHECK_THROWS_AS(read_bytes(file(k, other)), InputError);
    }
  }
}

TEST_CASE("MATLAB files of other versions are refused: of 7.3, which may lead to other files, and of 4, which are believed every size") {
  if (!readable()) return;
  std::string bytes = test::bytes_of(kFile);
  REQUIRE(bytes.substr(124, 4) == std::string("\0\1IM", 4));
  bytes.replace(124, 2, std::string("\0\2", 2));
  CHECK_THROWS_WITH_AS(read_bytes(bytes), "'made.mat': it is a MATLAB file of version 7.3, which is not read: save it with -v7", InputError);
  bytes.replace(124, 2, std::string("\2\0", 2));
  const char* other = "'made.mat': it is no MATLAB file of version 5 to 7: save it with -v7";
  CHECK_THROWS_WITH_AS(read_bytes(bytes), other, InputError);
  // Version 4: a full matrix P of 2 x 2, whose numbers are not there.
  const std::int32_t head[] = {0, 2, 2, 0, 2};
  bytes = std::string(reinterpret_cast<const char*>(head), sizeof head) + std::string("P\0", 2);
  for (const std::size_t more : {0, 16, 32, 200}) CHECK_THROWS_WITH_AS(read_bytes(bytes + std::string(more, '\0')), other, InputError);
}

TEST_CASE("a pipe is no file: opening it would wait for ever") {
  mkfifo("pipe", 0600);
  Monitor quiet;
  const char* message = "cannot read 'pipe': it is not a file";
  CHECK_THROWS_WITH_AS(program::read_mat("pipe", quiet), message, InputError);
  CHECK_THROWS_WITH_AS(program::read_qps(std::string("pipe")), message, InputError);
  CHECK_THROWS_WITH_AS(program::read_lcp("pipe"), message, InputError);
  std::filesystem::remove("pipe");
}

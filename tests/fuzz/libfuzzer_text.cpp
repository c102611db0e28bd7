// libFuzzer on the readers of files that run in this process: the first byte says which one, the rest is the file.
// What cannot be read must be refused by an exception that says so; anything else is a finding.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "fclib/contact_problem.hpp"
#include "meshfile/contents.hpp"
#include "meshfile/formats.hpp"
#include "program/lcp.hpp"
#include "program/program_file.hpp"

namespace {

using namespace dotyk;

// For readers that open their file themselves.
const std::string& file_of(std::string_view text) {
  static const std::string name = (std::filesystem::temp_directory_path() / ("dotyk_fuzz_" + std::to_string(getpid()))).string();
  std::ofstream(name, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
  static const int registered = std::atexit([] { std::remove(name.c_str()); });
  static_cast<void>(registered);
  return name;
}

void read(unsigned reader, std::string_view text) {
  switch (reader) {
    case 0:
      meshfile::read_mfem(text, "file");
      break;
    case 1: {
      std::istringstream in{std::string(text)};
      program::read_qps(in, "file");
      break;
    }
    case 2:
      program::read_lcp(file_of(text));
      break;
    case 3:
      fclib::read_text(file_of(text));
      break;
    case 4:
      meshfile::read_msh(text, "file");
      break;
    default:
      meshfile::read(text);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    read(data[0] % 6u, {reinterpret_cast<const char*>(data) + 1, size - 1});
  } catch (const std::exception&) {
  }
  return 0;
}

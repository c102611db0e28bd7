// fuzz_files COUNT SEED [FOLDER]: files that scripts read, changed at random: programs (QPS, MATLAB), linear
// complementarity problems, contact problems as siconos prints them and in HDF5, meshes of Gmsh, MFEM and VTK, of order
// 1 or 2; where ../shared/reference is, its small files too. Each is read, and what could be read is solved. Failures
// are those of fuzz_lua; the file that failed stands in the script.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "../support/file.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "machine.hpp"

namespace {

using namespace dotyk;

// A sound file and the calls that read it; FILE stands for its name.
struct Seed {
  std::string ending, content;
};

std::string read_of(const std::string& ending, bool second_order) {
  if (ending == ".qps" || ending == ".mat") return "dotyk.qp{ file = FILE, method = 'active_set', max_iterations = 50 }";
  if (ending == ".lcp") return "dotyk.lcp{ file = FILE, unique = false }";
  if (ending == ".fc" || ending == ".hdf5") return "dotyk.solver.newton{ max_iterations = 20 }:solve(dotyk.fclib(FILE))";
  return second_order ? "dotyk.mesh.load(FILE, { order = 2 })" : "dotyk.mesh.load(FILE)";
}

// As scripts write it: every byte by its number.
std::string quoted(const std::string& bytes) {
  std::string out = "\"";
  char digits[8];
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte < 127 && c != '"' && c != '\\') {
      out += c;
      continue;
    }
    std::snprintf(digits, sizeof digits, "\\%03d", byte);
    out += digits;
  }
  return out + "\"";
}

std::vector<Seed> seeds() {
  std::vector<Seed> all;
  const auto add = [&](const std::filesystem::path& file, const std::string& ending) {
    all.push_back({ending, dotyk::test::bytes_of(file)});
  };
  for (const auto& entry : std::filesystem::directory_iterator(DOTYK_FUZZ_DIR "/files")) add(entry.path(), entry.path().extension());
  for (const auto& entry : std::filesystem::directory_iterator(DOTYK_FUZZ_DIR "/../meshfile/files"))
    if (entry.file_size() < 30000 && entry.path().extension() != ".geo") add(entry.path(), entry.path().extension());
  const std::filesystem::path reference = DOTYK_FUZZ_DIR "/../../../shared/reference";
  for (const auto& [folder, from, to] : {std::tuple{"lcp", ".dat", ".lcp"}, std::tuple{"fclib/dat", ".dat", ".fc"}}) {
    if (!std::filesystem::is_directory(reference / folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(reference / folder))
      if (entry.path().extension() == from && entry.file_size() < (std::string(folder) == "lcp" ? 600 : 4000)) add(entry.path(), to);  // an LCP without a solution has all its sets tried
  }
  std::sort(all.begin(), all.end(), [](const Seed& a, const Seed& b) { return a.content < b.content; });
  return all;
}

class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  // One to four changes: bytes, words, lines, pieces of another file.
  std::string operator()(std::string bytes, const std::string& other) {
    for (std::size_t changes = below(4) + 1; changes > 0; --changes) change(bytes, other);
    return bytes;
  }

 private:
  void change(std::string& bytes, const std::string& other) {
    static const std::vector<std::string> words = {"-1", "0", "1", "2", "3", "999999999", "2147483648", "-2147483648", "1e308", "1e999", "nan", "inf", "-",
                                                   "0.5", "", "x", "1e-320", "18446744073709551616", "$End", "\n", "1000000"};
    const std::size_t at = below(bytes.size() + 1);
    switch (below(7)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2: {
        const auto from = bytes.find_first_not_of(" \t\n\"", at);
        if (from == std::string::npos) break;
        bytes.replace(from, bytes.find_first_of(" \t\n\"", from) - from, words[below(words.size())]);
        break;
      }
      case 3: {
        const auto from = bytes.rfind('\n', at);
        const auto to = bytes.find('\n', at);
        if (from < to && to != std::string::npos) bytes.erase(from, to - from);
        break;
      }
      case 4: {
        const auto from = bytes.rfind('\n', at);
        const auto to = bytes.find('\n', at);
        if (from < to && to != std::string::npos) bytes.insert(to, bytes.substr(from, to - from));
        break;
      }
      case 5:
        bytes.insert(at, words[below(words.size())]);
        break;
      default:
        if (!other.empty()) bytes.insert(at, other.substr(below(other.size()), below(60)));
    }
  }

  std::mt19937 random_;
};

}  // namespace

int main(int count, char** words) {
  const auto files = static_cast<unsigned>(count > 1 ? std::atoll(words[1]) : 500);
  const auto first = static_cast<unsigned>(count > 2 ? std::atoll(words[2]) : 1);
  fuzz::Machine machine(count > 3 ? words[3] : ".");
  const auto all = seeds();
  const Stopwatch clock;
  unsigned seed = first;
  for (; seed < first + files; ++seed) {
    Mutation mutation(seed);
    const Seed& one = all[mutation.below(all.size())];
    const std::string content = mutation(one.content, all[mutation.below(all.size())].content);
    const std::string name = "fuzz" + (one.ending == ".lcp" || one.ending == ".fc" ? std::string(".dat") : one.ending);
    machine.begin(text("file_", seed));
    std::ofstream(name, std::ios::binary) << content;
    std::string call = read_of(one.ending, mutation.below(2) == 0);
    call.replace(call.find("FILE"), 4, "'" + name + "'");
    machine.run("V[1] = try(function() return " + call + " end)", "do local f <close> = io.open('" + name + "', 'wb') f:write(" + quoted(content) + ") end\n");
  }
  machine.say(text(machine.executions(), " files (seeds ", first, " to ", seed - 1, ", of ", all.size(), " sound ones) in ", clock.seconds(), " s, ", machine.failures(),
                   " failures, ", machine.slowest(), "; memory ", fuzz::resident(), " MB"));
  return machine.failures() > 0;
}

#include <algorithm>
#include <map>
#include <vector>

#include "base/memory.hpp"
#include "fclib/contact_problem.hpp"
#include "fclib/hdf5_object.hpp"
#include "reader/process.hpp"

namespace dotyk::fclib {
namespace {

using algebra::SparseMatrix;
using algebra::Vector;
using Kind = Hdf5Object::Kind;

/// All places of a file that are looked at.
std::vector<std::string> places() {
  std::vector<std::string> all{"fclib_local_rolling", "fclib_global_rolling"};
  for (const std::string group : {"fclib_local", "fclib_global"}) {
    all.push_back(group);
    for (const char* place : {"/spacedim", "/info/title", "/info/description", "/vectors/mu", "/vectors/q", "/vectors/f", "/vectors/w", "/V", "/G", "/R"})
      all.push_back(group + place);
    for (const char* matrix : {"/W", "/M", "/H"})
      for (const char* place : {"/m", "/n", "/nz", "/p", "/i", "/x"}) all.push_back(group + matrix + place);
  }
  return all;
}

class File {
 public:
  File(const std::string& name, Monitor& monitor) : name_(name) {
    const std::vector<std::string> all = places();
    std::vector<std::string> arguments{name};
    arguments.insert(arguments.end(), all.begin(), all.end());
    const std::string program = reader::require_program("dotyk_hdf5", "HDF5 (apt-get install libhdf5-dev, then build again)");
    const std::string bytes = reader::output_of(program, arguments, "'" + name + "'", monitor);
    reader::Answer answer(bytes);
    for (const std::string& place : all) objects_[place] = read_object(answer);
    answer.end();
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError("'" + name_ + "': " + what); }

  bool has(const std::string& path) const { return objects_.at(path).kind != Kind::absent; }

  const std::vector<int>& integers(const std::string& path) const { return at(path, Kind::integers, " does not hold integers").integers; }
  int integer(const std::string& path) const {
    const std::vector<int>& all = integers(path);
    if (all.size() != 1) fail(text(path, " holds ", all.size(), " numbers; one is expected"));
    return all[0];
  }
  Vector vector(const std::string& path) const {
    const std::vector<double>& all = at(path, Kind::reals, " does not hold real numbers").reals;
    return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
  }
  /// A string, or nothing where there is none.
  std::string words(const std::string& path) const {
    const std::string& content = objects_.at(path).words;
    return content.substr(0, content.find('\0'));
  }

 private:
  const Hdf5Object& at(const std::string& path, Kind expected, const char* otherwise) const {
    const Hdf5Object& object = objects_.at(path);
    if (object.kind == Kind::absent) fail(path + " is missing");
    if (object.kind == Kind::group) fail(path + " is not an array");
    if (object.kind != expected) fail(path + otherwise);
    return object;
  }

  std::string name_;
  std::map<std::string, Hdf5Object> objects_;
};

/// One line of a compressed matrix's outer index after the other: the outer index of every entry.
std::vector<int> expand(const File& file, const std::string& path, const std::vector<int>& p, int outer, std::size_t entries) {
  if (p.size() != static_cast<std::size_t>(outer) + 1)
    file.fail(text(path, "/p has ", p.size(), " entries; ", outer + 1, " are expected"));
  if (p.front() != 0 || p.back() != static_cast<int>(entries) || !std::is_sorted(p.begin(), p.end()))
    file.fail(text(path, "/p does not ascend from 0 to the number of entries"));
  std::vector<int> index(entries);
  for (int o = 0; o < outer; ++o) std::fill(index.begin() + p[o], index.begin() + p[o + 1], o);
  return index;
}

/// Triplets (nz ≥ 0: rows i, columns p), compressed columns (nz = −1) or compressed rows (nz = −2). Entries at
/// one place are added.
SparseMatrix matrix(const File& file, const std::string& path) {
  const int m = file.integer(path + "/m"), n = file.integer(path + "/n"), nz = file.integer(path + "/nz");
  if (m < 0 || m > kMost || n < 0 || n > kMost || nz < -2) file.fail(text(path, " has m = ", m, ", n = ", n, ", nz = ", nz));
  const std::vector<int> p = file.integers(path + "/p"), i = file.integers(path + "/i");
  const Vector x = file.vector(path + "/x");
  const std::size_t entries = nz >= 0 ? static_cast<std::size_t>(nz) : i.size();
  if (i.size() < entries || static_cast<std::size_t>(x.size()) < entries || (nz >= 0 && p.size() < entries))
    file.fail(text(path, " has ", entries, " entries, but ", i.size(), " indices and ", x.size(), " values"));
  const std::vector<int> outer = nz >= 0 ? p : expand(file, path, p, nz == -1 ? n : m, entries);
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t k = 0; k < entries; ++k) {
    const int row = nz == -2 ? outer[k] : i[k], column = nz == -2 ? i[k] : outer[k];
    if (row < 0 || row >= m || column < 0 || column >= n)
      file.fail(text(path, " has an entry at (", row, ", ", column, "), outside ", m, " x ", n));
    triplets.emplace_back(row, column, x[static_cast<Eigen::Index>(k)]);
  }
  SparseMatrix a(m, n);
  a.setFromTriplets(triplets.begin(), triplets.end());
  return a;
}

/// The group of the problem: fclib_local or fclib_global.
std::string group_of(const File& file) {
  if (file.has("fclib_global_rolling") || file.has("fclib_local_rolling"))
    file.fail("rolling friction (two rolling moments beside each contact force) is not treated: only "
              "fclib_local and fclib_global are");
  for (const std::string group : {"fclib_local", "fclib_global"})
    if (file.has(group)) {
      for (const char* equations : {"/V", "/G", "/R"})
        if (file.has(group + equations))
          file.fail(text("equations beside the contacts (", group, equations, ") are not treated"));
      return group;
    }
  file.fail("there is no group fclib_local or fclib_global in it");
}

}  // namespace

ContactProblem read_hdf5(const std::string& name, Monitor& monitor) {
  const File file(name, monitor);
  const std::string group = group_of(file);
  ContactProblem p;
  p.name = name;
  p.dimension = file.integer(group + "/spacedim");
  p.mu = file.vector(group + "/vectors/mu");
  p.title = file.words(group + "/info/title");
  p.description = file.words(group + "/info/description");
  if (group == "fclib_local") {
    const SparseMatrix W = matrix(file, group + "/W");
    require_memory(8.0 * W.rows() * W.cols(), text("the dense matrix of ", W.rows(), " rows"));
    p.W = W;
    p.q = file.vector(group + "/vectors/q");
  } else {
    p.kind = ContactProblem::Kind::global;
    p.M = matrix(file, group + "/M");
    p.H = matrix(file, group + "/H");
    p.f = file.vector(group + "/vectors/f");
    p.w = file.vector(group + "/vectors/w");
  }
  return p;
}

}  // namespace dotyk::fclib

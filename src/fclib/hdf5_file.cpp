#include <memory>
#include <stdexcept>
#include <vector>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "fclib/read.hpp"

#ifdef DOTYK_HDF5
#include <hdf5.h>
#endif

namespace dotyk::fclib {

#ifdef DOTYK_HDF5
namespace {

using algebra::SparseMatrix;
using algebra::Vector;

/// An HDF5 identifier with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: stands for the identifier in calls
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Keeps the library from printing its errors while it lives.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_;
  void* data_;
};

class File {
 public:
  explicit File(const std::string& name)
      : name_(name), file_(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose) {
    if (!file_.valid()) throw InputError("'" + name + "' cannot be read as HDF5: it is damaged or cut short");
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError("'" + name_ + "': " + what); }

  bool has(const std::string& path) const {  // every group on the way must be there
    for (auto slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
      if (H5Lexists(file_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
  }

  std::vector<int> integers(const std::string& path) const { return read<int>(path, H5T_INTEGER, H5T_NATIVE_INT); }
  int integer(const std::string& path) const {
    const std::vector<int> all = integers(path);
    if (all.size() != 1) fail(text(path, " holds ", all.size(), " numbers; one is expected"));
    return all[0];
  }
  Vector vector(const std::string& path) const {
    const std::vector<double> all = read<double>(path, H5T_FLOAT, H5T_NATIVE_DOUBLE);
    return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

  /// A string, or nothing where there is none.
  std::string words(const std::string& path) const {
    if (!has(path)) return "";
    const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!set.valid()) return "";
    const Handle type(H5Dget_type(set), &H5Tclose);
    if (!type.valid() || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return "";
    std::string content(H5Tget_size(type), '\0');
    if (points(set) != 1 || H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data()) < 0) return "";
    return content.substr(0, content.find('\0'));
  }

 private:
  static hssize_t points(const Handle& set) {
    const Handle space(H5Dget_space(set), &H5Sclose);
    return space.valid() ? H5Sget_simple_extent_npoints(space) : -1;
  }

  template <class Number>
  std::vector<Number> read(const std::string& path, H5T_class_t expected, hid_t memory_type) const {
    if (!has(path)) fail(path + " is missing");
    const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!set.valid()) fail(path + " is not an array");
    const Handle type(H5Dget_type(set), &H5Tclose);
    if (!type.valid() || H5Tget_class(type) != expected)
      fail(path + (expected == H5T_INTEGER ? " does not hold integers" : " does not hold real numbers"));
    const hssize_t size = points(set);
    if (size < 0) fail(path + " cannot be read");
    require_memory(static_cast<double>(size) * sizeof(Number), path);
    std::vector<Number> values(static_cast<std::size_t>(size));
    if (size > 0 && H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      fail(path + " cannot be read");
    return values;
  }

  std::string name_;
  Quiet quiet_;
  Handle file_;
};

/// One line of a compressed matrix's outer index after the other: the outer index of every entry.
std::vector<int> expand(const File& file, const std::string& path, const std::vector<int>& p, int outer, std::size_t entries) {
  if (p.size() != static_cast<std::size_t>(outer) + 1)
    file.fail(text(path, "/p has ", p.size(), " entries; ", outer + 1, " are expected"));
  std::vector<int> index(entries);
  for (int o = 0; o < outer; ++o) {
    if (p[o] < 0 || p[o] > p[o + 1] || p[o + 1] > static_cast<int>(entries))
      file.fail(text(path, "/p does not ascend from 0 to the number of entries"));
    std::fill(index.begin() + p[o], index.begin() + p[o + 1], o);
  }
  if (p.front() != 0 || p.back() != static_cast<int>(entries))
    file.fail(text(path, "/p does not ascend from 0 to the number of entries"));
  return index;
}

/// Triplets (nz ≥ 0: rows i, columns p), compressed columns (nz = −1) or compressed rows (nz = −2). Entries at
/// one place are added.
SparseMatrix matrix(const File& file, const std::string& path) {
  const int m = file.integer(path + "/m"), n = file.integer(path + "/n"), nz = file.integer(path + "/nz");
  if (m < 0 || n < 0 || nz < -2) file.fail(text(path, " has m = ", m, ", n = ", n, ", nz = ", nz));
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

ContactProblem read_hdf5(const std::string& name) {
  const File file(name);
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

#else

ContactProblem read_hdf5(const std::string& name) {
  throw std::runtime_error("'" + name + "' cannot be read: this dotyk was built without HDF5 "
                           "(apt-get install libhdf5-dev, then build again)");
}

#endif

}  // namespace dotyk::fclib

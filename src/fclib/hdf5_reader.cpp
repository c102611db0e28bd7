// Reads objects of an HDF5 file with its own library.
//   dotyk_hdf5 FILE PATH…     each is handed over as an Hdf5Object, in this order
#include <hdf5.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "hdf5_object.hpp"
#include "reader/reader_main.hpp"

namespace {

using dotyk::fclib::Hdf5Object;

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

/// Every group on the way must be there. Throws at a link to another place, which may be another file's.
bool has(hid_t file, const std::string& path) {
  for (auto slash = path.find('/');; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    H5L_info_t info;
    if (H5Lget_info(file, part.c_str(), &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_HARD) throw std::runtime_error(part + " is a link to another place, which is not followed");
    if (slash == std::string::npos) return true;
  }
}

/// Throws where the data lie in other files, which the file only names.
void require_here(hid_t set, const std::string& path) {
  const Handle how(H5Dget_create_plist(set), &H5Pclose);
  if (!how.valid() || H5Pget_external_count(how) != 0 || H5Pget_layout(how) == H5D_VIRTUAL)
    throw std::runtime_error(path + " lies in another file, which is not read");
}

template <class Sequence>
Sequence numbers(hid_t set, hid_t type, hssize_t size, const std::string& path) {
  using Number = typename Sequence::value_type;
  if (size < 0 || static_cast<std::size_t>(size) > std::numeric_limits<std::size_t>::max() / sizeof(Number) / 2)
    throw std::runtime_error(path + " cannot be read");
  Sequence values(static_cast<std::size_t>(size), Number{});
  if (size > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) throw std::runtime_error(path + " cannot be read");
  return values;
}

Hdf5Object object(hid_t file, const std::string& path) {
  using Kind = Hdf5Object::Kind;
  if (!has(file, path)) return {};
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), &H5Dclose);
  if (!set.valid()) return {Kind::group};
  require_here(set, path);
  const Handle type(H5Dget_type(set), &H5Tclose), space(H5Dget_space(set), &H5Sclose);
  if (!type.valid() || !space.valid()) throw std::runtime_error(path + " cannot be read");
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  Hdf5Object out{Kind::other};
  switch (H5Tget_class(type)) {
    case H5T_INTEGER: return {Kind::integers, numbers<std::vector<int>>(set, H5T_NATIVE_INT, size, path)};
    case H5T_FLOAT: return {Kind::reals, {}, numbers<std::vector<double>>(set, H5T_NATIVE_DOUBLE, size, path)};
    case H5T_STRING:
      if (size != 1 || H5Tis_variable_str(type) != 0) return out;
      out.words.resize(H5Tget_size(type));
      if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.words.data()) < 0) throw std::runtime_error(path + " cannot be read");
      out.kind = Kind::words;
      return out;
    default: return out;
  }
}

}  // namespace

int main(int count, char** argument) {
  if (count < 2) return 2;
  dotyk::reader::limit_reader(argument[1]);
  return dotyk::reader::answer([&](std::FILE* out) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are not printed
    const Handle file(H5Fopen(argument[1], H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
    if (!file.valid()) throw std::runtime_error("it is no whole HDF5 file: damaged or cut short");
    std::vector<Hdf5Object> all;
    for (int k = 2; k < count; ++k) all.push_back(object(file, argument[k]));
    for (const Hdf5Object& one : all) write(out, one);
    dotyk::reader::put_end(out);
  });
}

// Reads matrices of a MATLAB file with libmatio.
//   dotyk_mat FILE.mat VARIABLE…     each is handed over as a MatVariable, in this order
#include <matio.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "mat_variable.hpp"
#include "reader/reader_main.hpp"

namespace {

using dotyk::program::MatVariable;

constexpr std::size_t kMost = 100'000'000;
constexpr uLong kMostBytes = 1'000'000'000;  ///< of a compressed variable: a few bytes may become any number

/// The words of a file, first byte first or last.
struct Order {
  bool little;
  std::uintmax_t operator()(const unsigned char* b) const {
    return little ? b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uintmax_t>(b[3]) << 24
                  : b[3] | b[2] << 8 | b[1] << 16 | static_cast<std::uintmax_t>(b[0]) << 24;
  }
};

/// Throws where the next `size` bytes are not what a compressed variable is, by zlib's check sum and its own size.
void require_sound(std::istream& in, std::uintmax_t size, const Order& word) {
  std::array<unsigned char, 1 << 16> packed, plain;
  std::array<unsigned char, 8> tag{};
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  int status = Z_OK;
  while (status == Z_OK && (size > 0 || stream.avail_in > 0) && stream.total_out <= kMostBytes) {
    if (stream.avail_in == 0) {
      in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(std::min<std::uintmax_t>(size, packed.size())));
      stream.next_in = packed.data(), stream.avail_in = static_cast<uInt>(in.gcount());
      size -= stream.avail_in;
      if (stream.avail_in == 0) break;
    }
    stream.next_out = plain.data(), stream.avail_out = plain.size();
    const uLong before = stream.total_out;
    status = inflate(&stream, Z_NO_FLUSH);
    for (uLong k = before; k < std::min<uLong>(stream.total_out, tag.size()); ++k) tag[k] = plain[k - before];
  }
  const std::uintmax_t total = stream.total_out;
  inflateEnd(&stream);
  if (total > kMostBytes) throw std::runtime_error("a compressed variable has more than a gigabyte");
  if (status != Z_STREAM_END || total < tag.size() + word(tag.data() + 4)) throw std::runtime_error("a compressed variable is damaged or cut short");
}

/// Throws where a file is not of version 5, ends within an element, or has damaged ones: libmatio takes what is missing for
/// zeros. In a file of version 4 it believes every size, and one of version 7.3 (HDF5) may lead to other files.
void require_whole(const std::string& file) {
  constexpr std::uintmax_t kCompressed = 15;
  std::ifstream in(file, std::ios::binary);
  std::array<char, 128> head{};
  in.read(head.data(), head.size());
  const bool little = head[126] == 'I' && head[127] == 'M', big = head[126] == 'M' && head[127] == 'I';
  const int version = in.gcount() == head.size() && (little || big) ? head[little ? 125 : 124] << 8 | head[little ? 124 : 125] : 0;
  if (version == 0x200) throw std::runtime_error("it is a MATLAB file of version 7.3, which is not read: save it with -v7");
  if (version != 0x100) throw std::runtime_error("it is no MATLAB file of version 5 to 7: save it with -v7");
  const auto size = std::filesystem::file_size(file);
  const Order word{little};
  for (std::uintmax_t at = head.size(); at < size;) {
    std::array<unsigned char, 8> tag{};
    in.clear();
    in.seekg(static_cast<std::streamoff>(at));
    in.read(reinterpret_cast<char*>(tag.data()), tag.size());
    const bool small = word(tag.data()) >> 16 != 0;  // the element stands in its tag
    const std::uintmax_t length = small ? 0 : word(tag.data() + 4);
    at += tag.size() + length;
    if (in.gcount() != tag.size() || at > size) throw std::runtime_error("the file is cut short");
    if (word(tag.data()) == kCompressed) require_sound(in, length, word);
  }
}

/// Do columns and rows of the entries lie within the matrix, and the entries within the lists? The file alone says so.
bool sound(const mat_sparse_t& s, std::size_t rows, std::size_t columns) {
  if (s.njc != columns + 1 || !s.jc) return false;
  for (std::size_t j = 0; j < columns; ++j)
    if (s.jc[j] > s.jc[j + 1]) return false;
  const std::size_t count = s.jc[columns];
  if (count > s.nir || count > s.ndata || (count > 0 && (!s.ir || !s.data))) return false;
  for (std::size_t k = 0; k < count; ++k)
    if (s.ir[k] >= rows) return false;
  return true;
}

/// The k-th of numbers that the file packs into whatever type holds them.
double number(const void* data, matio_types type, std::size_t k) {
  switch (type) {
    case MAT_T_DOUBLE: return static_cast<const double*>(data)[k];
    case MAT_T_SINGLE: return static_cast<const float*>(data)[k];
    case MAT_T_INT8: return static_cast<const std::int8_t*>(data)[k];
    case MAT_T_UINT8: return static_cast<const std::uint8_t*>(data)[k];
    case MAT_T_INT16: return static_cast<const std::int16_t*>(data)[k];
    case MAT_T_UINT16: return static_cast<const std::uint16_t*>(data)[k];
    case MAT_T_INT32: return static_cast<const std::int32_t*>(data)[k];
    case MAT_T_UINT32: return static_cast<const std::uint32_t*>(data)[k];
    default: throw std::runtime_error("numbers of a type that is not read");
  }
}

void add(MatVariable& to, std::size_t row, int column, double value) {
  to.row.push_back(static_cast<int>(row)), to.column.push_back(column), to.value.push_back(value);
}

bool is_there(mat_t* file, const char* name) {
  std::size_t count = 0;
  char* const* names = Mat_GetDir(file, &count);
  return std::any_of(names, names + count, [&](const char* one) { return one && std::strcmp(one, name) == 0; });
}

/// Throws where it is no real matrix of doubles, saying what it is.
MatVariable matrix(mat_t* file, const char* name) {
  MatVariable out;
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> v(Mat_VarRead(file, name), &Mat_VarFree);
  const auto fail = [name](const char* what) { throw std::runtime_error("variable '" + std::string(name) + "' " + what); };
  if (!v && is_there(file, name)) fail("cannot be read");
  if (!v) return out;
  if (v->rank != 2 || v->isComplex) fail("is not a real matrix");
  if (v->dims[0] > kMost || v->dims[1] > kMost) fail("is too large");
  out.rows = static_cast<int>(v->dims[0]), out.columns = static_cast<int>(v->dims[1]);
  if (out.rows == 0 || out.columns == 0) return out;
  if (!v->data) fail("has no entries in the file");
  if (v->class_type == MAT_C_SPARSE) {
    const auto* s = static_cast<const mat_sparse_t*>(v->data);
    if (!sound(*s, v->dims[0], v->dims[1])) fail("is damaged: its sparse entries do not fit its size");
    for (int j = 0; j < out.columns; ++j)
      for (auto k = s->jc[j]; k < s->jc[j + 1]; ++k) add(out, s->ir[k], j, number(s->data, v->data_type, k));
  } else if (v->class_type == MAT_C_DOUBLE) {
    if (v->data_type != MAT_T_DOUBLE) fail("is not stored as doubles");
    if (v->nbytes / sizeof(double) / v->dims[0] < v->dims[1]) fail("has too few entries in the file");
    const auto* x = static_cast<const double*>(v->data);
    for (int j = 0; j < out.columns; ++j)
      for (std::size_t i = 0; i < v->dims[0]; ++i, ++x)
        if (*x != 0) add(out, i, j, *x);
  } else {
    fail("is not a matrix of numbers");
  }
  return out;
}

}  // namespace

int main(int count, char** argument) {
  if (count < 2) return 2;
  dotyk::reader::limit_reader(argument[1]);
  return dotyk::reader::answer([&](std::FILE* out) {
    require_whole(argument[1]);
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_Open(argument[1], MAT_ACC_RDONLY), &Mat_Close);
    if (!file) throw std::runtime_error("it cannot be read as a MATLAB file");
    std::vector<MatVariable> all;
    for (int k = 2; k < count; ++k) all.push_back(matrix(file.get(), argument[k]));
    for (const MatVariable& v : all) write(out, v);
    dotyk::reader::put_end(out);
  });
}

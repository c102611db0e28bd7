#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "reader/bytes.hpp"

namespace dotyk::fclib {

/// What stands at a path of an HDF5 file, as the program that reads it hands it over.
struct Hdf5Object {
  enum class Kind : int { absent, group, integers, reals, words, other } kind = Kind::absent;
  std::vector<int> integers = {};  ///< of kind integers, whatever its rank; those too large are the largest
  std::vector<double> reals = {};  ///< of kind reals
  std::string words = {};          ///< of kind words: a single string of fixed length
};

inline void write(std::FILE* out, const Hdf5Object& object) {
  reader::put(out, object.kind);
  reader::put_all(out, object.integers), reader::put_all(out, object.reals), reader::put_all(out, object.words);
}

/// Throws std::runtime_error where the bytes are not whole.
inline Hdf5Object read_object(reader::Answer& from) {
  Hdf5Object object;
  object.kind = from.get<Hdf5Object::Kind>();
  object.integers = from.get_all<std::vector<int>>(), object.reals = from.get_all<std::vector<double>>();
  object.words = from.get_all<std::string>();
  return object;
}

}  // namespace dotyk::fclib

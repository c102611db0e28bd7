#pragma once

#include <cstdio>
#include <vector>

#include "reader/bytes.hpp"

namespace dotyk::program {

/// A real matrix of a MATLAB file, as the program that reads it hands it over: its entries that are not zero.
struct MatVariable {
  int rows = -1, columns = -1;  ///< −1 where the file has no such variable
  std::vector<int> row, column; ///< from 0
  std::vector<double> value;
};

inline void write(std::FILE* out, const MatVariable& v) {
  reader::put(out, v.rows), reader::put(out, v.columns);
  reader::put_all(out, v.row), reader::put_all(out, v.column), reader::put_all(out, v.value);
}

/// Throws std::runtime_error where the entries are not within the matrix.
inline MatVariable read_variable(reader::Answer& from) {
  MatVariable v;
  v.rows = from.get<int>(), v.columns = from.get<int>();
  v.row = from.get_all<std::vector<int>>(), v.column = from.get_all<std::vector<int>>(), v.value = from.get_all<std::vector<double>>();
  bool sound = v.rows >= -1 && v.columns >= -1 && v.row.size() == v.value.size() && v.column.size() == v.value.size();
  for (std::size_t k = 0; sound && k < v.value.size(); ++k)
    sound = v.row[k] >= 0 && v.row[k] < v.rows && v.column[k] >= 0 && v.column[k] < v.columns;
  if (!sound) throw std::runtime_error("the reader's answer has entries outside a matrix");
  return v;
}

}  // namespace dotyk::program

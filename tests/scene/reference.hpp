#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <string>

// Values of other public codes, read where they lie; tests skip, saying so, where they are absent.

namespace reference {

/// Value of a quantity in the table, found by the start of its problem, size and quantity.
inline std::optional<double> value(const std::string& problem, const std::string& size, const std::string& quantity) {
  std::ifstream table(std::string(DOTYK_TEST_DIR) + "/../../../shared/reference/other_codes.csv");
  std::string line, key = problem + "," + size + "," + quantity + ",";
  while (std::getline(table, line)) {
    std::string plain = line;
    if (plain[0] == '"') {  // "S2: description",n=64,… → S2,n=64,…
      const auto quote = plain.find('"', 1);
      plain = plain.substr(1, plain.find(':') - 1) + plain.substr(quote + 1);
    }
    if (plain.rfind(key, 0) == 0) return std::stod(plain.substr(key.size()));
  }
  return std::nullopt;
}

inline void compare(double value, const std::string& problem, const std::string& size, const std::string& quantity,
                    double digits) {
  const auto expected = reference::value(problem, size, quantity);
  if (!expected) {
    MESSAGE("skipped: no reference for " << problem << " " << size << " " << quantity);
    return;
  }
  CHECK_MESSAGE(std::abs(value - *expected) <= digits * std::abs(*expected),
                problem << " " << size << " " << quantity << ": " << value << " for " << *expected);
}

}  // namespace reference

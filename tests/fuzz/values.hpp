#pragma once
// Random values for the arguments of dotyk's callables, as Lua text.
#include <map>
#include <random>
#include <string>
#include <vector>

#include "script/bridge/descriptor.hpp"

namespace dotyk::fuzz {

// The objects made so far, by class: expressions such as "V[3]".
using Pool = std::map<std::string, std::vector<std::string>>;

class Values {
 public:
  Values(unsigned seed, const Pool& pool) : random_(seed), pool_(pool) {}

  // Fits the key, or rarely (1 in 30) is something else altogether.
  std::string value(const script::Key& key);
  // What is put between the parentheses, or braces, of a call.
  std::string arguments(const script::Descriptor& descriptor);

  int below(int count) { return std::uniform_int_distribution<>(0, count - 1)(random_); }
  bool once_in(int count) { return below(count) == 0; }
  const std::string& of(const std::vector<std::string>& texts) { return texts[static_cast<std::size_t>(below(static_cast<int>(texts.size())))]; }

 private:
  std::string fitting(const script::Key& key);
  std::string number(const script::Key& key);
  std::string integer(const script::Key& key);
  std::string file(const script::Key& key);
  std::string list(const script::Key& key, std::size_t usual, const script::Key* item);
  std::string table(const script::Key& key);
  std::string function();
  std::string object(const std::string& type);
  std::string wrong();

  std::mt19937 random_;
  const Pool& pool_;
};

}  // namespace dotyk::fuzz

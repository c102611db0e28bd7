#pragma once

#include <exception>
#include <stdexcept>
#include <string>

#include "base/text.hpp"  // of which messages are made

namespace dotyk {

/// What a user asked for cannot be done as asked. The text says what was
/// given, what is allowed and what to do; it carries no position: the script
/// layer adds the line of the call.
class InputError : public std::invalid_argument {
 public:
  explicit InputError(const std::string& what) : std::invalid_argument(what) {}
};

/// The user asked to stop (Ctrl-C) where no partial result exists to return. Not caught with the errors of a method.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace dotyk

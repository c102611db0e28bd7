#pragma once

#include <doctest/doctest.h>

#include <string>

#include "base/error.hpp"
#include "meshfile/assemble.hpp"
#include "meshfile/formats.hpp"

namespace dotyk::test {

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
  return text;
}

/// An MFEM mesh of this text is refused by a message that has `why` in it.
inline void refused(const std::string& text, const std::string& why, const meshfile::Choice& choice = {}) {
  try {
    meshfile::assemble(meshfile::read_mfem(text, "f.mesh"), choice, "f.mesh");
    FAIL_CHECK("not refused: " << why);
  } catch (const InputError& e) {
    CHECK_MESSAGE(std::string(e.what()).find(why) != std::string::npos, e.what());
  }
}

}  // namespace dotyk::test

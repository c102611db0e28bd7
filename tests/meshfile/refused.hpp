#pragma once

#include <doctest/doctest.h>

#include <string>

#include "base/error.hpp"
#include "meshfile/assemble.hpp"

namespace dotyk::test {

/// Contents that assemble() refuses for this reason, with the file's name before it.
inline void check_refused(const meshfile::Contents& c, const meshfile::Choice& choice, const std::string& why) {
  try {
    meshfile::assemble(c, choice, "f.msh");
    FAIL_CHECK("not refused: " << why);
  } catch (const InputError& e) {
    CHECK_MESSAGE(std::string(e.what()).find(why) != std::string::npos, e.what());
    CHECK(std::string(e.what()).rfind("f.msh: ", 0) == 0);
  }
}

}  // namespace dotyk::test

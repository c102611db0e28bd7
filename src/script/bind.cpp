#include "script/bind.hpp"

#include "script/help.hpp"

namespace dotyk::script {

void bind_all(Library& library) {
  library.module("dotyk", "Unilateral contact problems: describe bodies and contacts, solve, look.");
  bind_help(library);
}

}  // namespace dotyk::script

#include "problem/law.hpp"

namespace dotyk::problem {

const char* status_name(Status status) {
  switch (status) {
    case Status::open: return "open";
    case Status::closed: return "closed";
    case Status::stick: return "stick";
    default: return "slip";
  }
}

}  // namespace dotyk::problem

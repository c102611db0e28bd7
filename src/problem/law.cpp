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

bool kinked_at_zero(const Law& law, int row) {
  const Springs k = law.springs(row);
  return k.below != k.above;
}

}  // namespace dotyk::problem

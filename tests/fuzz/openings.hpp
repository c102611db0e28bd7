#pragma once
// Short programs that random ones begin with: valid, so that what follows has objects of every class to work on.
#include <string>
#include <vector>

namespace dotyk::fuzz {

// Expressions in their order; V[n] is the n-th one's value.
using Opening = std::vector<std::string>;

// Problems other than a body on a floor, files, help.
extern const std::vector<Opening> openings;

// Those that draw, which takes a tenth of a second each.
extern const std::vector<Opening> pictures;

}  // namespace dotyk::fuzz

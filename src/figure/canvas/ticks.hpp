// Where an axis has its ticks, and how numbers are written on a picture.
#pragma once

#include <string>
#include <vector>

namespace dotyk::figure {

// For differences and shares of any two numbers: a double would overflow, or underflow to nothing.
using Wide = long double;

struct Tick {
  double value = 0;
  std::string label;  // empty: a minor tick
};

struct Ticks {
  std::vector<Tick> ticks;
  int exponent = 0;  // labels are to be multiplied by 10^exponent
};

// Ticks at 1, 2 or 5 times a power of ten in [low, high], about `wanted`; of
// any finite ends, no more than some hundred.
Ticks linear_ticks(double low, double high, int wanted);

// Decades in [low, high], both positive; about `wanted` at most have labels,
// and of hundreds of decades only some have ticks.
// Ranges of about two decades and below have labels between decades too.
Ticks log_ticks(double low, double high, int wanted);

// 10 raised to k, in the script of the font: "10" with a raised exponent.
std::string power_of_ten(int k);

// A number with `digits` significant digits, without a machine's "e+05".
std::string number(double value, int digits = 3);

// The same in the unit of an axis, 10^exponent, as its labels are: no second
// power of ten; what is nearer to zero than 0.001 is said to be so.
std::string scaled_number(double value, int exponent);

}  // namespace dotyk::figure

#pragma once
#include <string>

namespace dotyk::script {

// SHA-256 of some bytes as 64 hexadecimal digits (FIPS 180-4).
std::string sha256(const std::string& bytes);

}  // namespace dotyk::script

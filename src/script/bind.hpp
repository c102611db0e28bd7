#pragma once
// Everything a script sees, one function per file bind_*.cpp.
namespace dotyk::script {

class Library;

void bind_all(Library& library);

}  // namespace dotyk::script

#pragma once
// The kernel's own rule for the folder of a run with --safe.
#include <string>
#include <vector>

#include "base/place.hpp"

namespace dotyk::script {

// From here on the kernel lets this thread, those it starts, and programs that they start open, make, rename and
// remove files below the folder only, and beside it read and run what lies below the folders of the system (/usr,
// /etc, /proc, …) and those named in `own`. Threads that run already (OpenBLAS's, which compute) and open files stay
// as they are. False where the kernel has no Landlock (Linux before 5.13, or it is switched off): then nothing has
// changed. Source: landlock(7).
bool confine(const Folder& folder, const std::vector<std::string>& own);

}  // namespace dotyk::script

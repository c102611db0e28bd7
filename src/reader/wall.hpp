#pragma once

namespace dotyk::reader {

/// From here on this process, with all threads it starts, computes, reads files and writes to what it has open, and nothing
/// else: it starts no program, opens no file for writing, removes, renames and makes none, and reaches no network. Such
/// calls fail with EPERM. For libraries that take commands from the files they read. A Linux kernel without seccomp
/// leaves the process as it is.
void wall_in();

}  // namespace dotyk::reader

#pragma once
#include <string>

namespace antilock {

/// Flushes standard output. Throws Error where the output could not be written: on a full disk, or
/// where the program was started with standard output closed. Output through stdio fails only when
/// it is flushed. A program that does not check this ends with status 0.
void require_output();

/// Returns the exit status of a program. If `status` is 0 and require_output() throws, it prints
/// one line that begins with `program` on standard error, and returns 2. Otherwise it returns
/// `status`. `main` calls it last.
int delivered(int status, const std::string& program);

/// Opens each of the descriptors 0 to 2 that was closed when the program started. Reading from such
/// a standard input, and writing to such an output, still fails. Without this the first file that
/// the program writes would get the number of standard output, and would contain the output.
void open_standard_streams();

}  // namespace antilock

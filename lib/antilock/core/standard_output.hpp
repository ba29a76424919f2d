#pragma once
#include <string>

namespace antilock {

/// Flushes standard output. Throws Error where what was printed did not arrive: on a full disk, or where the program was
/// started with standard output closed. What is printed through stdio fails at a flush, and a program that does not
/// look ends with status 0.
void require_output();

/// The status that a program ends with, whose own is `status`: where that is 0 and require_output() throws, one line on
/// standard error, `program` first, and 2. The last call of main.
int delivered(int status, const std::string& program);

/// Opens those of the descriptors 0 to 2 that the program was started without, so that reading and writing them fails.
/// Else the first file that the program writes would get the number of standard output, and what is printed would
/// stand in it.
void open_standard_streams();

}  // namespace antilock

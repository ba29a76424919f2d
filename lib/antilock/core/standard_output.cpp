#include "antilock/core/standard_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "antilock/core/error.hpp"

namespace antilock {

void require_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  // an earlier flush that failed left its mark, and no longer its reason
  const std::string why =
      errno == 0 ? "what was printed did not arrive" : std::generic_category().message(errno);
  throw Error("standard output: " + why +
              "; accepted: a file, terminal or pipe that takes all of it");
}

int delivered(int status, const std::string& program) {
  try {
    require_output();
  } catch (const Error& error) {
    if (status != 0) return status;  // a line says why already
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return 2;
  }
  return status;
}

void open_standard_streams() {
  for (const int stream : {0, 1, 2}) {
    if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    const int opened =
        ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);  // the lowest number that is free
    if (opened != stream) return;
  }
}

}  // namespace antilock

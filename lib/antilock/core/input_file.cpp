#include "antilock/core/input_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <system_error>

#include "antilock/core/error.hpp"

namespace antilock {

std::unique_ptr<std::istream> open_file(const std::filesystem::path& path, const std::string& name,
                                        const std::string& accepted) {
  const auto refuse = [&](const char* why) {
    throw Error(fmt::format("{}: {}; accepted: {}", name, why, accepted));
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    refuse(std::filesystem::exists(path, error) ? "is a folder, a device or a pipe"
                                                : "cannot be opened");
  if (std::filesystem::file_size(path, error) == 0 && !error)
    return std::make_unique<std::istringstream>();
  auto in = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!in->is_open()) refuse("cannot be opened");
  return in;
}

}  // namespace antilock

#include "programs/program.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#if defined(__linux__)
#include <sys/resource.h>
#endif

#include "antilock/core/blas.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/standard_output.hpp"

namespace antilock::tutorial {
namespace {

/// This program; empty where the system does not say.
std::filesystem::path self() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

/// What glibc's malloc is asked for where Linux gives large pages to who asks ("madvise"; "always" and "never" leave
/// nothing to ask): pages of 2 MB, and to keep what is freed. A factor of half a million unknowns touches 200,000 pages
/// of 4 kB; on a virtual machine their faults and look-ups took two fifths of the processor's seconds.
std::string large_pages() {
  std::string setting;
  std::getline(std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"), setting);
  if (setting.find("[madvise]") == std::string::npos) return "";
  return "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:glibc.malloc.trim_threshold=4294967296";
}

/// Whether a limit of the process (ulimit -v, ulimit -d) is too low for the threads that OpenBLAS has. Each maps its
/// buffer as soon as it is there, and asks without end where it gets none: then the program could not even end.
bool too_many_threads([[maybe_unused]] int threads) {
#if defined(__linux__)
  constexpr double thread = 220e6;  // bytes: a buffer of 134e6, a stack of 8e6, up to 67e6 of malloc's; 209e6 were seen
  constexpr double program = 250e6;  // bytes: with all of its libraries, and the first thread's buffer
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (threads > 1 && getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        double(limit.rlim_cur) < program + (threads - 1) * thread)
      return true;
  }
#endif
  return false;
}

}  // namespace

void choose_machine(char** argv) {
  const char* const threads = std::getenv("OPENBLAS_NUM_THREADS");
  if (too_many_threads(blas().threads) && (threads == nullptr || std::string_view(threads) != "1")) {
    setenv("OPENBLAS_NUM_THREADS", "1", /*overwrite*/ 1);
    become("", argv);
  }
  if (threads == nullptr) set_blas_threads(1);
  if (std::getenv("ANTILOCK_KEEP_KERNELS")) return;
  bool again = false;
  const auto ask = [&](const char* variable, const std::string& value) {
    if (value.empty() || std::getenv(variable)) return;
    setenv(variable, value.c_str(), 0);
    again = true;
  };
  ask("OPENBLAS_CORETYPE", blas().wider);
  ask("GLIBC_TUNABLES", large_pages());
  if (again) become("", argv);
}

void become(const std::string& program, char** argv) {
  if (self().empty()) return;
  std::fflush(nullptr);
  execv((program.empty() ? self() : self().parent_path() / program).c_str(), argv);
}

std::string beside(const std::string& program) {
  std::error_code ignored;
  const std::filesystem::path path = self().parent_path() / program;
  return std::filesystem::exists(path, ignored) ? path.string() : program;
}

std::string in_shell(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_-+./,:=@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::optional<int> parse(CLI::App& line, int argc, char** argv, bool silent) {
  const auto refuse = [&](const std::string& message) {
    // fmt::print would throw where standard error is full or closed, and end the program by a signal
    const std::string said = fmt::format("{}: {} (see --help)\n", line.get_name(), printable(message, 4000));
    if (!silent) std::fputs(said.c_str(), stderr);
    return 2;
  };
  for (CLI::Option* option : line.get_options())
    if (option->get_expected_max() == 1) option->capture_default_str();
  open_standard_streams();
  try {
    line.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return silent ? 0 : delivered(line.exit(help), line.get_name());
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  }
  for (const CLI::Option* option : line.get_options())  // NaN is in any range for CLI11
    if (option->count() > 0 && option->get_type_name().rfind("FLOAT", 0) == 0 && std::isnan(option->as<double>()))
      return refuse(option->get_name() + ": nan; accepted: a number");
  choose_machine(argv);
  return std::nullopt;
}

}  // namespace antilock::tutorial

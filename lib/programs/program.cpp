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
#include <fcntl.h>
#include <sys/resource.h>
#endif

#include "antilock/core/blas.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/memory.hpp"
#include "antilock/core/standard_output.hpp"

namespace antilock::tutorial {
namespace {

/// This program; empty where the system does not say.
std::filesystem::path self() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

/// What glibc's malloc is asked for where Linux gives large pages to who asks ("madvise"; "always"
/// and "never" leave nothing to ask): pages of 2 MB, and to keep what is freed. A factor of half a
/// million unknowns touches 200,000 pages of 4 kB; on a virtual machine their faults and look-ups
/// took two fifths of the processor's seconds.
std::string large_pages() {
  std::string setting;
  std::getline(std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"), setting);
  if (setting.find("[madvise]") == std::string::npos) return "";
  return "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:glibc.malloc.trim_"
         "threshold=4294967296";
}

#if defined(__linux__)
// Bytes of each further thread of OpenBLAS: its buffer, a stack of 8e6, and up to 67e6 of malloc's.
// 209e6 were seen.
constexpr std::size_t blas_thread = 220'000'000;

// Bytes that the other libraries take before OpenBLAS is loaded. On Debian 13 run_scene waited
// without end where a limit left up to 2.6e6 bytes beside the buffer, and run_scene_petsc up to
// 20e6. PMIx, a part of Open MPI, ended the latter with status 14 up to 30e6.
constexpr std::size_t other_libraries = 40'000'000;

/// The number of threads that OpenBLAS starts with.
long blas_threads(char** environment) {
  for (const std::string_view variable :
       {"OPENBLAS_NUM_THREADS=", "GOTO_NUM_THREADS=", "OMP_NUM_THREADS="})
    for (char** setting = environment; *setting != nullptr; ++setting)
      if (std::string_view(*setting).substr(0, variable.size()) == variable)
        if (const long threads = std::strtol(*setting + variable.size(), nullptr, 10); threads > 0)
          return threads;
  return sysconf(_SC_NPROCESSORS_ONLN);
}

/// Under a limit of the process (ulimit -v, ulimit -d): starts the program again with one thread
/// where there is no room for those that OpenBLAS would start, and ends it with a line where there
/// is none for one. OpenBLAS maps a buffer for each of its threads while it is loaded (0.3.29,
/// Debian 13), and asks without end where it gets none (OpenBLAS #5289), so that no function of the
/// program would be reached. This one is called before the libraries' own constructors, and so it
/// uses nothing that they prepare: no memory of malloc's, no `environ`.
void require_room_for_blas(int, char** argv, char** environment) {
  const auto limited = [](auto resource) {
    rlimit limit{};
    return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  };
  if (!limited(RLIMIT_AS) && !limited(RLIMIT_DATA)) return;
  const long threads = blas_threads(environment);
  constexpr std::size_t needed = blas_buffer + other_libraries;
  if (can_map(needed + static_cast<std::size_t>(threads - 1) * blas_thread)) return;
  if (threads > 1) {
    constexpr int most = 4096;
    char one_thread[] = "OPENBLAS_NUM_THREADS=1";
    char* changed[most + 2] = {one_thread};
    int count = 1;
    for (char** setting = environment; *setting != nullptr && count < most; ++setting)
      if (std::string_view(*setting).substr(0, 21) != "OPENBLAS_NUM_THREADS=")
        changed[count++] = *setting;
    execve("/proc/self/exe", argv, changed);
  }
  if (can_map(needed)) return;  // no second start was to be had
  constexpr std::string_view line =
      ": out of memory: the BLAS needs a buffer of 128 MB and other libraries 40 MB, the limit of "
      "this process (ulimit -v, ulimit -d) leaves less; accepted: a higher limit\n";
  const std::string_view path = argv[0] == nullptr ? "antilock" : argv[0];
  const std::string_view name = path.substr(path.rfind('/') + 1);
  [[maybe_unused]] const auto written =
      write(2, name.data(), name.size()) + write(2, line.data(), line.size());
  _exit(3);
}

/// The folder in which the program was started, while its libraries are loaded.
int start_folder = -1;

[[noreturn]] void end_outside_of_start_folder() {
  constexpr std::string_view line =
      "antilock: the current folder cannot be left and entered again; accepted: another folder\n";
  [[maybe_unused]] const auto written = write(2, line.data(), line.size());
  _exit(2);
}

/// Moves to the root folder until return_to_start_folder. Open MPI 5 (Debian 13) links UCX, whose
/// constructor reads ucx.conf of the current folder. This folder may hold somebody else's scene,
/// and an option in such a file may name a file that is then written. No variable of the
/// environment keeps UCX from reading it.
void leave_start_folder() {
  start_folder = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  // A folder that cannot be opened so is not searchable, and a library finds no file in it either.
  if (start_folder >= 0 && chdir("/") != 0) end_outside_of_start_folder();
}

/// Is called after the constructors of the libraries, since it is one of the program itself, and
/// before main.
[[gnu::constructor]] void return_to_start_folder() {
  if (start_folder < 0) return;
  if (fchdir(start_folder) != 0) end_outside_of_start_folder();
  close(start_folder);
}

// The order matters: require_room_for_blas may start the program again, in the same folder.
void before_the_libraries(int argc, char** argv, char** environment) {
  require_room_for_blas(argc, argv, environment);
  leave_start_folder();
}
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const called_before_the_libraries)(int, char**, char**) = before_the_libraries;
#endif

}  // namespace

void reexec_tuned(char** argv) {
  const char* const threads = std::getenv("OPENBLAS_NUM_THREADS");
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
  if (again) exec_program("", argv);
}

void exec_program(const std::string& program, char** argv) {
  if (self().empty()) return;
  std::fflush(nullptr);
  execv((program.empty() ? self() : self().parent_path() / program).c_str(), argv);
}

std::string sibling_path(const std::string& program) {
  std::error_code ignored;
  const std::filesystem::path path = self().parent_path() / program;
  return std::filesystem::exists(path, ignored) ? path.string() : program;
}

std::string in_shell(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-+./,:=@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::optional<int> parse(CLI::App& line, int argc, char** argv, bool silent) {
  const auto refuse = [&](const std::string& message) {
    // fmt::print would throw where standard error is full or closed, and end the program by a
    // signal
    const std::string said =
        fmt::format("{}: {} (see --help)\n", line.get_name(), printable(message, 4000));
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
    if (option->count() > 0 && option->get_type_name().rfind("FLOAT", 0) == 0 &&
        std::isnan(option->as<double>()))
      return refuse(option->get_name() + ": nan; accepted: a number");
  reexec_tuned(argv);
  return std::nullopt;
}

}  // namespace antilock::tutorial

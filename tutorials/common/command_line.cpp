#include "common/command_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "antilock/core/detail/blas.hpp"
#include "antilock/core/error.hpp"

namespace antilock::tutorial {
namespace {

int from_environment(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names)
    if (const char* value = std::getenv(name)) return std::atoi(value);
  return otherwise;
}

/// What glibc's malloc is asked for where Linux gives large pages to who asks ("madvise"; "always" and "never" leave nothing
/// to ask): pages of 2 MB, and to keep what is freed. A factor of half a million unknowns touches 200,000 pages of 4 kB, and
/// on a virtual machine their faults and the look-ups of their addresses took two fifths of all processor seconds.
std::string large_pages() {
  std::string setting;
  std::getline(std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"), setting);
  if (setting.find("[madvise]") == std::string::npos) return "";
  return "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:glibc.malloc.trim_threshold=4294967296";
}

}  // namespace

void choose_machine(char** argv) {
  if (!std::getenv("OPENBLAS_NUM_THREADS")) set_blas_threads(1);
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

int launched_rank() { return from_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0); }
int launched_ranks() { return from_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1); }

void become(const std::string& program, char** argv) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return;
  std::fflush(nullptr);
  execv((program.empty() ? self : self.parent_path() / program).c_str(), argv);
}

std::string beside(const std::string& program, const std::string& folder) {
  std::error_code error;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& path : {here / program, here.parent_path() / folder / program})
    if (!error && std::filesystem::exists(path, error)) return path.string();
  return program;
}

CommandLine::CommandLine(const std::string& what, std::string name)
    : app_(std::make_unique<CLI::App>(what, name)), name_(std::move(name)) {}
CommandLine::~CommandLine() = default;

void CommandLine::add(const std::string& option, double& value, const std::string& what, double least, double most) {
  app_->add_option(option, value, what)->capture_default_str()->check(CLI::Range(least, most));
  numbers_.emplace_back(option, &value);
}

void CommandLine::add(const std::string& option, int& value, const std::string& what, int least, int most) {
  app_->add_option(option, value, what)->capture_default_str()->check(CLI::Range(least, most));
}

void CommandLine::add(const std::string& option, std::string& value, const std::string& what) {
  app_->add_option(option, value, what)->capture_default_str();
}

void CommandLine::add(const std::string& option, std::filesystem::path& value, const std::string& what) {
  app_->add_option(option, value, what)->capture_default_str();
}

void CommandLine::add(const std::string& option, std::vector<std::filesystem::path>& values, const std::string& what) {
  app_->add_option(option, values, what)->expected(static_cast<int>(values.size()));
}

void CommandLine::add(const std::string& option, bool& value, const std::string& what) {
  app_->add_flag(option, value, what);
}

void CommandLine::add_required(const std::string& name, std::filesystem::path& value, const std::string& what) {
  app_->add_option(name, value, what)->required();
}

void CommandLine::footer(const std::string& text) { app_->footer(text); }

std::optional<int> CommandLine::parse(int argc, char** argv) {
  const auto refuse = [&](const std::string& message) {
    if (!silent_) fmt::print(stderr, "{}: {} (see --help)\n", name_, printable(message, 4000));
    return 2;
  };
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return silent_ ? 0 : app_->exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  }
  for (const auto& [option, value] : numbers_)  // NaN is in any range for CLI11
    if (std::isnan(*value)) return refuse(option + ": nan; accepted: a number");
  choose_machine(argv);
  return std::nullopt;
}

bool CommandLine::given(const std::string& option) const { return app_->count(option) > 0; }

}  // namespace antilock::tutorial

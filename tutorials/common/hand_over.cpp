#include "common/hand_over.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "antilock/core/detail/blas.hpp"

namespace antilock::tutorial {
namespace {

int from_environment(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names)
    if (const char* value = std::getenv(name)) return std::atoi(value);
  return otherwise;
}

}  // namespace

int launched_rank() { return from_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0); }
int launched_ranks() { return from_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1); }

void become(const std::string& program, char** argv) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return;
  std::fflush(nullptr);
  execv((program.empty() ? self : self.parent_path() / program).c_str(), argv);
}

void choose_kernels(char** argv) {
  if (!std::getenv("OPENBLAS_NUM_THREADS")) set_blas_threads(1);
  const std::string wider = blas().wider;
  if (wider.empty() || std::getenv("OPENBLAS_CORETYPE") || std::getenv("ANTILOCK_KEEP_KERNELS")) return;
  setenv("OPENBLAS_CORETYPE", wider.c_str(), 0);
  become("", argv);
}

}  // namespace antilock::tutorial

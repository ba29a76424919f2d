#pragma once
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace antilock::tutorial {

/// A number that mpiexec leaves in the environment: Open MPI's name for it first, then that of MPICH and Slurm.
inline int from_environment(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names)
    if (const char* value = std::getenv(name)) return std::atoi(value);
  return otherwise;
}

/// Which of the processes that mpiexec started this is, and how many there are, without MPI. 0 of 1 without mpiexec.
inline int launched_rank() { return from_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0); }
inline int launched_ranks() { return from_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1); }

/// Becomes the program of that name beside this one, with the same arguments. Returns where there is none.
inline void become(const std::string& program, char** argv) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return;
  std::fflush(nullptr);
  execv((self.parent_path() / program).c_str(), argv);
}

}  // namespace antilock::tutorial

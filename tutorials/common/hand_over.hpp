#pragma once
#include <string>

namespace antilock::tutorial {

/// Which of the processes that mpiexec started this is, and how many there are, without MPI: from the environment that
/// Open MPI, MPICH and Slurm set. 0 of 1 without mpiexec.
int launched_rank();
int launched_ranks();

/// Becomes the program of that name beside this one, with the same arguments. Returns where there is none.
void become(const std::string& program, char** argv);

}  // namespace antilock::tutorial

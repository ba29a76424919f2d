#pragma once
#include <string>

namespace antilock::tutorial {

/// Which of the processes that mpiexec started this is, and how many there are, without MPI: from the environment that
/// Open MPI, MPICH and Slurm set. 0 of 1 without mpiexec.
int launched_rank();
int launched_ranks();

/// Becomes the program of that name beside this one (this one again, where it is empty), with the same arguments.
/// Returns where there is none.
void become(const std::string& program, char** argv);

/// One thread of the BLAS, unless OPENBLAS_NUM_THREADS says otherwise: two were no faster, since they wait for each
/// other by spinning, and much slower beside other programs. And the kernels of this CPU: OpenBLAS knows CPUs by model
/// number, and gives kernels of 2004 to one that is younger than itself; the factor then takes 1.6 times as long. Where
/// blas().wider is known, the program starts again with those. Returns where there is nothing to gain, where
/// OPENBLAS_CORETYPE is set, and where ANTILOCK_KEEP_KERNELS asks to leave the kernels as they are.
void choose_kernels(char** argv);

}  // namespace antilock::tutorial

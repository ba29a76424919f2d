#pragma once
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace antilock::tutorial {

/// Fills the values of the options; those given beforehand are the defaults that --help shows. Returns nothing where the
/// program goes on, otherwise the status to exit with: 0 after --help, 2 after an option that is not accepted (NaN is not),
/// which one line on standard error names, or where the help did not arrive. `silent`: nothing is printed, for every rank of a parallel run but the first.
std::optional<int> parse(CLI::App& line, int argc, char** argv, bool silent = false);

/// One thread of the BLAS, unless OPENBLAS_NUM_THREADS says otherwise: two were no faster, since they wait for each
/// other by spinning, and much slower beside other programs. The kernels of this CPU: OpenBLAS knows CPUs by model
/// number, and gives kernels of 2004 to one that is younger than itself; the factor then takes 1.6 times as long. And
/// memory in large pages. Both are read where a program starts, so it starts again with what the environment does not
/// name yet. Returns where there is nothing to gain, and where ANTILOCK_KEEP_KERNELS asks to leave all as it is.
/// `parse` calls it; a program that starts MPI does so before.
void reexec_tuned(char** argv);

/// Becomes the program of that name beside this one (this one again, where it is empty), with the same arguments.
/// Returns where there is none.
void exec_program(const std::string& program, char** argv);

/// The path of a program that stands in the folder of this one; its bare name where there is none.
std::string sibling_path(const std::string& program);

/// A word of a command as a shell takes it: in quotes where a blank, a bracket or another sign would mean something.
std::string in_shell(const std::string& word);

}  // namespace antilock::tutorial

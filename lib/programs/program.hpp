#pragma once
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace antilock::tutorial {

/// Fills the values of the options from the command line. Values given beforehand are the defaults
/// that --help shows. Returns nothing where the program continues, and otherwise the status with
/// which it must exit: 0 after --help, and 2 after an option that is not accepted, or where the
/// help could not be written. NaN is not accepted. One line on standard error names the option.
/// With `silent` nothing is printed: for all ranks of a parallel run except the first.
std::optional<int> parse(CLI::App& line, int argc, char** argv, bool silent = false);

/// Starts the program again with settings of the environment that make it faster, where there are
/// any. OpenBLAS and glibc read them only at the start of a program.
///
/// One setting names the kernels of OpenBLAS for this CPU. OpenBLAS recognises CPUs by model number
/// and uses kernels of 2004 for a CPU that is newer than itself. The factorisation then takes 1.6
/// times as long. The other setting requests memory in large pages.
///
/// A variable that the environment has already stays as it is. The function returns where nothing
/// can be gained, and where ANTILOCK_KEEP_KERNELS is set. It also sets the BLAS to one thread,
/// unless OPENBLAS_NUM_THREADS is set: two threads were not faster, because they wait for each
/// other by spinning, and much slower beside other programs. `parse` calls it. A program that
/// starts MPI calls it before MPI.
void reexec_tuned(char** argv);

/// Replaces this process by the program of that name in the folder of this one, with the same
/// arguments; an empty name is this program. Returns where there is no such program.
void exec_program(const std::string& program, char** argv);

/// Returns the path of a program in the folder of this one, or its bare name where there is none.
std::string sibling_path(const std::string& program);

/// Returns a word of a command in the form that a shell reads: in quotes where a blank, a bracket
/// or another sign would have a meaning.
std::string in_shell(const std::string& word);

}  // namespace antilock::tutorial

#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace antilock::tutorial {

/// The options of a program. CLI11, which does the work, costs seconds of compilation per source that includes it: it
/// is included in command_line.cpp alone. Values given beforehand are the defaults that --help shows.
class CommandLine {
 public:
  /// @param what  what the program does, for --help
  /// @param name  of the program, before every message
  CommandLine(const std::string& what, std::string name);
  ~CommandLine();

  /// A number between `least` and `most`, both accepted. NaN is refused.
  void add(const std::string& option, double& value, const std::string& what, double least, double most);
  void add(const std::string& option, int& value, const std::string& what, int least, int most);
  void add(const std::string& option, std::string& value, const std::string& what);
  void add(const std::string& option, std::filesystem::path& value, const std::string& what);
  /// As many paths as `values` has, or none.
  void add(const std::string& option, std::vector<std::filesystem::path>& values, const std::string& what);
  /// A flag: true where it stands on the command line.
  void add(const std::string& option, bool& value, const std::string& what);
  /// An argument without an option's name, which must be given.
  void add_required(const std::string& name, std::filesystem::path& value, const std::string& what);
  /// Nothing is printed: for every rank of a parallel run but the first.
  void silence() { silent_ = true; }
  /// What --help prints below the options.
  void footer(const std::string& text);

  /// Fills the values. Returns nothing where the program goes on, otherwise the status to exit with: 0 after --help, 2
  /// after an option that is not accepted, which one line on standard error names.
  std::optional<int> parse(int argc, char** argv);
  /// Whether the option stands on the command line.
  bool given(const std::string& option) const;

 private:
  std::unique_ptr<CLI::App> app_;
  std::string name_;
  std::vector<std::pair<std::string, const double*>> numbers_;
  bool silent_ = false;
};

/// One thread of the BLAS, unless OPENBLAS_NUM_THREADS says otherwise: two were no faster, since they wait for each
/// other by spinning, and much slower beside other programs. The kernels of this CPU: OpenBLAS knows CPUs by model
/// number, and gives kernels of 2004 to one that is younger than itself; the factor then takes 1.6 times as long. And
/// memory in large pages. Both are read where a program starts, so it starts again with what the environment does not
/// name yet. Returns where there is nothing to gain, and where ANTILOCK_KEEP_KERNELS asks to leave all as it is.
/// CommandLine::parse calls it; a program that starts MPI does so before.
void choose_machine(char** argv);

/// Which of the processes that mpiexec started this is, and how many there are, without MPI: from the environment that
/// Open MPI, MPICH and Slurm set. 0 of 1 without mpiexec.
int launched_rank();
int launched_ranks();

/// Becomes the program of that name beside this one (this one again, where it is empty), with the same arguments.
/// Returns where there is none.
void become(const std::string& program, char** argv);

/// The path of a program that is installed beside this one, or built in that folder of the same build; its bare name
/// where there is none.
std::string beside(const std::string& program, const std::string& folder);

}  // namespace antilock::tutorial

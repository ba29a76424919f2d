#pragma once
#include <functional>
#include <string>
#include <vector>

namespace antilock::distributed {

/// Initialises MPI and PETSc, and finalises them at the end of its scope. A program may have only
/// one. PETSc's own reports on standard error are off, because each failure is reported by an
/// exception. The options of BoomerAMG are those that were the best here (measured). The
/// environment variable PETSC_OPTIONS overrides them. PETSc's files of options (.petscrc, petscrc
/// and ~/.petscrc) are not read.
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

int rank();   ///< of this process, 0 to ranks() - 1
int ranks();  ///< number of processes of the run
std::string petsc_version();

/// Runs `work` on this rank. Where it throws Error, InputError, NotConverged or bad_alloc on any
/// rank, every rank throws the exception of the first of these ranks. So no rank continues and
/// waits for one that has failed. `work` itself must not communicate.
void collectively(const std::function<void()>& work);

/// Prints one line on standard error and ends the run of all ranks with the exit status `status`.
/// It is for a failure of this rank of which the others do not know.
[[noreturn]] void abort(const std::string& message, int status);

double sum(double value);        ///< over the ranks
double largest(double value);    ///< over the ranks
long long sum(long long value);  ///< over the ranks
/// Returns, on every rank, the values of all ranks in the order of the ranks.
std::vector<double> all_gather(const std::vector<double>& values);
/// Returns, on every rank, one value per rank.
std::vector<long long> all_gather(long long value);
/// Returns the text of rank 0 on every rank.
std::string broadcast(std::string text);

/// Returns the text of the first rank whose text is not empty, on every rank; empty if there is
/// none.
std::string first_nonempty(const std::string& text);

/// Returns the largest resident memory so far, in MB, of the rank that has the most.
double peak_megabytes();

}  // namespace antilock::distributed

#pragma once
#include <functional>
#include <string>
#include <vector>

namespace antilock::distributed {

/// MPI and PETSc from here to the end of the scope. One a program. PETSc's own reports on standard error are off: a
/// failure comes as an exception. BoomerAMG's options are set as measured to be best here; the environment variable
/// PETSC_OPTIONS overrides them.
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

int rank();   ///< of this process, 0 to ranks() - 1
int ranks();  ///< processes of the run
std::string petsc_version();

/// Runs `work` on this rank. Where it throws Error, InputError, NotConverged or bad_alloc on any rank, every rank throws what the
/// first of them threw: no rank goes on and waits for one that has given up. `work` itself must not communicate.
void collectively(const std::function<void()>& work);

/// Ends the run of all ranks with that status, after one line on standard error: for a failure of this rank that the
/// others do not know of.
[[noreturn]] void abort(const std::string& message, int status);

double sum(double value);                                           ///< over the ranks
double largest(double value);                                       ///< over the ranks
long long sum(long long value);                                     ///< over the ranks
std::vector<double> all_gather(const std::vector<double>& values);  ///< of all ranks, rank by rank, on every rank
std::vector<long long> all_gather(long long value);                 ///< one value per rank, on every rank
std::string broadcast(std::string text);                            ///< the text of rank 0, on every rank

std::string first_nonempty(const std::string& text);  ///< of the first rank whose text is not empty

double peak_megabytes();  ///< largest resident memory so far, of the rank that has most

}  // namespace antilock::distributed

#include "antilock/distributed/ranks.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <numeric>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/distributed/detail/strip_multigrid.hpp"

namespace antilock::distributed {
namespace {

/// Conjugate gradients with BoomerAMG: 2 to 5 iterations for four digits in the energy norm,
/// whatever delta, on layers in columns. The interpolation FF1 is set up in 0.87 of the seconds of
/// ext+i, for 13 iterations in place of 11 (2.1 million unknowns, two ranks: 0.9 of the processor's
/// seconds in all). One forward sweep of SOR down and one backward sweep up take half the time of
/// symmetric sweeps on both ways, and as many iterations. The coarse problem of a layer without
/// columns has the same options.
std::string multigrid_options(const std::string& prefix) {
  return fmt::format(
      "-{0}pc_type hypre -{0}pc_hypre_type boomeramg "
      "-{0}pc_hypre_boomeramg_coarsen_type HMIS -{0}pc_hypre_boomeramg_interp_type FF1 "
      "-{0}pc_hypre_boomeramg_P_max 6 "
      "-{0}pc_hypre_boomeramg_relax_type_down SOR/Jacobi "
      "-{0}pc_hypre_boomeramg_relax_type_up backward-SOR/Jacobi ",
      prefix);
}

/// MUMPS may take twice the memory that it estimates: its own 20 % more are not enough for the
/// small first levels on three ranks. PETSc 3.22 would print a warning of those that a run does not
/// use.
std::string default_options() {
  const std::string of_coarse_problem = fmt::format("{}mg_coarse_", StripMultigrid::prefix);
  return fmt::format(
      "-no_signal_handler -ksp_type cg -ksp_norm_type natural {}{}"
      "-mat_mumps_icntl_14 100 -options_left no",
      multigrid_options(""), multigrid_options(of_coarse_problem));
}

enum Outcome : int { unconverged, no_memory, bad_input, refused };
struct Failure {
  Outcome outcome = refused;
  int steps = 0;
  double reached = 0;
};

template <class Value>
Value over_ranks(Value value, MPI_Datatype type, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, type, operation, PETSC_COMM_WORLD);
  return value;
}

std::string said_by(int rank, std::string text) {
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, rank, PETSC_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, rank, PETSC_COMM_WORLD);
  return text;
}

}  // namespace

Session::Session() {
  // Without this argument PETSc reads options from .petscrc and petscrc of the current folder. They
  // may name files that are written, and a library that is loaded, which runs its code.
  static char program[] = "antilock";
  static char skip[] = "-skip_petscrc";
  static char* arguments[] = {program, skip, nullptr};  // PETSc keeps the pointer
  int count = 2;
  char** given = arguments;
  ok(PetscOptionsInsertString(nullptr, default_options().c_str()));
  ok(PetscInitialize(&count, &given, nullptr, nullptr));  // reads PETSC_OPTIONS over them
  ok(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

Session::~Session() { PetscFinalize(); }

int rank() {
  PetscMPIInt value = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &value);
  return value;
}

int ranks() {
  PetscMPIInt value = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &value);
  return value;
}

std::string petsc_version() {
  return fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR);
}

void collectively(const std::function<void()>& work) {
  std::string message;
  Failure failure;
  int failed = rank();
  try {
    work();
    failed = ranks();
  } catch (const NotConverged& error) {
    message = error.what();
    failure = {unconverged, error.steps, error.reached};
  } catch (const InputError& error) {
    message = error.what();
    failure.outcome = bad_input;
  } catch (const Error& error) {
    message = error.what();
  } catch (const std::bad_alloc&) {
    failure.outcome = no_memory;
  }
  const int first = over_ranks(failed, MPI_INT, MPI_MIN);
  if (first == ranks()) return;
  message = said_by(first, message);
  MPI_Bcast(&failure, sizeof failure, MPI_BYTE, first, PETSC_COMM_WORLD);
  if (failure.outcome == no_memory) throw std::bad_alloc();
  if (failure.outcome == unconverged) throw NotConverged(message, failure.reached, failure.steps);
  if (failure.outcome == bad_input) throw InputError(message);
  throw Error(message);
}

void abort(const std::string& message, int status) {
  fmt::print(stderr, "{}\n", message);
  std::fflush(nullptr);
  if (ranks() > 1) MPI_Abort(PETSC_COMM_WORLD, status);
  std::_Exit(status);
}

double sum(double value) { return over_ranks(value, MPI_DOUBLE, MPI_SUM); }
double largest(double value) { return over_ranks(value, MPI_DOUBLE, MPI_MAX); }
long long sum(long long value) { return over_ranks(value, MPI_LONG_LONG, MPI_SUM); }

std::vector<double> all_gather(const std::vector<double>& values) {
  const std::vector<long long> sizes = all_gather(static_cast<long long>(values.size()));
  const std::vector<int> counts(sizes.begin(), sizes.end());
  std::vector<int> starts(ranks() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
  std::vector<double> all(starts.back());
  MPI_Allgatherv(values.data(), counts[rank()], MPI_DOUBLE, all.data(), counts.data(),
                 starts.data(), MPI_DOUBLE, PETSC_COMM_WORLD);
  return all;
}

std::vector<long long> all_gather(long long value) {
  std::vector<long long> all(ranks());
  MPI_Allgather(&value, 1, MPI_LONG_LONG, all.data(), 1, MPI_LONG_LONG, PETSC_COMM_WORLD);
  return all;
}

std::string broadcast(std::string text) { return said_by(0, std::move(text)); }

std::string first_nonempty(const std::string& text) {
  const int first = over_ranks(text.empty() ? ranks() : rank(), MPI_INT, MPI_MIN);
  return first == ranks() ? std::string() : said_by(first, text);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return largest(static_cast<double>(usage.ru_maxrss) / 1024);
}

}  // namespace antilock::distributed

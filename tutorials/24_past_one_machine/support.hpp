#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/element.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// One solve: what to do, on how many ranks, with 1/h = cells.
struct Asked {
  std::string what;
  int ranks = 1, cells = 64;
  double epsilon = 1e-6;
};

/// What came of it, from rank 0.
struct Ended {
  long long unknowns = 0;
  int corrections = 0, iterations = 0,
      most = 0;                       ///< most: iterations of the correction that took most
  double seconds = 0, megabytes = 0;  ///< megabytes: of the rank that has most
  double u_max = 0, u_min = 0;
  std::string reason =
      "settled";  ///< one word: why it ended; "gave_up" where it did not converge
};

/// In a process that mpiexec started for on_ranks: solves what the command line asks for,
/// within MPI and PETSc, prints the outcome from rank 0 and returns the exit status.
/// Elsewhere returns nothing.
std::optional<int> answer_as_rank(int argc, char** argv,
                                  const std::function<Ended(const Asked&)>& solve);

/// The same program on that many ranks of this machine: more than it has cores are allowed.
/// One row, with a column per member of Asked and Ended. Throws Error where mpiexec fails.
Table on_ranks(const Asked& asked);
/// One row per number of ranks; `cells` for each.
Table on_ranks(const std::string& what, const std::vector<int>& ranks,
               const std::function<int(int ranks)>& cells, double epsilon);

/// A solver of PETSc: SNESVI where `what` begins so, else TAO. It runs out of the box on the
/// summed matrix where `what` ends with ", summed", else in the split form.
Ended by_petsc(const Asked& asked);
/// The serial library's answer on a whole mesh.
Solution serial(const TriangleMesh& mesh, const Element& element, double epsilon);

/// The table of such runs, for the reader.
void print_runs(const Table& runs);

/// Shares of the triangles that cut columns: eighths of the unit square in turn, as on a
/// chessboard.
std::vector<int> chessboard(const TriangleMesh& mesh, int ranks);

/// scaling.csv, as the picture takes it: per number of ranks the iterations of all
/// corrections on one mesh, with as many unknowns per rank, and on one mesh with columns
/// cut; and the memory of the largest rank over that of one alone.
void write_scaling(const std::filesystem::path& folder, const Table& strong,
                   const Table& weak, const Table& cut);

}  // namespace antilock::tutorial

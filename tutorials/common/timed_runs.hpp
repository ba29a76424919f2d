#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antilock/exact/truth_table.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"
#include "antilock/study/method.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// One point of the work-precision study: a method (element, kind of mesh, solver) at one epsilon
/// on one mesh.
struct TimedRun {
  std::string element{}, mesh{}, solver{};
  double epsilon = 0;
  int cells = 0, unknowns = 0, iterations = 0;
  bool ok = true;
  double seconds = 0, least = 0,
         most = 0;          ///< wall seconds: median and extremes of the repeats; where it failed: spent
  double mesh_seconds = 0;  ///< apart
  Errors errors{};          ///< of FreeFEM's script: max_at_unknowns alone
  double scale = 0;         ///< largest |u_h|
  std::string why{};        ///< of a failure

  double relative() const { return errors.max_at_unknowns / scale; }
  /// The same method at the same epsilon, on whatever mesh size.
  bool same_method(const TimedRun& other) const;
};

/// Marks a run as failed where the same method was over the limit on a coarser mesh; true: then it
/// need not be tried.
bool given_up(const std::vector<TimedRun>& before, TimedRun& run, double limit);

/// Runs `solve` `repeats` times and notes the seconds; the last answer, or nothing where it throws
/// or takes longer than `limit`: a run over the limit counts as a failure, even where its answer is
/// good.
std::optional<Solution> time_solver(TimedRun& run, const std::function<Solution()>& solve, double limit, int repeats);

/// FreeFEM's active set on the same mesh, the stiff part summed as a plain script does: `command`
/// is freefem/run. The clock is the script's own, without start-up and reading the mesh.
void time_freefem(TimedRun& run, const std::string& command, const Space& space, const TruthTable& truth, double limit,
                  int repeats, const std::filesystem::path& folder);

/// A study of work and precision: what a run may take, and the runs so far.
struct Timing {
  double limit = 0.1;         ///< seconds after which a run counts as failed
  std::string freefem;        ///< the command freefem/run, or nothing: then FreeFEM is not timed
  std::filesystem::path out;  ///< folder of the results
  int repeats = 5;            ///< of each run; the median is its time
  std::vector<TimedRun> runs{};

  /// Times one solver. `run` says what is solved: element, mesh, epsilon, cells, unknowns, mesh_seconds. Not tried
  /// where the same method was over the limit on a coarser mesh; `limited` false: a solver that no limit stops.
  void add(TimedRun run, const std::string& solver, const std::function<Solution()>& solve,
           const std::function<Errors(const Solution&)>& errors, bool limited = true);
  /// FreeFEM's script on the same mesh, where its command is given.
  void add_freefem(TimedRun run, const Space& space, const TruthTable& truth);
  /// The active set's run on the finest mesh of this method.
  const TimedRun& finest(const Method& method, double epsilon) const;
  /// Claims that the active set always answers, and that Uzawa's answers are its own.
  void judge(Report& report) const;
  /// Writes work_precision.csv, the price list, the stages up to 1/h = finest or 128, and the machine.
  void write(int finest) const;
};

/// One row per run, columns as in TimedRun; status is ok or failed. `relative` and the errors are 0
/// where it failed.
void write_runs(const std::filesystem::path& path, const std::vector<TimedRun>& runs);

/// The cheapest run that was measured within a relative error (at the unknowns) of 1e-2, 1e-3 and
/// 1e-4, one row per method and epsilon: price_list.csv, its outcome reached, never (locked: the
/// error hardly falls from mesh to mesh), failed (before it came so far) or beyond (a finer mesh
/// than measured would). In short as Markdown: price_list.md.
void write_price_list(const std::filesystem::path& folder, const std::vector<TimedRun>& runs);

/// Where the time goes: stages.csv, wall seconds of each stage of the run of median length, 1/h
/// from 16 to `finest` (P1, structured mesh, active set, epsilon = 1e-6). `corrections` holds all
/// of the solver that is no other stage.
void write_stages(const std::filesystem::path& folder, int finest, int repeats);

/// What the seconds were measured on: processor, cores, threads of the BLAS, compiler, libraries,
/// date: `what,value`.
void write_machine(const std::filesystem::path& path);

}  // namespace antilock::tutorial

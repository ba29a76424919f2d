#pragma once
#include <algorithm>

#include "antilock/core/stopwatch.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// One point of the study: a method (element, kind of mesh, solver) at one epsilon on one mesh. The wall seconds are the
/// median and the extremes of the repeats; where it failed, what was spent.
struct TimedRun {
  std::string element{}, mesh{}, solver{};
  double epsilon = 0;
  int cells = 0, unknowns = 0, iterations = 0;
  bool ok = true;
  double seconds = 0, least = 0, most = 0, mesh_seconds = 0;
  Errors errors{};    ///< of FreeFEM's script: max_at_unknowns alone
  double scale = 0;   ///< largest |u_h|
  std::string why{};  ///< of a failure
  double relative() const { return errors.max_at_unknowns / scale; }
  bool same_method(const TimedRun& other) const {  // on whatever mesh size
    return element == other.element && mesh == other.mesh && solver == other.solver && epsilon == other.epsilon;
  }
  void note(std::vector<double> all) {
    std::sort(all.begin(), all.end());
    least = all.front(), most = all.back(), seconds = all[all.size() / 2];
  }
  void fail(double spent, std::string reason) {
    ok = false;
    seconds = least = most = spent;
    std::replace(reason.begin(), reason.end(), ',', ';');  // one field of the table
    why = std::move(reason);
  }
};

/// What a run may take, and the runs so far.
struct Timing {
  double limit = 0.1;         ///< seconds after which a run counts as failed, even where its answer is good
  std::string freefem;        ///< the command freefem/run, or nothing: then FreeFEM is not timed
  std::filesystem::path out;  ///< folder of the results
  int repeats = 5;
  std::vector<TimedRun> runs{};

  bool given_up(TimedRun& run) const {  // failed, where the same method was over the limit on a coarser mesh
    const auto over = [&](const TimedRun& r) { return r.same_method(run) && !r.ok && r.seconds >= limit; };
    const bool hopeless = std::any_of(runs.begin(), runs.end(), over);
    if (hopeless) run.fail(limit, "not tried: over the limit on a coarser mesh");
    return hopeless;
  }
  /// Times one solver. `run` says what is solved: element, mesh, epsilon, cells, unknowns, mesh_seconds.
  void add(TimedRun run, const std::string& solver, const std::function<Solution()>& solve,
           const std::function<Errors(const Solution&)>& errors, bool limited = true) {  // false: no limit stops it
    run.solver = solver;
    if (!given_up(run)) {
      const Stopwatch since_start;
      std::vector<double> seconds;
      Solution solution;
      try {
        for (int i = 0; i < repeats; ++i) {
          const Stopwatch watch;
          solution = solve();
          seconds.push_back(watch.seconds());
          if (limited && seconds.back() > limit)
            throw NotConverged(fmt::format("took longer than {:g} s", limit), 1, 0);
        }
        run.note(std::move(seconds));
      } catch (const Error& failure) {
        run.fail(since_start.seconds(), failure.what());
      }
      if (run.ok) {
        run.iterations = solution.counters.contact;
        run.scale = solution.u.cwiseAbs().maxCoeff();
        run.errors = errors(solution);
      }
    }
    runs.push_back(std::move(run));
  }
};

}  // namespace antilock::tutorial

// run_scene_petsc: answers a scene file with solver = "petsc", alone or on many ranks.
//
// Run:    run_scene SCENE.toml --out DIR                     hands scenes with solver = "petsc" over to this program
//         mpiexec -n 4 run_scene SCENE.toml --out DIR
//         mpiexec -n 4 run_scene SCENE.toml --out DIR --restart     after a run that was ended: from its last level
//
// The way of the data: scene -> coarse mesh on every rank -> strips -> refinement, assembly and
// contact loop, level by level, on each rank's own strip -> files, written by the ranks in turn. It
// promises what run_scene promises: an answer with exit status 0, or one line on standard error,
// from rank 0, and no results: status 2 for a question that cannot be asked, 3 for a solve that did
// not get there.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <new>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/runner/scene_checks.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/runner/scene_results.hpp"
#include "antilock/solve/active_set.hpp"
#include "programs/petsc/checkpoint.hpp"
#include "programs/petsc/scene_files.hpp"
#include "programs/program.hpp"
#include "programs/report.hpp"

using namespace antilock;
namespace dist = antilock::distributed;

namespace {

struct Choices {
  bool restart = false, direct = false;
  double most_seconds = std::numeric_limits<double>::infinity();
};

/// The mesh to begin with, on every rank, and how often it is refined: as often as the scene says.
/// A structured mesh is one of few cells, refined: the same vertices.
struct Hierarchy {
  TriangleMesh coarse;
  int refinements = 0, coarse_cells = 1;  // per unit side; 1 where a file does not say
};

Hierarchy hierarchy(const SceneFile& file, int ranks) {
  Hierarchy h;
  SceneFile first = file;
  std::swap(h.refinements, first.mesh.refinements);
  const bool halves = file.mesh.kind == "structured" &&
                      !std::holds_alternative<ThinLayer>(
                          file.scene.layer());  // its rows do not halve with the cells
  const int least = std::max(16, 8 * ranks);
  while (halves && first.mesh.cells % 2 == 0 && first.mesh.cells / 2 >= least) {
    first.mesh.cells /= 2;
    ++h.refinements;
  }
  h.coarse = make_mesh(first);
  h.coarse_cells = std::max(first.mesh.cells, 1);
  return h;
}

/// The contact set of the library's own solver on a coarse structured mesh: where the first level
/// begins to search.
dist::ContactSet first_guess(const Scene& scene) {
  const Space space(structured_mesh(32, Domain{scene.layer_depth()}), p1());
  const VariationalInequality problem = assemble(scene, space);
  const Solution solution = active_set(problem);
  dist::ContactSet set;
  for (std::size_t i = 0; i < problem.bounds.unknowns.size(); ++i) {
    set.x.push_back(space.dof_coordinates()(problem.bounds.unknowns[i], 0));
    set.active.push_back(solution.active[i] ? 1 : 0);
  }
  return set;
}

/// Better one line now than a process killed in the middle: about 1.1 kB per unknown of P1 and 2 kB
/// per unknown of CR.
void check_memory(const SceneFile& file, const Hierarchy& h, int ranks) {
  const double vertices = h.coarse.vertex_count() * std::pow(4.0, h.refinements);
  const double needed = 300e6 + vertices * (file.method.element == "CR" ? 4000 : 1150) / ranks;
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
    if (needed > static_cast<double>(limit.rlim_cur))
      throw NotConverged(
          fmt::format(
              "{}: mesh: about {:.0f} MB per rank are needed, the limit of this process is {:.0f} "
              "MB; accepted: fewer cells, more ranks, or a higher limit",
              file.name, needed / 1e6, static_cast<double>(limit.rlim_cur) / 1e6),
          1, 0);
  }
}

/// What a failure of the solver says, with the name of the file in front.
template <class Work>
void named(const std::string& file, const Work& work) {
  try {
    work();
  } catch (const NotConverged& failure) {
    throw NotConverged(file + ": solve: " + failure.what(), failure.reached, failure.steps);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(file + ": " + error.what());
  }
}

/// The run of a scene. All ranks call its functions together.
class SceneRun {
 public:
  SceneRun(std::filesystem::path scene, std::filesystem::path out, const Choices& choices,
           tutorial::Report& report)
      : scene_(std::move(scene)),
        out_(std::move(out)),
        checkpoint_(dist::checkpoint_path(out_)),
        choices_(choices),
        report_(report) {}

  void answer() {
    read();
    if (dist::rank() == 0) {
      const std::string& title = file_->title.empty() ? file_->name : file_->title;
      fmt::print("run_scene: {} (petsc, {} rank{})\n", printable(title, 200), dist::ranks(),
                 dist::ranks() > 1 ? "s" : "");
    }
    begin_stage("coarse mesh");
    make_coarse_mesh();
    if (choices_.restart) skip_solved_levels();
    set_options();
    const double before = watch_.lap();
    solve();
    const std::string of_data = data_warning();
    const std::optional<LockingReport> layer =
        dist::layer_report_of_all(*file_, hierarchy_.coarse, hierarchy_.refinements, *level_);
    const std::string warning = joined(layer ? layer->warning : "", of_data);
    // the rest of the wall time belongs to the stages in between: files are counted apart
    const double rest = watch_.lap() - solved_.mesh - solved_.assemble - solved_.setup;
    const RunSeconds seconds{before + solved_.mesh, solved_.assemble, solved_.setup, rest};

    begin_stage("files");
    dist::write_scene_files(out_, *file_, *level_, solved_, hierarchy_.refinements + 1, layer,
                            warning, seconds);
    remove_checkpoint();
    if (dist::rank() == 0) print_summary(warning);
  }

 private:
  void begin_stage(const std::string& what) {
    if (dist::rank() == 0) report_.stage(what);
  }

  /// Reads the scene file, and with --restart the checkpoint.
  void read() {
    dist::collectively([&] {
      file_ = read_scene_file(scene_);
      if (file_->method.solver != "petsc")
        throw Error(
            fmt::format("{}: method.solver: \"{}\" runs without mpiexec, {} ranks were started; "
                        "accepted: \"petsc\"",
                        file_->name, file_->method.solver, dist::ranks()));
      check_folder(out_);
      check_inputs_stay(out_, scene_, *file_, dist::ranks());
      question_ = dist::question_of(scene_, file_->mesh.file);
      if (!choices_.restart) return;
      const dist::Checkpoint checkpoint = dist::read_checkpoint(checkpoint_, question_);
      options_.start = checkpoint.set;
      solved_cells_ = checkpoint.cells;
    });
  }

  void make_coarse_mesh() {
    dist::collectively([&] {
      hierarchy_ = hierarchy(*file_, dist::ranks());
      check_memory(*file_, hierarchy_, dist::ranks());
      const bool unit_square = !file_->mesh.from_file();
      if (unit_square && !options_.start && file_->scene.contact())
        options_.start = first_guess(file_->scene);
    });
  }

  /// Begins at the first level that is finer than that of the checkpoint.
  void skip_solved_levels() {
    options_.first_level = 0;
    while (options_.first_level < hierarchy_.refinements &&
           (hierarchy_.coarse_cells << options_.first_level) <= solved_cells_)
      ++options_.first_level;
    begin_stage(fmt::format("restart from the contact set at 1/h = {}", solved_cells_));
  }

  void set_options() {
    options_.refinements = hierarchy_.refinements;
    if (choices_.direct) options_.loop.preconditioner = dist::Preconditioner::factor;
    options_.loop.progress = [most = choices_.most_seconds, since = Stopwatch()](const Progress&) {
      return since.seconds() <= most;
    };
    options_.loop.tolerance = std::max(file_->method.tolerance, MethodRequest::finest_tolerance);
    options_.loop.residual = std::max(options_.loop.residual, options_.loop.tolerance);
    options_.stage = [this](const std::string& what) { begin_stage(what); };
    options_.checkpoint = [this](int level, const dist::ContactSet& set) {
      dist::collectively([&] {
        if (dist::rank() == 0)
          dist::write_checkpoint(checkpoint_, {question_, hierarchy_.coarse_cells << level, set});
      });
    };
  }

  void remove_checkpoint() const {
    if (std::error_code ignored; dist::rank() == 0) std::filesystem::remove(checkpoint_, ignored);
  }

  void solve() {
    const MethodRequest& method = file_->method;
    try {
      named(file_->name, [&] {
        level_ = dist::solve_nested(file_->scene, hierarchy_.coarse, element(method.element),
                                    options_, solved_);
        if (method.tolerance < MethodRequest::finest_tolerance)
          throw NotConverged(fmt::format("petsc: relative error about {:.0e} reached after {} "
                                         "corrections, asked for {:.1e}; "
                                         "double precision goes no further",
                                         MethodRequest::finest_tolerance, solved_.last.corrections,
                                         method.tolerance),
                             MethodRequest::finest_tolerance, solved_.last.corrections);
      });
    } catch (const Error&) {
      remove_checkpoint();
      throw;
    }
  }

  /// The warning of the solver, else of the loads and obstacles that a rank sees on its own strip.
  std::string data_warning() const {
    std::string warning;
    dist::collectively([&] {
      Solution here;
      here.u = level_->state.u;
      warning = load_warning(*file_, level_->space, level_->problem.part());
      if (warning.empty() && file_->scene.contact())
        warning = gap_warning(*file_, level_->space, here);
    });
    return solved_.warning.empty() ? dist::first_nonempty(warning) : solved_.warning;
  }

  void print_summary(const std::string& warning) {
    report_.finish();
    if (!warning.empty()) fmt::print("  warning: {}\n", warning);
    fmt::print(
        "  {} unknowns; {} corrections and {} iterations of conjugate gradients on the last level; "
        "results in {}\n",
        solved_.unknowns.back(), solved_.last.corrections, solved_.last.linear_iterations,
        out_.string());
    if (dist::ranks() == 1)
      fmt::print("  a picture of it: {} surface {} --out {}\n",
                 tutorial::in_shell(tutorial::sibling_path("render")),
                 tutorial::in_shell((out_ / "solution_0.vtu").string()),
                 tutorial::in_shell((out_ / "solution.png").string()));
  }

  const std::filesystem::path scene_;
  const std::filesystem::path out_;
  const std::filesystem::path checkpoint_;
  const Choices choices_;
  tutorial::Report& report_;
  Stopwatch watch_;
  std::optional<SceneFile> file_;
  std::string question_;  ///< by which a checkpoint knows its scene
  int solved_cells_ = 0;  ///< per unit side, on the level of the checkpoint
  Hierarchy hierarchy_;
  dist::NestedOptions options_;
  dist::NestedReport solved_;
  std::unique_ptr<dist::NestedLevel> level_;
};

int fail(const std::string& message, int status) {
  if (dist::rank() == 0)
    std::fputs((printable(message, 4000) + "\n").c_str(), stderr);  // it cannot throw
  return status;
}

int run(int argc, char** argv) {
  CLI::App line(
      "Solves the scene of a file with solver = \"petsc\"; run_scene --help says what a scene file "
      "holds.",
      "run_scene");
  std::filesystem::path scene, out;
  Choices choices;
  line.add_option("SCENE", scene, "the scene file, in TOML")->required();
  const CLI::Option* folder = line.add_option(
      "--out", out,
      "folder of the results, made if absent; default: results/NAME of the scene file");
  line.add_flag("--restart", choices.restart,
                "start from the last level of a run to the same folder that was ended");
  line.add_option("--most-seconds", choices.most_seconds,
                  "stop a solve that takes longer: status 3")
      ->check(CLI::Range(0.0, choices.most_seconds));
  line.add_flag("--direct", choices.direct, "a factor by MUMPS in place of multigrid");
  if (const auto status = tutorial::parse(line, argc, argv, dist::rank() > 0)) return *status;
  tutorial::Report report;
  const auto failed = [&](const std::string& message, int status) {
    if (dist::rank() == 0) report.finish();
    return fail(message, status);
  };
  try {
    if (folder->count() == 0) out = default_results_folder(scene);
    SceneRun(scene, out, choices, report).answer();
  } catch (const NotConverged& failure) {
    return failed(failure.what(), 3);
  } catch (const Error& error) {
    return failed(error.what(), 2);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  tutorial::reexec_tuned(argv);
  try {
    const dist::Session session;
    try {
      return delivered(run(argc, argv), "run_scene");
    } catch (const std::exception& failure) {  // of this rank alone: the others may wait for it
      const bool memory = dynamic_cast<const std::bad_alloc*>(&failure) != nullptr;
      dist::abort(fmt::format("run_scene: {}",
                              memory ? "out of memory; accepted: fewer cells, or more ranks"
                                     : failure.what()),
                  3);
    }
  } catch (const std::exception& failure) {
    fmt::print(stderr, "run_scene: {}\n", failure.what());
  }
  return 3;
}

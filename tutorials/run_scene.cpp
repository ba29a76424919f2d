// run_scene: answers a question asked in a scene file, without a line of C++.
//
// Run:    run_scene tutorials/scenes/figure8.toml --out results/figure8
// Takes:  about a second for 1/h = 64; unstructured meshes above 1/h = 256 take several.
//
// The way of the data is that of every tutorial: scene -> mesh -> space -> discrete problem -> solution -> files.
// What this program promises: an answer with exit status 0, or one line on standard error and no file at all:
// status 2 for a question that cannot be asked (the line names file and key), 3 for a solve that did not get there.
#include <algorithm>
#include <cstdio>
#include <new>

#include "antilock/core/result_folder.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/io/expression.hpp"
#include "antilock/io/scene_file.hpp"
#include "antilock/io/scene_results.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

namespace {

// clang-format off
const char* const help = R"help(A scene file is TOML; the text after # is a comment:

  title = "figure 8"            # optional
  [load]                        # required: the body force on the unit square
  f = "10*sin(2*pi*x)"          # in x and y: + - * / ^, sin cos exp sqrt abs, pi, comparisons, x < 0.5 ? 1 : 2
  [layer]                       # leave out: no layer
  epsilon = 1e-6                # 0 (the rigid limit) to 1
  model = "scaled"              # "scaled" (default): problem (23) on (0,1) x (-1,0)
                                # "thin": (22) on (0,1) x (-epsilon,0), epsilon from 1e-3
                                # "ventcel": the limit (25) on Sigma, no layer mesh, epsilon = 0
  [contact]                     # leave out: no obstacle
  gap = "0"                     # how far the obstacle lies below: u >= -gap(x)
  [mesh]                        # required
  kind = "unstructured"         # "structured" (cells up to 2048), "unstructured" (up to 512) or "file"
  cells = 64                    # cells a unit side; with kind = "file" instead: file = "my.msh", beside the scene
  [method]                      # optional
  element = "CR"                # "P1" (default) or "CR" (Crouzeix-Raviart)
  solver = "active-set"         # (default) or "uzawa", the paper's
  tolerance = 1e-10             # relative, on the algebraic error

Written to the results folder: summary.json, solution.csv (x,y,u), contact.csv (x,gap,pressure; with contact only),
mesh.msh (gmsh and FreeFEM read it), solution.vtu (for ParaView: open it, colour by u).
In summary.json, h is 1/cells, or the longest edge of a mesh from a file; seconds are wall seconds.
Exit status: 0 answered; 2 bad input; 3 not solved to the tolerance. 2 and 3 say why in one line and write nothing.
Examples: the folder tutorials/scenes; start with   run_scene tutorials/scenes/figure8.toml --out results/figure8
)help";
// clang-format on

/// Below this no double can be promised, however long one iterates.
constexpr double finest_tolerance = 1e-14;

Solution solve(const VariationalInequality& problem, const Method& method) {
  // A rough answer saves two or three solves of a factored matrix, and could not be certified: none is rougher than
  // 1e-8.
  const double tolerance = std::clamp(method.tolerance, finest_tolerance, 1e-8);
  Solution solution;
  if (method.solver == "uzawa") {
    UzawaOptions options;
    options.tolerance = tolerance;
    solution = uzawa(problem, options);
  } else {
    ActiveSetOptions options;
    options.corrections.tolerance = tolerance;
    solution = active_set(problem, options);
  }
  if (method.tolerance < finest_tolerance)
    throw NotConverged(fmt::format("{}: relative error about {:.0e} reached after {} corrections, asked for {:.1e}; "
                                   "double precision goes no further",
                                   method.solver, finest_tolerance, solution.counters.corrections, method.tolerance),
                       finest_tolerance, solution.counters.corrections);
  return solution;
}

void answer(const std::filesystem::path& scene, const std::filesystem::path& out, tutorial::Report& report) {
  const Stopwatch total;
  Stopwatch watch;
  RunSeconds seconds;
  const SceneFile file = read_scene_file(scene);
  check_folder(out);
  check_inputs_stay(out, scene, file);
  fmt::print("run_scene: {}\n", printable(file.title.empty() ? file.name : file.title, 200));

  report.stage("mesh");
  watch.lap();
  const TriangleMesh mesh = make_mesh(file);
  seconds.mesh = watch.lap();

  report.stage(fmt::format("assembly: {} on {} triangles", file.method.element, mesh.triangle_count()));
  watch.lap();
  const Space space(mesh, element(file.method.element));
  if (space.free_count() == 0)
    throw Error(file.name + ": mesh: every unknown is clamped, none is left to solve for; accepted: a finer mesh");
  const VariationalInequality problem = assemble(file.scene, space);
  seconds.assemble = watch.lap();

  report.stage(fmt::format("solve: {}, {} unknowns", file.method.solver, problem.free_count()));
  Solution solution;
  try {
    solution = solve(problem, file.method);
  } catch (const NotConverged& failure) {
    throw NotConverged(file.name + ": solve: " + failure.what(), failure.reached, failure.steps);
  }
  seconds.factor = solution.seconds.analyse + solution.seconds.factor;
  seconds.solve = solution.seconds.contact + solution.seconds.solve;
  seconds.total = total.seconds();

  report.stage("files");
  write_scene_results(out, file, space, problem, solution, seconds);
  report.finish();
  if (!solution.warning.empty()) fmt::print("  warning: {}\n", solution.warning);
  fmt::print("  u from {:.6g} to {:.6g}; {} contact steps, {} corrections; results in {}\n", solution.u.minCoeff(),
             solution.u.maxCoeff(), solution.counters.contact, solution.counters.corrections, out.string());
}

int fail(const std::string& message, int status) {
  fmt::print(stderr, "{}\n", printable(message, 4000));
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  tutorial::CommandLine line(
      "Solves the scene of a file: a loaded body, with or without a stiff layer, with or without contact.",
      "run_scene");
  std::filesystem::path scene, out;
  line.add_required("SCENE", scene, "the scene file, in TOML");
  line.add("--out", out, "folder of the results, made if absent; default: results/NAME of the scene file");
  line.footer(help);
  if (const auto status = line.parse(argc, argv)) return *status;
  if (!line.given("--out")) out = std::filesystem::path("results") / scene.stem();
  tutorial::Report report;
  const auto failed = [&](const std::string& message, int status) {
    report.finish();  // the line of the stage that did not end
    return fail(message, status);
  };
  try {
    answer(scene, out, report);
  } catch (const NotConverged& failure) {
    return failed(failure.what(), 3);
  } catch (const std::bad_alloc&) {
    return failed(scene.string() + ": mesh: out of memory; accepted: fewer cells", 3);
  } catch (const std::exception& error) {
    return failed(error.what(), 2);
  }
  return 0;
}

// run_scene: answers a question asked in a scene file, without a line of C++.
//
// Run:    run_scene tutorials/scenes/figure8.toml --out results/figure8
// Takes:  about a second for 1/h = 64; unstructured meshes of 1/h = 128 take several.
//
// The way of the data is that of every tutorial: scene -> mesh -> space -> discrete problem ->
// solution -> files. What this program promises: an answer with exit status 0, or one line on
// standard error and no file at all: status 2 for a question that cannot be asked (the line names
// file and key), 3 for a solve that did not get there.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>
#include <variant>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/runner/scene_keys.hpp"
#include "antilock/runner/scene_results.hpp"
#include "antilock/runner/solve_scene.hpp"
#include "programs/program.hpp"
#include "programs/report.hpp"

using namespace antilock;

namespace {

// clang-format off
const char* const more_help = R"help(
A mesh from a file has the physical groups body, layer (if the scene has one), clamped and contact. The body may be any
shape on and above y = 0 with a bottom edge on that line; all of that edge is contact, or has the layer below it. A scaled
layer that the file does not hold is grown below the contact edges, in columns. In a file with the body alone these edges may be
curved, each x once, and at any height: the layer grows along their normals, and gap(x) is asked at the x of the edge. accuracy refuses springs, a ceiling, a
load on the layer, a stiffness that varies on a triangle and a displacement that is not affine on the edges of the mesh;
"petsc" refuses all of [body], [[edge]], [at], geometry, ceiling and the layer's numbers. With dimension = 3 body and layer are groups
of volumes, the others are groups of surfaces, the bottom of the body is on z = 0, and a traction is force per area; refused are
an accuracy, "petsc", "ventcel", plane strain, two bodies, refinements, a geometry, other elements than P1, CR and P2, and P2 with
contact. With a geometry, accuracy and refinements put
the new vertices of the body's boundary on its curves.
Read are the scene and the two files that [mesh] names, no other; nothing is run. A .geo is a script of gmsh, which may run programs
and read and write files: gmsh gets the commands of it that draw. A script with any other is refused by name and line; statements on
the mesh alone (Mesh, Physical, Field, ...) are left out. A .brep holds data, which OpenCASCADE reads. A .geo or .brep
that lies beside the mesh file and is not named is not read: refinements and accuracy warn of it.

Written to the results folder: summary.json; solution.csv (x,y,u; in space x,y,z,u; in plane strain x,y,u_x,u_y; with element = "BDM1-hybrid" x,y,u,mean: the unknowns are means, u is a value); contact.csv (x,gap,pressure, in space x,y,gap,pressure; with contact only,
with friction a column of that name: the tangential force per length), where
gap is the opening u + gap(x) >= 0 and pressure is force per unit length; mesh.msh (gmsh and FreeFEM read it; parts of the body that [body] names are one group there);
solution.vtu (for ParaView: open it, colour by u; it has p, the layer stress, and pressure, too). A picture of it:
build/bin/render surface DIR/solution.vtu --out picture.png (of a mesh from a file: render plan, in plane strain: render deformed, in space: render cut)
In summary.json, h is 1/cells of the refined mesh, or the longest edge of a mesh from a file or of the last mesh of an accuracy, the layer of depth 1 included; seconds are wall seconds, which add up to total;
blas is the library of dense linear algebra, its kernels and threads (where OpenBLAS does not know the CPU and falls
back to old kernels, the program starts again with wider ones, and with memory in large pages where Linux gives them to
who asks; ANTILOCK_KEEP_KERNELS=1 leaves both);
locking, with a layer, is {diagnosis, kept, lost_energy}: lost_energy is the share of the energy released by the layer's
motion that is lost at least (proved; null where nothing is proved), kept is 1 - lost_energy;
contact_force, with contact, is the resultant of the obstacles' forces on the body: normal (upwards), tangential (to the right; null without friction) and
moment (anticlockwise, about x = 0), in the unit of f times length^2 and length^3; normal_proved and moment_proved are the intervals
that are proved, with an accuracy and where u is prescribed at no end of the contact boundary, else null. In space it is {normal,
moment, moment_y}, the integrals of the pressure times 1, x and y, in one power of length more. contact has the range of x from ... to of the unknowns in
contact, and from_within and to_within: the interval between the end of that range and the next unknown (in space y_from and y_to,
the range of y, in their place);
coulomb, with that key, has the steps of the fixed point and the contraction of the last one; where it does not contract: status 3;
compliance is {value, lower, upper}: the work L(u) of the loads, with an accuracy and where gap and displacements are 0 its proved bounds;
scene is the question in full; certificate, with an accuracy, is what was proved, level by level, of the
polygon of the last mesh, with load, traction and gap as sampled; warning says what to
distrust: a layer that locks, a solution with a larger error than promised, a load of the body or
an obstacle that the mesh misses, u within a layer beyond its values around it, a polygon in place of a curve.
Exit status: 0 answered; 2 bad input, or what is printed does not arrive; 3 not solved to the tolerance, or out of memory. 2 and
3 say why in one line and write nothing.
Examples: the folder tutorials/scenes; start with   run_scene tutorials/scenes/figure8.toml --out results/figure8
)help";
// clang-format on

/// Which of the processes that mpiexec started this is, and how many there are, without MPI: from
/// the environment that Open MPI, MPICH and Slurm set. 0 of 1 without mpiexec.
int mpi_variable(const char* by_open_mpi, const char* by_others, int alone) {
  for (const char* name : {by_open_mpi, by_others})
    if (const char* value = std::getenv(name)) return std::atoi(value);
  return alone;
}
int mpi_rank() { return mpi_variable("OMPI_COMM_WORLD_RANK", "PMI_RANK", 0); }
int mpi_size() { return mpi_variable("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", 1); }

/// Scenes with solver = "petsc" are answered by the program beside this one, alone or on many
/// ranks.
void check_solver(const SceneFile& file, bool for_petsc, char** argv) {
  if (file.method.solver == "petsc") {
    tutorial::exec_program("run_scene_petsc", argv);
    throw Error(
        file.name +
        ": method.solver: \"petsc\" is not built here, since PETSc or MPI was missing; accepted: "
        "\"active-set\", \"uzawa\"");
  }
  if (for_petsc)
    throw Error(
        file.name +
        ": --restart and --direct go with solver = \"petsc\" only; accepted: a run without it");
  if (mpi_size() > 1)
    throw Error(
        file.name +
        ": method.solver: was started on several ranks, and PETSc or MPI was missing when this was "
        "built; accepted: a run without mpiexec");
}

/// A line on the terminal that follows a long solve, from its second second on, and the end of one
/// that takes longer than it may.
ProgressHook follower(double most_seconds) {
  return [watch = Stopwatch(), shown = 1.0, most_seconds](const Progress& now) mutable {
    const double seconds = watch.seconds();
    if (seconds > shown + 1 && ::isatty(STDERR_FILENO) != 0) {
      shown = seconds;
      fmt::print(stderr, "\r  {:.0f} s, {} {}: relative error about {:.0e}, asked for {:.0e} ",
                 seconds, now.stage, now.step, now.error, now.tolerance);
    }
    return seconds <= most_seconds;
  };
}

/// What the command line asks for beside the scene.
struct Asked {
  std::filesystem::path out;
  ResultFiles files;
  double most_seconds = std::numeric_limits<double>::infinity();
  bool restart = false, direct = false;
};

/// s / epsilon^2, as a quotient where it is beyond double precision.
std::string across(const StiffLayer& layer) {
  const double square = layer.epsilon * layer.epsilon;
  const double stiffness = layer.s / square;
  return square > 0 && std::isfinite(stiffness)
             ? fmt::format("{:g}", stiffness)
             : fmt::format("{:g} / {:g}^2", layer.s, layer.epsilon);
}

void answer(const std::filesystem::path& scene, const Asked& asked, tutorial::Report& report,
            char** argv) {
  const SceneFile file = read_scene_file(scene);
  const MethodRequest& method = file.method;
  check_solver(file, asked.restart || asked.direct, argv);
  check_folder(asked.out);
  check_inputs_stay(asked.out, scene, file);
  fmt::print("run_scene: {}\n", printable(file.title.empty() ? file.name : file.title, 200));

  Stopwatch watch;
  const auto level_done = [&](const RefinementLevel& level) {
    const std::string quote = level.predicted_unknowns > 0
                                  ? fmt::format(", about {:.0f} unknowns and {:.2g} s in the end",
                                                level.predicted_unknowns, level.predicted_seconds)
                                  : "";
    fmt::print("\n    {} unknowns: proved {:.3g}{}", level.unknowns, level.relative, quote);
    if (level.seconds > asked.most_seconds && level.relative > *method.accuracy)
      throw NotConverged(
          fmt::format("stopped after {:.1f} s: proved {:.3g} with {} unknowns, asked for {:g}",
                      level.seconds, level.relative, level.unknowns, *method.accuracy),
          level.relative, 0);
  };
  CertifiedSolution found = solve_scene(file, {[&](const std::string& what) { report.stage(what); },
                                               follower(asked.most_seconds), level_done});
  watch.lap();
  const CertifiedSolution* const certified = found.history.empty() ? nullptr : &found;
  const SceneSummary summary = summary_of(file, found.result, certified);
  found.result.seconds.solve += watch.lap();
  if (const auto* stiff = std::get_if<StiffLayer>(&file.scene.layer());
      stiff != nullptr && nlohmann::json::parse(file.json)["layer"].contains("thickness"))
    fmt::print("  layer: {:g} before a_x^-, {} before a_y^-\n", stiff->s, across(*stiff));
  report.stage("files");
  write_scene_results(asked.out, file, found.result, summary, certified, asked.files);
  report.finish();
  fmt::print("{}", force_table(file, summary, certified));
  if (!summary.warning.empty()) fmt::print("  warning: {}\n", summary.warning);
  const std::string name = (asked.out / "solution").string();
  const char* const in_plane = std::visit(
      [&](const auto& model) { return model.picture(file.mesh.from_file()); }, file.model);
  const char* const kind = file.mesh.dimension == 3 ? "cut" : in_plane;
  if (asked.files.contains("vtu"))
    fmt::print("  a picture of it: {} {} {} --out {}\n",
               tutorial::in_shell(tutorial::sibling_path("render")), kind,
               tutorial::in_shell(name + ".vtu"), tutorial::in_shell(name + ".png"));
  if (found.history.empty())
    fmt::print("  u from {:.6g} to {:.6g}; {} contact steps, {} corrections; results in {}\n",
               summary.u_min, summary.u_max, summary.contact_steps, summary.corrections,
               asked.out.string());
  else
    fmt::print("  proved relative error {:.3g}, {} levels, {} unknowns; results in {}\n",
               found.certificate.relative(method.of), found.history.size(),
               found.result.space.free_count(), asked.out.string());
}

int fail(const std::string& message, int status) {
  if (mpi_rank() > 0) return 0;  // rank 0 says it, and its status is that of the run
  // fmt::print would throw where standard error is full or closed, and end the program by a signal
  std::fputs((printable(message, 4000) + "\n").c_str(), stderr);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  if (mpi_size() > 1)
    tutorial::exec_program("run_scene_petsc", argv);  // which reads the scene on all at once
  CLI::App line(
      "Solves the scene of a file: a loaded body, with or without a stiff layer, with or without "
      "contact.",
      "run_scene");
  std::filesystem::path scene;
  Asked asked;
  std::string files = "summary,csv,mesh,vtu";
  line.add_option("SCENE", scene, "the scene file, in TOML")->required();
  const CLI::Option* out = line.add_option(
      "--out", asked.out,
      "folder of the results, made if absent; default: results/NAME of the scene file");
  line.add_option("--files", files,
                  "which files to write: any of summary, csv, mesh, vtu, with commas between them");
  line.add_flag("--direct", asked.direct,
                "with solver = \"petsc\": a factor by MUMPS in place of multigrid");
  line.add_flag("--restart", asked.restart,
                "with solver = \"petsc\": start from the last level of a run that was ended");
  line.add_option("--most-seconds", asked.most_seconds,
                  "stop a solve that takes longer: status 3, and how far it came")
      ->check(CLI::Range(0.0, asked.most_seconds));
  line.footer("A scene file is TOML; the text after # is a comment:\n\n" + scene_keys_help() +
              more_help);
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;
  tutorial::Report report;
  const auto failed = [&](const std::string& message, int status) {
    if (std::ferror(stdout) == 0) report.finish();  // the line of the stage that did not end
    return fail(message, status);
  };
  try {
    if (out->count() == 0) asked.out = default_results_folder(scene);
    asked.files = result_files(files);  // a name that is none is refused before the work
    answer(scene, asked, report, argv);
  } catch (const NotConverged& failure) {
    return failed(failure.what(), 3);
  } catch (const std::bad_alloc&) {
    return failed(scene.string() + ": mesh: out of memory; accepted: fewer cells", 3);
  } catch (const std::system_error& error) {  // of standard output: those of files come as Error
    return failed(std::string("run_scene: standard output: ") + error.what(), 2);
  } catch (const std::exception& error) {
    return failed(error.what(), 2);
  }
  return delivered(0, "run_scene");
}

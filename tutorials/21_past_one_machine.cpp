// Past one machine: the same inequality on PETSc over MPI, and why the mesh of the layer decides whether that works.
//
// Run: 21_past_one_machine                     1/h = 256 on 1, 2 and 4 ranks; about a minute on two cores
// Run: 21_past_one_machine --cells 64          counts only: the problem is too small to share
//
// What ends the direct solver. Every chapter before factors K = A1 + delta^-1 B' M B. In two dimensions the factor of N
// unknowns holds about N log N entries and takes N^(3/2) operations; its ordering is serial. At 2 million unknowns it
// takes 16 s and 2.6 GB here, and a second machine helps little.
//
// What replaces it. The iterated penalty needs K^-1 only on residuals, and each correction repairs what the last solve
// left over: four digits are enough. Conjugate gradients with algebraic multigrid (PETSc, BoomerAMG of hypre) give them
// in 2 to 5 iterations, whatever delta, **if the layer is made of columns**. The loop of a level is
//
//     r1 = L - A1 u - B' M p        r2 = compliance p - B u          (always from A1, B, M and p, never from K)
//     contact set:  kept where -r1 presses, entered where u < -gap
//     K du = r1 + delta^-1 B' M r2  off the set,   du = -gap - u  on it;      u += du,   p += (B du - r2) / delta
//
// Contact set and penalty are corrected in one loop, 4 or 5 linear solves a level. Each level starts from the contact
// set of the level before, so that the number of loops does not grow with 1/h. No rank ever holds the fine mesh: every
// rank reads the coarse one, keeps its own strip and refines that. Matrices A1, B and M stay on their rank; only K is a
// matrix of all ranks (lib/antilock/distributed).
//
// Why columns. The functions that multigrid must carry to its coarse grids unharmed are those that K hardly charges:
// the kernel of B, chapter 07. In columns they are P1's "one function per column", which coarsening along a column
// keeps. Two exhibits: a share of the triangles that cuts the columns, and a layer without columns, whose kernel (Crouzeix-Raviart: half
// a function per triangle) no coarse grid of the kind knows.
//
// The third exhibit is PETSc's own solver for variational inequalities, SNESVI, out of the box on the summed matrix
// A1 + epsilon^-2 B' M B: below epsilon = 1e-4 round-off in the sum (chapter 8) defeats it.
//
// How far on paper. Measured on one rank with P1: 1.0 kB per unknown at 2.1 and at 8.4 million unknowns, and about 8
// processor microseconds per unknown at 2.1 million (one run), all levels with mesh and assembly. So 10^8 unknowns ask for 100 GB and 800 core seconds,
// 10^9 for 1 TB and 8000. What breaks first: Debian's PETSc counts with 32 bits, which this room refuses beyond 134
// million unknowns (libpetsc64-real-dev goes further); then the strips, of which there are at most as many as coarse
// columns, each an interface from top to bottom; then the coarse mesh, which every rank holds.
//
// FreeFEM's interface to PETSc is not in Debian's package: this chapter has no script to compare with. Load chosen
// here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/distributed/nested.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/distributed/snesvi.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
namespace dist = antilock::distributed;

namespace {

/// One solve, as a process of each rank sees it and as the table shows it.
struct Run {
  std::string what = "strips";  // "strips", "blocks" (columns cut), "free" (no columns) or "snesvi"
  int ranks = 1, cells = 64;
  double epsilon = 1e-6;
  long long unknowns = 0;
  int iterations = 0, most = 0, corrections = 0, levels = 0;  // 0 iterations: it did not converge
  double seconds = 0, megabytes = 0, u_max = 0, u_min = 0;
  std::string reason = "-";  // PETSc's name for why it stopped (snesvi alone)
};

Scene scene_of(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

// 1. On every rank: a coarse mesh, refined to the mesh that is asked for, solved level by level.
void solve(Run& run) {
  dist::NestedOptions options;
  int coarse = run.cells;
  while (coarse % 2 == 0 && coarse / 2 >= std::max(16, 4 * run.ranks)) coarse /= 2, ++options.refinements;
  TriangleMesh mesh = structured_mesh(coarse);
  const Element* page = &p1();
  if (run.what == "blocks") {  // squares dealt out in turn, as a chessboard: every column is cut again and again
    options.share = [](const TriangleMesh& m, int ranks) {
      std::vector<int> rank_of(m.triangle_count());
      for (int t = 0; t < m.triangle_count(); ++t)
        rank_of[t] = static_cast<int>(8 * m.vertices.col(0)(m.triangles.row(t)).mean()) +
                     static_cast<int>(8 * (m.vertices.col(1)(m.triangles.row(t)).mean() + 1));
      for (int& r : rank_of) r %= ranks;
      return rank_of;
    };
  } else if (run.what == "free") {  // Crouzeix-Raviart does not lock there; nobody asks whether there are columns
    mesh = unstructured_mesh(run.cells);
    page = &crouzeix_raviart();
    run.unknowns = Space(mesh, *page).free_count();
    options.refinements = 0;
    options.share = [](const TriangleMesh& m, int) { return std::vector<int>(m.triangle_count(), 0); };
  }
  dist::NestedReport report;
  const Stopwatch watch;
  const auto level = dist::solve_nested(scene_of(run.epsilon), mesh, *page, options, report);
  run.seconds = watch.seconds();
  run.unknowns = report.unknowns.back();
  run.iterations = report.last.linear_iterations, run.most = report.last.most_iterations;
  run.corrections = report.last.corrections, run.levels = options.refinements + 1;
  run.u_max = dist::largest(level->state.u.maxCoeff());
  run.u_min = -dist::largest(-level->state.u.minCoeff());
  run.megabytes = dist::peak_megabytes();
}

// 2. PETSc's own solver on the summed matrix: no split, no nesting.
void snesvi(Run& run) {
  const TriangleMesh mesh = structured_mesh(run.cells);
  const dist::Piece piece = dist::piece_of(mesh, std::vector<int>(mesh.triangle_count(), 0), 0, 1);
  const Space space(piece.mesh, p1());
  const dist::Inequality problem(scene_of(run.epsilon), piece, space, true);
  const dist::SnesviEnd end = dist::snesvi(problem);
  run.unknowns = problem.rows().total();
  run.iterations = end.converged ? end.linear : 0;
  run.corrections = end.newton;
  run.u_max = end.largest;
  run.reason = end.reason;
}

/// What a rank's process does: `--on-ranks WHAT CELLS EPSILON`; rank 0 prints the numbers.
int on_ranks(char** argv) {
  const dist::Session session;
  Run run;
  run.what = argv[2], run.cells = std::stoi(argv[3]), run.epsilon = std::stod(argv[4]), run.ranks = dist::ranks();
  try {
    if (run.what == "snesvi")
      snesvi(run);
    else
      solve(run);
  } catch (const NotConverged&) {
    run.iterations = 0;  // an exhibit of failure
  } catch (const std::exception& error) {
    dist::abort(error.what(), 3);
  }
  if (dist::rank() == 0)
    fmt::print("{} {} {} {} {} {} {} {} {} {}\n", run.unknowns, run.iterations, run.most, run.corrections, run.levels,
               run.seconds, run.megabytes, run.u_max, run.u_min, run.reason);
  return 0;
}

// 3. From outside: the same program under mpiexec, its line read back. More ranks than cores are allowed, root too.
Run launch(const std::string& self, Run run) {
  const std::string launcher = run.ranks == 1 ? "" : fmt::format("mpiexec -n {} ", run.ranks);
  const std::string command = fmt::format(
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
      "OMPI_MCA_mpi_yield_when_idle=1 OPENBLAS_NUM_THREADS=1 {}'{}' --on-ranks {} {} {}",
      launcher, self, run.what, run.cells, run.epsilon);
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string answer;
  std::array<char, 512> line{};
  while (pipe != nullptr && std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr)
    answer += line.data();
  const int status = pipe != nullptr ? ::pclose(pipe) : -1;
  std::istringstream text(answer);
  text >> run.unknowns >> run.iterations >> run.most >> run.corrections >> run.levels >> run.seconds >> run.megabytes >>
      run.u_max >> run.u_min >> run.reason;
  if (status != 0 || !text)
    throw Error(fmt::format("mpiexec -n {} failed (status {}); accepted: a machine where mpiexec starts {} processes",
                            run.ranks, status, run.ranks));
  return run;
}

void print(const char* title, const std::vector<Run>& runs) {
  fmt::print("\n  {}\n  {:>6} {:>6} {:>9} {:>9} {:>12} {:>12} {:>11} {:>9} {:>9}\n", title, "ranks", "1/h", "epsilon",
             "unknowns", "corrections", "iterations", "most at once", "seconds", "MB/rank");
  for (const Run& r : runs)
    fmt::print("  {:>6} {:>6} {:>9} {:>9} {:>12} {:>12} {:>11} {:>9.2f} {:>9.0f}\n", r.ranks, r.cells, r.epsilon,
               r.unknowns, r.corrections, r.iterations > 0 ? std::to_string(r.iterations) : "fails", r.most, r.seconds,
               r.megabytes);
}

void write(const std::filesystem::path& path, const std::vector<std::pair<std::string, std::vector<Run>>>& studies) {
  write_file(path, [&](std::ostream& out) {
    out << "study,ranks,cells,epsilon,unknowns,corrections,iterations,most,seconds,megabytes,u_max\n";
    for (const auto& [name, runs] : studies)
      for (const Run& r : runs)
        out << fmt::format("{},{},{},{},{},{},{},{},{:.4g},{:.4g},{}\n", name, r.ranks, r.cells, r.epsilon, r.unknowns,
                           r.corrections, r.iterations, r.most, r.seconds, r.megabytes, r.u_max);
  });
}

void study(const std::string& self, const tutorial::Options& options, tutorial::Report& report) {
  constexpr std::array ranks{1, 2, 4};
  std::vector<Run> strong, weak, cut, without, vi;

  report.stage("strong scaling: one mesh on 1, 2 and 4 ranks");
  for (const int n : ranks) strong.push_back(launch(self, {"strips", n, options.cells, options.epsilon}));
  report.stage("weak scaling: as many unknowns per rank");
  for (const int n : ranks)  // cells per side grow like the root of the ranks
    weak.push_back(launch(
        self, {"strips", n, static_cast<int>(std::lround(options.cells / 16.0 * std::sqrt(n))) * 8, options.epsilon}));
  report.stage("exhibit: a share that cuts the columns");
  for (const int n : ranks) cut.push_back(launch(self, {"blocks", n, options.cells, options.epsilon}));
  report.stage("exhibit: a layer without columns");
  without.push_back(launch(self, {"free", 1, std::min(options.cells, 32), options.epsilon}));
  report.stage("exhibit: SNESVI on the summed matrix");
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) vi.push_back(launch(self, {"snesvi", 1, 64, epsilon}));

  report.stage("the serial library on the same mesh");
  const TriangleMesh mesh = structured_mesh(options.cells);
  const Space space(mesh, p1());
  const Solution serial = active_set(assemble(scene_of(options.epsilon), space));
  report.finish();

  print("strong scaling", strong);
  print("weak scaling", weak);
  print("a share that cuts the columns: squares dealt out as on a chessboard", cut);
  print("a layer without columns, Crouzeix-Raviart", without);
  fmt::print("\n  SNESVI on the summed matrix, 1/h = 64\n  {:>9} {:>7} {:>12} {:>22}  {}\n", "epsilon", "Newton",
             "iterations", "largest u on Gamma_C", "PETSc says");
  for (const Run& r : vi)
    fmt::print("  {:>9} {:>7} {:>12} {:>22.7f}  {}\n", r.epsilon, r.corrections, r.iterations, r.u_max, r.reason);
  write(options.out / "scaling.csv",
        {{"strong", strong}, {"weak", weak}, {"cut", cut}, {"without columns", without}, {"snesvi", vi}});

  // 4. The verdict.
  double difference = 0;
  int most = 0, most_corrections = 0;
  for (const Run& r : strong)
    difference =
        std::max({difference, std::abs(r.u_max - serial.u.maxCoeff()), std::abs(r.u_min - serial.u.minCoeff())});
  for (const auto* runs : {&strong, &weak})
    for (const Run& r : *runs)
      most = std::max(most, r.most), most_corrections = std::max(most_corrections, r.corrections);
  report.claim(
      difference <= 1e-9 * serial.u.maxCoeff(),
      fmt::format("any number of ranks gives the serial library's largest and smallest u to {:.0e}", difference));
  report.claim(
      most > 0 && most <= 15 && most_corrections <= 6,
      fmt::format("at most {} iterations per correction and {} corrections, on every mesh and any number of ranks",
                  most, most_corrections));
  report.claim(2 * cut.back().iterations > 3 * strong.back().iterations,
               fmt::format("a share that cuts the columns takes more iterations on 4 ranks: {} for {}",
                           cut.back().iterations, strong.back().iterations));
  report.claim(without.front().iterations == 0,
               "multigrid fails on a layer without columns: no answer in 500 iterations");
  report.claim(
      vi.front().iterations > 0 && vi.back().iterations == 0,
      fmt::format("SNESVI on the summed matrix converges at epsilon = 1e-2 and not at 1e-6 ({})", vi.back().reason));
  fmt::print(
      "\n  Three things to try: --epsilon 0 (the same counts); PETSC_OPTIONS=-log_view; the memory per rank at --cells "
      "1024.\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && std::string(argv[1]) == "--on-ranks") return on_ranks(argv);
  tutorial::Options options;
  options.cells = 256;
  options.least_cells = 32;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  return tutorial::run(argc, argv, "21_past_one_machine", "the same inequality on PETSc over MPI", options,
                       [&](const tutorial::Options& o, tutorial::Report& report) { study(self, o, report); });
}

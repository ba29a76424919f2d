// # Past one machine
//
// Run: 24_past_one_machine                1/h = 256 on 1, 2 and 4 ranks; 10 s on two cores with nothing else on them
// Run: 24_past_one_machine --cells 1024   2.1 million unknowns, 5 GB; minutes
// Run: 24_past_one_machine --exercise 1
// Run: 24_past_one_machine --exercise 2
//
// Needs: [02](../02_meshes/02_meshes.cpp) for the layered mesh,
// [07](../07_kernel/07_kernel.cpp) for the kernel on the layer,
// [18](../18_roundoff/18_roundoff.cpp) for the split form and the iterated penalty. There
// is no FreeFEM script, because Debian's package has no interface to PETSc.
//
// **The picture.** One mesh on more *ranks*, the processes that share a problem (strong
// scaling), and as many unknowns on each rank (weak scaling). *Where each rank owns whole
// columns of the layer, the iterations hardly grow with the ranks.* It stands at the end of
// this page, because its third curve answers (a).
//
// **Predict.** (a) The triangles are dealt out in squares, as on a chessboard, so that
// columns are cut. By what factor do the iterations grow on four ranks, and why? (b) PETSc
// has a solver of its own for variational inequalities. It is given the summed matrix
// $A_1 + ε^{-2} B^T M B$ at ε = 1e-6. Does it find $u$, does it answer with a wrong $u$, or
// does it report a failure? (c) The layer has no columns. A preconditioner solves small
// problems on overlapping *subdomains* and one problem on a *coarse space*, and adds the
// answers up. The subdomains are small patches, or strips from $Σ$ to $Γ_C$. The coarse
// space stops at $Σ$, or goes on into the layer. Which of the four pairs needs as many
// iterations for every δ and every h?
//
// ## Why the factor stops, and what replaces it
//
// Every chapter before factors $A_δ = A_1 + δ^{-1} B^T M B$, in $N^{3/2}$ operations for
// $N$ unknowns in the plane. A second machine helps little: the order of elimination is
// found on one processor, and the last and largest blocks of the factor wait for all
// others.
//
// The iterated penalty needs $A_δ^{-1}$ on residuals alone. Each correction repairs what
// the last one left over, and that includes what a careless solve with $A_δ$ left over. So
// four digits per correction are enough. Conjugate gradients give them in 2 to 5 iterations
// with *algebraic multigrid* (BoomerAMG): it reads from $A_δ$ which unknowns hang together,
// merges them into a coarser problem, and so on until one is left that is solved at once.
// Contact set and penalty are corrected in one loop. What is left over is formed from
// $A_1$, $B$, $M$ and $p$, not from $A_δ$, since $A_δ$ has lost digits (chapter 18):
//
// $$ r_1 = L - A_1 u - B^T M p,   r_2 = ε^2 p - B u. $$
//
// In balance $r_1$ is $-λ$: on a touching point it is what the obstacle adds, with the
// other sign. So a point stays in contact where $-r_1 > 0$ presses, and comes into contact
// where $u < -\text{gap}$. Off this set one correction solves
//
// $$ A_δ\,du = r_1 + δ^{-1} B^T M r_2,   u ← u + du,   p ← p + δ^{-1} (B\,du - r_2), $$
//
// as `cure` does in chapter 18, and on it $du = -\text{gap} - u$. The penalty $δ$ is about
// $10^{-9}$ on every mesh in columns. Each level of refinement begins with the contact set
// of the level before.
//
// ## Columns: multigrid finds the kernel
//
// Multigrid must keep on its coarse problems what $A_δ$ hardly charges: the kernel of $B$
// on the layer. For P1 in columns that is one function per vertical line of vertices, and
// the unknowns that hang together through $δ^{-1}$ are those of one such line. Merged, they
// are still in the kernel. Without columns Crouzeix-Raviart has one such function per two
// triangles (chapter 07), each spread over several triangles. None of the algebraic
// multigrids that we tried merges unknowns so that they stay in this kernel: each needed
// 500 iterations and more (observed).
//
// ## No columns: tell the solver the kernel
//
// A solver that cannot find the kernel in the matrix can be told of it. For elasticity
// that is nearly incompressible, the same difficulty, Schöberl (1999) corrects on small
// patches of triangles that hold the kernel's functions, and carries what a coarse mesh
// found to the finer one so that the kernel stays the kernel; the number of iterations
// then does not depend on the parameter (proved there). Farrell, Mitchell, Scott and
// Wechsung (2020) do so on meshes whose triangles are cut in three at a point inside. Two
// questions decide what becomes of this idea here: how far do the functions of our kernel
// reach, and which of them are smooth?
//
// **The kernel is a flow.** Let $u$ be a function of Crouzeix-Raviart, $u_e$ its mean over
// the edge $e$, which goes from the vertex $a$ to the vertex $b$. By Green's formula $∂_y
// u_h$ on a triangle is a sum over its edges,
//
// $$ |T| ∂_y u_h = - \sum_{e ⊂ ∂T} (x_b - x_a) u_e, $$
//
// where the edges are run through counterclockwise. So $B u = 0$ says of $q_e = (x_b -
// x_a) u_e$ that as much of it enters each triangle as leaves it: $q$ is a flow without
// sources. A flow without sources in a simply connected layer has a stream function $ψ$
// with values at the vertices, $q_e = ψ_b - ψ_a$ (proved: add $q$ up along any path).
// Hence
//
// $$ u_e = (ψ_b - ψ_a) / (x_b - x_a). $$
//
// With $ψ = G(x)$ this is the mean of $g = G'$ over the edge. So *the means of every
// function of $x$ lie in the kernel* (chapter 08), and they are the smooth functions in
// it. On a vertical edge $u_e$ is free, because $q_e = 0$ there.
//
// **What $A_1$ charges.** $u$ is a difference quotient of $ψ$ in $x$, so $A_1$ charges
// second differences of $ψ$ in $x$, triangle by triangle. A $ψ$ that changes with $y$,
// however slowly, is another function on neighbouring triangles, and $A_1$ charges it
// $h^{-2}$ times as much as a function of $x$ with the same values (argued, and observed
// below). Two conclusions:
//
// 1. A subdomain must have the whole height from $Σ$ to $Γ_C$. If it ends in between, a
//    function of $x$ is cut off along a horizontal line, and the part that is left over
//    costs $h^{-2}$. It must also overlap its neighbours well: cutting $ψ$ off over a
//    width $w$ costs about $(ψ / w^2)^2$.
// 2. What is smooth from one subdomain to the next is a function of $x$. The coarse
//    space must hold such functions: the hat functions of the vertices of $Σ$, taken by
//    edge means. In the body they go on as P1, so that the coarse problem is P1 on a
//    mesh whose layer is in columns. That is where multigrid works.
//
// The damped sum of the corrections on the subdomains is called the *smoother*, because the
// error that it leaves over is smooth from one subdomain to the next. *The smoother must
// hold the functions that cost nothing, and the coarse space the smooth ones of them.* The
// program tries the four pairs of prediction (c).
// :figure: layer_strips
// :figure: layer_hat
//
// **Why the sum of the corrections is safe.** $A_δ$ is a sum over triangles. If at most
// $N$ subdomains meet in a triangle, the sum of the exact corrections has no eigenvalue
// above $N$ (proved: bound the energy triangle by triangle). We damp the sum by $1.5 / N$.
// Then all its eigenvalues are below 2, and a step of smoothing, a coarse correction and
// another step make a positive definite preconditioner for every mesh, every δ and every
// contact set. How *small* the eigenvalues get, and with them the number of iterations, is
// observed, not proved.
//
// **A stop that contact needs.** Four digits of each correction are not enough here. After
// a change of the contact set the first residual is large and stiff, and $10^{-4}$ of it
// hides the soft part that decides the next set: for δ far below $h^2$ the sets then cycle
// for ever (observed). So the error must also fall below $10^{-6} \sqrt{L^T u}$. A point
// is released only where it pulls by more than the largest entry of $r_1$ off the contact
// set, which is 0 but for the error of the solve: the sign of a smaller force is not
// known. While a point of the set pulls, the corrections go on until the sign is known.
// With the sign alone the set changed 14 times on two ranks at 460,288 unknowns, and with
// this condition not at all (observed). And δ is here some $h^2 / 256$. With $10^{-9}$ and
// the sign alone it changed four times at 114,944 unknowns, and at 460,288 it did not
// settle (observed).
//
// **Two other ways.** *MUMPS* is a direct solver. It eliminates unknowns as the serial
// factor does, but the ranks share the blocks of the factor, and send each other its
// numbers by MPI (exercise 2). So it needs no kernel, and it keeps the price of a factor.
// *BDDC* (balancing domain decomposition by constraints) factors each strip by itself. Its
// conjugate gradients work on the values along the seams alone, and a small problem ties
// the strips together. It took 5 to 9 iterations up to 1/h = 256 and broke down at 1.8
// million unknowns, so it is not offered. A *strip* is here the part of the mesh or of the
// layer between two vertical lines, not the strip of chapter 19.
//
// **SNESVI**, PETSc's own solver, is an active set
// ([00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp)) whose line search
// compares residuals. The rows of the summed matrix are of size $ε^{-2}$, and so is the
// round-off in its residual: below ε = 1e-4 there is nothing left to compare. In the split
// form it solves for $du$ alone, with full steps, and ends with our $u$.
//
// **TAO**, PETSc's optimisers, take the energy and its gradient. `bntr` is Newton's method
// for bounds in a trust region. It compares values of the energy from step to step, where
// SNESVI compares residuals, and the digits of the energy are lost in the same sum. The
// runs below print why it stops; no claim is made about it.

#include "antilock/distributed/nested.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/form/edge_forms.hpp"
#include "course/course.hpp"
#include "support.hpp"
#include "two_levels.hpp"

using namespace antilock;
namespace dist = antilock::distributed;
using tutorial::Asked, tutorial::Ended, tutorial::iterations_table, tutorial::on_ranks,
    tutorial::serial;

// Every rank runs the next function: it knows the same coarse mesh, keeps its own strip and
// refines that. No rank ever holds the fine mesh. $A_1$, $B$ and $M$ stay on their rank;
// $A_δ$ alone is a matrix of all ranks.
Ended on_each_rank(const Asked& ask) {
  const Scene scene = tutorial::paper_scene(ask.epsilon);
  const bool columns = ask.what == "strips" || ask.what == "chessboard";
  // ### Mesh
  dist::NestedOptions options;
  int coarse = ask.cells;
  while (columns && coarse % 2 == 0 && coarse / 2 >= std::max(16, 4 * ask.ranks))
    coarse /= 2, ++options.refinements;
  const TriangleMesh mesh = columns ? structured_mesh(coarse) : unstructured_mesh(coarse);
  if (ask.what == "chessboard") options.partition = tutorial::chessboard;
  // ### Solve
  if (ask.what == "multigrid")
    options.loop.preconditioner = dist::Preconditioner::multigrid;
  if (ask.what == "MUMPS") options.loop.preconditioner = dist::Preconditioner::factor;
  dist::NestedReport report;
  const Stopwatch watch;
  const auto level =
      dist::solve_nested(scene, mesh, columns ? p1() : crouzeix_raviart(), options, report);
  return {report.unknowns.back(),
          report.last.corrections,
          report.last.linear_iterations,
          report.last.max_iterations,
          watch.seconds(),
          0,
          dist::largest(level->state.u.maxCoeff()),
          -dist::largest(-level->state.u.minCoeff())};
}

// ### Output
// Measured by `figures/benchmarks/distributed` (medians, mesh and assembly and all levels
// included; cores: 2):
//
// | unknowns | serial: seconds, GB | PETSc: seconds, GB | on two ranks: seconds, GB per rank | iterations at most |
// |---|---|---|---|---|
// | 32,512 | 0.07, 0.09 | 0.08, 0.07 | 0.07, 0.06 | 4 |
// | 523,264 | 2.7, 0.83 | 1.5, 0.50 | 1.1, 0.29 | 5 |
// | 2,095,104 | 11, 3.3 | 7.2, 1.9 | 5.1, 1.0 | 5 |
// | 8,384,512 | | | 49, 4.3 (an earlier state) | 5 |
//
// On paper $10^9$ unknowns need 1 TB and some 10,000 processor seconds. What breaks first:
// Debian's PETSc counts with 32 bits (refused beyond 134 million unknowns); then the
// strips, at most as many as coarse columns, with seams from top to bottom; then the coarse
// mesh, which every rank holds.
//
// Strips and hat functions, Crouzeix-Raviart on gmsh's mesh, ε = 1e-6 (`distributed_cost
// --element CR --mesh unstructured`, two cores that other programs used, too). Processor
// seconds are those of factor, set-ups and solves of all levels on the rank that has most,
// and contain the waiting for other ranks. The iterations are those of all corrections at
// the finest level. A process takes some 90 MB for 118 unknowns: they are part of each
// number.
//
// | unknowns | CHOLMOD, serial | 1 rank | 2 ranks | 4 ranks | MUMPS, 1 and 2 ranks |
// |---|---|---|---|---|---|
// | 28,672: iterations | | 19 | 25 | 25 | |
// | seconds | 0.09 | 0.18 | 0.21 | 0.12 | 0.84, 1.6 |
// | MB per rank | 109 | 118 | 106 | 99 | 121, 123 |
// | 114,944: iterations | | 21 | 35 | 30 | |
// | seconds | 0.34 | 0.61 | 0.92 | 0.40 | 4.1, 4.5 |
// | MB per rank | 190 | 201 | 154 | 123 | 201, 175 |
// | 460,288: iterations | | 30 | 37 | 32 | |
// | seconds | 1.8 | 3.4 | 2.5 | 1.6 | |
// | MB per rank | 525 | 540 | 344 | | |
//
// Strong scaling: two ranks take 0.75 of the processor seconds of one at 460,288 unknowns,
// and 0.56 of its memory without the 90 MB. Weak scaling: from 114,944 unknowns on one
// rank to 460,288 on four the seconds grow from 0.61 to 1.6, because one smoothing step is
// damped more where four subdomains meet than where three do, and because a rank waits for
// others. No size up to 460,288 is cheaper on one core than with CHOLMOD (1.8 to 2.1 times
// as expensive). On four ranks 460,288 unknowns are: 1.6 seconds each against 1.8
// (observed).
//
// **Beyond two cores, on paper.** One iteration is three products with $A_δ$ in the split
// form, two smoothing steps, $P$ and $P^T$, and one cycle of multigrid on the coarse
// problem; the columns of $P$ are the coarse functions. A rank exchanges values with its
// two neighbours 12 times (twice per product and per smoothing step, once for $P$ and for
// $P^T$), besides the coarse cycle, and takes part in two global sums. The coarse
// problem has one unknown per vertex of the body, a sixth of all; algebraic multigrid is
// known to scale there. $10^9$ unknowns are 1/h = 12,000. What fails first is the full
// height of a strip: its unknowns grow like 110/h (1.3 million there; more than 500,000
// are refused), and by conclusion 1 its overlap must grow like $h^{-1/2}$ for as many
// iterations as at 1/h = 256, 7 times. The strips are then some 110 edges wide, and about
// a hundred ranks can share the layer. More ranks would need a method that divides a
// strip, which is not known here.
//
// **In space** `solver = "petsc"` refuses tetrahedra in one line. Tubes over squares of
// $Σ$ would be the strips, and hat functions of $(x, y)$, by face means, the coarse space.
// In a prototype they took 27 to 33 iterations for every δ on 10,256 to 251,574 unknowns.
// The library does not divide a mesh by $(x, y)$ yet, and has no face means on an
// unstructured $Σ$. It also needs a smaller damping where four tubes and the body meet.
void past_one_machine(const tutorial::Options& options, tutorial::Report& report) {
  const double epsilon = options.epsilon;
  const auto same = [&](int) { return options.cells; };
  const auto growing = [&](int ranks) {
    return 8 * std::lround(options.cells / 16.0 * std::sqrt(ranks));
  };
  report.stage("strong scaling, weak scaling, the chessboard");
  const Table strong = on_ranks("strips", {1, 2, 4}, same, epsilon),
              weak = on_ranks("strips", {1, 2, 4}, growing, epsilon),
              cut = on_ranks("chessboard", {1, 2, 4}, same, epsilon);
  report.stage("a layer without columns: four pairs");
  const tutorial::TwoLevels strips{true, false}, strips_and_hats{true, true};
  Table pairs = iterations_table({{false, false}, {false, true}, strips, strips_and_hats},
                                 {16, 32}, {1, 1e-2, 1e-6});
  pairs.add(iterations_table({strips, strips_and_hats}, {64, 128}, {1, 1e-2, 1e-6}));
  pairs.add(iterations_table({strips, strips_and_hats}, {256}, {1e-6}));
  const Table growth = pairs.filter("delta", 1e-6);
  report.stage("a layer without columns, distributed; SNESVI; the serial library");
  const Table without = on_ranks({"multigrid", 1, 32, epsilon}),
              told = on_ranks(
                  "any layer", {1, 2, 4}, [](int) { return 32; }, epsilon),
              split = on_ranks({"SNESVI, split", 1, 32, 1e-6}),
              coarse = on_ranks({"SNESVI, summed", 1, 32, 1e-2}),
              summed = on_ranks({"SNESVI, summed", 1, 32, 1e-6}),
              tao_coarse = on_ranks({"TAO bntr, summed", 1, 32, 1e-2}),
              tao_summed = on_ranks({"TAO bntr, summed", 1, 32, 1e-6}),
              tao_split = on_ranks({"TAO bntr, split", 1, 32, 1e-6});
  const Solution u = serial(structured_mesh(options.cells), p1(), epsilon);
  tutorial::write_scaling(options.out, strong, weak, cut);
  tutorial::write_strip(options.out / "strip.csv");
  tutorial::write_coarse_function(options.out);
  tutorial::write_four_pairs(options.out / "four_pairs.csv", pairs);
  report.finish();
  for (const Table& runs : {strong, weak, cut, without, told, split, coarse, summed,
                            tao_coarse, tao_summed, tao_split})
    tutorial::print_runs(runs);
  pairs.print("iterations to 1e-8 of the four pairs, 200 at most");
  growth.print("iterations to 1e-8 as 1/h grows");

  report.claim_within(std::abs(strong.max("u_max") / u.u.maxCoeff() - 1), 0, 1e-9,
                      "any ranks: away from the serial u by (observed)");
  report.claim_within(std::max(strong.max("most"), weak.max("most")), 1, 10,
                      "iterations per correction, at most (observed)");
  report.claim_within(cut.last("iterations") / strong.last("iterations"), 1.5, 4,
                      "cut columns: iterations times (observed)");
  report.claim(without.entry("reason") == "gave_up",
               "BoomerAMG fails on a layer without columns (observed)");
  const auto of_pair = [](const Table& table, const char* name) {
    return table.filter("pair", name);
  };
  report.claim_within(std::min(of_pair(growth, "patches").last("iterations"),
                               of_pair(growth, "patches and hats").last("iterations")),
                      150, 200, "small patches at delta = 1e-6, of 200 allowed (observed)");
  const auto times = [&](const char* name) {
    const Table runs = of_pair(growth, name);
    return runs.last("iterations") / runs.first("iterations");
  };
  report.claim_within(times("strips") / times("strips and hats"), 1.1, 4,
                      "strips alone grow with 1/h, times faster than with hats (observed)");
  const Table stiff = pairs.filter_number("delta", [](double delta) { return delta < 1; });
  report.claim_within(of_pair(stiff, "strips and hats").max("iterations"), 5, 20,
                      "strips and hats, delta = 1e-2 and 1e-6, any h: at most (observed)");
  report.claim_within(told.max("most"), 1, 15,
                      "the same on 1, 2 and 4 ranks: iterations per correction (observed)");
  const std::string reason = summed.entry("reason").text();
  report.claim(coarse.number("u_max") > 0 && summed.number("u_max") == 0 &&
                   reason.starts_with("DIVERGED"),
               "SNESVI, summed: solves 1e-2 and reports {} at 1e-6, with u = 0, the start "
               "(observed)",
               reason);
  report.claim_within(split.number("u_max") / coarse.number("u_max"), 0.95, 1.05,
                      "SNESVI, split at 1e-6 over summed at 1e-2 (observed)");
}

// ## What came out
//
// (a) By a factor of 2 to 3, because a cut column is no longer merged as a whole.
// :figure: past_one_machine
//
// (b) It reports a failure. At ε = 1e-6 round-off hides the residual, the line search finds
// no descent (DIVERGED_LINE_SEARCH after one step), and $u$ is still the start, 0. At ε =
// 1e-2 the same solver is right, and in the split form it is right at 1e-6.
//
// (c) Strips with hat functions, and no other pair, as long as δ is small.
// :figure: four_pairs
//
// Patches cut the functions that cost nothing. At δ = 1e-6 they use up the 200 iterations
// that they may take, hat functions or not. Strips alone no longer feel δ. But what is
// smooth over many strips is left over, and the iterations grow with 1/h, from 15 at 1/h =
// 32 to 32 at 1/h = 256. With hat functions they are 14 at 1/h = 32, and 17 at 1/h = 128 as
// well as at 1/h = 256 (observed). At δ = 1 even this pair grows, to 24 at 1/h = 128: the
// layer is then as soft as the body, and its smooth functions vary with $y$, too. For such
// δ the library cuts the hat functions into rows.
// :number: 15 = table "iterations to 1e-8 as 1/h grows" iterations pair=strips cells=32
// :number: 32 = table "iterations to 1e-8 as 1/h grows" iterations pair=strips cells=256
// :number: 14 = table "iterations to 1e-8 as 1/h grows" iterations "pair=strips and hats" cells=32
// :number: 17 = table "iterations to 1e-8 as 1/h grows" iterations "pair=strips and hats" cells=256
// :number: 24 = table "iterations to 1e-8 of the four pairs, 200 at most" iterations "pair=strips and hats" cells=128 delta=1
//
// On one core this gains nothing over the serial factor in the plane. What it gains is
// ranks: no rank holds more than its strips, and the largest problem that is factored is
// one of them.
//
// ## Exercises
//
// 1. Take ε = 0 in place of 1e-6. What becomes of the iterations?
// 2. Take MUMPS in place of multigrid on the layer without columns. Does the loop settle,
//    and on which $u$?
// 3. Predict, then try: strips of half the height. (Change `strips_of_layer`.)
// 4. On paper: how many columns must the coarse mesh have for 1,024 ranks, and how often is
//    it refined for $10^9$ unknowns?
//
// ## Further reading
//
// - [Hintermüller, Ito and Kunisch 2002](../guides/bibliography.md#hintermueller-2002): the
//   active set as a method of Newton.
// - [Higham 2002](../guides/bibliography.md#higham-2002): rounding, and why a residual must
//   be formed with care.

#include "answers.hpp"

int main(int argc, char** argv) {
  const auto any = [](const Asked& ask) {
    const bool of_petsc = ask.what.starts_with("SNESVI") || ask.what.starts_with("TAO");
    return of_petsc ? tutorial::by_petsc(ask) : on_each_rank(ask);
  };
  if (const auto status = tutorial::answer_as_rank(argc, argv, any)) return *status;
  return tutorial::run(
      argc, argv, "24_past_one_machine", "the same inequality on PETSc over MPI",
      {.cells = 256, .least_cells = 64, .exercises = exercises}, past_one_machine);
}

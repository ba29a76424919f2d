#pragma once
// The answers to the exercises of 24_past_one_machine, whose page includes this one: to be
// read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"epsilon = 0 in place of 1e-6: what becomes of the iterations?",
     "they stay as they are: the matrix that multigrid sees has delta in place of "
     "epsilon^2",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Table rigid = on_ranks({"strips", 2, 64, 0}),
                   stiff = on_ranks({"strips", 2, 64, 1e-6});
       report.claim_within(rigid.number("iterations") - stiff.number("iterations"), -1, 1,
                           "more iterations:");
     }},
    {"The layer without columns, with MUMPS in place of multigrid: does the loop settle, "
     "and on which u?",
     "yes, on the serial u, in a few corrections: multigrid needs columns, the loop does "
     "not",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Table direct = on_ranks({"MUMPS", 1, 32, 1e-6});
       const double u =
           serial(unstructured_mesh(32), crouzeix_raviart(), 1e-6).u.maxCoeff();
       report.claim_within(direct.number("corrections"), 1, 10, "corrections");
       report.claim_within(std::abs(direct.number("u_max") / u - 1), 0, 1e-9,
                           "away from the serial u by");
     }}};

// ## Answers on paper
//
// **3.** A strip of half the height cuts the functions of x off along a horizontal line. A
// prototype of this preconditioner needed 97 iterations in place of 10 (gmsh's
// Frontal-Delaunay mesh, δ = 1e-8), and 153 with a quarter of the height.
//
// **4.** A strip owns whole columns, so 1,024 ranks need 1,024 of them. P1 has about
// $2 n^2$ unknowns, $n = 1/h$: $10^9$ of them ask for $n = 22,400$. That is 1,024 doubled 4
// times (16,384) or 5 times (32,768).

#pragma once
// The answers to the exercises of 21_work_precision, whose page includes this one: to be
// read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"P1 structured at epsilon = 1e-2, 1/h = 8, 16, 32, 64: how do the contact steps of "
     "the active set grow, and those "
     "of Uzawa?",
     "the active set's do not: 1 or 2 on each of the four meshes. Uzawa's grow with every "
     "refinement, from 139 to "
     "some 5,300",
     [](const tutorial::Options&, tutorial::Report& report) {
       Table counts({"cells", "active set", "Uzawa"});
       for (const int n : {8, 16, 32, 64}) {
         const Space space(structured_mesh(n), p1());
         const VariationalInequality problem = assemble(tutorial::paper_scene(1e-2), space);
         counts.add({n, active_set(problem).counters.contact_iterations,
                     uzawa(problem).counters.contact_iterations});
       }
       counts.print();
       report.claim(counts.max("active set") <= 4, "active set: {} steps at most",
                    counts.max("active set"));
       report.claim(counts.order("Uzawa", "cells") > 0.5, "Uzawa: steps like (1/h)^{:.2f}",
                    counts.order("Uzawa", "cells"));
     }}};

// ## Answers on paper
//
// **2.** The error is like $h^2 = 1/N$, and the seconds are like $N$: one digit more costs
// 10 times the seconds. With an error like $h = N^{-1/2}$: 100 times. (A sparse Cholesky
// factor in the plane takes $N^{3/2}$: 32 and 1,000 times.)

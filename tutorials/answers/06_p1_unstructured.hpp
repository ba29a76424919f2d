#pragma once
#include "antilock/mesh/layered.hpp"

// The answers to the exercises of 06_p1_unstructured, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Refine from 1/h = 32 to 64 at epsilon = 1e-6. What happens to the error, what to the small rest of the ridge?",
     "the error stays within 1 %; the rest grows like h^-3, eight times (a factor 2 for the mesh)",
     [](const tutorial::Options&, tutorial::Report& report) {
       const tutorial::Exact exact(tutorial::paper_scene(1e-6));
       double error[2], rest[2];
       for (const int k : {0, 1}) {
         const Discretisation on = Method{&p1(), unstructured()}.on(32 << k);
         const Solution solution = active_set(assemble(tutorial::paper_scene(1e-6), on.space()));
         error[k] = exact.errors(on.space(), solution).max_at_unknowns,
         rest[k] = solution.u(on.space().contact()).maxCoeff();
       }
       report.claim_within(error[1] / error[0], 0.99, 1.01, "error on 1/64 / error on 1/32:");
       report.claim_within(rest[1] / rest[0], 4, 16, "rest of the ridge, 1/64 / 1/32:");
     }},
    {"Keep the body's triangles, and put the layer into columns (the layered mesh of chapter 02). Does it lock?",
     "no: the kernel on the layer has its hat functions again; the error is below 4 h^2",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Discretisation on(layered_mesh(options.cells), p1());
       const Solution solution = active_set(assemble(tutorial::paper_scene(1e-6), on.space()));
       const double h = 1.0 / options.cells, error = tutorial::Exact(tutorial::paper_scene(1e-6)).errors(on.space(), solution).max_at_unknowns;
       report.claim_within(error / (h * h), 0, 4, "error / h^2:");
     }}};

// ## Answers on paper
//
// **3.** At `--cells 16` $x = (h^{3/2}/ε)^2 = 2.44$, and $1/(1 + x) = 0.29$ should be kept. At `--cells 64`
// $x = 0.038$, and 0.96 should be kept. The runs keep 0.73 and 0.98 times as much: 0.21 and 0.95. The constant of the
// law is near 1.

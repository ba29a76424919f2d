#pragma once
// The answers to the exercises of 05_p1_structured, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Turn the diagonals of the mesh to the left. Does P1 lock, or lose digits?",
     "neither: vertical lines matter, diagonals do not; the error changes by less than half of itself",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const auto error = [&](Diagonal diagonal) {
         const Discretisation on = Method{&p1(), structured({}, diagonal)}.on(options.cells);
         const Solution solution = active_set(assemble(tutorial::paper_scene(1e-6), on.space()));
         return tutorial::Exact(tutorial::paper_scene(1e-6)).errors(on.space(), solution).max_at_unknowns;
       };
       report.claim_within(error(Diagonal::left) / error(Diagonal::right), 0.5, 1.5, "error left / error right:");
     }},
    {"Double the load. Does the contact zone grow? Does the pressure double?",
     "the zone stays, u and the pressure double: K is a cone (chapter 00)",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Discretisation on = Method{&p1(), structured()}.on(options.cells);
       VariationalInequality problem = assemble(tutorial::paper_scene(1e-6), on.space());
       const Solution once = active_set(problem);
       problem.load *= 2;
       const Solution twice = active_set(problem);
       report.claim(twice.active == once.active, "the same contact set");
       report.claim_within((twice.lambda - 2 * once.lambda).norm() / once.lambda.norm(), 0, 1e-8, "lambda - 2 lambda:");
     }}};

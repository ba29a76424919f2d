#pragma once
// The answers to the exercises of 05_p1_structured, whose page includes this one: to be
// read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Turn the diagonals of the mesh to the left. Does P1 lock, or lose digits?",
     "neither: vertical lines matter, diagonals do not; the error changes by less than "
     "half of itself",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const tutorial::Exact exact(tutorial::paper_scene(1e-6));
       const auto error = [&](Diagonal diagonal) {
         const Space space = Method{&p1(), structured({}, diagonal)}.space(options.cells);
         return exact.errors(space, active_set(assemble(exact.scene, space)))
             .max_at_unknowns;
       };
       report.claim_within(error(Diagonal::left) / error(Diagonal::right), 0.5, 1.5,
                           "error left / error right:");
     }},
    {"Double the load. Does the contact zone grow? Does the pressure double?",
     "the zone stays, u and the pressure double: K is a cone (chapter 00); so does the "
     "truth, and with it the error",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Space space = Method{&p1(), structured()}.space(options.cells);
       const tutorial::Exact one(tutorial::paper_scene(1e-6));
       const tutorial::Exact two(
           Scene(Body{SineLoad{{{2, {20}}}}}, StiffLayer{1e-6}, UnilateralContact{}));
       const Solution once = active_set(assemble(one.scene, space));
       const Solution twice = active_set(assemble(two.scene, space));
       report.claim(twice.active == once.active, "the same contact set");
       report.claim_within((twice.lambda - 2 * once.lambda).norm() / once.lambda.norm(), 0,
                           1e-8, "lambda - 2 lambda:");
       report.claim_within(two.errors(space, twice).h1 / one.errors(space, once).h1, 1.999,
                           2.001, "error / error:");
     }}};

// ## Answers on paper
//
// **3.** $p$ on $Σ$ minus $p$ on $Γ_C$ is $-u''$, so $∂_y u^+ + λ = -u''$, or
// $λ = -∂_y u^+ - u''$ on $Σ$. With $∂_n u = -∂_y u^+$, the derivative along the outward
// normal of the body, $λ = ∂_n u - u''$. This is $r$ of (25), the problem of chapter 10.

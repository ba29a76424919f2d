#pragma once
// The answers to the exercises of 23_effects, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Move the obstacle out of reach, gap = 1. What does the scene with layer and contact "
     "cost, and what does it "
     "answer?",
     "the answer of the scene without contact, for the same factorisation: one look at the "
     "signs is all that is "
     "added",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const auto on = [&] { return unstructured_mesh(options.cells); };
       const Run far(
           Scene(body, StiffLayer{1e-2}, UnilateralContact{[](double) { return 1.0; }}),
           on()),
           none(Scene(body, StiffLayer{1e-2}), on());
       report.claim_within((far.solution.u - none.solution.u).cwiseAbs().maxCoeff(), 0,
                           1e-9, "difference of u");
       report.claim(far.solution.counters.contact_iterations <= 1 &&
                        far.solution.counters.factorisations ==
                            none.solution.counters.factorisations,
                    "{} contact step(s), {} factorisation(s)",
                    far.solution.counters.contact_iterations,
                    far.solution.counters.factorisations);
     }},
    {"Take P1 for Crouzeix-Raviart on this unstructured mesh. Which models of the layer "
     "lock: (23), (24), (25)?",
     "(23) and (24), whose layer is meshed; (25) has no layer to lock",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const auto largest = [&](const Layer& layer) {
         const Scene scene(body, layer, obstacle);
         const Space space(unstructured_mesh(options.cells, {scene.layer_depth()}), p1());
         return active_set(assemble(scene, space)).u(space.contact_dofs()).maxCoeff();
       };
       report.claim_within(largest(StiffLayer{1e-6}), 0, 1e-3,
                           "(23) at 1e-6: largest u on Gamma_C");
       report.claim_within(largest(StiffLayer{0}), 0, 1e-9, "(24): largest u on Gamma_C");
       report.claim_within(largest(VentcelLayer{}), 0.044, 0.048,
                           "(25): largest u on Sigma (truth 0.0457)");
     }}};

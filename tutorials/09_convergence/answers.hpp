#pragma once
#include "antilock/analysis/locking.hpp"

// The answers to the exercises of 09_convergence, whose page includes this one: to be read
// after predicting.

std::vector<tutorial::Exercise> exercises() {
  const auto largest_error = [](const Method& method, int cells, double epsilon) {
    const Space space = method.space(cells);
    return tutorial::Exact(tutorial::paper_scene(epsilon))
        .errors(space, active_set(assemble(tutorial::paper_scene(epsilon), space)))
        .max;
  };
  return {{"Add epsilon = 1e-3 for P1 unstructured. Where does its line start to fall?",
           "before the wall, 5.84 k = 1e-3, passes it near h = 1/130: 0.03 of the ridge is "
           "kept at 1/32, 0.17 at "
           "1/64, 0.57 at 1/128",
           [=](const tutorial::Options&, tutorial::Report& report) {
             const Method p1_any{&p1(), unstructured()};
             report.claim_within(largest_error(p1_any, 16, 1e-3) / 0.0457160, 0.99, 1.01,
                                 "1/h = 16: error / ridge:");
             const double x = std::pow(5.836 * bending_length(p1_any.mesh(128)) / 1e-3, 2),
                          kept = 1 - largest_error(p1_any, 128, 1e-3) / 0.0457160;
             report.claim_within(kept * (1 + x), 0.9, 1.8,
                                 fmt::format("1/h = 128 keeps {:.2f}; kept / law:", kept));
           }},
          {"P1 on the layered mesh: uniform or not?",
           "uniform: worst / best over epsilon stays below 1.2; only the layer's columns "
           "matter",
           [=](const tutorial::Options&, tutorial::Report& report) {
             const Method layered{&p1(), mesh_family("layered")};
             Table errors({"epsilon", "error"});
             for (const double epsilon : {1.0, 1e-2, 1e-6})
               errors.add({epsilon, largest_error(layered, 32, epsilon)});
             errors.print("P1 layered, 1/h = 32");
             report.claim_within(errors.max("error") / errors.min("error"), 1, 1.2,
                                 "worst / best:");
           }}};
}

// ## Answers on paper
//
// **3.** Both have order 1 where nothing locks: they measure the gradient, which is
// constant per triangle. In `energy` the layer's slope counts $ε^{-1}$ times, and the order
// is the same (observed in chapter 13; Remark 4 says that this error tends to 0, without an
// order). Where P1 locks both are level.

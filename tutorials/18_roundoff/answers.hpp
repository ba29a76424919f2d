#pragma once
// The answers to the exercises of 18_roundoff, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Iterative refinement, as textbooks have it: factor the sum itself, take r = L - (A1 "
     "+ B' M B / epsilon^2) u, "
     "correct. "
     "Does it bring the digits back, at epsilon = 1e-7?",
     "no: it finds the solution of the rounded sum; the digits that were lost are not in "
     "its residual",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Space space(structured_mesh(options.cells), p1());
       const VariationalInequality problem = assemble(tutorial::paper_scene(1e-7), space);
       PenalisedCholesky factor(problem);
       const Solution right = active_set(problem, factor);
       const auto apart = [&](const VectorXd& u) {
         return (u - right.u).norm() / right.u.norm();
       };
       const double split = apart(cure(problem, right.active, factor.delta()));
       const double sum = apart(cure(problem, right.active, problem.compliance, false));
       report.claim(split < 1e-8, "residual of the split form: relative error {:.0e}",
                    split);
       report.claim(!(sum < 1e-4), "residual of the sum: relative error {:.0e}", sum);
     }}};

// ## Answers on paper
//
// **2.** $h^2 = 2.4e-4$, so the factor is $δ/(δ + h^2) = 1e-6 / 2.45e-4 = 4.1e-3$: 2.4
// digits per correction. Five corrections give 11.9 digits, six give more than 12. The
// library takes $δ = 6 · 10^{-8}$ here and needs 2.

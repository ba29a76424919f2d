#pragma once
// The answers to the exercises of 03_by_hand, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"delta = 1e-2 in place of 1e-4. The same u? As many corrections?",
     "the same u; more corrections, since (delta - epsilon^2) / (delta + sigma) is nearer "
     "to 1",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const ByHand problem = assemble_by_hand(structured_mesh(options.cells));
       Table small({"correction", "contact steps", "du"}), large = small;
       const SolvedByHand fast = solve_by_hand(problem, options.epsilon, 1e-4, small);
       const SolvedByHand slow = solve_by_hand(problem, options.epsilon, 1e-2, large);
       fmt::print("  corrections: {} and {}\n", small.size(), large.size());
       report.claim_within((fast.u - slow.u).norm() / fast.u.norm(), 0, 1e-11,
                           "difference of u, relative:");
       report.claim(large.size() >= 2 * small.size(), "at least twice as many corrections");
     }},
    {"Move one inner vertex of the layer sideways by h/10. Six triangles meet there. How "
     "many entries have their rows "
     "of B?",
     "four rows have three entries; the two whose opposite edge is still vertical keep two",
     [](const tutorial::Options& options, tutorial::Report& report) {
       TriangleMesh mesh = structured_mesh(options.cells);
       const int vertex =
           (options.cells + 1) + options.cells / 2;  // in the first row above Gamma_C
       mesh.vertices(vertex, 0) += 0.1 / options.cells;
       const ByHand problem = assemble_by_hand(mesh);
       int three = 0;
       for (Eigen::Index row = 0; row < problem.b.rows(); ++row)
         three += (problem.b.row(row).array().abs() > 1e-9).count() == 3;
       report.claim_within(three, 4, 4, "rows of three entries:");
     }}};

// ## Answers on paper
//
// **3.** Without contact $λ = 0$. After the first correction $r_1 = 0$, and it stays 0:
// $A_1 du + B^T M dp = 0$. Hence $B du = -S dp$ with $S = B A_1^{-1} B^T M$. Put this into
// $δ dp = B du - r_2$: $(δ + S) dp = -r_2$. The new residual is
// $ε² (p + dp) - B (u + du) = r_2 + ε² dp - B du = (ε² - δ) dp = (δ - ε²) (δ + S)^{-1} r_2$. On an eigenvector of $S$ this is the factor $(δ - ε²)/(δ + σ)$.

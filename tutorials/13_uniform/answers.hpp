#pragma once
// The answers to the exercises of 13_uniform, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"The load -10 sin(pi x) presses everywhere. Is P1 on the unstructured mesh uniform "
     "now?",
     "yes: u^0 is 0 on the layer, nothing can be lost there; the hypothesis of Theorem 4 "
     "is sufficient, not "
     "necessary",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const SineLoad load{{{1, {-10}}}};
       std::vector<Exact> exact;
       for (const double epsilon : tutorial::quarter_decades())
         exact.emplace_back(Scene(Body{load}, StiffLayer{epsilon}, UnilateralContact{}),
                            14);
       Table map(columns);
       for (int n = 4; n <= options.cells; n *= 2)
         map.add(solve_all({&p1(), unstructured()}, n, exact, load));
       const Table worst = worst_from(0, map);
       worst.print();
       report.claim_order(worst, "h1", "h", 0.9, 1.05, "the worst error");
       report.claim(worst.max("ratio") < 1.05, "locking ratio at most {:.3f}",
                    worst.max("ratio"));
     }}};

// ## Answers on paper
//
// **2.** By the law of chapter 06, $ρ = (5.84 k/ε)^2$, the worst error over $[ε(h), 1]$
// tends to 0 if and only if $ε(h)$ moves to the right of the wall for good: $ε(h)/k → ∞$.
// On the unstructured mesh $k ∼ h^{3/2}$ (observed). Over $[h, 1]$ $ρ$ is at most of the
// order of $h$, and the worst error tends to 0. Over $[h^2, 1]$ it does not: at $ε = h^2$
// nearly all is lost, the more the finer the mesh. On the Delaunay mesh $k ≈ 0.117 h$
// (observed). At $ε = h$ the law says $ρ = 0.47$: the share $ρ/(1 + ρ)$, about a third, is
// lost however fine the mesh is. So even over $[h, 1]$ the worst error does not tend to 0.

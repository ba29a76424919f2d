#pragma once
// The answers to the exercises of 12_uniform, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"The load -10 sin(pi x) presses everywhere. Is P1 on the unstructured mesh uniform now?",
     "yes: u^0 is 0 on the layer, nothing can be lost there; the hypothesis of Theorem 4 is sufficient, not "
     "necessary",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const SineLoad load{{{1, {-10}}}};
       std::vector<Exact> truth;
       for (const double epsilon : tutorial::half_decades())
         truth.emplace_back(Scene(Body{load}, StiffLayer{epsilon}, UnilateralContact{}), 14);
       Table map(columns);
       for (int n = 8; n <= options.cells; n *= 2) map.add(solve_all({&p1(), unstructured()}, n, truth, load));
       const Table worst = worst_from(0, map);
       worst.print();
       report.claim_within(worst.order("h1", "h"), 0.9, 1.1, "order of the worst error");
       report.claim(worst.most("ratio") < 1.1, "locking ratio at most {:.2f}", worst.most("ratio"));
     }}};

// ## Answers on paper
//
// **2.** P1 loses the share $x/(1 + x)$ of the ridge, $x = (h^{3/2}/ε)^2$ (chapter 06). On $[h, 1]$ $x$ is at most
// $h$: what is lost tends to 0, and the rest of the error has order 1. At $ε = h^2$, the end of $[h^2, 1]$, $x = 1/h$:
// nearly all is lost, the more the finer the mesh. Over $[ε(h), 1]$ the worst error tends to 0 if and only if
// $ε(h) / h^{3/2} → ∞$.

#pragma once
#include <numbers>

// The answers to the exercises of 01_domain, whose page includes this one: to be read after
// predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Which costs more energy when the layer is made thinner: sin(pi x), or sin(pi x) y~ "
     "in the layer?",
     "the first costs the same at every thickness; the second grows, and by the factor 4 "
     "per halving in the end",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space at(structured_mesh(16),
                      p1());  // unstructured: the first grows too, and chapter 06 says why
       const auto x = at.dof_coordinates().col(0).array(),
                  y = at.dof_coordinates().col(1).array();
       const Eigen::VectorXd along = (std::numbers::pi * x).sin(),
                             across = along.array() * y.min(0);
       Table table({"epsilon", "along", "across"});
       for (const double epsilon : {0.4, 0.2, 0.1, 0.05}) {
         const Space space(squashed(at.mesh(), epsilon), p1());
         const auto problem = assemble(
             Scene(Body{paper_load}, ThinLayer{epsilon}, UnilateralContact{}), space);
         table.add({epsilon, energy_form(problem, along), energy_form(problem, across)});
       }
       table.print("a(v, v) on body and thin layer together");
       report.claim_within(table.max("along") / table.min("along") - 1, 0, 1e-12,
                           "along: largest / smallest - 1:");
       const auto grown = table.numbers("across");
       report.claim_within(grown[3] / grown[2], 3.5, 4, "across: last factor");
     }}};

// ## Answers on paper
//
// **2.** The last line: $u ≥ -g$, $∂_n u ≥ 0$, $(u + g) ∂_n u = 0$ on $Γ_{C,ε}$. So $K_ε$
// asks for $v ≥ -g$; it is still convex, but no cone. In the derivation the boundary term
// changes: $∂_n u (v - u) = ∂_n u (v + g) - ∂_n u (u + g)$. The second part is 0 and the
// first is not negative, since $v + g ≥ 0$. So (22) and (23) stay as they are, with the new
// $K$.
//
// **3.** In the unit layer $∂_y$ becomes $ε^{-1} ∂_y$. So
// $-ε^{-1} (∂_{xx} + ε^{-2} ∂_{yy}) u = 0$, which is $-∂_{xx} u - ε^{-2} ∂_{yy} u = 0$. On
// $Σ$: $u^+ = u^-$ and $∂_n u^+ = ε^{-2} ∂_n u^-$. On $Γ_C$: $u ≥ 0$, $ε^{-2} ∂_n u ≥ 0$,
// and their product is 0.

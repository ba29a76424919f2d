#pragma once
// The answers to the exercises of 10_limits, whose page includes this one: to be read after
// predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Take the obstacle away. Which order has |u^epsilon - u^0| now?",
     "2: no end of contact, no jump of the pressure",
     [](const tutorial::Options&, tutorial::Report& report) {
       const ExactSolution limit(paper_sine_load(), 0, false, 15);
       Table curve({"epsilon", "distance"});
       for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4})
         curve.add(
             {epsilon,
              h1_distance(ExactSolution(paper_sine_load(), epsilon, false, 15), limit)});
       report.claim_order(curve, "distance", "epsilon", 1.95, 2.05, "without an obstacle");
     }}};

// ## Answers on paper
//
// **2.** $a^ε(u^ε, u^ε) = (f, u^ε)$, since $v = 0$ gives $≤$ and $v = 2u^ε$ gives $≥$. Drop
// all but the stiff part: $ε^2 ‖p‖^2 = ε^{-2} a_y^-(u^ε, u^ε) ≤ (f, u^ε) ≤ ‖f‖ ‖u^ε‖$. For
// $ε ≤ 1$ also $a^ε(v, v) ≥ ∫ |∇v|^2 ≥ μ ‖v‖^2$ with $μ = π^2 (1 + 1/16)$ (chapter 14), so
// $‖u^ε‖ ≤ ‖f‖/μ$ and $ε ‖p‖ ≤ ‖f‖ μ^{-1/2}$, which is $(50/10.49)^{1/2} = 2.18$ for our
// load. At $ε = 1$ the truth has 0.16. The bound says nothing about $‖p‖$ itself; the run
// shows that it stays finite.
//
// **3.** A function of $K_0$ is a function $z$ on the body, and in the layer its trace, a
// function of $x$ on a depth of 1. So $a_1(u, z) = ∫_{Ω^+} ∇u·∇z + ∫_Σ u' z'$. By parts,
// with $z = 0$ on $Γ_D$ and at the ends of $Σ$,
//
// $$ a_1(u, z) - (f, z) = ∫_{Ω^+} (-Δu - f) z + ∫_Σ (∂_n u - u_{xx}) z. $$
//
// Let $z = w - u$ be any function that is 0 on $Σ$: both signs are allowed, and $-Δu = f$.
// What is left of (2) is $∫_Σ r (w - u) ≥ 0$ for all $w ≥ 0$. Put $w = 0$ and $w = 2u$:
// $∫_Σ r u = 0$. Hence $∫_Σ r w ≥ 0$ for all $w ≥ 0$, and $r ≥ 0$. As $r ≥ 0$ and $u ≥ 0$
// have a product whose integral is 0, $r u = 0$.

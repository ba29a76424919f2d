#pragma once
// The answers to the exercises of 14_estimates, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"In the norm of the energy M = alpha = 1. For P1, what do J(u_h) - J(u) and its order "
     "tell on the two meshes?",
     "the first infimum lies between J(u_h) - J(u) and twice that. On the structured mesh "
     "this falls like h^2. On the "
     "unstructured mesh it tends to 0.0091, what clamping Sigma costs: the locking is in "
     "the first infimum",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Scene scene = tutorial::paper_scene(1e-6);
       const Exact exact(scene);
       Table rows({"mesh", "h", "excess"});
       for (const MeshFamily& family : {structured(), unstructured()})
         for (int n = 4; n <= options.cells; n *= 2) {
           const Space space(family.mesh(n), p1());
           const VariationalInequality problem = assemble(scene, space);
           rows.add({family.name, 1.0 / n,
                     energy(problem, active_set(problem)) - exact.solution.energy()});
         }
       rows.pivot("h", "mesh", "excess").print("J(u_h) - J(u)");
       report.claim_order(rows.filter("mesh", "structured"), "excess", "h", 1.8, 2.1,
                          "structured (observed)");
       // What is left is E / 2 of chapter 06, half the energy that the layer sets free by
       // giving.
       report.claim_within(rows.filter("mesh", "unstructured").last("excess"), 8e-3, 12e-3,
                           "unstructured, finest:");
     }}};

// ## Answers on paper
//
// **2.** Start from $a(v_h - u_h, v_h - u_h) = a(v_h - u, v_h - u_h) + a(u, v_h - u_h) - a(u_h, v_h - u_h)$. The two last
// terms are at most $R(v_h) - R(u_h)$, by the discrete inequality. The first term is at
// most $M ‖u - v_h‖_h ‖v_h - u_h‖_h$. With $s t ≤ α s^2/2 + t^2/(2α)$ for
// $s = ‖v_h - u_h‖_h$ it becomes half of the left side and $M^2 ‖u - v_h‖_h^2/(2α)$.
// Divided by $α/2$ this is $(M/α)^2 ‖u - v_h‖_h^2$: the constant is quadratic. This road
// does not use the energy, and so it gives a symmetric form a larger constant than it
// needs.
//
// **3.** The unknowns of P2 on $Γ_C$ are vertices and midpoints. A parabola that is not
// negative at three points may dip below 0 between two of them, so $K_h ⊄ K$, and the work
// of the pressure on such a dip is negative.

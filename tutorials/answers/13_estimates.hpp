#pragma once
// The answers to the exercises of 13_estimates, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Move the vertices of the structured mesh by up to h/5: nothing cancels any more, slopes are of size h. Where "
     "is the wall?",
     "q tends to 1: half is lost at epsilon ~ h, worse than on the meshes of gmsh",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const MeshFamily jittered{"jittered", [](int cells) { return jittered_mesh(cells, 0.2); }};
       Table lost({"curve", "inverse_epsilon", "x"}),
           rows[]{Table(tutorial::estimate_columns), Table(tutorial::estimate_columns)};
       const std::vector<Case> truth = tutorial::cases();
       for (int n = 8; n <= options.cells; n *= 2)
         for (const bool cr : {false, true})
           rows[cr].add(both_sides({cr ? &crouzeix_raviart() : &p1(), jittered}, n, truth));
       const Table walls = tutorial::walls(rows[false], rows[true], lost);
       walls.print();
       report.claim_within(walls.order("half lost at epsilon", "h"), 0.8, 1.3, "q =");
     }},
    {"In the energy norm M = α = 1. Where does the locking go? (Show J(v) - J(u) = |u - v|^2 / 2 + R(v) first.)",
     "into the first infimum: it is about J(u_h) - J(u), which does not fall for locked P1, and like h^2 otherwise",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Exact exact(tutorial::paper_scene(1e-6));
       Table rows({"mesh", "h", "excess"});
       for (const MeshFamily& family : {structured(), unstructured()})
         for (int n = 8; n <= options.cells; n *= 2) {
           const Discretisation on(family.mesh(n), p1());
           const VariationalInequality problem = assemble(tutorial::paper_scene(1e-6), on.space());
           rows.add({family.name, 1.0 / n, energy(problem, active_set(problem)) - exact.truth.energy()});
         }
       rows.pivot("h", "mesh", "excess").print("J(u_h) - J(u)");
       report.claim_within(rows.where("mesh", "structured").order("excess", "h"), 1.8, 2.2, "structured: order");
       report.claim(rows.where("mesh", "unstructured").least("excess") > 8e-3, "unstructured: it stays");
     }}};

#pragma once
// The answers to the exercises of 15_promises, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Rows of triangles of base h, but half as high and twice as high as those of the "
     "staggered mesh. Where is the "
     "wall?",
     "k = h^2 / (8 H) is h/4 and h/16: half is lost at epsilon = 1.46 h and 0.36 h",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const auto& [rows, k] : {std::pair{64, 1.0 / 4}, {16, 1.0 / 16}}) {
         const MeshFamily family{
             "rows", [rows = rows](int cells) { return rows_mesh(cells, rows); }};
         const double at = kappa * k / 32;
         const Table kept = keep(family, family.mesh(32), 32, {1.4 * at, at, 0.7 * at});
         kept.print();
         report.claim_within(wall(kept) * 32 / (kappa * k), 0.97, 1.03,
                             fmt::format("{} rows: wall / 5.84 k:", rows));
       }
     }}};

// ## Answers on paper
//
// **2.** $ε^{-2} h^{3/4}$ does not fall for $ε ≤ h^{3/8}$: already at $h = 1/32$ that is
// all $ε$ below 0.27. It has the true order, $h$, for $ε = h^{-1/8}$, and this is above 1:
// for no ε of the problem.
//
// **3.** To smaller ε. A longer wave bends less: with $a = π$ the factor
// $a^2/(a \coth a + a^2)^{1/2}$ is 2.73 in the place of 5.84. Short waves lock first, and a
// load with many waves has many walls.

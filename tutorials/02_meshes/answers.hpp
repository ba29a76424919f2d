#pragma once
// The answers to the exercises of 02_meshes, whose page includes this one: to be read after
// predicting.

TriangleMesh with_lines(int n,
                        int lines) {  // jittered inside, but for this many vertical lines
  const TriangleMesh straight = structured_mesh(n);
  TriangleMesh mesh = jittered_mesh(n, 0.1);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    for (int k = 1; k <= lines; ++k)
      if (std::abs(straight.vertices(v, 0) - k / (lines + 1.0)) < 1e-9)
        mesh.vertices.row(v) = straight.vertices.row(v);
  for (int v = 0; v < mesh.vertex_count();
       ++v)  // Sigma and Gamma_C stay as they are but for their own points
    if (straight.vertices(v, 1) == 0 || straight.vertices(v, 1) == -1)
      mesh.vertices.row(v) = straight.vertices.row(v);
  return mesh;
}

const std::vector<tutorial::Exercise> exercises{
    {"All inner vertices of a structured mesh are moved a little, but for those on 3 "
     "vertical lines. Groups? Kernel?",
     "4 groups, one per strip between the lines; exactly 3 kernel functions, one per line",
     [](const tutorial::Options&, tutorial::Report& report) {
       const TriangleMesh mesh = with_lines(16, 3);
       report.claim_within(tied(mesh).count, 4, 4, "groups:");
       report.claim_within(kernel_on_layer(mesh), 3, 3,
                           "dimension of the kernel on the layer:");
     }},
    {"Turn the diagonals of the structured mesh (left), or draw both (crossed). How many "
     "groups?",
     "one per column, as before: diagonals tie within a column, vertical lines part the "
     "columns",
     [](const tutorial::Options& options, tutorial::Report& report) {
       for (const Diagonal diagonal : {Diagonal::left, Diagonal::crossed})
         report.claim_within(tied(structured_mesh(options.cells, {}, diagonal)).count,
                             options.cells, options.cells, "groups:");
     }}};

// ## Answers on paper
//
// **3.** $1$ and $x$: one pair $(a, b)$ is left, and nothing holds it. If the layer alone
// is free at its sides, the answer is 0 again. The corners $(0,0)$ and $(1,0)$ belong to
// the clamped sides of the body, so $a = 0$ and $a + b = 0$.
//
// **4.** One, and its multiples: $a + b x + c x²$ has three numbers, the two ends fix two
// of them, and $x(1 - x)$ is left.

#pragma once
// The answers to the exercises of 02_meshes, whose page includes this one: to be read after predicting.

TriangleMesh with_lines(int n, int lines) {  // jittered inside, but for this many vertical lines
  const TriangleMesh straight = structured_mesh(n);
  TriangleMesh mesh = jittered_mesh(n, 0.1);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    for (int k = 1; k <= lines; ++k)
      if (std::abs(straight.vertices(v, 0) - k / (lines + 1.0)) < 1e-9) mesh.vertices.row(v) = straight.vertices.row(v);
  for (int v = 0; v < mesh.vertex_count(); ++v)  // Sigma and Gamma_C stay as they are but for their own points
    if (straight.vertices(v, 1) == 0 || straight.vertices(v, 1) == -1) mesh.vertices.row(v) = straight.vertices.row(v);
  return mesh;
}

const std::vector<tutorial::Exercise> exercises{
    {"All inner vertices of a structured mesh are moved a little, but for those on 3 vertical lines. Groups? Kernel?",
     "4 groups, one per strip between the lines; exactly 3 kernel functions, one per line",
     [](const tutorial::Options&, tutorial::Report& report) {
       const TriangleMesh mesh = with_lines(16, 3);
       report.claim_within(tutorial::ties(mesh).groups, 4, 4, "groups:");
       report.claim_within(kernel_on_layer(mesh), 3, 3, "dimension of the kernel on the layer:");
     }},
    {"Turn the diagonals of the structured mesh (left), or draw both (crossed). How many groups?",
     "one per column, as before: diagonals tie within a column, vertical lines part the columns",
     [](const tutorial::Options& options, tutorial::Report& report) {
       for (const Diagonal diagonal : {Diagonal::left, Diagonal::crossed})
         report.claim_within(tutorial::ties(structured_mesh(options.cells, {}, diagonal)).groups, options.cells,
                             options.cells, "groups:");
     }}};

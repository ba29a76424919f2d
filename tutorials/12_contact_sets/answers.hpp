#pragma once
// The answers to the exercises of 12_contact_sets, whose page includes this one: to be read
// after predicting.

const auto distances = [](const Method& method, const Reference& v, AdmissibleSet within) {
  Table table({"h", "distance"});
  for (const int n : {8, 16, 32}) {
    const Space space = method.space(n);
    table.add({1.0 / n, best_approximation(space, assemble(tutorial::paper_scene(0), space),
                                           v, within)
                            .distance});
  }
  return table;
};
const std::vector<tutorial::Exercise> exercises{
    {"v = min(x, 1 - x) (1 - y) / 2 is in K and has a kink at x = 1/2. How fast does P1 "
     "approach it, on both meshes?",
     "structured: order 1, the kink is a mesh line; unstructured: 1/2, a strip of area h "
     "is wrong by O(1) in the "
     "slope",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Reference v{
           [](double x, double y) { return std::min(x, 1 - x) * (1 - y) / 2; },
           [](double x, double y) {
             return Eigen::Vector2d(std::copysign((1 - y) / 2, 0.5 - x),
                                    -std::min(x, 1 - x) / 2);
           },
           [](double, double) { return 0.0; }};
       const auto order = [&](const MeshFamily& mesh) {
         return distances({&p1(), mesh}, v, AdmissibleSet::k_h).order("distance", "h");
       };
       report.claim_within(order(structured()), 0.9, 1.1, "structured: order");
       report.claim_within(order(unstructured()), 0.35, 0.65, "unstructured: order");
     }},
    {"Move the vertices of the structured mesh by up to h/10. Does K_0h of P1 approach "
     "K_0?",
     "no: its kernel functions vanish on the layer from the first shift on, so u^0 there "
     "is missed, and the distance "
     "tends to 0.138",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Exact u0(tutorial::paper_scene(0), 15);
       const MeshFamily jittered{"jittered",
                                 [](int cells) { return jittered_mesh(cells, 0.1); }};
       const Table table =
           distances({&p1(), jittered}, u0.reference(), AdmissibleSet::k_0h);
       table.print();
       report.claim_within(table.last("distance") / clamped_distance(u0.solution), 1, 1.15,
                           "distance / that of u^0 from the solution clamped on Sigma");
     }}};

// ## Answers on paper
//
// **3.** Where the values at the ends of an edge differ and the one at its midpoint is low.
// The values 1, 0, 0 at end, midpoint and end give $v = (1 - t)(1 - 2t)$, which is $-1/8$
// at $t = 3/4$. With $a, b ≥ 0$ at the ends and $m ≥ 0$ at the midpoint the parabola dips
// below 0 if and only if $4 m < (a^{1/2} - b^{1/2})^2$. This happens where contact ends.

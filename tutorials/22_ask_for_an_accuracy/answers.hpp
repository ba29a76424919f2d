#pragma once
// The answers to the exercises of 22_ask_for_an_accuracy, whose page includes this one: to
// be read after predicting.

// |2u|, sigma, m are twice as large, C and both energies four times: the same relative bound on the same meshes
void doubled_load(const tutorial::Options&, tutorial::Report& report) {
  const auto ask = [](double factor) {
    const Scene scene({[factor](double x, double y) { return factor * paper_load(x, y); }},
                      StiffLayer{1e-6}, UnilateralContact{});
    return solve_to(scene, unstructured_mesh(8, {0}), {0.05}).history.back();
  };
  const RefinementLevel once = ask(1), twice = ask(2);
  report.claim(once.unknowns == twice.unknowns,
               "{} unknowns for the load, {} for twice the load", once.unknowns,
               twice.unknowns);
  report.claim_within(twice.relative / once.relative - 1, -1e-8, 1e-8,
                      "the relative bounds are the same, up to");
  report.claim_within(twice.bound / once.bound, 2 - 1e-8, 2 + 1e-8,
                      "the bounds themselves: a ratio of");
}

void needle(const tutorial::Options&, tutorial::Report& report) {
  const Profile gap = [](double x) {
    return 0.1 - 0.12 * std::exp(-std::pow((x - 0.75) / 0.004, 2));
  };
  const Scene scene({paper_load}, StiffLayer{1e-6}, UnilateralContact{gap});
  const CertifiedSolution found = solve_to(scene, unstructured_mesh(8, {0}), {0.1});
  const TriangleMesh uniform = layered_mesh(64, 1e-6);
  const double on_uniform =
      tutorial::certified(scene, uniform).relative(Quantity::displacement);
  const int unknowns = Space(uniform, crouzeix_raviart()).free_count();
  report.claim(2 * found.history.back().unknowns <= unknowns,
               "10 % of the needle cost {} unknowns in {} levels",
               found.history.back().unknowns, found.history.size());
  report.claim(on_uniform > 0.2, "{} unknowns of a uniform mesh prove {:.0f} %", unknowns,
               100 * on_uniform);
}

void spike(const tutorial::Options&, tutorial::Report& report) {
  const Field load = [](double x, double y) {
    return paper_load(x, y) +
           20000 *
               std::exp(-(std::pow(x - 0.31, 2) + std::pow(y - 0.62, 2)) / (0.002 * 0.002));
  };
  const TriangleMesh first = unstructured_mesh(8, {0});
  const CertifiedSolution found =
      solve_to(Scene({load}, StiffLayer{1e-6}, UnilateralContact{}), first, {0.2});
  const TriangleMesh layered = extruded(first, 1e-6);
  const int asked_for = Space(layered, crouzeix_raviart()).free_count();
  report.claim(found.history.front().unknowns > asked_for,
               "the first mesh has {} unknowns, not {}: 64 x 64 samples per triangle found "
               "the spike",
               found.history.front().unknowns, asked_for);
  double least = 1;
  for (int t = 0; t < found.result.space.mesh().triangle_count(); ++t)
    least = std::min(least, found.result.space.mesh().area(t));
  report.claim(found.result.warning.empty() && least < 0.002 * 0.002,
               "no warning is left, and the smallest triangle has the area {:.1e}", least);
}

const std::vector<tutorial::Exercise> exercises{
    {"The load is doubled. How many unknowns does an accuracy of 5 % cost now?",
     "As many: flux, companion and bound are doubled, and what is relative stays.",
     doubled_load},
    {"The obstacle is a needle of width 0.004. What do 10 % cost, adapted and on a uniform "
     "mesh?",
     "A uniform mesh with some 14,400 unknowns proves 29 %. Adapted, some 4,900, a third "
     "of them, prove 10 %.",
     needle},
    {"A spike of the load lies between the points of the first mesh's quadrature. Is it "
     "seen?",
     "This one is: 64 x 64 samples per triangle, about 0.002 apart, find it before the "
     "first level, and the mesh is "
     "refined around it. A much narrower one may lie between the samples, too.",
     spike}};

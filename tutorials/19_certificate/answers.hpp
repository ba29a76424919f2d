#pragma once
// The answers to the exercises of 19_certificate, whose page includes this one: to be read
// after predicting.

// u and p are multiplied by 1.01: r grows from lambda to lambda + 0.01 A u, so that r1 =
// 0.01 A u on the free edges off Gamma_C, and rho = 0.01 |u|_a up to what the clamped and
// touching edges take.
void scaled_solution(const tutorial::Options&, tutorial::Report& report) {
  const Exact exact(paper_scene(1e-2), 14);
  tutorial::Solved run(paper_scene(exact.epsilon), unstructured_mesh(32));
  const Certificate before = run.certified();
  run.solution.u *= 1.01;
  run.solution.p *= 1.01;
  const Certificate after = run.certified();
  const double error = exact.errors(run.space, run.solution).energy;
  report.claim(after.gradient >= error,
               "the bound {:.4f} of the wrong answer is not below its error {:.4f}",
               after.gradient, error);
  report.claim_within(after.algebraic_residual_norm / before.norm, 0.009, 0.011,
                      "rho / |v|_a:");
  // with 1.01 f for f the bound were 1.01 times as large: so it grows by rho and a
  // hundredth of itself at most
  report.claim_within((after.gradient - before.gradient) / after.algebraic_residual_norm, 1,
                      1 + 0.01 * before.gradient / after.algebraic_residual_norm,
                      "the bound grows, in parts of rho, by");
}

void other_gap(const tutorial::Options&, tutorial::Report& report) {
  const Scene scene({paper_load}, StiffLayer{1e-6},
                    UnilateralContact{[](double x) { return 0.02 * x * (1 - x); }});
  const Certificate coarse = tutorial::Solved(scene, unstructured_mesh(16)).certified(),
                    fine = tutorial::Solved(scene, unstructured_mesh(32)).certified();
  const auto width = [](const Certificate& c) { return c.energy_upper - c.energy_lower; };
  report.claim(
      coarse.energy_lower <= fine.energy_upper && fine.energy_lower <= coarse.energy_upper,
      "the brackets [{:.5f}, {:.5f}] and [{:.5f}, {:.5f}] have energies in common",
      coarse.energy_lower, coarse.energy_upper, fine.energy_lower, fine.energy_upper);
  report.claim_within(width(coarse) / width(fine), 3.6, 4.4,
                      "half the mesh width, a quarter of the bracket's width:");
}

// v must lie in K: a parabola that is 0 at a vertex and at a midpoint dips below between
// them.
void parabola(const tutorial::Options&, tutorial::Report& report) {
  const Space space(unstructured_mesh(8), p2());
  const Solution solution = active_set(assemble(paper_scene(1e-2), space));
  double lowest = 0;
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = space.mesh().triangle_edges(t, i);
      if (space.mesh().edge_tag[e] != EdgeTag::contact) continue;
      for (int k = 1; k < 32; ++k) {
        Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
        lambda((i + 1) % 3) = k / 32.0;
        lambda((i + 2) % 3) = 1 - k / 32.0;
        lowest = std::min(lowest, space.element().basis(lambda).dot(
                                      solution.u(space.cell_dofs().row(t))));
      }
    }
  report.claim(lowest < 0,
               "P2 is nowhere negative at its unknowns on Gamma_C, and {:.1e} between "
               "them: not in K",
               lowest);
}

const std::vector<tutorial::Exercise> exercises{
    {"u_h and p are multiplied by 1.01. Is the bound still one, and by how much does it "
     "grow?",
     "It is. Off Gamma_C r1 is 0.01 of the forces of u_h and p, so rho is about 0.01 "
     "|u_h|_a, and the bound grows by "
     "rho and a hundredth of itself at most.",
     scaled_solution},
    {"The gap is 0.02 x (1 - x), a problem without an exact solution here. Do the brackets "
     "of two meshes agree?",
     "They overlap, since both hold J(u), and half the mesh width makes the bracket four "
     "times narrower.",
     other_gap},
    {"Why may P2 not take the place of P1 in the upper bound?",
     "Between two unknowns that are not negative a parabola may be negative: P2's solution "
     "does not lie in K.",
     parabola}};

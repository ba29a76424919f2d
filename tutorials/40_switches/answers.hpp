#pragma once
// The answers to the exercises of 40_switches, whose page includes this one: to be read
// after predicting.

/// Returns the share of the largest displacement on Gamma_C that is kept at an epsilon.
double share_kept(const VariationalInequality& problem, const Space& space,
                  double epsilon) {
  static const std::vector<Exact> exact = tutorial::exact_solutions({1e-3}, 14);
  Sweep sweep(problem);
  sweep.set_compliance(epsilon * epsilon);
  return sweep.solve().u(space.contact_dofs()).maxCoeff() /
         exact.front().solution.max_on_contact();
}

const std::vector<tutorial::Exercise> exercises{
    {"Stabilise the layer with its own modulus: add 1/epsilon^2 times the energy of the "
     "hourglass part across the layer. What becomes of locking on the jittered mesh at "
     "epsilon = 1e-3?",
     "it is back: the one-point form and the form of the hourglass part together are full "
     "integration",
     [](const tutorial::Options&, tutorial::Report& report) {
       constexpr double epsilon = 1e-3;
       const Scene scene = tutorial::paper_scene(1);
       const auto kept = [&](const Switch& of, double across) {
         const Space space(family_mesh("jittered", 16), *of.element);
         return share_kept(assemble(scene, space, of, across), space, epsilon);
       };
       const double weak = kept(stabilised, 0);
       const double strong = kept(stabilised, 1 / (epsilon * epsilon));
       const double all = kept(full, 0);
       fmt::print(
           "kept: {:.4f} with the weak form, {:.4f} with the strong one, {:.4f} "
           "with full integration\n",
           weak, strong, all);
       report.claim(
           strong < 0.1 * weak && std::abs(strong / all - 1) < 1e-3,
           "the strong form keeps {:.4f} times as much as full integration (proved: "
           "1)",
           strong / all);
     }},
    {"The rotated element of four functions, without S T, with means over cells: "
     "rotated_q1(). How many functions without strain has it, does it lock, and does it "
     "converge on the jittered meshes?",
     "one per cell, and it does not lock. But it fails the patch test, and its error falls "
     "more slowly from mesh to mesh",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Switch four{"four functions", &rotated_q1(), true};
       const std::vector<Exact> exact = tutorial::exact_solutions({1, 1e-3, 0}, 14);
       Table rows({"n", "kernel", "cells", "patch", "kept", "four", "five"});
       for (const int n : {8, 16, 32}) {
         const Space space(family_mesh("jittered", n), *four.element);
         const VariationalInequality problem =
             assemble(tutorial::paper_scene(1), space, four);
         const Table runs = solve_all(four, "jittered", n, exact);
         rows.add({n, layer_kernel_dimension(problem),
                   tutorial::layer_counts(space.mesh()).cells,
                   tutorial::patch_test(space, problem), runs.last("kept"), runs.max("h1"),
                   solve_all(rotated_means, "jittered", n, exact).max("h1")});
       }
       rows.print("worst H1 error with four and with five functions", 3);
       report.claim(rows.numbers("kernel") == rows.numbers("cells"),
                    "one function without strain per cell (proved)");
       report.claim(rows.min("patch") > 1e-3, "the patch test fails: {:.2g} and more",
                    rows.min("patch"));
       report.claim(rows.min("kept") > 0.9, "kept at epsilon = 0: {:.3f} and more",
                    rows.min("kept"));
       const std::vector<double> orders = rows.pairwise_orders("four", "n");
       report.claim(-orders.back() < 0.7 && -orders.back() < -orders.front(),
                    "the order of its error is {:.2f} and then {:.2f} (observed)",
                    -orders.front(), -orders.back());
     }}};

// ## Answers on paper
//
// **3.** $E_Σ = E_C = n$ and $E_D = 2 m$, so at least $½ (2 n - 2 m) - 1 = n - m - 1$ on
// any mesh. That they come near $K_0$ is another question: (ii) of chapter 28 asks for it.

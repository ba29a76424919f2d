#pragma once
// The answers to the exercises of 37_nitsche, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Take gamma_0 = 1 and theta = 1, and let the program check its own bound. What does "
     "it say?",
     "it refuses: gamma is epsilon^-2/h, and the bound on this mesh is 2 epsilon^-2/h. "
     "With gamma_0 = 2.1 it does not",
     [](const tutorial::Options&, tutorial::Report& report) {
       const NitscheProblem columns =
           tutorial::nitsche_problem(tutorial::paper_scene(1e-3), columns_of(32));
       const auto refusal = [&](double gamma_0) -> std::string {
         try {
           tutorial::check_monotone(columns, Choice{"", gamma_0, 1, true}.method(1e-3, 32));
         } catch (const NotConverged& reason) {
           return reason.what();
         }
         return "";
       };
       fmt::print("{}\n", refusal(1));
       report.claim(!refusal(1).empty() && refusal(2.1).empty(),
                    "gamma_0 = 1 is refused, and 2.1 is not");
     }},
    {"theta = 0 and gamma_0 = 1 with the right scale: is it above its bound, and how large "
     "is the error?",
     "yes, the bound is gamma_0 > 1/2, and the error is that of P1",
     [](const tutorial::Options&, tutorial::Report& report) {
       const tutorial::Exact exact(tutorial::paper_scene(1e-3), 14);
       const Space space = columns_of(32);
       const NitscheProblem columns = tutorial::nitsche_problem(exact.scene, space);
       const Nitsche method = Choice{"", 1, 0, true}.method(1e-3, 32);
       tutorial::check_monotone(columns, method);
       report.claim_within(
           on_contact(space, tutorial::solve_nitsche(columns, method).u, exact).error /
               on_contact(space, active_set(columns.problem).u, exact).error,
           0.9, 1.1, "error over that of the active set:");
     }}};

// ## Answers on paper
//
// **3.** Both triangles at a vertical edge have the same slope, and one of them has an edge
// on $Γ_C$. So $∫_E λ_d^2$ is compared with the stiff form of both, and $|T|$ becomes
// $2 |T| = h^2$: $γ > \frac{(1 + θ)^2}{4}\, ε^{-2}/h$, or $γ_0 > 1$ for θ = 1. This is
// sharp: at $γ_0 = 1$ the lowest row loses its stiffness. The program checks the bound for
// any mesh.
//
// **4.** The same as for P1. The slope is constant on the triangle, the derivation does not
// use that $v$ is continuous, and the bracket is the share of $T$ in the stiff form of
// (29). The two triangles at a vertical edge may have different slopes, so the argument of
// 3 does not apply.
//
// **5.** The derivative of $½ [x]_+^2$ is $[x]_+$. In the direction $v$ the last integral
// changes by
// $\frac{1}{γ} ∫ ([λ(u) - γ u]_+ (λ(v) - γ v) - λ(u) λ(v))$, which are the terms on $Γ_C$
// with θ = 1.

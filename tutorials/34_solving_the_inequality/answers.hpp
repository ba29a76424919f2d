#pragma once
// The answers to the exercises of 34_solving_the_inequality, whose page includes this one:
// to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Proximal Galerkin of the library at epsilon = 0, P1 on columns, 1/h = 16, with alpha "
     "= 1 "
     "in every step: how many proximal steps in place of those with alpha = 2^k?",
     "at least twice as many: near the end of contact, where the force is small, exp(psi) "
     "falls by a constant factor per step, and not by the square of the last one",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space space(structured_mesh(16), p1());
       const VariationalInequality problem = assemble(tutorial::paper_scene(0), space);
       const std::size_t doubled = proximal_galerkin(problem).history.size();
       ProximalGalerkinOptions options;
       options.step_length = [](int) { return 1.0; };
       options.max_proximal_steps = 10000;
       const std::size_t constant = proximal_galerkin(problem, options).history.size();
       report.claim(constant >= 2 * doubled, "{} proximal steps in place of {}", constant,
                    doubled);
     }},
    {"The augmented Lagrangian at epsilon = 0, P1 on columns, 1/h = 32: multiply r by 100. "
     "What happens to the outer "
     "steps, and to the inner ones of the first outer step?",
     "there are fewer outer steps, since each divides the error by at least 1 + r times "
     "the smallest eigenvalue of F; "
     "the first outer step becomes the whole active set iteration",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space space(structured_mesh(32), p1());
       const OnContact p = tutorial::condense(assemble(tutorial::paper_scene(0), space));
       const double r = 10 / p.f.diagonal().mean();
       const Found soft = augmented_lagrangian(p, r),
                   hard = augmented_lagrangian(p, 100 * r);
       report.claim(hard.outer < soft.outer, "outer steps: {} in place of {}", hard.outer,
                    soft.outer);
       report.claim(hard.steps <= soft.steps, "linear systems in all: {} in place of {}",
                    hard.steps, soft.steps);
     }},
    {"Uzawa at epsilon = 0, P1 on columns, 1/h = 32, with twice the step, beyond 2 / "
     "sigma_max. Does it diverge?",
     "no: it takes half as many steps. Where nothing touches lambda is 0, so that the "
     "compliance of the touching points alone counts, once they are known. Its largest "
     "eigenvalue is smaller",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Space space(structured_mesh(32), p1());
       const OnContact p = tutorial::condense(assemble(tutorial::paper_scene(0), space));
       const int safe = uzawa_on_contact(p, false).steps,
                 bold = uzawa_on_contact(p, false, 2).steps;
       report.claim_within(static_cast<double>(safe) / bold, 1.9, 2.1,
                           "steps saved, a factor");
       const std::vector<int> set =
           tutorial::members(semismooth_newton(p, std::vector<bool>(p.w.size())).active);
       const double all = symmetric_eigenvalues(p.f).maxCoeff(),
                    touching = symmetric_eigenvalues(p.f(set, set)).maxCoeff();
       report.claim(touching < all / 2,
                    "the largest eigenvalue of the touching points is {:.2f} of that of "
                    "all: once these are known, steps up to {:.1f} times as long are safe",
                    touching / all, all / touching);
     }}};

// ## Answers on paper
//
// **3.** Once the points that touch are known, their block of $F$ alone decides which steps
// are safe. For the string of chapter 00 its largest eigenvalue is about $1/(k² h)$, where
// $k$ is the smallest solution of $\tan(k(1 - c)) = -k c$, and contact starts at $c$. This
// is $k = 2π$, since $\tan 2πc = 2πc$. So steps below $8π² h$ are safe then, and for all
// points only those below $2π² h$. From $λ = 0$ on the longer ones are not safe, because
// the points are not known yet. On 32 cells $ρ = 4π² h$ takes less than half as many steps
// as $ρ = 1.9π² h$. With $ρ = 5π² h$ Uzawa's method does not end within 20,000 steps: it
// swings between too little contact and too much (measured).
//
// **4.** Step $k$ minimises $α_k J(v) + D_h(v, u_{k-1})$. At the minimum
// $α_k J'(u_k)(v - u_k) = ∑ h (ψ_{k-1} - ψ_k)_i (v - u_k)_i$ for every $v$. Put in $D_h$
// and see that the right side is $D_h(v, u_k) + D_h(u_k, u_{k-1}) - D_h(v, u_{k-1})$
// (the *three points identity*). With $v = u$ and $J(u) - J(u_k) ≥ J'(u_k)(u - u_k)$ this
// gives $α_k (J(u_k) - J(u)) ≤ D_h(u, u_{k-1}) - D_h(u, u_k)$, since
// $D_h(u_k, u_{k-1}) ≥ 0$. Add all steps: the right sides telescope to at most
// $D_h(u, u_0)$. And $J(u_k)$ does not grow, because $v = u_{k-1}$ is a candidate of step
// $k$. So the sum is at least $(α_1 + ... + α_k)(J(u_k) - J(u))$.
//
// **5.** If $F = 0$, a force moves nothing, and $s = w = 0$ at every point. So the active
// set method meets no wrong sign, and ends after one guess. The gradient in Uzawa's method
// is 0. Both answers are right for the discrete problem: its only admissible function is 0.

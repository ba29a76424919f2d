#pragma once
// The answers to the exercises of 00_string_on_an_obstacle, whose page includes this one:
// to be read after predicting. For 3: where the string is free $λ = 0$, so only the
// compliance of the touching nodes counts. Its largest eigenvalue is about $1/(k² h)$,
// where $k$ is the smallest solution of $\tan(k(1 - c)) = -k c$. This is $k = 2π$, since
// $\tan 2πc = 2πc$. Once the contact set is right, a step is safe below 2 / largest
// eigenvalue, $2k² h = 8π² h$.

std::vector<tutorial::Exercise> exercises() {
  const auto solve = [](const String& s) {
    std::vector<VectorXd> guesses;
    return active_set_by_hand(s, guesses);
  };
  return {{"Double the load. What happens to u, to the forces, to the contact set?",
           "u and the forces double, the set stays: K is a cone, and with u it holds 2 u",
           [=](const tutorial::Options& options, tutorial::Report& report) {
             const Result once = solve(hang(options.cells)),
                          twice = solve(hang(options.cells, 20));
             report.claim_within((twice.u - 2 * once.u).norm() / once.u.norm(), 0, 1e-13,
                                 "u(2 f) - 2 u(f), relative:");
             report.claim(
                 (twice.lambda.array() > 0).matrix() == (once.lambda.array() > 0).matrix(),
                 "same contact set");
           }},
          {"Lower the floor to -0.05. Where does contact start? Does it reach x = 1?",
           "later, at c with sin z - z cos z = -0.05/alpha, z = 2 pi c; and it ends before "
           "x = 1, where the string is held",
           [=](const tutorial::Options& options, tutorial::Report& report) {
             const String s = hang(options.cells, 10, -0.05);
             const Result low = solve(s);
             report.claim_within(
                 tutorial::contact_starts(low.lambda) - tutorial::touches_from(0.05), -s.h,
                 s.h, "start - c:");
             report.claim(low.lambda(low.lambda.size() - 1) == 0, "the last node is free");
           }},
          {"Uzawa with rho = 4 pi^2 h, twice the safe step. Does it diverge?",
           "no: it needs half as many. Once the contact set is right, steps up to 8 pi^2 h "
           "are safe. From lambda = 0 they "
           "are not: with 5 pi^2 h it swings between no contact and too much (measured)",
           [](const tutorial::Options& options, tutorial::Report& report) {
             const String s = hang(options.cells);
             const int safe = uzawa_by_hand(s, 1.9 * pi * pi * s.h, 1e-10).solves;
             const int bold = uzawa_by_hand(s, 4 * pi * pi * s.h, 1e-10).solves;
             report.claim_within(static_cast<double>(safe) / bold, 4 / 1.9 * 0.9,
                                 4 / 1.9 * 1.1, "steps saved, a factor");
           }}};
}

// ## Answers on paper
//
// **4.** $v = 0$ gives $a(u, u) ≤ L(u)$, and $v = 2u$ gives $a(u, u) ≥ L(u)$. In exercise 2
// the string touches at $u = -d$, $d = 0.05$, and $2u = -2d$ is below the floor: it is
// forbidden. From $v = 0$ the inequality $a(u, u) ≤ L(u)$ is left. What is missing is the
// work of the floor: each $λ_i (u_i + d) = 0$, so
// $a(u, u) = L(u) + λ^T u = L(u) - d ∑ λ_i$. With 32 cells: $0.8860 = 0.9514 - 0.0654$.

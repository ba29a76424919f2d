#pragma once
// The answers to the exercises of 00_string_on_an_obstacle, whose page includes this one:
// to be read after predicting. For 3: let the floor be the line $-d + m x$. Where contact
// starts the string is on it, and has its slope: $U(c) = -d + m c$ and $U'(c) = m$, with
// $U(x) = α \sin 2πx + s x$ as on the page. So $U(c) - c U'(c) = -d$. With $z = 2πc$ this
// is $α (\sin z - z \cos z) = -d$, and it contains neither $m$ nor $s$.

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
          {"Tilt the floor of exercise 2: -0.05 at x = 0 still, 0 at x = 1. Where does "
           "contact start now, and does it reach x = 1?",
           "where it starts for the flat floor of exercise 2: only the height of the line "
           "at x = 0 counts. It reaches x = 1, where the floor ends at the height 0 of the "
           "string",
           [=](const tutorial::Options& options, tutorial::Report& report) {
             String s = hang(options.cells, 10, -0.05);
             const double flat = tutorial::contact_starts(solve(s).lambda);
             for (int i = 0; i < s.floor.size(); ++i)
               s.floor(i) = -0.05 * (1 - (i + 1) * s.h);
             const Result tilted = solve(s);
             report.claim(tutorial::contact_starts(tilted.lambda) == flat,
                          "contact starts at the same node, {:.4f}", flat);
             report.claim(tilted.lambda(tilted.lambda.size() - 1) > 0,
                          "the last node touches");
           }}};
}

// ## Answers on paper
//
// **4.** $v = 0$ gives $a(u, u) ≤ L(u)$, and $v = 2u$ gives $a(u, u) ≥ L(u)$. In exercise 2
// the string touches at $u = -d$, $d = 0.05$, and $2u = -2d$ is below the floor: it is
// forbidden. From $v = 0$ the inequality $a(u, u) ≤ L(u)$ is left. What is missing is the
// work of the floor: each $λ_i (u_i + d) = 0$, so
// $a(u, u) = L(u) + λ^T u = L(u) - d ∑ λ_i$. With 32 cells: $0.8860 = 0.9514 - 0.0654$.

#pragma once
// The answers to the exercises of 28_mixed, whose page includes this one: to be read after
// predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Boxes of side h/2, h, 2h, 4h: which side is best? Is smaller always better?",
     "no: most boxes of side h/2 hold one triangle or none, and P1 locks as before. From "
     "side h on it does not lock on "
     "these meshes, and the error grows with the side. For side h this is an observation: "
     "n^2 conditions on some "
     "1.15 n^2 unknowns, and no proof of (ii) is known to us",
     [](const tutorial::Options&, tutorial::Report& report) {
       const std::vector<Exact> exact = tutorial::exact_solutions({1, 1e-2, 1e-4, 0}, 14);
       Table errors({"side / h", "h", "worst"});
       for (const double side : {0.5, 1.0, 2.0, 4.0})
         for (const int n : {8, 16, 32}) {
           const Means own = [=](auto& mesh, auto& strain, double h) {
             return box_projection(mesh, strain, side * h, side * h);
           };
           errors.add({side, 1.0 / n, measure({"", any, own, 0.5}, n, exact).max("h1")});
         }
       errors.pivot("side / h", "h", "worst").print("the largest error over epsilon, by h");
       const auto worst = [&](double side) {
         return errors.filter("side / h", side).filter("h", 1.0 / 16).number("worst");
       };
       report.claim(worst(0.5) > 1.2 * worst(1),
                    "1/h = 16: side h/2 locks: {:.3f}, against {:.3f} with side h",
                    worst(0.5), worst(1));
       report.claim(worst(1) < worst(2) && worst(2) < worst(4),
                    "then the error grows: {:.3f}, {:.3f}, {:.3f}", worst(1), worst(2),
                    worst(4));
       report.claim_within(errors.filter("side / h", 1).order("worst", "h"), 0.9, 1.1,
                           "side h: order");
     }}};

// ## Answers on paper
//
// **2.** The mean of $∂_y v$ over a column of width $h$ and height 1 is the mean over $h$
// of $d(x) = v(x, 0) - v(x, -1)$. So $a_{0h}(v, v) → ∫ d^2 dx$, and the columns solve the
// problem with the form $a_1 + ½ a_0 + (ε^{-2} - ½) ∫ d^2$. In its limit $v$ is equal on Σ
// and on $Γ_C$, and in between it bulges as half of $a_0$ allows.
//
// **3.** By parts the slope is $-π ∫ v \sin πx \cos πy$. It is largest for
// $v = g(y) \sin πx$ on the layer, with $-g'' + κ^2 g$ a multiple of $\cos πy$,
// $κ^2 = π^2 + 1$ (the norm of $H^1$, with $\sin πx$ put in). $\cos πy$ is odd about
// $y = -½$. So is $g$, and $g(0) = g(-1)$ then makes both 0: the body stays at rest. The
// solution is $g = (\cos πy - \sinh κ(y + ½) / \sinh(κ/2)) / (π^2 + κ^2)$, and the square
// of the slope is $\frac{π^2}{2} ∫ g \cos πy$, that is
// $\frac{π^2}{2} (½ - 2κ \coth(κ/2) / (π^2 + κ^2)) / (π^2 + κ^2) = 0.194^2$.

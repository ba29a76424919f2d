#pragma once
// The answers to the exercises of 35_interior_penalty, whose page includes this one: to be
// read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Whole jump, staggered mesh, epsilon = 0, 1/h = 32: replace gamma = 3 by 6. How much "
     "of the "
     "ridge is kept?",
     "about half as much: the layer follows a + b x, and the penalty at its two ends, like "
     "gamma/h, is all that holds it",
     [](const tutorial::Options&, tutorial::Report& report) {
       const TriangleMesh mesh = mesh_family("staggered").mesh(32);
       const auto kept = [&](double gamma) {
         gamma_of_run = gamma;
         return share_kept(whole_jump, mesh, 0, height(0));
       };
       const double three = kept(3), six = kept(6);
       report.claim_within(six / three, 0.4, 0.6,
                           "kept with gamma = 6 / kept with gamma = 3:");
     }},
    {"Whole jump on the structured mesh at epsilon = 1e-6: does it lock?",
     "no: each column between two vertical lines is a group, with two functions a + b x of "
     "its own",
     [](const tutorial::Options&, tutorial::Report& report) {
       report.claim_within(
           share_kept(whole_jump, mesh_family("structured").mesh(32), 1e-6, height(1e-6)),
           0.97, 1.03, "share that is kept:");
     }}};

// ## Answers on paper
//
// **3.** A triangle at a side has the vertical edge $h$ and the area $h^2/4$, so its
// penalty is $η |E| = 3 γ h^2/(h^2/4) = 12 γ$ times the square of the mean. There are
// $n = 1/h$ of them on each side: $12 γ/h$ in all. A function $b(½ - x)$ has the means
// $±b/2$, and costs $½ · 2 · (12 γ/h) · b^2/4 = 3 γ b^2/h$. The load does the work $F b$
// with a fixed $F$, so $b = F h/(6 γ)$. It would be of the height of the ridge for γ like
// $h$, far below 1, where the form is not positive. Also, a straight line is no ridge.
//
// **4.** No. The change removes the restriction on γ, because the terms with the stress
// cancel for $u = v$. The stiff form with $v = u$ is then $∑_T |T| (∂_y u)^2$ and the
// penalty, which vanish together for $a + b x$ on each group again.

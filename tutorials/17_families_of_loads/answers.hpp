#pragma once
// The answers to the exercises of 17_families_of_loads, whose page includes this one: to be
// read after predicting.
#include <numbers>

using std::numbers::pi;

const std::vector<tutorial::Exercise> exercises{
    {"epsilon = 0, the unstructured mesh of 1/h = 8, the load sin(pi x): does P2 look free "
     "of locking? And on the "
     "ball?",
     "under this load yes: x (1 - x) is near its ridge, and its error is a fifth of that "
     "of P1 in columns. On the ball "
     "no: it contains sin(2 pi x), of whose ridge P2 keeps nothing",
     [](const tutorial::Options&, tutorial::Report& report) {
       Ball quadratic({&p2(), unstructured()}, 8), columns({&p1(), structured()}, 8);
       const double one = quadratic.ours(0, 1), two = quadratic.ours(0, 2);
       report.claim(one < columns.ours(0, 1), "sin(pi x): P2 {:.4f}, P1 structured {:.4f}",
                    one, columns.ours(0, 1));
       // constant in y, this load has the share (int psi_2) / |psi_2| of the worst one
       const double share = std::tanh(pi) / (2 * pi) / std::sqrt(1 / (4 * pi));
       report.claim(two > share * loss_of_wave(2),
                    "sin(2 pi x): P2 {:.4f}, at least {:.4f}", two,
                    share * loss_of_wave(2));
       report.claim(quadratic.worst(0).error > 3 * one, "the ball: P2 {:.4f}",
                    quadratic.worst(0).error);
     }},
    {"A smaller ball: sixteen waves in place of 2/h = 48 at 1/h = 24. Does the worst error "
     "of locked P1 fall? Of P1 in "
     "columns?",
     "neither by more than what is proved for waves beyond W: 1/(W pi)^2 in the square. "
     "The worst load of locked P1 is "
     "one arch; that of P1 in columns has waves, but long ones do nearly as much harm",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const Method& method : {all_methods[0], all_methods[1]}) {
         const Space space = method.space(24);
         std::vector<double> sup;
         for (const int waves : {16, 48}) {
           ErrorForm form(space, LoadModes(waves));
           form.set_epsilon(0);
           sup.push_back(form.worst().error);
         }
         report.claim(sup[1] < std::hypot(sup[0], 1 / (16 * pi)) && sup[1] > 0.999 * sup[0],
                      "{}: {:.4f} with 16 waves, {:.4f} with 48", method.name(), sup[0],
                      sup[1]);
       }
     }}};

// ## Answers on paper
//
// **3.** Stretch the layer: $y = ε η$, so that an integral over the thin layer is ε times
// one over the unit layer. By Cauchy and Schwarz the work is at most
// $(∫ g^2)^{1/2} (∫ v^2)^{1/2} = ‖g‖ ε^{1/2} ‖v‖$, the first integral over the thin layer
// and the second norm over the unit layer. So the work of a load of norm 1 on the layer
// vanishes with ε. This is why the ball holds loads of the body alone.
//
// **4.** On the body the error is $(S - S_h) f$. $S - S_h$ is symmetric, and
// $(f, (S - S_h) f) = |u - u_h|_a^2 ≥ 0$. The norm of such a map is its largest eigenvalue.
// So the largest $L^2(Ω^+)$ error is $E_h^2$, the square of the worst energy error: without
// locking it has order 2, and P1 that locks keeps $ℓ_1^2 = 0.012$.

#pragma once
// The answers to the exercises of 04_reference_solution, whose page includes this one: to
// be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Turn the load to -10 sin(pi x). Where does the body touch? How far does the ridge "
     "rise? How far off is P1?",
     "everywhere; not at all: u is 0 on the layer, and the body is that of a clamped lower "
     "side. The error falls like "
     "h^2, as before",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Scene scene(Body{SineLoad{{{1, {-10}}}}}, StiffLayer{1e-6},
                         UnilateralContact{});
       const tutorial::Exact exact(scene);
       report.claim(exact.contact_from() < 1e-4, "contact begins at {:.0e}",
                    exact.contact_from());
       report.claim(exact.solution.max_on_contact() < 1e-12, "the ridge rises to {:.0e}",
                    exact.solution.max_on_contact());
       Table errors({"h", "error"});
       for (const int n : {8, 16, 32, 64}) {
         const Result found = solve(scene, n);
         errors.add({1.0 / n, exact.errors(found.space, found.solution).max_at_unknowns});
       }
       report.claim_order(errors, "error", "h", 1.9, 2.1, "P1");
     }},
    {"How far does epsilon = 0.1 let half waves see a string: for which k has s_k lost "
     "half of T + a^2?",
     "from k = 6 on: there kappa = epsilon a is 1.9, and tanh(kappa) / kappa about 1/2",
     [](const tutorial::Options&, tutorial::Report& report) {
       int k = 1;
       while (symbol(k, 0.1) > 0.5 * symbol(k, 0)) ++k;
       report.claim_within(k, 6, 6, "half is lost from k =");
     }}};

// ## Answers on paper
//
// **3.** Without a load the body's equation is $u_k'' = a^2 u_k$, $u_k(1) = 0$:
// $u_k = w \sinh(a(1 - y))/\sinh a$. Its slope at $y = 0$ is $-a w \coth a$. At $ε = 1$,
// $z = κ = a$, and with $t = \tanh a$
//
// $$ s_k = a \frac{a/t + a t}{a + a} = \frac{a}{2} (t + 1/t) = a \coth 2a. $$
//
// Body and layer of one stuff are one body of the depth 2, held on top: the same formula,
// with 2 in place of 1.

#pragma once
// The answers to the exercises of 31_hp, whose page includes this one: to be read after
// predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Equal cells with one mesh line through the end of contact, no layers, P4. Which of "
     "the two orders 3/2 does that "
     "cure?",
     "that of epsilon = 0: the jump of w'' then lies on a mesh line, and what is left is "
     "r^2 log r in the body, which "
     "has "
     "order 2 in H1. Not that of epsilon = 1: r^(3/2) now begins at a corner of the cells, "
     "but it is still no "
     "polynomial, "
     "and the order on Gamma_C stays 3/2",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const auto& [epsilon, norm, low, high] :
            {std::tuple{1.0, "contact", 1.25, 1.75}, {0.0, "h1", 1.75, 2.5}}) {
         const Exact exact(tutorial::paper_scene(epsilon));
         Table rows(hp_columns);
         for (const int n : {16, 32})
           rows.add(solve("P4", {4, n, 0}, exact.contact_from(), exact));
         rows.select({"epsilon", "h", "unknowns", "h1", "contact"}).print();
         report.claim_within(rows.order(norm, "h"), low, high,
                             fmt::format("epsilon = {:g}, {}: order", epsilon, norm));
       }
     }},
    {"The end of contact is known to d only. Layers toward the wrong place, P6, epsilon = "
     "1: how does the error on "
     "Gamma_C depend on d?",
     "at most like d^(3/2), 0.06 to 0.63 times it by where the end lies in its cell: the "
     "cell that holds the end is "
     "about d wide, and an error there is that of a mesh with h = d. The "
     "chapter's levels need no better: each finds the end within its smallest cells",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Exact exact(tutorial::paper_scene(1));
       Table rows({"d", "contact", "multiple of d^(3/2)"});
       for (const double d : {0.1, 0.08, 0.05, 0.03, 0.02, 0.015, 0.01, 0.005})
         for (const double side : {d, -d}) {
           const double error =
               solve("P6", hp.back(), exact.contact_from() + side, exact).number("contact");
           rows.add({side, error, error / std::pow(d, 1.5)});
         }
       rows.print();
       // where the end lies in its cell decides from d to d: the envelope has the order
       report.claim_within(rows.max("multiple of d^(3/2)"), 0.35, 1.3,
                           "the error is at most this multiple of d^(3/2):");
       const Table near =
           rows.filter_number("d", [](double d) { return std::abs(d) <= 0.01; });
       report.claim_within(near.max("multiple of d^(3/2)"), 0.2, 0.8, "and for d <= 0.01:");
     }},
    {"Degrees 1 to 6 on 8 layers, then P6 on 0 to 6 layers, epsilon = 1. Does hp's error "
     "follow degree or layers?",
     "in H1 the degree: with 8 layers from the start it is the same. On Gamma_C the first "
     "four layers take factors "
     "of 4.5 to 12 from the error of P6; a fifth and a sixth change nothing",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Exact exact(tutorial::paper_scene(1));
       std::vector<Grading> degrees, layers;
       for (int p = 1; p <= 6; ++p) degrees.push_back({p, 3, 8});
       for (int n = 0; n <= 6; ++n) layers.push_back({6, 3, n});
       const Table both = climb("hp", hp, exact),
                   degree = climb("8 layers", degrees, exact),
                   layer = climb("P6", layers, exact);
       for (const Table* rows : {&both, &degree, &layer})
         rows->select({"series", "degree", "unknowns", "h1", "contact"}).print();
       double apart = 0;
       for (int p = 1; p <= 6; ++p) {
         const double ratio = both.filter("degree", p).number("h1") /
                              degree.filter("degree", p).number("h1");
         apart = std::max(apart, std::abs(ratio - 1));
       }
       report.claim(apart < 0.02,
                    "hp and the degrees on 8 layers: H1 errors differ by {:.2g} % at most",
                    100 * apart);
       const std::vector<double> on_contact = layer.numbers("contact");
       // q^(-3/2) = 8, on average over four layers
       report.claim_within(std::pow(on_contact[0] / on_contact[4], 0.25), 6, 10,
                           "P6 on Gamma_C: error per layer");
       report.claim_within(on_contact[6] / on_contact[4], 0.9, 1.1,
                           "P6 on Gamma_C: six layers over four");
     }}};

// ## Answers on paper
//
// **4.** A polynomial of degree $p$ on an interval resolves lengths of about $1/p$ inside
// it and $1/p^2$ near its ends, as the zeros of Chebyshev's polynomials show, which are
// that close to each other there. So near a vertex degree $p$ does what a mesh of width
// $h ∼ 1/p^2$ does, and $h^{3/2}$ becomes $p^{-3}$.

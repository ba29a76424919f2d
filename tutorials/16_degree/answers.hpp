#pragma once
// The answers to the exercises of 16_degree, whose page includes this one: to be read after
// predicting.

const std::vector<tutorial::Exercise> exercises{
    {"A coarse unstructured mesh (1/h = 4) and epsilon = 1e-4: P1 and P2 both lock under "
     "sin(2 pi x). And under 10 "
     "sin(pi x)?",
     "P1 loses all, P2 keeps nearly all: its one kernel function x (1 - x) is near the "
     "ridge. The load sin(2 pi x) is "
     "odd about x = 1/2 and x (1 - x) is even: this load does no work on it, and P2 loses "
     "all",
     [](const tutorial::Options&, tutorial::Report& report) {
       const SineLoad one_hump{{{1, {10}}}};
       for (const auto& [load, name, low, high] :
            {std::tuple{paper_sine_load(), "sin(2 pi x)", 0.0, 0.1},
             {one_hump, "sin(pi x)", 0.9, 1.1}}) {
         const Exact exact(Scene(Body{load}, StiffLayer{1e-4}, UnilateralContact{}), 15);
         for (const Element* element : {&p1(), &p2()}) {
           const Table row = solve({element, unstructured()}, 4, 1e-4, load, exact);
           const bool p1_used = element == &p1();
           report.claim_within(
               row.number("kept"), p1_used ? 0 : low, p1_used ? 0.1 : high,
               element->name() + " under " + name + ": share of the ridge that is kept");
         }
       }
     }}};

// ## Answers on paper
//
// **2.** Vertical mesh lines at three inner $x$, and anything between them without a
// vertical edge. A kernel function of P1 is affine between two lines, may bend at each of
// them, and is 0 at both ends: one hat per line.

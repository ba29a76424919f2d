#pragma once
// The answers to the exercises of 11_propositions, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Locked P1 along epsilon = h in place of h^2: does its error still stay?",
     "no, it falls; the second term stays, so the third stays too: the two differences "
     "nearly cancel, "
     "but (18) adds their norms",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Exact limit(tutorial::paper_scene(0), 15);
       const Table terms =
           three_terms({&p1(), unstructured()}, path(1, options.cells, limit), limit);
       const auto of = [&](const char* term) { return terms.filter("term", term); };
       terms.pivot("h", "term", "value").print();
       report.claim(of("left side").order("value", "h") > 0.5, "the error falls");
       report.claim(of("third term").last("value") > 0.5 * of("second term").last("value"),
                    "the third term stays");
     }}};

// ## Answers on paper
//
// **2.** $p_h^ε$ tends to the stress $p_h^0$ of the discrete limit, the finite force that
// holds the layer at 0. So $‖p_h^ε‖ → ‖p_h^0‖$ and $ε ‖p_h^ε‖ → 0$, as without locking.
// Only the number is large: this force does not keep the layer straight, it keeps it from
// moving.

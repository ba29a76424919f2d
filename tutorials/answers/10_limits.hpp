#pragma once
// The answers to the exercises of 10_limits, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Locked P1 along epsilon = h in place of h^2: does its error still stay?",
     "no, it falls; the second term stays, so the third stays too: two large terms nearly cancel",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Table terms = three_terms({&p1(), unstructured()}, 1, options.cells, Exact(0, 15));
       const auto of = [&](const char* term) { return terms.where("term", term); };
       terms.pivot("h", "term", "value").print();
       report.claim(of("left side").order("value", "h") > 0.5, "the error falls");
       report.claim(of("third term").last("value") > 0.5 * of("second term").last("value"), "the third term stays");
     }},
    {"Take the obstacle away. Which order has |u^epsilon - u^0| now?", "2: no end of contact, no jump of the pressure",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Truth limit(paper_sine_load(), 0, false, 15);
       Table curve({"epsilon", "distance"});
       for (const double epsilon : {1e-2, 1e-3, 1e-4})
         curve.add({epsilon, h1_distance(Truth(paper_sine_load(), epsilon, false, 15), limit)});
       report.claim_within(curve.order("distance", "epsilon"), 1.95, 2.05, "order");
     }}};

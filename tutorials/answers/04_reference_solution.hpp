#pragma once
// The answers to the exercises of 04_reference_solution, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"At epsilon = 1, 1/h = 64: what do two further digits cost, from 1e-8 to 1e-10, and from 1e-10 to 1e-12?",
     "both times the same number of steps, (kappa / 2) ln(100)",
     [](const tutorial::Options&, tutorial::Report& report) {
       const int first = uzawa_steps(1, 64, 1e-8), second = uzawa_steps(1, 64, 1e-10),
                 third = uzawa_steps(1, 64, 1e-12);
       fmt::print("  {} steps to 1e-8, {} more to 1e-10, {} more to 1e-12\n", first, second - first, third - second);
       report.claim_within(static_cast<double>(third - second) / (second - first), 0.9, 1.1, "second price / first:");
     }},
    {"At epsilon = 1, 1/h = 32 the steps are known. How many at 1/h = 64? And at epsilon = 1e-6?",
     "twice as many; and a little less than four times as many",
     [](const tutorial::Options&, tutorial::Report& report) {
       const auto grown = [](double epsilon) {
         return static_cast<double>(uzawa_steps(epsilon, 64, 1e-12)) / uzawa_steps(epsilon, 32, 1e-12);
       };
       report.claim_within(grown(1), 1.7, 2.4, "factor at epsilon = 1:");
       report.claim_within(grown(1e-6), 3, 4, "factor at epsilon = 1e-6:");
     }}};

#pragma once
// The answers to the exercises of 28_your_own_problem, whose page includes this one: to be read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Give both strings n cells. Does the glue at every point still lock?",
     "no: the corners coincide, the n - 1 inner values are free, and the energy is the truth's up to q^2 h^2 / 24",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const VariationalInequality problem = make_problem({options.cells, 0}, Glue::pointwise, 0);
       const double truth = load * load * std::pow(free_part, 3) / 3 - load * gap, n = options.cells;
       report.claim(kernel_dimension(problem) == options.cells - 1, "kernel {}", kernel_dimension(problem));
       report.claim_within(energy(problem, active_set(problem)) - truth, 0, load * load / (24 * n * n),
                           "energy - truth");
     }}};

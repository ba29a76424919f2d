#pragma once
// The answers to the exercises of 33_your_own_problem, whose page includes this one: to be
// read after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Give both strings n cells. Does the glue at every point still lock?",
     "no: the corners coincide, the n - 1 inner values are free, and the energy is the "
     "truth's up to q^2 h^2 c / 24, "
     "what P1 misses",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const VariationalInequality problem =
           make_problem({options.cells, 0}, Glue::pointwise, 0);
       const double exact = load * load * std::pow(free_part, 3) / 3 - load * gap,
                    n = options.cells;
       report.claim(kernel_dimension(problem) == options.cells - 1, "kernel {}",
                    kernel_dimension(problem));
       const double missed = load * load * free_part / (24 * n * n);
       report.claim_within((energy(problem, active_set(problem)) - exact) / missed, 0.5,
                           1.5, "energy - truth, over what P1 misses");
     }},
    {"Give both strings that only touch n cells. Is the pressure between them smooth?",
     "yes: it is q/2 where the strings are above the floor and q where they lie on it, to "
     "round-off, but for the "
     "corners "
     "beside c1 and c2",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const Strings strings{options.cells, 0};
       const Solution solution = active_set(touching(strings));
       const double c1 = std::sqrt(2 * distance / load),
                    c2 = std::sqrt(c1 * c1 + 4 * distance / load);
       const double h = 1.0 / options.cells;
       double worst = 0;
       for (int i = 1; i < options.cells; ++i) {
         const double x = std::min(strings.corner(i), 1 - strings.corner(i));
         if (std::abs(x - c1) <= 1.5 * h || std::abs(x - c2) <= 1.5 * h) continue;
         const double exact = x < c1 ? 0 : x < c2 ? load / 2 : load;
         worst =
             std::max(worst, std::abs(solution.lambda(options.cells - 2 + i) / h - exact));
       }
       report.claim(worst < 1e-9 * load,
                    "pressure between the strings off by {:.1e} at most", worst);
     }}};

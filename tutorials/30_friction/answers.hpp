#pragma once
// The answers to the exercises of 30_friction, whose page includes this one: to be read
// after predicting.

const std::vector<tutorial::Exercise> exercises{
    {"Coulomb: g = F N with N of the answer before, F = 1/4, from N without friction. By "
     "how much does a step reduce "
     "the "
     "change of N?",
     "by a factor of 10 or more: N hardly depends on the friction, and F is small",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Rubber cr = tutorial::structured_rubbers(32).at(
           2);  // its unknowns of u_x and u_y share their places
       const Space x(cr.mesh, cr.in_x), y(x, cr.in_y);
       Sweep sweep(pressed(
           cr, {x, y}, [](double) { return 0; }, 1e-8));
       const auto count = static_cast<Eigen::Index>(y.contact_dofs().size());
       Eigen::VectorXd normal = sweep.solve().lambda.head(count),
                       bound = sweep.problem().bounds.force_limit;
       std::vector<double> changes;
       while (changes.size() < 6) {
         bound.tail(count) = 0.25 * normal;
         sweep.set_force_limit(bound);
         const Solution solution = sweep.solve();
         changes.push_back(
             (solution.lambda.head(count) - normal).lpNorm<Eigen::Infinity>());
         normal = solution.lambda.head(count);
       }
       double slowest = 0;
       for (std::size_t k = 1; k < changes.size() && changes[k] > 1e-13; ++k)
         slowest = std::max(slowest, changes[k] / changes[k - 1]);
       report.claim(slowest < 0.1,
                    "changes of N at a point: {:.1e}, {:.1e}, {:.1e}; the slowest step "
                    "leaves {:.3f}",
                    changes[0], changes[1], changes[2], slowest);
     }},
    {"A bar of stiffness 1 on a floor with g = 1 is pulled by 1/2 at x = 1. How far does "
     "it slip, and by how much does "
     "its end move?",
     "it slips on (1/2, 1), where friction balances the whole pull, by (x - 1/2)^2 / 2: "
     "its end moves by 1/8",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const int n = options.cells;
       const VariationalInequality bar = bar_on_a_floor(n, 0.5);
       const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(n + 1, 0, 1);
       const Eigen::VectorXd exact = 0.5 * (x - 0.5).max(0).square();
       for (const Solution& s : {active_set(bar), uzawa(bar)})
         report.claim_within((s.u - exact).lpNorm<Eigen::Infinity>(), 0,
                             0.125 / (n * n) + 1e-9,
                             fmt::format("{}: end moves by {:.6f}; error, at most h^2/8",
                                         s.solver, s.u(n)));
     }}};

// ## Answers on paper
//
// **3.** Where the rubber sticks, $u_x = 0$ is a constraint and $T$ is its multiplier: it
// is found. Where it slips $T = ±g$ is a load that is given, and $u_x$ is found. The
// unknown of the problem is which of the two holds where.

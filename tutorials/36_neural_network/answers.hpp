#pragma once
// The answers to the exercises of 36_neural_network, whose page includes this one: to be
// read after predicting.

/// Returns the shares of ridge and energy that 15 draws of 50 features have if the layer
/// has its true depth in the coordinates of the features. The problem is then that of the
/// true layer, and no derivative is stiff.
Table in_true_coordinate(double epsilon) {
  Table rows({"ridge", "energy"});
  for (int seed = 1; seed <= 15; ++seed) {
    const Modes modes = ritz(draw(50, false, seed), 20, epsilon);
    const Share kept = share(modes, 1, without_obstacle(epsilon));
    rows.add({kept.ridge, kept.energy});
  }
  return rows;
}

/// Claims that each row has nearly all of the energy, and the ridge. A rigid layer leaves
/// 0.97 of the energy, so the energy alone does not show a ridge.
void claim_no_locking(const Table& rows, double least_energy, double epsilon,
                      tutorial::Report& report) {
  report.claim(rows.min("energy") > least_energy && rows.max("energy") < 1 + 1e-6,
               "epsilon = {}: more than {} of the energy in each run", epsilon,
               least_energy);
  report.claim(rows.min("ridge") > 0.8 && rows.max("ridge") < 1.2,
               "epsilon = {}: 0.8 to 1.2 of the ridge in each run", epsilon);
}

const std::vector<tutorial::Exercise> exercises{
    {"Give the features the coordinate of the true layer, epsilon y in place of y. How "
     "much of energy and ridge does a network with random weights have?",
     "nearly all, whatever epsilon is: the slope of each feature across the layer is "
     "epsilon times as large. Divided by epsilon it stays bounded, and each feature tends "
     "to a column",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const double epsilon : {1e-2, 1e-3, 1e-4})
         claim_no_locking(in_true_coordinate(epsilon), 0.9, epsilon, report);
     }},
    {"Train in this coordinate. How much of the energy is there after 1000 steps at "
     "epsilon = 1e-4?",
     "more than 0.98, as at epsilon = 0.1: nothing is multiplied by epsilon^-2, and so the "
     "number of steps does not grow as epsilon falls",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const double epsilon : {1e-1, 1e-4}) {
         Table rows(training_columns);
         for (int seed = 1; seed <= seeds; ++seed)
           rows.add(train(epsilon, seed, {1000}, true));
         claim_no_locking(rows, 0.98, epsilon, report);
       }
     }},
    {"Train at epsilon = 1e-4 for 10000 steps, ten times as many. Does one seed find "
     "columns "
     "now?",
     "no: it has most of the energy then, but its weights across are as large as before, "
     "and "
     "it still has less energy than a rigid layer leaves",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Table row = train(1e-4, 1, {10000}, false);
       report.claim_within(row.number("energy"), 0.5, energy_without_ridge(1e-4),
                           "share of the energy");
       report.claim(row.number("across") > 0.15,
                    "half of its weights across are above 0.15");
     }}};

// ## Answers on paper
//
// **4.** As a function of a complex $y$, $\cosh^{-2}(w_j y + b_j)$ has its poles where
// $w_j y + b_j = iπ/2 + iπm$ with an integer $m$. The two that are nearest to the real axis
// are $y = -b_j/w_j ± iπ/(2 w_j)$. Take a sum that is 0, and among its terms with $a_j ≠ 0$
// one with the largest $|w_j|$. No term with a smaller $|w|$ has a pole as near to the real
// axis. Terms with the same $|w|$ have their poles at other real parts, because
// $b_i/w_i ≠ b_j/w_j$ by assumption. So this pole is not cancelled, and the sum is not 0: a
// contradiction.

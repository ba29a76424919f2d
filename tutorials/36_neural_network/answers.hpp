#pragma once
// The answers to the exercises of 36_neural_network, whose page includes this one: to be
// read after predicting.

/// Returns the share of the energy that each of 15 draws of 50 features has where the
/// features see the layer with its true depth. The problem is then that of the true layer,
/// and no derivative is stiff.
std::vector<double> energies_in_true_coordinate(double epsilon) {
  std::vector<double> energies;
  for (int seed = 1; seed <= 15; ++seed) {
    const Modes modes = ritz(draw(50, false, seed), 20, epsilon);
    energies.push_back(share(modes, 1, without_obstacle(epsilon)).energy);
  }
  return energies;
}

const std::vector<tutorial::Exercise> exercises{
    {"Give the features the coordinate of the true layer, epsilon y in place of y. How "
     "much of the energy does a network with random weights have?",
     "nearly all, whatever epsilon is: the slope of each feature across the layer is "
     "epsilon times as large. Divided by epsilon it stays bounded, and each feature tends "
     "to a column",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const double epsilon : {1e-2, 1e-3, 1e-4}) {
         const std::vector<double> energies = energies_in_true_coordinate(epsilon);
         const double least = *std::min_element(energies.begin(), energies.end());
         report.claim(least > 0.9, "epsilon {}: each draw has more than 0.9", epsilon);
       }
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
         report.claim(rows.min("energy") > 0.98 && rows.max("energy") < 1 + 1e-6,
                      "epsilon = {}: each seed has at least 0.98 of the energy", epsilon);
       }
     }}};

// ## Answers on paper
//
// **3.** As a function of a complex $y$, $\cosh^{-2}(w_j y + b_j)$ has its poles where
// $w_j y + b_j = iπ/2 + iπm$ with an integer $m$. The two that are nearest to the real axis
// are $y = -b_j/w_j ± iπ/(2 w_j)$. Take a sum that is 0, and among its terms with $a_j ≠ 0$
// one with the largest $|w_j|$. No term with a smaller $|w|$ has a pole as near to the real
// axis. Terms with the same $|w|$ have their poles at other real parts, because
// $b_i/w_i ≠ b_j/w_j$ by assumption. So this pole is not cancelled, and the sum is not 0: a
// contradiction.

#pragma once
// The answers to the exercises of 20_order_h, whose page includes this one: to be read
// after predicting.
#include "antilock/exact/exact_solution_data.hpp"

// The integral over the layer's rows of a sum over its waves k pi: Gauss's rule on cells
// that shrink toward both ends.
double over_layer(const ExactSolution& exact,
                  const std::function<double(const SineRow&, Eigen::Index)>& term) {
  const auto [points, weights] = gauss_rule(5);
  double sum = 0;
  for (int cell = 0; cell < 14; ++cell) {
    const double to = std::ldexp(0.5, -cell), from = cell == 13 ? 0 : to / 2;
    for (Eigen::Index q = 0; q < points.size(); ++q)
      for (const double y :
           {-from - (to - from) * points(q), from - 1 + (to - from) * points(q)}) {
        const SineRow row = layer_row(exact.data(), y);
        for (Eigen::Index k = 1; k < row.u.size(); ++k)
          sum += (to - from) * weights(q) * term(row, k) / 2;
      }
  }
  return sum;
}

const std::vector<tutorial::Exercise> exercises{
    {"Make the rows half as high. By which factors do S^- of CR and rho = k/epsilon of P1 "
     "grow, at the same h and "
     "epsilon?",
     "k doubles, so rho does; S^- goes like k^(3/4) and grows by about 2^(3/4) = 1.68",
     [](const tutorial::Options& options, tutorial::Report& report) {
       const std::vector<Exact> exact = tutorial::exact_solutions({0}, 14);
       for (int n = 16; n <= options.cells; n *= 2) {
         double layer[2] = {0, 0};
         for (const int flatter : {1, 2}) {
           const int rows = flatter * static_cast<int>(std::lround(2 * n / std::sqrt(3)));
           const Space space(rows_mesh(n, rows), crouzeix_raviart());
           SceneSweep sweep(exact[0].scene, space);
           layer[flatter - 1] =
               tutorial::take_apart(exact[0], {space, sweep.problem(), sweep.solve()})
                   .layer;
         }
         report.claim_within(layer[1] / layer[0], 1.5, 1.9,
                             fmt::format("S^- at half the height, 1/h = {}: times", n));
       }
     }},
    {"Rows again, under the load 10 sin(pi x), which lifts the layer off everywhere. Which "
     "order has S^- now, and why?",
     "order 1: without contact nothing jumps. As f is 0 on the sides, d/dx p is bounded "
     "for every epsilon by the norms "
     "of f and d/dx f",
     [](const tutorial::Options& options, tutorial::Report& report) {
       std::vector<Exact> exact;
       exact.emplace_back(
           Scene(Body{SineLoad{{{1, {10.0}}}}}, StiffLayer{0}, UnilateralContact{}), 10);
       Table layers(columns);
       for (int n = 8; n <= options.cells; n *= 2) layers.add(solve_both("rows", n, exact));
       report.claim_order(layers, "layer", "h", 0.85, 1.05, "S^- in rows without contact");
     }},
    {"Order 3/4 on any mesh rests on five bounds with one number N (Theorem D of "
     "uniform_rate). Is N for our load "
     "nearer "
     "to 1, to 10 or to 1000, and does it grow as epsilon tends to 0?",
     "nearest to 10: 6.5 is enough at every epsilon and t tried. The largest is the slope "
     "of p on Sigma: 3.5 at "
     "epsilon = 1, 6.2 at 0.1, 6.4 from 0.01 down to 0",
     [](const tutorial::Options&, tutorial::Report& report) {
       Table bounds(
           {"epsilon", "t", "lambda P_t u", "u_x and p", "P_t p", "p at Sigma", "d/dx p"});
       for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 0.0})
         for (const double t : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
           const ExactSolution u(paper_sine_load(), epsilon, true, 14);
           const ExactSolution::Data& modes = u.data();
           const auto cooled = [&](const SineRow& row, Eigen::Index k) {
             return std::exp(-std::pow(row.a(k), 2) * t);
           };
           double work = 0, at_sigma = 0;
           for (Eigen::Index k = 1; k <= modes.modes(); ++k) {
             const double a = std::numbers::pi * static_cast<double>(k);
             work -=
                 0.5 * std::exp(-a * a * t) * modes.stress_gamma_c(k) * modes.on_gamma_c(k);
             at_sigma += 0.5 * std::pow(a * modes.stress_sigma(k), 2);
           }
           const double slope = over_layer(u, [&](const SineRow& row, Eigen::Index k) {
             return std::pow((1 - cooled(row, k)) * row.a(k) * row.u(k), 2);
           });
           const double stress = over_layer(u, [&](const SineRow& row, Eigen::Index k) {
             return std::pow((1 - cooled(row, k)) * row.p(k), 2);
           });
           const double smoothed = over_layer(u, [&](const SineRow& row, Eigen::Index k) {
             return std::pow(cooled(row, k) * row.a(k) * row.p(k), 2);
           });
           bounds.add({epsilon, t, std::sqrt(work / std::pow(t, 1.5)),
                       (std::sqrt(slope) + epsilon * std::sqrt(stress)) / std::pow(t, 0.75),
                       std::pow(t, 0.25) * std::sqrt(smoothed), std::sqrt(at_sigma),
                       std::sqrt(epsilon * regularity(u).stress_x)});
         }
       bounds.print("the smallest N of each bound", 3);
       for (const std::string name :
            {"lambda P_t u", "u_x and p", "P_t p", "p at Sigma", "d/dx p"})
         report.claim(bounds.max(name) <= 6.5, "{}: N = {:.2f} is enough", name,
                      bounds.max(name));
       report.claim(bounds.filter("epsilon", 0).max("p at Sigma") <
                        1.1 * bounds.filter("epsilon", 0.1).max("p at Sigma"),
                    "it does not grow below epsilon = 0.1");
     }}};

// ## Answers on paper
//
// **4.** Only for $P_t u ∈ K$. With a gap this asks for $P_t u ≥ -g$. From $u ≥ -g$ follows
// $P_t u ≥ -P_t g$, since heat keeps an order between two functions. So $P_t g ≤ g$ is
// enough. It holds for each concave $g ≥ 0$, which only cools.

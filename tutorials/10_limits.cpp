// Theorem 1, Propositions 1 and 5: the limit epsilon -> 0, exact and discrete, with its orders; the
// limit problem (25).
//
// Run: 10_limits   1/h = 32, epsilon from 1 to 1e-4; a few seconds
// Run: 10_limits --cells 64
//
// --epsilon is not asked for here: it runs to 0.
//
// Two limits. The exact one: u^epsilon -> u^0 (Theorem 1, Proposition 5). And the discrete one, for
// every fixed h and every method: u_h^epsilon -> u_h^0 (Proposition 1). P1 on an unstructured mesh
// converges as well as the others, to a u_h^0 that is 0 on the layer. So locking is not in these
// limits; it is in u_h^0 being nowhere near u^0 (the second part of Proposition 2 does not apply,
// since K_0h does not approach K_0).
//
// The theorems give no order in epsilon. Two are seen here. At fixed h every u_h^epsilon is, once
// its contact set has settled, a rational function of epsilon^2: order 2, from epsilon about h on
// (where P1 locks from about h^(3/2) on, which 1e-4 does not show on meshes finer than 1/32). The
// exact limit is slower. The thickness of the layer changes wave k of u by the factor (epsilon k)^2
// up to k = 1/epsilon, and the jump of the contact pressure at the end of contact leaves u_k of
// size k^-3, so
//
//     ||u^epsilon - u^0||_1^2 = sum_k k^-4 min(1, (epsilon k)^4) = O(epsilon^3),   order 3/2.
//
// A mesh carries no waves beyond 1/h: that is where its order changes. The proof of Theorem 1 uses
// a0(u, u) <= C epsilon_c, epsilon_c = epsilon^2 the parameter of the class, so |d/dy u| <= C
// epsilon; measured is order 2, since d/dy u = epsilon^2 p with a bounded p.
//
// The limit lives on the body alone: u^0 solves the problem of Ventcel and Signorini (25),
//
//     -Delta u = f,   u >= 0,  r = d_n u - u_xx >= 0,  u r = 0  on Sigma
//
// (n the body's outward normal, d_n = -d/dy): a string on Sigma, pulled by the body, over an
// obstacle. It is checked in this strong form, by the series; and u_h^0 of P1 on the structured
// mesh *is* the discrete solution of (25).
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <cmath>

#include "antilock/exact/truth_distance.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::Exact;

std::vector<double> epsilons();  // 1, 10^-1/2, ..., 1e-4

// 1. Proposition 1 for one method: u_h^0 is (7), solved on the same mesh at epsilon = 0, not at a
// small epsilon. `strain` is the L2 norm of d/dy u = epsilon^2 p in the layer, `to_limit` is
// ||u_h^0 - u^0||_h.
Table discrete_limit(const Method& method, int cells, const Exact& exact_limit) {
  const Discretisation on = method.on(cells);
  SceneSweep sweep(tutorial::paper_scene(0), on.space());
  const Solution limit = sweep.solve();
  const double to_limit = exact_limit.errors(on.space(), limit).h1;
  const Reference nothing{[](double, double) { return 0.0; },
                          [](double, double) { return Eigen::Vector2d::Zero().eval(); },
                          [](double, double) { return 0.0; }};
  Table table({"method", "epsilon", "distance", "strain", "to_limit"});
  for (const double epsilon : epsilons()) {
    sweep.set_epsilon(epsilon);
    Solution solution = sweep.solve();
    const double stress = std::sqrt(solution.p.dot(sweep.problem().m.cwiseProduct(solution.p)));
    solution.u -= limit.u;
    table.add({method.name(), epsilon, measure_errors(on.space(), solution, epsilon, nothing).h1,
               epsilon * epsilon * stress, to_limit});
  }
  return table;
}

Table strong_form(const Truth& limit, int points);
double laplace_residual(const Truth& limit);
double against_ventcel(int cells);
void judge(const Table& curves, int cells, tutorial::Report& report);
void judge_strong_form(const Table& sigma, const Exact& limit, int cells, tutorial::Report& report);

void limits(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("exact solutions");
  const Exact limit(0, 15);
  Table curves({"method", "epsilon", "distance", "strain", "to_limit"});
  for (const double epsilon : epsilons())
    curves.add({"exact", epsilon, h1_distance(Truth(paper_sine_load(), epsilon, true, 15), limit.truth), 0, 0});
  report.stage("(25) in its strong form, by series");
  const Table sigma = strong_form(limit.truth, 400);
  report.stage(fmt::format("discrete solutions, four methods at 1/h = {}", options.cells));
  for (const Method& method : methods()) curves.add(discrete_limit(method, options.cells, limit));
  report.finish();
  curves.pivot("epsilon", "method", "distance").print("distance to the limit, H1");
  curves.select({"method", "epsilon", "distance"}).write(options.out / "limits.csv");
  sigma.write(options.out / "sigma.csv");
  judge(curves, options.cells, report);
  judge_strong_form(sigma, limit, options.cells, report);
}

void judge(const Table& curves, int cells, tutorial::Report& report) {
  // the slope that a curve settles to: over the last four epsilons, 10^-2.5 to 1e-4
  const Table small = curves.where_number("epsilon", [](double epsilon) { return epsilon < 4e-3; });
  report.claim_within(small.where("method", "exact").order("distance", "epsilon"), 1.35, 1.65,
                      "Theorem 1, Proposition 5: u^epsilon tends to u^0 with order (3/2: the pressure jumps)");
  for (const Method& method : methods()) {
    const Table own = small.where("method", method.name());
    const bool locks = method.name() == "P1 unstructured";
    const double room = locks || cells > 32 ? 0.2 : 0.05;  // order 2 begins at epsilon = h
    const double order = own.order("distance", "epsilon"), strain = own.order("strain", "epsilon");
    if (locks && cells > 32)
      report.not_judged("Proposition 1, P1 unstructured: on meshes finer than 1/32 its order has not settled at 1e-4");
    else
      report.claim(std::abs(order - 2) < room && std::abs(strain - 2) < room,
                   "Proposition 1, {}: order {:.2f}, and {:.2f} of d/dy u; the limit is {:.3f} from u^0", method.name(),
                   order, strain, own.first("to_limit"));
    if (locks)
      report.claim(own.first("to_limit") > 0.1, "P1 unstructured converges to a limit that is not near u^0: locked");
  }
}

void judge_strong_form(const Table& sigma, const Exact& limit, int cells, tutorial::Report& report) {
  // Away from the end of contact, where u_xx jumps and its series rings. 1e-6 and 1e-5 of r, the
  // largest of which is 1.5: what the sum of 2^15 waves leaves.
  const double end = limit.contact_from();
  const Table away = sigma.where_number("x", [&](double x) { return std::abs(x - end) > 0.005; });
  const Table free = away.where_number("x", [&](double x) { return x < end; });
  double product = 0, pressure = 0;
  for (const Table& point : away.rows()) {
    product = std::max(product, std::abs(point.number("u") * point.number("r")));
    pressure = std::max(pressure, std::abs(point.number("r") - point.number("pressure")));
  }
  report.claim(sigma.least("u") > -1e-9 && sigma.least("r") > -1e-6 && product < 1e-7,
               "(25) on Sigma: u >= {:.0e}, r >= {:.0e} (largest {:.2f}), |u r| <= {:.0e}", sigma.least("u"),
               sigma.least("r"), sigma.most("r"), product);
  const double largest = std::max(free.most("r"), -free.least("r"));
  report.claim(largest < 1e-6 && pressure < 1e-5,
               "(25): |r| <= {:.0e} where u > 0; r is the contact pressure to {:.0e}", largest, pressure);
  // values are good to 8e-9, differences over 5e-3 divide them by 2.5e-5
  const double laplace = laplace_residual(limit.truth), ventcel = against_ventcel(cells);
  report.claim(laplace < 5e-3, "(25): -Delta u = f in the body to {:.0e} (differences)", laplace);
  report.claim(ventcel < 1e-9, "Remark 5, discrete: u_h^0 of P1 structured is that of (25), to {:.0e}", ventcel);
}

// Three things to try:
// - --cells 128: the discrete curves follow the exact one of order 3/2 further before they turn to
//   order 2.
// - another load in Truth and Body, without contact (Truth(..., false)): order 2 for the exact one,
//   too.
// - plot u and r of sigma.csv: where one is positive, the other is 0.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 8;
  options.most_cells = 256;
  return tutorial::run(argc, argv, "10_limits", "Theorem 1, Propositions 1 and 5: the limit epsilon -> 0", options,
                       limits);
}

std::vector<double> epsilons() {
  std::vector<double> list;
  for (int k = 0; k <= 8; ++k) list.push_back(std::pow(10.0, -0.5 * k));
  return list;
}

// (25) in its strong form on Sigma, and the exact contact pressure.
Table strong_form(const Truth& limit, int points) {
  Table table({"x", "u", "r", "pressure"});
  for (int j = 0; j <= points; ++j) {
    const double x = static_cast<double>(j) / points;
    table.add({x, limit.value(x, 0), -limit.gradient(x, 0).y() - limit.d_xx(x, 0), limit.pressure(x)});
  }
  return table;
}

// -Delta u - f in the body by differences of values alone, largest over 3 x 3 points.
double laplace_residual(const Truth& limit) {
  constexpr double h = 5e-3;
  double largest = 0;
  for (const double x : {0.2, 0.5, 0.8})
    for (const double y : {0.2, 0.5, 0.8}) {
      const double around =
          limit.value(x - h, y) + limit.value(x + h, y) + limit.value(x, y - h) + limit.value(x, y + h);
      largest = std::max(largest, std::abs((4 * limit.value(x, y) - around) / (h * h) - paper_load(x, y)));
    }
  return largest;
}

// u_h^0 on the two squares against the discrete (25) on the body alone, P1 structured: largest
// difference.
double against_ventcel(int cells) {
  const Discretisation both(structured_mesh(cells), p1()), body(structured_mesh(cells, Domain{0}), p1());
  const Scene ventcel(Body{paper_load}, VentcelLayer{}, UnilateralContact{});
  const Eigen::VectorXd u0 = active_set(assemble(tutorial::paper_scene(0), both.space())).u;
  const Eigen::VectorXd u = active_set(assemble(ventcel, body.space())).u;
  return (u0.tail(u.size()) - u).cwiseAbs().maxCoeff();  // the body's rows come last
}

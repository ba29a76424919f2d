// Theorem 1, Propositions 1 and 5: the limit epsilon -> 0, exact and discrete, with its orders; the limit problem (25).
//
// Run: 12_limits                     1/h = 32, epsilon from 1 to 1e-4; a few seconds
// Run: 12_limits --cells 64
//
// --epsilon is not asked for here: it runs to 0.
//
// Three limits. u^epsilon -> u^0 (Theorem 1, Proposition 5), and for every fixed h and every method u_h^epsilon ->
// u_h^0 (Proposition 1): P1 on an unstructured mesh converges as well as the others, to u_h^0 = 0 on the layer. So
// locking is not in this limit; it is in u_h^0 being nowhere near u^0 (Proposition 2.2 does not apply, since K_0h does
// not approach K_0).
//
// The theorems give no order in epsilon. Two are seen here. At fixed h every u_h^epsilon is, once its contact set has
// settled, a rational function of epsilon^2: order 2, from epsilon about h on (where P1 locks from
// about h^(3/2) on, which 1e-4 does not show on meshes finer than 1/32). The exact one is slower: wave k of u
// feels the layer's thickness by (epsilon k)^2 up to k = 1/epsilon, and the jump of the contact pressure at the end of
// contact leaves u_k of size k^-3, so
//
//     ||u^epsilon - u^0||_1^2 = sum_k k^-4 min(1, (epsilon k)^4) = O(epsilon^3),   order 3/2.
//
// A mesh sees no waves beyond 1/h: that is where its order changes. The proof of Theorem 1 uses a0(u, u) <= C
// epsilon_c, epsilon_c = epsilon^2 the parameter of the class, so |d/dy u| <= C epsilon; d/dy u = epsilon^2 p is of
// order 2.
//
// The limit lives on the body alone: u^0 solves the problem of Ventcel and Signorini (25),
//
//     -Delta u = f,   u >= 0,  r = d_n u - u_xx >= 0,  u r = 0  on Sigma
//
// (n the body's outward normal, d_n = -d/dy): a string on Sigma, pulled by the body, over an obstacle. It is checked
// in this strong form, by the series; and u_h^0 of P1 on the structured mesh *is* the discrete solution of (25).
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <array>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_distance.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/study/sweep.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

std::vector<double> epsilons() {
  std::vector<double> list;
  for (int k = 0; k <= 8; ++k) list.push_back(std::pow(10.0, -0.5 * k));
  return list;
}

// One curve: the distance to the limit, and the slope it settles to: over the last four epsilons, 10^-2.5 to 1e-4.
struct Curve {
  std::string name;
  std::vector<double> distance, strain;  // strain: the L2 norm of d/dy u in the layer (discrete curves alone)
  double limit_error = 0;                // ||u_h^0 - u^0||_h

  double order() const { return slope(last(epsilons()), last(distance)); }
  double strain_order() const { return slope(last(epsilons()), last(strain)); }
  static std::vector<double> last(const std::vector<double>& v) { return {v.end() - 4, v.end()}; }
};

Curve exact_limit(const Truth& limit) {
  Curve curve{"exact", {}, {}};
  for (const double epsilon : epsilons())
    curve.distance.push_back(h1_distance(Truth(paper_sine_load(), epsilon, true, 15), limit));
  return curve;
}

// Proposition 1 for one method: u_h^0 is (7), solved on the same mesh at epsilon = 0, not a small epsilon.
Curve discrete_limit(const std::string& name, const std::string& mesh_name, const TriangleMesh& mesh,
                     const TruthTable& truth) {
  const Space space(mesh, element(name));
  Sweep sweep(Scene(Body{paper_load}, StiffLayer{0}, UnilateralContact{}), space);
  const Solution limit = sweep.solve();
  const Reference nothing{[](double, double) { return 0.0; },
                          [](double, double) { return Eigen::Vector2d::Zero().eval(); },
                          [](double, double) { return 0.0; }};
  Curve curve{name + " " + mesh_name, {}, {}};
  curve.limit_error = measure_errors(space, limit, 0, reference(truth)).h1;
  for (const double epsilon : epsilons()) {
    sweep.set_epsilon(epsilon);
    Solution solution = sweep.solve();
    curve.strain.push_back(epsilon * epsilon * std::sqrt(solution.p.dot(sweep.problem().m.cwiseProduct(solution.p))));
    solution.u -= limit.u;
    curve.distance.push_back(measure_errors(space, solution, epsilon, nothing).h1);
  }
  return curve;
}

// (25) in its strong form on Sigma: a row x, u, r, exact contact pressure.
Eigen::MatrixXd strong_form(const Truth& limit, int points) {
  Eigen::MatrixXd rows(points + 1, 4);
  for (int j = 0; j <= points; ++j) {
    const double x = static_cast<double>(j) / points;
    rows.row(j) << x, limit.value(x, 0), -limit.gradient(x, 0).y() - limit.d_xx(x, 0), limit.pressure(x);
  }
  return rows;
}

// -Delta u - f in the body by differences of values alone, largest over 3 x 3 points.
double laplace_residual(const Truth& limit) {
  const double h = 5e-3;
  double largest = 0;
  for (const double x : {0.2, 0.5, 0.8})
    for (const double y : {0.2, 0.5, 0.8}) {
      const double around =
          limit.value(x - h, y) + limit.value(x + h, y) + limit.value(x, y - h) + limit.value(x, y + h);
      largest = std::max(largest, std::abs((4 * limit.value(x, y) - around) / (h * h) - paper_load(x, y)));
    }
  return largest;
}

// u_h^0 on the two squares against the discrete (25) on the body alone, P1 structured: largest difference.
double against_ventcel(int cells) {
  const TriangleMesh both = structured_mesh(cells), body = structured_mesh(cells, Domain{0});
  const Space space(both, p1()), alone(body, p1());
  const Solution limit = active_set(assemble(Scene(Body{paper_load}, StiffLayer{0}, UnilateralContact{}), space));
  const Solution ventcel = active_set(assemble(Scene(Body{paper_load}, VentcelLayer{}, UnilateralContact{}), alone));
  return (limit.u.tail(alone.size()) - ventcel.u).cwiseAbs().maxCoeff();  // the body's rows come last
}

void limits(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("exact solutions");
  const Truth limit(paper_sine_load(), 0, true, 15);
  std::vector<Curve> curves{exact_limit(limit)};
  report.stage("(25) in its strong form, by series");
  const Eigen::MatrixXd sigma = strong_form(limit, 400);
  const double laplace = laplace_residual(limit);
  report.stage(fmt::format("discrete solutions, four methods at 1/h = {}", options.cells));
  const TruthTable table(limit);
  const TriangleMesh structured = structured_mesh(options.cells), unstructured = unstructured_mesh(options.cells);
  for (const std::string name : {"P1", "CR"}) {
    curves.push_back(discrete_limit(name, "structured", structured, table));
    curves.push_back(discrete_limit(name, "unstructured", unstructured, table));
  }
  const double ventcel = against_ventcel(options.cells);
  report.finish();

  fmt::print("\n  distance to the limit, H1\n  {:>10}", "epsilon");
  for (const Curve& curve : curves) fmt::print(" {:>16}", curve.name);
  for (std::size_t i = 0; i < epsilons().size(); ++i) {
    fmt::print("\n  {:10.1e}", epsilons()[i]);
    for (const Curve& curve : curves) fmt::print(" {:16.3e}", curve.distance[i]);
  }
  fmt::print("\n  {:>10}", "order");
  for (const Curve& curve : curves) fmt::print(" {:16.2f}", curve.order());
  fmt::print("\n  {:>10} {:16}", "to u^0", "");
  for (std::size_t i = 1; i < curves.size(); ++i) fmt::print(" {:16.3e}", curves[i].limit_error);
  fmt::print("  ||u_h^0 - u^0||_h\n\n");

  write_csv(options.out / "sigma.csv", {"x", "u", "r", "pressure"}, sigma);
  write_file(options.out / "limits.csv", [&](std::ostream& out) {
    out << "method,epsilon,distance\n";
    for (const Curve& curve : curves)
      for (std::size_t i = 0; i < epsilons().size(); ++i)
        out << fmt::format("{},{:.17g},{:.17g}\n", curve.name, epsilons()[i], curve.distance[i]);
  });

  report.claim(std::abs(curves[0].order() - 1.5) < 0.15,
               fmt::format("Theorem 1, Proposition 5: u^epsilon tends to u^0 with order {:.2f} in epsilon (3/2: the "
                           "pressure jumps)",
                           curves[0].order()));
  for (std::size_t i = 1; i < curves.size(); ++i) {
    if (i == 2 && options.cells > 32) continue;  // the locked one has not settled at 1e-4
    report.claim(std::abs(curves[i].order() - 2) < 0.2 && std::abs(curves[i].strain_order() - 2) < 0.2,
                 fmt::format("Proposition 1, {}: order {:.2f}, and {:.2f} of d/dy u; the limit is {:.3f} from u^0",
                             curves[i].name, curves[i].order(), curves[i].strain_order(), curves[i].limit_error));
  }
  report.claim(curves[2].limit_error > 0.1, "P1 unstructured converges to a limit that is not near u^0: locked");

  // The strong form, away from the end of contact, where u_xx jumps and its series rings.
  const double end = limit.contact_zones().at(0).first;
  double free = 0, product = 0, pressure = 0;
  for (Eigen::Index j = 0; j < sigma.rows(); ++j) {
    if (std::abs(sigma(j, 0) - end) < 0.005) continue;
    if (sigma(j, 0) < end) free = std::max(free, std::abs(sigma(j, 2)));
    product = std::max(product, std::abs(sigma(j, 1) * sigma(j, 2)));
    pressure = std::max(pressure, std::abs(sigma(j, 2) - sigma(j, 3)));
  }
  report.claim(sigma.col(1).minCoeff() > -1e-9 && sigma.col(2).minCoeff() > -1e-3 && product < 1e-4,
               fmt::format("(25) on Sigma: u >= {:.0e}, r >= {:.0e} (largest {:.2f}), |u r| <= {:.0e}",
                           sigma.col(1).minCoeff(), sigma.col(2).minCoeff(), sigma.col(2).maxCoeff(), product));
  report.claim(free < 1e-3 && pressure < 1e-3,
               fmt::format("(25): |r| <= {:.0e} where u > 0; r is the contact pressure to {:.0e}", free, pressure));
  report.claim(laplace < 1e-2, fmt::format("(25): -Delta u = f in the body to {:.0e} (differences)", laplace));
  report.claim(ventcel < 1e-9,
               fmt::format("Remark 5, discrete: u_h^0 of P1 structured is that of (25), to {:.0e}", ventcel));
}

// Three things to try:
// - --cells 128: the discrete curves follow the exact one of order 3/2 further before they turn to order 2.
// - another load in Truth and Body, without contact (Truth(..., false)): order 2 for the exact one, too.
// - plot u and r of sigma.csv: where one is, the other is not.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 8;
  options.most_cells = 256;
  return tutorial::run(argc, argv, "12_limits", "Theorem 1, Propositions 1 and 5: the limit epsilon -> 0", options,
                       limits);
}

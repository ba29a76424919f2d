#include "common/limit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "antilock/exact/truth_distance.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "common/effects.hpp"
#include "common/paper_problem.hpp"

namespace antilock::tutorial {
namespace {

Discretisation p1_for(const Scene& scene, int cells) {
  return {structured_mesh(cells, Domain{scene.layer_depth()}), p1()};
}

Eigen::VectorXd solve(const Scene& scene, const Space& space) { return active_set(assemble(scene, space)).u; }

Scene with_layer(const Layer& layer) { return Scene(Body{paper_load}, layer, UnilateralContact{}); }

}  // namespace

Table strong_form(const Truth& limit, int points) {
  Table table({"x", "u", "r", "pressure"});
  for (int j = 0; j <= points; ++j) {
    const double x = static_cast<double>(j) / points;
    table.add({x, limit.value(x, 0), -limit.gradient(x, 0).y() - limit.d_xx(x, 0), limit.pressure(x)});
  }
  return table;
}

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

double against_ventcel(int cells) {
  const Scene scaled = with_layer(StiffLayer{0}), ventcel = with_layer(VentcelLayer{});
  const Discretisation both = p1_for(scaled, cells), body = p1_for(ventcel, cells);
  const Eigen::VectorXd u0 = solve(scaled, both.space()), u = solve(ventcel, body.space());
  return (u0.tail(u.size()) - u).cwiseAbs().maxCoeff();  // the body's rows come last
}

double limit_on_layer(const Truth& limit) {
  const TruthTable table(limit);
  constexpr int points = 2000;
  double sum = 0;
  for (int j = 0; j < points; ++j) {
    const double x = (j + 0.5) / points, u = table.value(x, -0.5), slope = table.gradient(x, -0.5).x();
    sum += (u * u + slope * slope) / points;
  }
  return std::sqrt(sum);
}

Table three_models(double epsilon, int cells) {
  std::vector<Eigen::VectorXd> on_contact;
  for (const Layer& layer : {Layer(ThinLayer{epsilon}), Layer(StiffLayer{epsilon}), Layer(VentcelLayer{})}) {
    const Scene scene = with_layer(layer);
    const Discretisation p1_on = p1_for(scene, cells);
    on_contact.push_back(solve(scene, p1_on.space())(p1_on.space().contact()));
  }
  Table table({"x", "thin", "scaled", "limit"});
  table.add({0, 0, 0, 0});  // clamped
  for (int i = 1; i < cells; ++i)
    table.add({static_cast<double>(i) / cells, on_contact[0](i - 1), on_contact[1](i - 1), on_contact[2](i - 1)});
  table.add({1, 0, 0, 0});
  return table;
}

Table exact_to_the_limit(const std::vector<double>& epsilons, const Exact& limit) {
  Table rows({"method", "epsilon", "distance", "stiff"});
  std::set<double, std::greater<>> different(epsilons.begin(), epsilons.end());
  for (const double epsilon : different) {
    const Truth u(paper_sine_load(), epsilon, true, 15);
    rows.add({"exact", epsilon, h1_distance(u, limit.truth), std::pow(epsilon * stress_norm(u), 2)});
  }
  return rows;
}

void show_limits(const std::filesystem::path& out, const Table& curves, const Table& terms) {
  curves.pivot("epsilon", "method", "distance").print("distance to the limit, H1");
  terms.where("method", "P1 unstructured").pivot("h", "term", "value").print("(18) for locked P1, epsilon = h^2");
  terms.write(out / "terms.csv");
  curves.write(out / "limits.csv");
}

void judge_orders(const Table& curves, const Table& terms, Report& report) {
  // Slopes over the last four epsilons, 10^-2.5 to 1e-4. Locked P1 settles only below h^(3/2).
  const Table small = curves.where_number("epsilon", [](double epsilon) { return epsilon < 4e-3; });
  for (const Entry& method : small.different("method")) {
    const Table own = small.where("method", method);
    const double low = method == "exact" ? 1.35 : method == "P1 unstructured" ? 1.5 : 1.9;
    report.claim_within(own.order("distance", "epsilon"), low, method == "exact" ? 1.65 : 2.1,
                        method.text() + (method == "exact" ? ", Theorem 1: order" : ", Proposition 1: order"));
    report.claim_within(own.order("stiff", "epsilon"), method == "P1 unstructured" ? 1.5 : 1.9, 2.1,
                        method.text() + ", (5): order of epsilon^2 |p|^2");
  }
  for (const Entry& method : terms.different("method")) {
    const Table own = terms.where("method", method);
    const auto order = [&](const char* term) { return own.where("term", term).order("value", "h"); };
    const bool locks = method == "P1 unstructured";
    report.claim(order("first term") > 2.5 && order("third term") > (locks ? 0.5 : 2.5),
                 "{}, (18) along epsilon = h^2: first term h^{:.2f}, third h^{:.2f}", method.text(),
                 order("first term"), order("third term"));
    if (!locks)
      report.claim(order("second term") > 0.9 && order("left side") > 0.9,
                   "{}, Propositions 2, 3: second term h^{:.2f}, left side h^{:.2f}", method.text(),
                   order("second term"), order("left side"));
  }
}

double last_second_term(const Table& terms) {
  return terms.where("method", "P1 unstructured").where("term", "second term").last("value");
}

void judge_limit_problem(const std::filesystem::path& out, const Exact& limit, int cells, Report& report) {
  const Table sigma = strong_form(limit.truth, 400), models = three_models(0.1, cells);
  sigma.write(out / "sigma.csv");
  models.write(out / "models.csv");
  // Away from the end of contact, where u_xx jumps and its series rings. 1e-6 and 1e-5 of r, the largest of which is
  // 1.5: what the sum of 2^15 waves leaves.
  const double end = limit.contact_from();
  const Table away = sigma.where_number("x", [&](double x) { return std::abs(x - end) > 0.005; });
  double product = 0, pressure = 0, free = 0;
  for (const Table& point : away.rows()) {
    const double u = point.number("u"), r = point.number("r");
    product = std::max(product, std::abs(u * r));
    pressure = std::max(pressure, std::abs(r - point.number("pressure")));
    if (point.number("x") < end) free = std::max(free, std::abs(r));
  }
  report.claim(sigma.least("u") > -1e-9 && sigma.least("r") > -1e-6 && product < 1e-7,
               "(25) on Sigma: u >= {:.0e}, r >= {:.0e} (largest {:.2f}), |u r| <= {:.0e}", sigma.least("u"),
               sigma.least("r"), sigma.most("r"), product);
  report.claim(free < 1e-6 && pressure < 1e-5, "(25): |r| <= {:.0e} where u > 0; r is the contact pressure to {:.0e}",
               free, pressure);
  const double laplace = laplace_residual(limit.truth), ventcel = against_ventcel(cells);
  report.claim(laplace < 5e-3, "(25): -Delta u = f in the body to {:.0e} (differences)", laplace);
  report.claim(ventcel < 1e-9, "Remark 5, discrete: u_h^0 of P1 structured is that of (25), to {:.0e}", ventcel);
  // (22) and (23) are one problem: what is between them is the mesh, of second order. The thin layer has 2 rows of
  // cells at 1/h = 16 and 3 at 32, and (2/3)^2 = 0.44.
  const double here = most_apart(models, "thin", "scaled"),
               coarser = most_apart(three_models(0.1, cells / 2), "thin", "scaled");
  report.claim(here < 0.5 * coarser, "(22) and (23) at epsilon = 0.1: {:.1e} apart on Gamma_C, {:.1e} at 2 h", here,
               coarser);
  const double limit_apart = most_apart(models, "scaled", "limit");
  report.claim(limit_apart > 10 * here, "(25) is {:.1e} from them: the limit, not the layer", limit_apart);
}

}  // namespace antilock::tutorial

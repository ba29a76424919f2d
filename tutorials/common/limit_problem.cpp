#include "common/limit_problem.hpp"

#include <algorithm>
#include <cmath>

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

void judge_limit_problem(const Table& sigma, const Table& models, const Exact& limit, int cells, Report& report) {
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

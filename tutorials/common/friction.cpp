#include "common/friction.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "antilock/measure/contact_zone.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

std::vector<Entry> floor_row(const Rubber& rubber, double epsilon, const VariationalInequality& problem,
                             const Solution& solution, int cells) {
  struct Forces {
    double normal, tangential;
  };
  static const std::map<double, Forces> reference{
      {1, {0.16034, 0.01627}}, {1e-4, {0.26073, 0.01222}}, {1e-8, {0.26077, 0.01223}}, {0, {0.26077, 0.01223}}};
  double normal = 0, tangential = 0, sticks = 0;
  for (Eigen::Index i = 0; i < solution.lambda.size(); ++i) {
    const bool rubs = std::isfinite(problem.force_bound(i));
    (rubs ? tangential : normal) += rubs ? std::abs(solution.lambda(i)) / 2 : solution.lambda(i);
    if (rubs && solution.active[i] && problem.force_bound(i) > 0) sticks += 1.0 / cells;
  }
  const auto at = reference.find(epsilon);
  const bool known = at != reference.end();
  return {rubber.name,
          1 / epsilon,
          epsilon,
          rubber.locks,
          normal,
          tangential,
          sticks,
          solution.counters.corrections,
          known,
          known ? Entry(100 * std::abs(normal / at->second.normal - 1)) : Entry(""),
          known ? Entry(100 * std::abs(tangential / at->second.tangential - 1)) : Entry("")};
}

Extremes extremes_of_friction(const std::function<VariationalInequality(const Profile& g)>& pressed) {
  const auto great = [](double) { return 1e6; };
  const auto zero = [](double) { return 0.0; };
  VariationalInequality bonded = pressed(great);
  const Eigen::VectorXd holds = active_set(bonded).u;
  bonded.force_bound.resize(0);
  return {(active_set(pressed(zero)).u - active_set(pressed({})).u).cwiseAbs().maxCoeff(),
          (holds - active_set(bonded).u).cwiseAbs().maxCoeff()};
}

Eigen::MatrixX3d on_floor(const Space& in_x, const VariationalInequality& problem, const Solution& solution) {
  const Eigen::VectorXd lengths = contact_lengths(in_x);
  Eigen::MatrixX3d curves(lengths.size(), 3);
  curves.col(0) = in_x.points().col(0)(in_x.contact());
  curves.col(1) = solution.lambda.tail(lengths.size()).cwiseQuotient(lengths);
  curves.col(2) = solution.u(problem.contact).tail(lengths.size());
  return curves;
}

void show_friction(const std::filesystem::path& out, const Table& checks, const Table& forces, const Profile& g,
                   const Eigen::MatrixX3d& locked, const Eigen::MatrixX3d& crossed) {
  const Table known = forces.where("known", 1);
  checks.print("", 2);
  known.pivot("element", "lambda", "N off").print("error of the normal force in %, by lambda");
  known.pivot("element", "lambda", "T off").print("error of the friction force in %, by lambda");
  forces.pivot("element", "lambda", "sticks").print("length that sticks, by lambda");
  Table zones({"x", "g", "minus_g", "T_locked", "T", "u_locked", "u"});
  for (Eigen::Index i = 0; i < crossed.rows(); ++i) {
    const double x = crossed(i, 0);
    zones.add({x, g(x), -g(x), locked(i, 1), crossed(i, 1), locked(i, 2), crossed(i, 2)});
  }
  zones.write(out / "zones.csv");
}

void judge_friction(const Table& checks, const Table& forces, int cells, Report& report) {
  report.claim(checks.most("patch") < 1e-12,
               "patch test: a block that slips as a whole has its uniform strain to {:.0e}", checks.most("patch"));
  report.claim(std::max(checks.most("g = 0"), checks.most("g = 1e6")) < 1e-12,
               "g = 0 is the block without friction to {:.0e}, g = 1e6 the bonded one to {:.0e}", checks.most("g = 0"),
               checks.most("g = 1e6"));
  report.claim(checks.most("apart") < 1e-9 && checks.most("steps") <= 10,
               "active set and Uzawa agree to {:.0e}: {} steps at most against {:.0f} or more", checks.most("apart"),
               checks.most("steps"), checks.least("Uzawa steps"));
  const Table robust = forces.where("locks", 0), known = robust.where("known", 1);
  double drift = 0;
  for (const Entry& element : robust.different("element")) {
    const Table limit =
        robust.where("element", element).where_number("epsilon", [](double epsilon) { return epsilon <= 1e-8; });
    drift = std::max(drift, limit.most("T") / limit.least("T") - 1);
  }
  report.claim(robust.most("corrections") <= 5 && drift < 1e-6,
               "at most {} corrections at any lambda; from lambda = 1e8 to infinity T moves by {:.0e}, like 1/lambda",
               robust.most("corrections"), drift);
  report.claim(known.most("N off") < 20.0 / cells, "N is off by {:.2f} % at most, at any lambda of the table",
               known.most("N off"));
  // in the cell at either end of the stick zone |T| is between 0 and g: h g / 2, where g = 0.15 and T = 0.0122 in all
  report.claim(known.most("T off") < 615.0 / cells, "T is off by {:.1f} % at most (half a cell at its end: {:.0f} %)",
               known.most("T off"), 615.0 / cells);
  const Table locked = forces.where("locks", 1).where("epsilon", 0);
  report.claim(locked.number("N") > 2 * 0.2608 && locked.number("T") > 2 * 0.0122,
               "P1 locks: its contact zone slides to one side; N = {:.2f} and T = {:.4f} are more than twice too large",
               locked.number("N"), locked.number("T"));
}

}  // namespace antilock::tutorial

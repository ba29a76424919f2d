#pragma once
#include <functional>

#include "antilock/io/writers.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/sweep.hpp"
#include "backstage/26_rubber.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// The largest difference of u: with g = 0 from the block without friction (an empty g), and with g = 1e6 from the
/// block whose bonds to the floor never give way.
struct Extremes {
  double none, bonded;
};
inline Extremes extremes_of_friction(const std::function<VariationalInequality(const Profile& g)>& pressed) {
  const auto great = [](double) { return 1e6; };
  const auto zero = [](double) { return 0.0; };
  VariationalInequality bonded = pressed(great);
  const Eigen::VectorXd holds = active_set(bonded).u;
  bonded.force_bound.resize(0);
  return {(active_set(pressed(zero)).u - active_set(pressed({})).u).cwiseAbs().maxCoeff(),
          (holds - active_set(bonded).u).cwiseAbs().maxCoeff()};
}

/// One row per unknown of the floor: its x, T per length, and the slip u_x.
inline Eigen::MatrixX3d on_floor(const Space& in_x, const VariationalInequality& problem, const Solution& solution) {
  const Eigen::VectorXd lengths = contact_lengths(in_x);
  Eigen::MatrixX3d curves(lengths.size(), 3);
  curves.col(0) = in_x.points().col(0)(in_x.contact());
  curves.col(1) = solution.lambda.tail(lengths.size()).cwiseQuotient(lengths);
  curves.col(2) = solution.u(problem.contact).tail(lengths.size());
  return curves;
}

/// Prints the tables; writes zones.csv, where P1 on parallel triangles (`locked`) and on crossed ones sticks and slips, and
/// lambda.csv, T and the length that sticks against lambda.
inline void show_friction(const std::filesystem::path& out, const Table& checks, const Table& forces, int cells,
                          const Profile& g, const Eigen::MatrixX3d& locked, const Eigen::MatrixX3d& crossed) {
  checks.print("active set and Uzawa", 2);
  const Table here = forces.where("h", 1.0 / cells);
  here.where("known", 1).pivot("element", "lambda", "N off").print("error of the normal force in %, by lambda");
  for (const char* what : {"T", "sticks"})
    here.where_number("lambda", [](double l) { return l <= 100 || std::isinf(l); })
        .pivot("element", "lambda", what)
        .print(std::string(what) + ", by lambda");
  Table zones({"x", "g", "minus_g", "T_locked", "T", "u_locked", "u"}),
      by_lambda({"log_lambda", "T_crossed", "T_cr", "T_ks", "crossed", "cr", "ks"});
  for (Eigen::Index i = 0; i < crossed.rows(); ++i) {
    const double x = crossed(i, 0);
    zones.add({x, g(x), -g(x), locked(i, 1), crossed(i, 1), locked(i, 2), crossed(i, 2)});
  }
  zones.write(out / "zones.csv");
  const Table drawn = here.where_number("lambda", [](double l) { return l <= 1e4; });
  for (const Entry& lambda : drawn.different("lambda")) {
    std::vector<Entry> row{std::log10(lambda.number())};
    for (const char* what : {"T", "sticks"})
      for (const char* element : {"P1 crossed triangles", "Crouzeix-Raviart with jumps", "Kouhia-Stenberg"})
        row.push_back(drawn.where("lambda", lambda).where("element", element).entry(what));
    by_lambda.add(row);
  }
  by_lambda.write(out / "lambda.csv");
}

}  // namespace antilock::tutorial

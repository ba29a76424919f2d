#include "common/mixed.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "antilock/analysis/inf_sup.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/nearest.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "common/limit_problem.hpp"

namespace antilock::tutorial {
namespace {

/// The worst error over epsilon on each mesh, beside what the theorem asks.
Table worst_over_epsilon(const Table& own) {
  Table rows({"name", "h", "worst", "ratio", "alpha", "near", "hidden", "seconds"});
  for (const Entry& h : own.different("h")) {
    const Table mesh = own.where("h", h);
    rows.add({mesh.entries("name").front(), h, mesh.most("h1"), mesh.most("h1") / mesh.where("epsilon", 1).number("h1"),
              mesh.first("alpha"), mesh.first("near"), mesh.first("hidden"), mesh.most("seconds")});
  }
  return rows;
}

}  // namespace

Asked what_theorem_4_asks(const Space& space, const VariationalInequality& problem, const Exact& u0) {
  using std::numbers::pi;
  const SparseMatrix norm = h1_norm(space);
  const Field slope_of_phi = [](double x, double y) { return pi * std::sin(pi * x) * std::cos(pi * y); };
  return {space.free_count() < 1000 ? coercivity(problem, norm) : std::numeric_limits<double>::quiet_NaN(),
          nearest(space, problem, u0.reference(), Within::k_0h).distance,
          dual_norm(problem, norm, load_vector(space, slope_of_phi, Region::layer), true)};
}

void judge_projections(const std::filesystem::path& out, const Table& layer, const Truth& limit, Report& report) {
  Table side_by_side({"strain", "alpha", "finer", "dist(u^0, K_0h)", "its order", "slope hidden", "order ", "sup error",
                      "order", "locking ratio", "seconds"}),
      worst({"name", "h", "worst", "ratio", "alpha", "near", "hidden", "seconds"});
  for (const Entry& name : layer.different("name")) {
    const Table own = worst_over_epsilon(layer.where("name", name));
    worst.add(own);
    const Table known = own.where_number("alpha", [](double alpha) { return std::isfinite(alpha); });
    const bool slopes = own.least("hidden") > 1e-6;  // else round-off: conforming, nothing is hidden
    side_by_side.add({name, known.first("alpha"), known.last("alpha"), own.last("near"), own.order("near", "h"),
                      own.last("hidden"), slopes ? Entry(own.order("hidden", "h")) : Entry("-"), own.last("worst"),
                      own.order("worst", "h"), own.last("ratio"), own.last("seconds")});
  }
  side_by_side.print("Theorem 4 for another a0: (i), (ii), (iii), and the conclusion", 3);
  layer.where("h", layer.least("h")).pivot("name", "epsilon", "h1").print("H1 error on the finest mesh, by epsilon", 3);
  worst.write(out / "projections.csv");
  layer.write(out / "layer.csv");

  const auto of = [&](const char* name) { return worst.where("name", name); };
  const auto at_last = [](const Table& own, const char* column) {  // the order between the two finest meshes
    const double finest = own.least("h");
    return own.where_number("h", [=](double h) { return h < 2.5 * finest; }).order(column, "h");
  };
  const double lost = limit_on_layer(limit);
  for (const char* name : {"P1 as it is", "patches (half kept)"})
    report.claim(of(name).least("near") > lost && of(name).least("worst") > lost,
                 "{}: (ii) fails, u^0 stays {:.3f} away; so does the worst error, {:.3f}: |u^0| on the layer is {:.3f}",
                 name, of(name).last("near"), of(name).last("worst"), lost);
  const Table columns = of("columns (half kept)"), alone = of("boxes (nothing kept)"), half = of("boxes (half kept)");
  // the mean over a column is a condition on two boundaries, in the limit too: its order is 0
  report.claim(std::abs(at_last(columns, "hidden")) < 0.2 && at_last(columns, "worst") < 0.2,
               "columns (half kept): (iii) fails, K_0h hides a slope of {:.3f}; the worst error stays, {:.3f}",
               columns.last("hidden"), columns.last("worst"));
  // a zigzag across the layer, of a wave length of some h, has energy from d/dx alone: alpha ~ h^2
  const Table known = alone.where_number("alpha", [](double alpha) { return std::isfinite(alpha); });
  report.claim_within(known.order("alpha", "h"), 1.7, 2.3,
                      "boxes (nothing kept): (i) fails, alpha falls like h to the");
  report.claim(alone.last("worst") > 2 * alone.first("worst"), "and the worst error grows, {:.2f} to {:.2f}",
               alone.first("worst"), alone.last("worst"));
  report.claim(half.where_number("alpha", [](double a) { return std::isfinite(a); }).least("alpha") > 0.5 * 0.9129,
               "boxes (half kept): (i), alpha is at least half of that on V, 0.9129");
  report.claim(at_last(half, "hidden") > 0.8, "and (iii), the slope hidden falls like h^{:.2f}",
               at_last(half, "hidden"));
  for (const Table& own : {half, of("Crouzeix-Raviart")}) {
    const std::string name = own.entries("name").front().text();
    // 0.9 to 1.1: first order in H1, 0.1 for coarse meshes
    report.claim_within(own.order("near", "h"), 0.9, 1.1, name + ": (ii), the distance from u^0 to K_0h falls like h^");
    report.claim_within(own.order("worst", "h"), 0.9, 1.1, name + ": the worst error falls like h^");
    report.claim(own.last("ratio") < 1.1, "{}: locking ratio {:.2f}", name, own.last("ratio"));
  }
  double corrections = 0;
  for (const char* name : {"boxes (half kept)", "Crouzeix-Raviart"})
    corrections = std::max(corrections, layer.where("name", name).most("corrections"));
  report.claim(corrections <= 5, "at most {} corrections, epsilon from 1 to 1e-20, and 0", corrections);
}

std::vector<Mixed> mixed_methods() {
  return {{"P1 (pressure per triangle)", "", p1(), false, false},
          {"P1 (pressure per vertex)", "p1_vertex", p1(), true, false},
          {"MINI", "mini", p1_bubble(), true, true},
          {"Taylor-Hood", "", p2(), true, true},
          {"CR with jumps", "", crouzeix_raviart(), false, true}};
}

VariationalInequality rubber(const Mixed& way, const Space& space) {
  PlaneStrain scene;
  scene.epsilon = 0;
  scene.gap = [](double x) { return (x - 0.5) * (x - 0.5); };
  scene.jump_weight = way.element.conforming() ? 0 : 1;
  scene.continuous_pressure = way.pressure_per_vertex;
  return assemble(scene, {space, space});
}

Table inf_sup_constants(const Mixed& way) {
  Table rows(beta_columns);
  for (const int n : {4, 8, 12}) {
    const TriangleMesh mesh = with_free_sides(structured_mesh(n, Domain{0}));
    const VariationalInequality problem = rubber(way, Space(mesh, way.element));
    for (const bool contact : {false, true}) {
      const std::vector<bool> nothing(problem.contact.size());
      const auto linear = held_in_contact(problem, contact ? active_set(problem).active : nothing);
      const double beta = inf_sup(multiplier_gram(linear, linear.a1), Eigen::MatrixXd(linear.m.asDiagonal()));
      rows.add({way.name, 1.0 / n, contact ? "contact held" : "contact free", beta});
    }
  }
  return rows;
}

Table push(const Mixed& way, const Options& options) {
  const std::map<double, double> reference{{1, 0.158792}, {1e-2, 0.255738}, {1e-4, 0.259131}};  // chapter 23
  const TriangleMesh mesh = with_free_sides(structured_mesh(options.cells, Domain{0}));
  const Space space(mesh, way.element);
  const Stopwatch watch;
  Sweep sweep(rubber(way, space));
  Solution solution = sweep.solve();
  const double seconds = watch.seconds();
  if (!way.file.empty()) {
    Eigen::VectorXd pressure(mesh.triangle_count());
    for (int t = 0; t < mesh.triangle_count(); ++t) pressure(t) = -solution.p(mesh.triangles.row(t)).mean();
    write_deformed_vtu(options.out / (way.file + ".vtu"), {space, space}, solution.u, pressure);
  }
  Table rows(force_columns);
  for (const double epsilon : {1.0, 1e-2, 1e-4, 1e-8, 1e-20, 0.0}) {
    sweep.set_compliance(epsilon);
    solution = sweep.solve();
    const auto known = reference.find(epsilon);
    const double force = known == reference.end() ? 0.259166 : known->second;
    rows.add({way.name, sweep.problem().free_count(), 1 / epsilon, epsilon, 100 * (solution.lambda.sum() / force - 1),
              solution.p.lpNorm<Eigen::Infinity>(), solution.counters.corrections, seconds});
  }
  return rows;
}

void judge_mixed(const std::filesystem::path& out, const Table& constants, const Table& forces, int cells,
                 Report& report) {
  for (const char* contact : {"contact free", "contact held"})
    constants.where("contact", contact)
        .pivot("name", "h", "beta")
        .print(fmt::format("inf-sup constant, {}, by h", contact), 3);
  forces.pivot("name", "lambda", "percent").print("error of the contact force in %, by lambda", 2);
  forces.where("epsilon", 0)
      .select({"name", "unknowns", "pressure", "corrections", "seconds"})
      .print("incompressible: largest pressure, corrections, seconds");
  constants.where_number("beta", [](double beta) { return beta > 0; }).write(out / "inf_sup.csv");  // to be drawn
  forces.write(out / "forces.csv");
  Table obstacle({"x", "y"});
  for (int i = 0; i <= 40; ++i) obstacle.add({-0.1 + 0.03 * i, -std::pow(-0.6 + 0.03 * i, 2)});
  obstacle.write(out / "obstacle.csv");

  for (const Mixed& way : mixed_methods()) {
    const Table own = constants.where("name", way.name), held = own.where("contact", "contact held"),
                free = own.where("contact", "contact free"), force = forces.where("name", way.name);
    if (way.stable) {
      // a tenth: for what the coarsest mesh of 4 cells still lacks
      report.claim(held.last("beta") > 0.9 * held.first("beta") && held.last("beta") > 0.9 * free.last("beta"),
                   "{}: beta with the contact set does not fall, {:.3f} to {:.3f}; without it {:.3f}", way.name,
                   held.first("beta"), held.last("beta"), free.last("beta"));
      const double worst = std::max(force.most("percent"), -force.least("percent"));
      // first order, from the 10 % by which 4 cells may miss
      report.claim(worst < 40.0 / cells, "{}: the force is off by {:.2f} % at most, at any lambda, in {} corrections",
                   way.name, worst, force.most("corrections"));
    } else if (way.pressure_per_vertex) {
      report.claim(free.most("beta") == 0, "{}: beta is 0, a pressure that no displacement sees", way.name);
    } else {
      report.claim_within(free.order("beta", "h"), 0.8, 1.2, way.name + ": beta falls like h^");
      report.claim(force.where("epsilon", 0).number("percent") > 100, "{}: it locks, force {:.0f} % too large",
                   way.name, force.where("epsilon", 0).number("percent"));
    }
  }
}

}  // namespace antilock::tutorial

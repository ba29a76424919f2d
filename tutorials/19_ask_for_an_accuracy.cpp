// Ask for an accuracy: the library finds the mesh, and hands over the proof that it is fine enough.
//
// Run: 19_ask_for_an_accuracy                two loads, three epsilons, accuracies from 10 % to 2 %; some seconds
// Run: 19_ask_for_an_accuracy --asked 0.01   down to 1 %: a minute
//
// --epsilon is not asked for here: the study has three of its own.
//
// The certificate of 17_certificate is a sum over triangles of terms that are never negative. So it says where the
// error is, and the loop is short:
//
//     solve, certify, stop where the bound is small enough, else mark and refine.
//
// Marked are the largest terms that make up half of the sum (Doerfler 1996). Where epsilon <= 0.1 the body is bisected
// and the layer's columns are extruded below it: what happens at one x happens in the whole thickness of a thin layer,
// and squares would be the dearer mesh. From the third level on the bound falls like N^(-1/2), N the unknowns, so that
// the price of what is asked is known in advance, and a price beyond the limit is refused at once.
//
// Adaptivity does not cure locking. It finds it: the terms of a locked P1 solution lie in the layer, and go on lying
// there. The cure is the columns.

#include <cmath>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/io/vtu_grid.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "common/command_line.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

double smallest_asked = 0.02;
const std::vector<double> epsilons{1, 1e-6, 0};

// Loads chosen here: the one of every page, and one that is concentrated.
double bump(double x, double y) {
  return 400 * std::exp(-(std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)) / (2 * 0.02 * 0.02));
}
Scene scene_of(const std::string& load, double epsilon) {
  return Scene(Body{load == "bump" ? Field(bump) : Field(paper_load)}, StiffLayer{epsilon}, UnilateralContact{});
}
TriangleMesh first_mesh(Growth growth) { return unstructured_mesh(8, {growth == Growth::bisect ? 1.0 : 0.0}); }

const std::vector<std::string> path_columns{"load", "epsilon", "method", "unknowns", "seconds", "relative"};
const std::vector<std::string> price_columns{"load",   "epsilon", "of",       "asked", "unknowns",
                                             "quoted", "seconds", "relative", "levels"};

// 1. The way of the loop: every level with its unknowns, seconds and bound.
Table path(const std::string& load, double epsilon, const std::string& method, const Accuracy& accuracy) {
  const Growth growth = accuracy.growth.value_or(epsilon > 0.1 ? Growth::bisect : Growth::extrude);
  Table rows(path_columns);
  for (const Level& level : solve_to(scene_of(load, epsilon), first_mesh(growth), accuracy).history)
    rows.add({load, epsilon, method, level.unknowns, level.seconds, level.relative});
  return rows;
}

// 2. What it is measured by: the same certificate on the uniform meshes of gmsh, every level paid for as well.
Table uniform_path(const std::string& load, double epsilon, int finest) {
  Table rows(path_columns);
  double seconds = 0;
  for (int cells = 8; cells <= finest; cells *= 2) {
    const TriangleMesh mesh = unstructured_mesh(cells);  // gmsh's own time is not counted
    Stopwatch watch;
    const Scene scene = scene_of(load, epsilon);
    const Space space(mesh, crouzeix_raviart());
    const VariationalInequality problem = assemble(scene, space);
    PenaltyFactor factor(problem);
    const Certificate found = certify(scene, space, problem, active_set(problem, factor), {.factor = &factor});
    seconds += watch.lap();
    rows.add({load, epsilon, "uniform", space.free_count(), seconds, found.relative(Quantity::displacement)});
  }
  return rows;
}

// 3. The price list: asked -> unknowns, seconds, certified.
Table price(const std::string& load, double epsilon, Quantity of, double asked) {
  const Growth growth = epsilon > 0.1 ? Growth::bisect : Growth::extrude;
  const CertifiedSolution found = solve_to(scene_of(load, epsilon), first_mesh(growth), {asked, of});
  const Level& last = found.history.back();
  const double quoted = found.history.size() > 3 ? found.history[found.history.size() - 2].quoted_unknowns : 0;
  Table row(price_columns);
  row.add({load, epsilon, of == Quantity::stress ? "stress" : "displacement", asked, last.unknowns, quoted,
           last.seconds, last.relative, static_cast<int>(found.history.size())});
  return row;
}

// 4. The mesh at the end, coloured by its indicator as a density (log10), for a picture.
void write_indicator(const std::filesystem::path& file, const std::string& load, double epsilon, double asked) {
  const Growth growth = epsilon > 0.1 ? Growth::bisect : Growth::extrude;
  const CertifiedSolution found = solve_to(scene_of(load, epsilon), first_mesh(growth), {asked});
  const int count = found.mesh.triangle_count();
  VtuGrid grid;
  grid.points.resize(3 * count, 2);
  grid.triangles.resize(count, 3);
  Eigen::MatrixXd value(3 * count, 1), region(count, 1);
  for (int t = 0; t < count; ++t) {
    for (int i = 0; i < 3; ++i) {
      grid.points.row(3 * t + i) = found.mesh.vertices.row(found.mesh.triangles(t, i));
      grid.triangles(t, i) = 3 * t + i;
      value(3 * t + i) = std::log10(std::max(found.certificate.indicator(t) / found.mesh.area(t), 1e-12));
    }
    region(t) = static_cast<int>(found.mesh.region[t]);
  }
  grid.point_data.push_back({"u", value});
  grid.cell_data.push_back({"region", region, true});
  write_grid(file, grid);
}

void verdicts(const Table& paths, const Table& prices, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  Table paths(path_columns), prices(price_columns);
  for (const std::string load : {"paper", "bump"})
    for (const double epsilon : epsilons) {
      report.stage(fmt::format("load {}, epsilon = {:g}: uniform, bisected, extruded, midpoint", load, epsilon));
      paths.add(uniform_path(load, epsilon, options.cells));
      paths.add(path(load, epsilon, "bisected", {smallest_asked, Quantity::displacement, 2e6, Growth::bisect}));
      if (epsilon <= 0.1) paths.add(path(load, epsilon, "extruded", {smallest_asked}));
      paths.add(path(load, epsilon, "midpoint", {smallest_asked, Quantity::stress}));
      for (const Quantity of : {Quantity::displacement, Quantity::stress})
        for (double asked = 0.1; asked >= 0.99 * smallest_asked; asked /= std::sqrt(5))
          prices.add(price(load, epsilon, of, asked));
    }
  report.stage("meshes for the picture");
  for (const std::string load : {"paper", "bump"}) write_indicator(options.out / (load + ".vtu"), load, 1e-6, 0.1);
  report.stage("more than the limit allows");
  std::string refusal;
  try {
    solve_to(scene_of("paper", 1e-6), first_mesh(Growth::extrude), {1e-4});
  } catch (const NotConverged& error) {
    refusal = error.what();
  }
  report.finish();
  prices.print("asked -> unknowns, seconds, certified");
  fmt::print("  1e-4 is refused: {}\n", refusal);
  paths.write(options.out / "paths.csv");
  prices.write(options.out / "price_list.csv");
  verdicts(paths, prices, report);
  report.claim(refusal.find("can be reached") != std::string::npos,
               "what is too dear is refused, with what can be had");
}

void verdicts(const Table& paths, const Table& prices, tutorial::Report& report) {
  int kept = 0, quoted = 0, quotes = 0;
  for (const Table& row : prices.rows()) {
    const double asked = row.number("asked"), relative = row.number("relative");
    kept += relative <= asked && relative >= asked / 2 ? 1 : 0;
    if (row.number("quoted") == 0) continue;
    ++quotes;
    quoted += std::abs(row.number("quoted") / row.number("unknowns") - 1) <= 0.3 ? 1 : 0;
  }
  report.claim(kept == prices.size(), "{} of {} answers lie between half of what was asked and all of it", kept,
               prices.size());
  report.claim(quoted == quotes, "{} of {} quotes were within 30 % of the unknowns in the end", quoted, quotes);
  // unknowns times the square of the error: the price of a family of meshes, whatever is asked of it
  const auto cost = [&](const char* load, double epsilon, const char* method) {
    const Table way = paths.where("load", load).where("epsilon", epsilon).where("method", method);
    return way.last("unknowns") * std::pow(way.last("relative"), 2);
  };
  report.claim(
      cost("bump", 1e-6, "extruded") < cost("bump", 1e-6, "uniform") / 8,
      "bump, epsilon = 1e-6: {:.0f} times fewer unknowns than uniform meshes, {:.0f} times when bisected throughout",
      cost("bump", 1e-6, "uniform") / cost("bump", 1e-6, "extruded"),
      cost("bump", 1e-6, "uniform") / cost("bump", 1e-6, "bisected"));
  report.claim(cost("paper", 1e-6, "extruded") < cost("paper", 1e-6, "uniform") / 1.5,
               "a smooth load gains {:.1f}, all of it from the extruded layer",
               cost("paper", 1e-6, "uniform") / cost("paper", 1e-6, "extruded"));
  report.claim(cost("paper", 1e-6, "midpoint") < 0.35 * cost("paper", 1e-6, "extruded"),
               "stresses cost {:.2f} of what displacements cost: a quarter",
               cost("paper", 1e-6, "midpoint") / cost("paper", 1e-6, "extruded"));
}

// Three things to try:
// - a load with a spike between the points of the first mesh's quadrature, 20000 exp(-((x - .31)^2 + (y - .62)^2) / 4e-6):
//   it is found before the first level.
// - an obstacle of one needle, gap(x) = 0.1 - 0.12 exp(-((x - 0.3) / 0.004)^2).
// - Marking{.share = 0.9} in the library: fewer levels, more unknowns.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 32;
  options.most_cells = 256;
  options.cells = 64;
  options.add = [](tutorial::CommandLine& line) {
    line.add("--asked", smallest_asked, "smallest relative accuracy asked for", 0.005, 0.1);
  };
  return tutorial::run(argc, argv, "19_ask_for_an_accuracy", "an accuracy asked for, a mesh found, a proof handed over",
                       options, study);
}

// The C++ library against FreeFEM, tutorial by tutorial, on identical meshes: one table, and the
// data of a picture.
//
// Run: compare                 about a minute
// Run: compare --cells 16      coarser meshes, a few seconds
//
// In the formulation `mixed` FreeFEM solves the saddle point problem with u and the layer stress p
// as it stands, by one UMFPACK; the library corrects a penalised problem. In the formulation
// `penalty` both do the latter. The two are the same discrete solution on paper, so they must agree
// to round-off and to the tolerance of the corrections; the bound is 1e-8 relative in the maximum
// norm. Scripts that write numbers and no solution are compared by these. The column `road` says
// what FreeFEM did in each line. The last lines show FreeFEM with the plain sum a1 + epsilon^-2 a0,
// which is no solution at the paper's epsilon.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "antilock/core/standard_output.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/summed.hpp"
#include "antilock/solve/uzawa.hpp"
#include "cross_check.hpp"
#include "lines.hpp"
#include "model_check.hpp"
#include "numbers.hpp"
#include "programs/program.hpp"
#include "runner.hpp"

using namespace antilock;
using freefem::Line;

namespace {

struct Compared {
  std::string element;
  bool structured;
  std::string name() const { return element + (structured ? " structured" : " unstructured"); }
  std::string script() const {
    if (element == "CR") return "08_crouzeix_raviart";
    return structured ? "05_p1_structured" : "06_p1_unstructured";
  }
};

TriangleMesh make_mesh(const Compared& method, int cells) {
  return method.structured ? structured_mesh(cells) : unstructured_mesh(cells);
}

VariationalInequality problem_on(const Space& space, double epsilon) {
  return assemble(Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}), space);
}

/// Where P1 locks no contact unknown moves: gaps are 0 to the tolerance, in contact or not, and
/// there is no set to compare.
std::string contact_words(const VariationalInequality& problem, const Solution& ours,
                          const freefem::Result& theirs, int disagree) {
  if (disagree == 0) return "same";
  const double gap = std::max(ours.u(problem.bounds.unknowns).cwiseAbs().maxCoeff(),
                              theirs.gap.cwiseAbs().maxCoeff());
  return gap < 1e-9 ? "none moves" : fmt::format("{} others", disagree);
}

struct Both {
  Line line;
  Solution ours;
  freefem::Result theirs;
};
Both solve_both(const std::string& tutorial, const std::string& script, const Space& space,
                double epsilon, const std::filesystem::path& out,
                const std::vector<std::string>& options = {}, bool by_uzawa = false) {
  const VariationalInequality problem = problem_on(space, epsilon);
  Both both;
  both.ours = by_uzawa ? uzawa(problem) : active_set(problem);
  both.theirs = freefem::solve(script, space, epsilon, out / "freefem", options);
  const freefem::Comparison c = freefem::compare(space, problem, both.ours, both.theirs);
  both.line = {tutorial,
               "",
               both.theirs.road,
               space.size(),
               c.difference,
               contact_words(problem, both.ours, both.theirs, c.contact_disagree),
               both.ours.seconds.total(),
               both.theirs.seconds};
  return both;
}

Line meshes(int cells, const std::filesystem::path& out) {
  Line line{"02_meshes", "vertices, edges, longest edge", "-", 0, 0, "-"};
  for (const bool structured : {true, false}) {
    const TriangleMesh mesh = make_mesh({"P1", structured}, cells);
    const auto file = out / "freefem" / "mesh.freefem.msh";
    write_freefem_mesh(file, mesh);
    freefem::run("02_meshes",
                 {"-mesh", file, "-cells", std::to_string(cells), "-out", out / "freefem"});
    const freefem::ScriptTable t = freefem::read_table(out / "freefem" / "imported.csv");
    const double counts = std::abs(t.column("vertices")(0) - mesh.vertex_count()) +
                          std::abs(t.column("triangles")(0) - mesh.triangle_count()) +
                          std::abs(t.column("edges")(0) - mesh.edge_count());
    line.unknowns += mesh.vertex_count();
    line.difference =
        std::max(line.difference, counts + std::abs(t.column("h")(0) / mesh.diameter() - 1));
  }
  return line;
}

/// The solutions of the convergence study, by the scripts 05, 06 and 08: one method, every epsilon
/// and mesh; the worst difference and the seconds together.
Line study(const Compared& method, int cells, const std::filesystem::path& out) {
  Line all{"09_convergence", "", ""};
  int meshes = 0;
  for (int n = std::max(4, cells / 4); n <= cells; n *= 2) {
    ++meshes;
    const Space space(make_mesh(method, n), element(method.element));
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6}) {
      const Line line = solve_both("", method.script(), space, epsilon, out).line;
      all.road = line.road;
      all.unknowns = line.unknowns;
      all.difference = std::max(all.difference, line.difference);
      all.seconds += line.seconds;
      all.freefem_seconds += line.freefem_seconds;
      if (line.contact != "same" && all.contact.find("other") == std::string::npos)
        all.contact = line.contact;
    }
  }
  all.what = fmt::format("{}, {} runs of {} to h = 1/{}", method.name(), 5 * meshes,
                         method.script().substr(0, 2), cells);
  return all;
}

std::string same_set(const Solution& ours, const Eigen::VectorXd& force) {
  int disagree = 0;
  for (Eigen::Index i = 0; i < force.size(); ++i) disagree += ours.active[i] != (force(i) != 0);
  return disagree == 0 ? "same" : fmt::format("{} others", disagree);
}

/// The same with friction: where a force is at its bound, nothing holds.
std::string same_zones(const VariationalInequality& problem, const Solution& ours,
                       Eigen::VectorXd force) {
  for (Eigen::Index i = 0; i < force.size(); ++i)
    if (std::abs(force(i)) >= (1 - 1e-9) * problem.bounds.force_limit(i)) force(i) = 0;
  return same_set(ours, force);
}

/// The beam, both integrations, at epsilon = 1e-4.
std::vector<Line> beams(int cells, const std::filesystem::path& out) {
  freefem::run("25_beam",
               {"-cells", std::to_string(cells), "-epsilon", "1e-4", "-out", out / "freefem"});
  const freefem::ScriptTable nodes = freefem::read_table(out / "freefem" / "beam.csv"),
                             summary = freefem::read_table(out / "freefem" / "summary.csv", 1);
  std::vector<Line> lines;
  for (const bool full : {true, false}) {
    Beam beam;
    beam.cells = cells;
    beam.shear = full ? ShearIntegration::full : ShearIntegration::reduced;
    const Solution ours = active_set(assemble(beam));
    const std::string name = full ? "full" : "reduced";
    const Eigen::VectorXd w = ours.u(Eigen::seqN(0, cells + 1, 2));
    lines.push_back(
        {"25_beam",
         fmt::format("{} integration, {} cells, epsilon = {:g}", name, cells, beam.epsilon),
         summary.names.at(full ? 1 : 0), static_cast<int>(ours.u.size()),
         (w - nodes.column("w_" + name)).cwiseAbs().maxCoeff() / w.cwiseAbs().maxCoeff(),
         same_set(ours, nodes.column("force_" + name).segment(1, cells - 1)), ours.seconds.total(),
         summary.column("seconds")(full ? 1 : 0)});
  }
  return lines;
}

/// Nearly incompressible elasticity, lambda = 1e8, the elements that both sides have; `friction`:
/// with chapter 30's.
std::vector<Line> elasticity(int cells, bool friction, const std::filesystem::path& out) {
  const TriangleMesh mesh = with_free_sides(structured_mesh(cells, Domain{0}));
  PlaneStrain scene;
  scene.gap = [](double x) { return (x - 0.5) * (x - 0.5); };
  if (friction)
    scene.friction = [](double x) { return std::max(0.0, 0.2 - 5 * (x - 0.5) * (x - 0.5)); };
  const std::string script = friction ? "30_friction" : "26_elasticity";
  freefem::run_elastic(script, mesh, scene.epsilon, out / "freefem");
  std::vector<Line> lines;
  const auto add = [&](const std::string& name, const std::string& what, const Element& in_x,
                       const Element& in_y) {
    const Space x(mesh, in_x), y(x, in_y);
    scene.jump_weight = name == "P1nc" ? 1 : 0;
    const VariationalInequality problem = assemble(scene, {x, y});
    const Solution ours = active_set(problem);
    const freefem::ElasticAnswer theirs =
        (friction ? freefem::friction_answer : freefem::elastic_answer)(out / "freefem", name,
                                                                        {x, y});
    lines.push_back(
        {script, fmt::format("{}, h = 1/{}, lambda = {:g}", what, cells, 1 / scene.epsilon),
         theirs.road, static_cast<int>(ours.u.size()),
         (ours.u - theirs.u).cwiseAbs().maxCoeff() / ours.u.cwiseAbs().maxCoeff(),
         same_zones(problem, ours, theirs.force), ours.seconds.total(), theirs.seconds});
  };
  add("P1", "P1 and P1, locked", p1(), p1());
  add("P1nc", "CR and CR with jumps", crouzeix_raviart(), crouzeix_raviart());
  add("KS", "P1 and CR", p1(), crouzeix_raviart());
  return lines;
}

/// The coating at t = 1e-3 on an unstructured mesh, the elements that both sides have.
std::vector<Line> coated(int cells, const std::filesystem::path& out) {
  const TriangleMesh mesh = with_free_sides(unstructured_mesh(cells));
  Coating scene;
  scene.thickness = 1e-3;
  scene.gap = [](double x) { return (x - 0.5) * (x - 0.5); };
  freefem::run_elastic("32_coating", mesh, scene.thickness, out / "freefem");
  std::vector<Line> lines;
  const Element &one = p1(), &cr = crouzeix_raviart();
  using Row = std::tuple<std::string, const Element*, const Element*>;
  for (const auto& [name, in_x, in_y] :
       {Row{"P1", &one, &one}, {"P1nc", &cr, &cr}, {"KS", &one, &cr}, {"P2", &p2(), &p2()}}) {
    const Space x(mesh, *in_x), y(x, *in_y);
    const VariationalInequality problem = assemble(scene, {x, y});
    const Solution ours = active_set(problem);
    const freefem::ElasticAnswer theirs = freefem::elastic_answer(out / "freefem", name, {x, y});
    lines.push_back({"32_coating",
                     fmt::format("{} and {}, h = 1/{}, t = {:g}", in_x->name(), in_y->name(), cells,
                                 scene.thickness),
                     theirs.road, static_cast<int>(ours.u.size()),
                     (ours.u - theirs.u).cwiseAbs().maxCoeff() / ours.u.cwiseAbs().maxCoeff(),
                     same_zones(problem, ours, theirs.force), ours.seconds.total(),
                     theirs.seconds});
  }
  return lines;
}

/// The plate at t = 1e-4, the elements that both sides have: w at the unknowns of the deflection.
std::vector<Line> plates(int rings, const std::filesystem::path& out) {
  const TriangleMesh mesh = disc_mesh(rings);
  const Plate plate{.thickness = 1e-4};
  freefem::run_plate(mesh, 1e-8, out / "freefem");
  std::vector<Line> lines;
  const auto add = [&](const std::string& name, const std::string& what, const Element& in_w,
                       const Element& in_theta, ShearRule shear) {
    const Space w(mesh, in_w), theta(w, in_theta);
    const Solution ours = active_set(assemble(plate, {w, {theta, theta}, shear}));
    const freefem::PlateAnswer theirs = freefem::plate_answer(out / "freefem", name, w);
    const Eigen::VectorXd deflection = ours.u.head(w.size());
    int disagree = 0, bound = 0;
    for (int i = 0; i < w.size(); ++i) {
      if (std::binary_search(w.dirichlet_dofs().begin(), w.dirichlet_dofs().end(), i)) continue;
      disagree += ours.active[bound++] != (theirs.force(i) != 0);
    }
    lines.push_back(
        {"27_plate", fmt::format("{}, {} rings, t = {:g}", what, rings, plate.thickness),
         theirs.road, static_cast<int>(ours.u.size()),
         (deflection - theirs.w).cwiseAbs().maxCoeff() / deflection.cwiseAbs().maxCoeff(),
         disagree == 0 ? "same" : fmt::format("{} others", disagree), ours.seconds.total(),
         theirs.seconds});
  };
  add("P1", "P1 with exact shear, locked", p1(), p1(), ShearRule::exact);
  add("P1_one", "P1 with one-point shear, locked", p1(), p1(), ShearRule::mean);
  add("Arnold_Falk", "Arnold-Falk", crouzeix_raviart(), p1_bubble(), ShearRule::mean);
  return lines;
}

/// FreeFEM with the plain sum: shown, not asked to agree.
Line plain_sum(const Compared& method, double epsilon, int cells,
               const std::filesystem::path& out) {
  const Space space(make_mesh(method, cells), element(method.element));
  Line line;
  try {
    line = solve_both("plain sum", method.script(), space, epsilon, out, {"-stiff", "sum"}).line;
    line.what = fmt::format("{}, epsilon = {:g}", method.name(), epsilon);
  } catch (const Error& error) {
    line = {"plain sum", fmt::format("{}, epsilon = {:g}: no answer", method.name(), epsilon),
            "sum",       space.size(),
            0,           "-"};
    line.difference = std::numeric_limits<double>::infinity();
  }
  line.bound = std::numeric_limits<double>::infinity();
  return line;
}

/// The scripts that write numbers and no solution. Coarser meshes where a script solves many
/// problems on one.
std::vector<Line> numbers(int cells, const std::filesystem::path& out) {
  std::vector<Line> lines;
  const auto add = [&](const std::string& tutorial, const std::string& what,
                       const freefem::Numbers& n) {
    lines.push_back({tutorial, what, n.road.empty() ? "-" : n.road, n.unknowns, n.difference(), "-",
                     n.seconds, n.freefem_seconds});
  };
  const std::filesystem::path folder = out / "freefem";
  const int half = std::max(4, cells / 2);
  add("09_convergence",
      "P1 and CR structured, h = 1/8, 5 epsilons: error at the unknowns, P1 on h = 1/32 for the "
      "truth",
      freefem::errors_at_unknowns(folder));
  add("00_string_on_an_obstacle", fmt::format("{} cells: u, contact force, energy", cells),
      freefem::string_on_an_obstacle(cells, folder));
  add("03_by_hand", "P1 structured, h = 1/8, no varf: u, energy",
      freefem::by_hand(8, 1e-6, folder));
  for (const char* e : {"P1", "CR"})
    add("18_roundoff",
        fmt::format("{} structured, h = 1/{}, 17 epsilons to 1e-16: energy, largest u", e, half),
        freefem::roundoff(e, half, folder));
  add("23_effects",
      fmt::format("eight scenes, h = 1/{}, epsilon = 0.01: energy, least and largest u, how many "
                  "in contact",
                  cells),
      freefem::effects(cells, 1e-2, folder));
  add("07_kernel",
      fmt::format("P1 by ties to h = 1/{}, P1 and CR by rank at h = 1/4, both meshes: dimensions",
                  half),
      freefem::kernels(half, folder));
  add("11_propositions",
      fmt::format("P1, CR, both meshes, h = 1/{}, 9 epsilons: distance to the limit", half),
      freefem::limits(half, folder));
  const std::vector<freefem::Numbers> errors = freefem::worst_errors(folder);
  for (const int i : {0, 1})
    add("13_uniform",
        fmt::format("{} structured, h = 1/8, 6 epsilons: worst H1 error against P1 on h = 1/32",
                    i == 0 ? "P1" : "CR"),
        errors[i]);
  add("20_order_h",
      "P1 and CR structured, h = 1/8, 6 epsilons: energy norm of the error, P1 on h = 1/32 for the "
      "truth",
      freefem::energy_errors(folder));
  add("15_promises",
      fmt::format("P1 and CR unstructured, h = 1/{}, 13 epsilons to 1e-6: largest u on Gamma_C",
                  half),
      freefem::estimates(half, folder));
  add("19_certificate",
      fmt::format("P1 and CR unstructured, h = 1/{}, 5 epsilons: bracket, certified bound", half),
      freefem::certificate(half, folder));
  add("12_contact_sets",
      "P1 structured, h = 1/8: distances to K_h and K_0h of a solution on h = 1/32",
      freefem::contact_sets(folder));
  const std::vector<freefem::Numbers> degrees = freefem::degrees(half, folder);
  for (const int i : {0, 1})
    add("16_degree",
        fmt::format("P{} unstructured, h = 1/{}, epsilon = 0.01: cost of a ridge, ridge, energy",
                    i + 1, half),
        degrees[i]);
  add("17_families_of_loads",
      "P1 structured, h = 1/8, 4 epsilons: worst load of the ball against P1 on h = 1/32",
      freefem::worst_loads(8, folder));
  add("28_mixed",
      fmt::format("boxes, MINI, Taylor-Hood, h = 1/{}, epsilon = 1e-6: u, contact force", half),
      freefem::mixed(half, 1e-6, folder));
  const std::vector<freefem::Numbers> layers = freefem::graded_layers(half, folder);
  for (const int i : {0, 1})
    add("31_hp",
        fmt::format("P{} on 4 layers, h = 1/{}, epsilon = 1 and 0.01: largest u on Gamma_C, "
                    "contact, energy",
                    i + 1, half),
        layers[i]);
  add("33_your_own_problem",
      fmt::format("two glued strings, {} and {} cells, 13 epsilons to 1e-12: energy, largest u, "
                  "contact force",
                  cells, cells + 1),
      freefem::glued_strings(cells, folder));
  add("34_solving_the_inequality",
      fmt::format("P1 structured, h = 1/{}, 4 epsilons, proximal Galerkin: largest u on Gamma_C, "
                  "contact force",
                  half),
      freefem::proximal_steps(half, folder));
  add("35_interior_penalty",
      fmt::format("P1dc unstructured, h = 1/{}, epsilon = 0.01, whole jump and mean: u, slopes, "
                  "contact force",
                  half),
      freefem::interior_penalty(half, 1e-2, folder));
  add("38_order_two",
      fmt::format("BDM1 unstructured, h = 1/{}, epsilon = 0, no obstacle: means of u, stresses "
                  "and their derivatives",
                  half),
      freefem::mixed_bdm1(half, 0, folder));
  add("39_three_dimensions",
      "P1 on tetrahedra, h = 1/8, cut cubes at epsilon = 1e-6 and gmsh's mesh at 0.01: u, contact "
      "forces, energy",
      freefem::three_dimensions(8, folder));
  return lines;
}

/// The paper's Uzawa step by step, CG in each step on both sides; the largest difference of a step
/// in the gap.
Line uzawa_steps(double epsilon, double rho, const std::filesystem::path& out) {
  const Space space(structured_mesh(16), p1());
  UzawaOptions options;
  options.step_length = rho;
  options.tolerance = 1e-8;
  const Solution ours = uzawa_cg_ilut(problem_on(space, epsilon), options);
  const auto steps = static_cast<Eigen::Index>(ours.history.size());
  const freefem::History theirs =
      freefem::uzawa_history(space, epsilon, rho, static_cast<int>(steps), out / "freefem");
  if (theirs.change.size() != steps) throw Error("history.csv: other steps than the library's");
  const Eigen::VectorXd difference =
      theirs.change - Eigen::Map<const Eigen::VectorXd>(ours.history.data(), steps);
  return {"04_reference_solution",
          fmt::format(
              "P1 structured, h = 1/16, epsilon = {:g}, the paper's Uzawa: every one of {} steps",
              epsilon, steps),
          theirs.road,
          space.size(),
          difference.cwiseAbs().maxCoeff(),
          "-",
          ours.seconds.total(),
          theirs.seconds};
}

/// The scenes against the strong problem: the worst of u and energy; not the bound of two equal
/// discrete problems.
std::vector<Line> models(const std::filesystem::path& out) {
  std::vector<Line> lines;
  for (const freefem::SceneCheck& c : freefem::model_check(out / "freefem")) {
    Line line{"model_check", fmt::format("{}: {}", c.scene, c.problem), "(22), P2",
              c.unknowns,    std::max(c.difference, c.energy),          "-",
              c.seconds};
    line.bound = freefem::model_bound;
    lines.push_back(line);
  }
  return lines;
}

std::vector<Line> compare_all(int cells, double epsilon, const std::filesystem::path& out) {
  std::vector<Line> lines{meshes(cells, out)};
  {
    const Space space(structured_mesh(2 * cells), p1());
    Line line = solve_both("04_reference_solution", "04_reference_solution", space, epsilon, out,
                           {"-solver", "condensed"}, true)
                    .line;
    line.what = fmt::format("P1 structured, h = 1/{}, condensed Uzawa", 2 * cells);
    lines.push_back(line);
  }
  lines.push_back(uzawa_steps(1, 0.37, out));
  lines.push_back(uzawa_steps(0.1, 1.4, out));
  const std::vector<Compared> methods{{"P1", true}, {"P1", false}, {"CR", true}, {"CR", false}};
  for (const Compared& method : {methods[0], methods[1], methods[3]}) {
    const Space space(make_mesh(method, cells), element(method.element));
    Both both = solve_both(method.script(), method.script(), space, epsilon, out);
    both.line.what = fmt::format("{}, h = 1/{}", method.name(), cells);
    lines.push_back(both.line);
    if (method.element != "CR") continue;
    Line corrected =
        solve_both(method.script(), method.script(), space, epsilon, out, {"-stiff", "penalty"})
            .line;
    corrected.what = both.line.what + ", the other road";
    lines.push_back(corrected);
    // Figure 8 twice, and the difference on its own scale
    write_vtu(out / "figure8_cpp.vtu", space, both.ours.u);
    write_vtu(out / "figure8_freefem.vtu", space, both.theirs.u);
    write_vtu(out / "figure8_difference.vtu", space, both.theirs.u - both.ours.u);
  }
  for (const Compared& method : methods) lines.push_back(study(method, cells, out));
  for (const Line& line : numbers(cells, out)) lines.push_back(line);
  for (const Line& line : beams(2 * cells, out)) lines.push_back(line);
  for (const bool friction : {false, true})
    for (const Line& line : elasticity(cells, friction, out)) lines.push_back(line);
  for (const Line& line : coated(cells / 2, out)) lines.push_back(line);
  for (const Line& line : plates(cells / 2, out)) lines.push_back(line);
  for (const Line& line : models(out)) lines.push_back(line);
  for (const double e : {1e-2, 1e-4, 1e-6, 1e-8})
    lines.push_back(plain_sum(methods[3], e, cells, out));
  return lines;
}

}  // namespace

int main(int argc, char** argv) {
  int cells = 32;
  double epsilon = 1e-6;
  std::filesystem::path out = "results/freefem/compare";
  std::filesystem::path table;
  CLI::App line("The C++ library against FreeFEM, tutorial by tutorial", "compare");
  line.add_option("--cells", cells, "cells per unit side, h = 1/cells")->check(CLI::Range(4, 128));
  line.add_option("--epsilon", epsilon, "of the tutorials 04, 05, 06 and 08")
      ->check(CLI::Range(1e-7, 1.0));
  line.add_option("--out", out, "folder of the results");
  line.add_option("--table", table, "file of the table for README (default: OUT/results.md)");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;
  if (table.empty()) table = out / "results.md";
  try {
    freefem::check();  // before anything runs
    const std::vector<Line> lines = compare_all(cells, epsilon, out);
    freefem::write_files(lines, epsilon, out, table);
    fmt::print("{}", freefem::markdown(lines, epsilon));
    const bool all =
        std::all_of(lines.begin(), lines.end(), [](const Line& l) { return l.holds(); });
    fmt::print("VERDICT {}: C++ and FreeFEM agree to {:.0e} on every line, the model to {:.0e}\n",
               all ? "holds" : "FAILS", freefem::bound, freefem::model_bound);
    return delivered(all ? 0 : 1, "compare");
  } catch (const std::exception& error) {
    fmt::print(stderr, "compare: {}\n", error.what());
    return 2;
  }
}

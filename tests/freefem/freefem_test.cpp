// The C++ library and FreeFEM, run live on identical meshes, agree: forms, load, linear and contact
// solutions. Unknowns are matched by coordinate. Where FreeFEM is missing every test here fails
// with the line that says so.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "antilock/analysis/worst_load.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/solve/summed.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "cross_check.hpp"
#include "model_check.hpp"
#include "numbers.hpp"
#include "runner.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock {
namespace {

using namespace test;
struct Setting {
  const char* element;
  bool structured;
  std::string name() const {
    return std::string(element) + (structured ? "Structured" : "Unstructured");
  }
  TriangleMesh mesh(int cells) const {
    return structured ? structured_mesh(cells) : unstructured_mesh(cells);
  }
  const char* script() const {
    if (std::string(element) == "CR") return "08_crouzeix_raviart";
    return structured ? "05_p1_structured" : "06_p1_unstructured";
  }
  bool locks() const { return std::string(element) == "P1" && !structured; }
};
std::ostream& operator<<(std::ostream& out, const Setting& s) { return out << s.name(); }
const Setting settings[] = {{"P1", true}, {"P1", false}, {"CR", true}, {"CR", false}};

double largest(const SparseMatrix& a) {
  return Eigen::Map<const Eigen::VectorXd>(a.valuePtr(), a.nonZeros()).cwiseAbs().maxCoeff();
}

class FreeFemForms : public ::testing::TestWithParam<Setting> {};

// Relative to the largest entry: entries are sums of a few products, each with a round-off or two
// (1e-16), and the coordinates carry all digits; 1e-12 leaves room for nothing but that.
TEST_P(FreeFemForms, MatricesAndLoadAgreeEntryByEntry) {
  const Space space(GetParam().mesh(16), element(GetParam().element));
  const VariationalInequality ours = stiff_problem(space, 1);
  const SparseMatrix a0 = ours.b.transpose() * ours.m.asDiagonal() * ours.b;
  const TemporaryFolder folder;
  const freefem::Discretisation theirs = freefem::assemble(space, folder.path());

  EXPECT_LE(largest(SparseMatrix(ours.a1 - theirs.a1)), 1e-12 * largest(ours.a1));
  EXPECT_LE(largest(SparseMatrix(a0 - theirs.a0)), 1e-12 * largest(a0));
  EXPECT_LE((ours.load - theirs.load).cwiseAbs().maxCoeff(),
            1e-12 * ours.load.cwiseAbs().maxCoeff());
  EXPECT_EQ(ours.dirichlet_dofs, theirs.clamped);
  EXPECT_EQ(ours.bounds.unknowns, theirs.contact);
}
INSTANTIATE_TEST_SUITE_P(FreeFem, FreeFemForms, ::testing::ValuesIn(settings),
                         [](const auto& info) { return info.param.name(); });

class Solutions : public ::testing::TestWithParam<std::tuple<Setting, double>> {};

// Both sides stop their corrections at a relative change of 1e-10 or less.
TEST_P(Solutions, WithoutContactAgree) {
  const auto [setting, epsilon] = GetParam();
  const Space space(setting.mesh(16), element(setting.element));
  const VariationalInequality problem = assemble(Scene({paper_load}, StiffLayer{epsilon}), space);
  const Solution ours = active_set(problem);
  const TemporaryFolder folder;
  const auto theirs =
      freefem::solve(setting.script(), space, epsilon, folder.path(), {"-contact", "off"});
  const auto comparison = freefem::compare(space, problem, ours, theirs);
  EXPECT_LE(comparison.difference, 1e-9);
  EXPECT_LE(comparison.energy, 1e-10);
}

// The solutions agree to the solvers' tolerances times the amplification of the corrections; energy
// is quadratic around the solution, hence its smaller bound.
TEST_P(Solutions, WithContactAgreeInValuesContactSetAndEnergy) {
  const auto [setting, epsilon] = GetParam();
  const Space space(setting.mesh(16), element(setting.element));
  const VariationalInequality problem = stiff_problem(space, epsilon);
  const Solution ours = active_set(problem);
  const TemporaryFolder folder;
  const auto theirs = freefem::solve(setting.script(), space, epsilon, folder.path());
  const auto comparison = freefem::compare(space, problem, ours, theirs);
  EXPECT_LE(comparison.difference, 1e-8);
  EXPECT_LE(comparison.energy, 1e-10);
  // P1 has dependent rows of B: at epsilon = 0 the saddle point matrix is singular, and the script
  // says so
  EXPECT_EQ(theirs.road,
            epsilon == 0 && std::string(setting.element) == "P1" ? "penalty" : "mixed");
  if (setting.locks() && epsilon <= 1e-6) {
    // The layer does not move: every gap is 0 to the tolerance of 1e-10 times the largest |u|, with
    // or without a contact force (at epsilon = 0 exactly, and the forces are not unique), so there
    // is no contact set to compare.
    EXPECT_LE(ours.u(problem.bounds.unknowns).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LE(theirs.gap.cwiseAbs().maxCoeff(), 1e-9);
  } else {
    EXPECT_EQ(comparison.contact_disagree, 0);
  }
}
INSTANTIATE_TEST_SUITE_P(FreeFem, Solutions,
                         ::testing::Combine(::testing::ValuesIn(settings),
                                            ::testing::Values(1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0)),
                         [](const auto& info) {
                           const double epsilon = std::get<1>(info.param);
                           const std::string power =
                               epsilon == 0
                                   ? "0"
                                   : "1eMinus" + std::to_string(std::lround(-std::log10(epsilon)));
                           return std::get<0>(info.param).name() + power;
                         });

// The plain sum A1 + epsilon^-2 A0, as FreeFEM users write it (stiff = "sum"), or FreeFEM's own
// split form ("mixed"), against the split form here.
struct Against {
  freefem::Comparison comparison;
  double residual;
};
Against against_ours(const Setting& setting, double epsilon, const std::string& stiff) {
  const Space space(setting.mesh(16), element(setting.element));
  const VariationalInequality problem = stiff_problem(space, epsilon);
  const TemporaryFolder folder;
  const auto theirs =
      freefem::solve(setting.script(), space, epsilon, folder.path(), {"-stiff", stiff});
  return {freefem::compare(space, problem, active_set(problem), theirs), theirs.residual};
}

// epsilon^-2 = 1e4 costs four of sixteen digits, the condition number of the rest three or so more.
TEST(PlainSum, IsRightWhileEpsilonIsLarge) {
  for (const Setting& setting : settings)
    for (const double epsilon : {1.0, 1e-1, 1e-2}) {
      const Against sum = against_ours(setting, epsilon, "sum");
      EXPECT_LE(sum.comparison.difference, 1e-9) << setting << " " << epsilon;
      EXPECT_EQ(sum.comparison.contact_disagree, 0) << setting << " " << epsilon;
    }
}

// Beside the split form, which does not drift: the difference of the sum is 4e7 to 5e9 times as
// large, its residual 3e8 to 9e10 times (measured with seven kernels of OpenBLAS). Which share of
// the 2e-4 that the sum rounds away shows in u is chance. Locked P1 is spared: its answer on the
// layer is 0, which no round-off can spoil.
TEST(PlainSum, DriftsAtThePapersEpsilon) {
  for (const Setting& setting : settings) {
    if (setting.locks()) continue;
    const Against sum = against_ours(setting, 1e-6, "sum"),
                  split = against_ours(setting, 1e-6, "mixed");
    EXPECT_GE(sum.comparison.difference / split.comparison.difference, 1e6) << setting;
    EXPECT_GE(sum.residual / split.residual, 1e6) << setting;  // and its residual says so
  }
}

TEST(PlainSum, HasNothingLeftAtEpsilon1eMinus8) {
  for (const Setting& setting : settings) {
    if (setting.locks()) continue;
    try {
      EXPECT_GE(against_ours(setting, 1e-8, "sum").residual, 1e-2) << setting;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("lost its digits"), std::string::npos)
          << error.what();
    }
  }
}

// Scripts that write numbers and no solution: each number against the library's on the same mesh.
void expect_same(const freefem::Numbers& numbers, double bound) {
  EXPECT_FALSE(numbers.all.empty());
  for (const freefem::Number& n : numbers.all)
    EXPECT_LE(n.difference(), bound) << n.name << ", here " << n.ours << ", there " << n.theirs;
}

// 18_roundoff: UMFPACK adds no tolerance of its own, so the drift follows the digits that the sum
// has lost, a small multiple of 1e-16 epsilon^-2, until nothing is left at 1e-8; the split form,
// the cure, does not see epsilon at all.
TEST(PlainSum, LosesTheDigitsThatTheSplitFormKeeps) {
  for (const char* element : {"P1", "CR"}) {
    const TemporaryFolder folder;
    expect_same(freefem::roundoff(element, 16, folder.path()),
                1e-10);  // the split form, here and there
    const freefem::ScriptTable table = freefem::read_table(folder / "results.csv", 1);
    const Eigen::VectorXd epsilon = table.column("epsilon"),
                          difference = table.column("difference");
    ASSERT_EQ(epsilon.size(), 17);
    EXPECT_LT(table.column("residual_split").maxCoeff(), 1e-12) << element;
    EXPECT_LT(table.column("difference_penalty").maxCoeff(), 1e-11)
        << element;  // the corrections' own tolerance
    for (Eigen::Index k = 0; k < epsilon.size(); ++k) {
      const double lost = 1e-16 / (epsilon(k) * epsilon(k));
      if (epsilon(k) > 3e-7) {
        EXPECT_LT(difference(k), 1e4 * lost)
            << element << " at " << epsilon(k);  // 1e4: condition of A1 on 1/h = 16
      }
      if (epsilon(k) < 3e-6) {
        EXPECT_GT(difference(k), 1e-6) << element << " at " << epsilon(k);
      }
      if (epsilon(k) < 3e-8) {
        EXPECT_GT(difference(k), 0.1) << element << " at " << epsilon(k) << ": garbage";
      }
    }
  }
}

// Both roads on the other side: the saddle point as it stands, and corrections of a penalised
// problem.
TEST(Roads, MixedAndPenaltyAgreeWithTheLibrary) {
  for (const Setting& setting : settings) {
    const Space space(setting.mesh(16), element(setting.element));
    const VariationalInequality problem = stiff_problem(space, 1e-4);
    const Solution ours = active_set(problem);
    for (const char* road : {"mixed", "penalty"}) {
      const TemporaryFolder folder;
      const auto theirs =
          freefem::solve(setting.script(), space, 1e-4, folder.path(), {"-stiff", road});
      EXPECT_EQ(theirs.road, road);
      EXPECT_LE(freefem::compare(space, problem, ours, theirs).difference, 1e-8)
          << setting << " " << road;
    }
  }
}

// Condensed on Gamma_C, on the other side: its own stop is a step in the gap of 1e-11.
TEST(FreeFemUzawa, CondensedFindsTheActiveSetsSolution) {
  const Space space(structured_mesh(16), p1());
  const VariationalInequality problem = stiff_problem(space, 1e-6);
  const TemporaryFolder folder;
  const auto theirs =
      freefem::solve("04_reference_solution", space, 1e-6, folder.path(), {"-solver", "condensed"});
  const auto comparison = freefem::compare(space, problem, active_set(problem), theirs);
  EXPECT_LE(comparison.difference, 1e-8);
  EXPECT_EQ(comparison.contact_disagree, 0);
  EXPECT_GE(theirs.steps, 100);  // it crawls
}

// The paper's algorithm with the paper's linear solver (CG preconditioned by ILUT here, by the
// diagonal there), the same rho: the same iterates. A step in the gap is relative to the
// largest |u|, which CG knows to about 1e-10 of itself.
TEST(FreeFemUzawa, ThePapersOwnTakesTheSameSteps) {
  const Space space(structured_mesh(16), p1());
  for (const auto& [epsilon, rho] : {std::pair{1.0, 0.37}, std::pair{0.1, 1.4}}) {
    UzawaOptions options;
    options.step_length = rho;
    options.tolerance = 1e-8;  // well above that noise
    const Solution ours = uzawa_cg_ilut(stiff_problem(space, epsilon), options);
    ASSERT_GE(ours.history.size(), 30u);
    const TemporaryFolder folder;
    const auto steps = static_cast<Eigen::Index>(ours.history.size());
    const freefem::History theirs =
        freefem::uzawa_history(space, epsilon, rho, static_cast<int>(steps), folder.path());
    ASSERT_EQ(theirs.change.size(), steps) << epsilon;
    for (Eigen::Index k = 0; k < steps; ++k)
      EXPECT_NEAR(theirs.change(k), ours.history[static_cast<std::size_t>(k)], 1e-9)
          << "step " << k;
  }
}

// ---- the other members of the class

class Beams : public ::testing::TestWithParam<double> {};

// The same rows of B on both sides. With a penalty of 1e-8 both lose up to eight digits in the
// stress and none in u; contact sets are equal, forces agree to what the condition number of 32
// cells leaves.
TEST_P(Beams, AgreeInDeflectionForceAndEnergyForBothIntegrations) {
  const TemporaryFolder folder;
  freefem::run("25_beam",
               {"-cells", "32", "-epsilon", std::to_string(GetParam()), "-out", folder.path()});
  const freefem::ScriptTable nodes = freefem::read_table(folder / "beam.csv"),
                             summary = freefem::read_table(folder / "summary.csv", 1);
  for (const bool full : {false, true}) {
    Beam beam;
    beam.cells = 32;
    beam.epsilon = GetParam();
    beam.shear = full ? ShearIntegration::full : ShearIntegration::reduced;
    const VariationalInequality problem = assemble(beam);
    const Solution ours = active_set(problem);
    const Eigen::VectorXd w = nodes.column(full ? "w_full" : "w_reduced"),
                          force = nodes.column(full ? "force_full" : "force_reduced");
    ASSERT_EQ(w.size(), 33);
    for (int i = 0; i <= 32; ++i)
      EXPECT_NEAR(w(i), ours.u(2 * i), 1e-9) << "node " << i;  // of a deflection of 1
    for (int i = 1; i < 32; ++i)
      EXPECT_NEAR(force(i), ours.lambda(i - 1), 1e-6 * beam.load) << "node " << i;
    EXPECT_NEAR(summary.column("energy")(full ? 1 : 0) / energy(problem, ours), 1, 1e-9);
  }
}
INSTANTIATE_TEST_SUITE_P(FreeFem, Beams, ::testing::Values(1e-2, 1e-4));

class Plates : public ::testing::TestWithParam<double> {};

// The same discrete problems on the same mesh. P1 is locked at 1e-8, and what is left of it is
// compared too.
TEST_P(Plates, AgreeInDeflectionForceAndEnergyForThreeElements) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = disc_mesh(8);
  freefem::run_plate(mesh, GetParam(), folder.path());
  for (const auto& [name, in_w, in_theta, shear] :
       {std::tuple{"P1", &p1(), &p1(), ShearRule::exact},
        {"P1_one", &p1(), &p1(), ShearRule::mean},
        {"Arnold_Falk", &crouzeix_raviart(), &p1_bubble(), ShearRule::mean}}) {
    SCOPED_TRACE(name);
    const Space w(mesh, *in_w), theta(mesh, *in_theta);
    const VariationalInequality problem =
        assemble(Plate{.thickness = std::sqrt(GetParam())}, PlateSpace{w, {theta, theta}, shear});
    const Solution ours = active_set(problem);
    const freefem::PlateAnswer theirs = freefem::plate_answer(folder.path(), name, w);
    const Eigen::VectorXd deflection = ours.u.head(w.size());
    EXPECT_LT((deflection - theirs.w).cwiseAbs().maxCoeff(),
              1e-8 * deflection.cwiseAbs().maxCoeff());
    EXPECT_NEAR(theirs.force.sum(), ours.lambda.sum(), 1e-6 * 256);
    EXPECT_NEAR(theirs.energy / energy(problem, ours), 1, 1e-7);
  }
}
INSTANTIATE_TEST_SUITE_P(FreeFem, Plates, ::testing::Values(1e-2, 1e-8));

// Both sides stop at corrections of 1e-10 of u; 1e-8 as for the scalar problem.
void expect_same(const freefem::ElasticAnswer& theirs, const Solution& ours) {
  EXPECT_LE(relative_difference(theirs.u, ours.u), 1e-8);
  ASSERT_EQ(theirs.force.size(), ours.lambda.size());
  EXPECT_LE(relative_difference(theirs.force, ours.lambda), 1e-7);
}

class Elasticity : public ::testing::TestWithParam<double> {};

TEST_P(Elasticity, AgreesOnTheSameMeshForEveryElementAndWithTaylorHood) {
  const TriangleMesh mesh = with_free_sides(structured_mesh(16, Domain{0}));
  const TemporaryFolder folder;
  freefem::run_elastic("26_elasticity", mesh, GetParam(), folder.path());
  const double exact = freefem::taylor_hood_force(folder.path());
  struct Row {
    const char* name;
    const Element &x, &y;
    double jumps, percent;  // how far the force is from Taylor-Hood's; infinity: it locks
  };
  for (const Row& row : {Row{"P1", p1(), p1(), 0, HUGE_VAL},
                         Row{"P1nc", crouzeix_raviart(), crouzeix_raviart(), 1, 1},
                         Row{"KS", p1(), crouzeix_raviart(), 0, 1}}) {
    SCOPED_TRACE(row.name);
    const Space x(mesh, row.x), y(mesh, row.y);
    const VariationalInequality problem = assemble(platen(GetParam(), row.jumps), {x, y});
    const Solution ours = active_set(problem);
    const freefem::ElasticAnswer theirs = freefem::elastic_answer(folder.path(), row.name, {x, y});
    expect_same(theirs, ours);
    EXPECT_NEAR(theirs.energy / energy(problem, ours), 1, 1e-8);
    EXPECT_LE(theirs.residual, 1e-10);
    const double percent = 100 * std::abs(ours.lambda.sum() / exact - 1);
    if (std::isfinite(row.percent)) {
      EXPECT_LE(percent, row.percent);
    } else if (GetParam() <= 1e-4) {
      EXPECT_GE(percent, 100);
    }
  }
}
TEST_P(Elasticity, AgreesWithFrictionInTheZonesAndTheForces) {
  const TriangleMesh mesh = with_free_sides(structured_mesh(16, Domain{0}));
  const TemporaryFolder folder;
  freefem::run_elastic("30_friction", mesh, GetParam(), folder.path());
  for (const std::string name : {"P1", "P1nc", "KS"}) {
    SCOPED_TRACE(name);
    const Space x(mesh, name == "P1nc" ? crouzeix_raviart() : p1()),
        y(mesh, name == "P1" ? p1() : crouzeix_raviart());
    PlaneStrain scene = platen(GetParam(), name == "P1nc" ? 1 : 0);
    scene.friction = [](double at) { return std::max(0.0, 0.2 - 5 * (at - 0.5) * (at - 0.5)); };
    const VariationalInequality problem = assemble(scene, {x, y});
    const Solution ours = active_set(problem);
    const freefem::ElasticAnswer theirs = freefem::friction_answer(folder.path(), name, {x, y});
    expect_same(theirs, ours);
    EXPECT_NEAR(theirs.energy / energy(problem, ours), 1,
                1e-8);  // with the work of the friction on both sides
    EXPECT_LE(theirs.residual, 1e-10);
  }
}

// The coating from thick to the limit; unstructured, so that P1 and P2 lock and CR does not.
TEST(FreeFemCoating, AgreesInDisplacementAndForce) {
  const TriangleMesh mesh = with_free_sides(unstructured_mesh(8));
  const Element &one = p1(), &cr = crouzeix_raviart();
  using Row = std::tuple<std::string, const Element*, const Element*>;
  for (const double t : {1.0, 1e-2, 1e-4, 0.0}) {
    const TemporaryFolder folder;
    freefem::run_elastic("32_coating", mesh, t, folder.path());
    for (const auto& [name, in_x, in_y] :
         {Row{"P1", &one, &one}, {"P1nc", &cr, &cr}, {"KS", &one, &cr}, {"P2", &p2(), &p2()}}) {
      SCOPED_TRACE(name + " at t = " + std::to_string(t));
      const Space x(mesh, *in_x), y(mesh, *in_y);
      Coating scene;
      scene.thickness = t;
      scene.gap = parabola;
      ActiveSetOptions options;
      options.penalty = penalty(scene, {x, y});
      const Solution ours = active_set(assemble(scene, {x, y}), options);
      expect_same(freefem::elastic_answer(folder.path(), name, {x, y}), ours);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(FreeFem, Elasticity, ::testing::Values(1.0, 1e-4, 1e-8, 0.0));

class FreeFemMixed : public ::testing::TestWithParam<double> {};

// Boxes, MINI and Taylor-Hood on the same meshes: 1e-8 as for the scalar problem, both sides stop
// at 1e-10 of u.
TEST_P(FreeFemMixed, AgreesInDisplacementAndForce) {
  const TemporaryFolder folder;
  const freefem::Numbers numbers = freefem::mixed(8, GetParam(), folder.path());
  EXPECT_GT(numbers.all.size(), 1000u);
  for (const freefem::Number& n : numbers.all) ASSERT_LE(n.difference(), 1e-8) << n.name;
}
INSTANTIATE_TEST_SUITE_P(FreeFem, FreeFemMixed, ::testing::Values(1.0, 1e-2, 1e-6, 1e-20, 0.0));

TEST(FreeFemScripts, EachRunsOnItsOwnMeshesAndWritesItsFiles) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> scripts{
      {"00_plain", {}},
      {"00_string_on_an_obstacle", {"string.csv", "summary.csv", "string.eps"}},
      {"01_domain", {"mesh.freefem.msh", "before.freefem.msh", "figure1.eps", "figure2.eps"}},
      {"02_meshes",
       {"structured.csv", "unstructured.csv", "structured.freefem.msh", "unstructured.freefem.msh",
        "figure3.eps"}},
      {"03_by_hand", {"solution.csv", "summary.csv", "by_hand.eps"}},
      {"04_reference_solution",
       {"solution.csv", "contact.csv", "summary.csv", "history.csv", "figure4.eps"}},
      {"05_p1_structured", {"solution.csv", "contact.csv", "summary.csv", "solution.eps"}},
      {"06_p1_unstructured", {"solution.csv", "contact.csv", "summary.csv", "solution.eps"}},
      {"08_crouzeix_raviart", {"solution.csv", "contact.csv", "summary.csv", "solution.eps"}},
      {"09_convergence", {"results.csv", "error_against_epsilon.eps"}},
      {"23_effects", {"effects.csv", "scene1.eps", "scene8.eps"}},
      {"07_kernel", {"kernel.csv", "ties_structured.eps", "ties_unstructured.eps"}},
      {"11_propositions", {"limits.csv"}},
      {"13_uniform", {"uniform.csv"}},
      {"15_promises", {"estimates.csv", "lost.eps"}},
      {"19_certificate", {"results.csv"}},
      {"12_contact_sets", {"results.csv"}},
      {"16_degree", {"results.csv"}},
      {"31_hp", {"results.csv"}},
      {"25_beam", {"beam.csv", "summary.csv", "beam.eps"}},
      {"26_elasticity",
       {"P1_x.csv", "P1nc_contact.csv", "KS_summary.csv", "TaylorHood_summary.csv",
        "P1_deformed.eps"}},
      {"27_plate", {"P1.csv", "P1_one_summary.csv", "Arnold_Falk.csv", "P1.eps"}},
      {"28_mixed", {"boxes.csv", "MINI_x.csv", "TaylorHood_y.csv", "summary.csv", "boxes.eps"}},
      {"30_friction",
       {"P1_floor.csv", "KS_summary.csv", "TaylorHood_summary.csv", "TaylorHood_deformed.eps"}},
      {"32_coating",
       {"P1_x.csv", "P1nc_contact.csv", "KS_summary.csv", "P2_summary.csv", "P1_deformed.eps"}},
      {"33_your_own_problem", {"results.csv", "pointwise.eps", "mortar.eps"}},
      {"34_solving_the_inequality", {"results.csv"}},
      {"35_interior_penalty", {"whole.csv", "mean.csv", "summary.csv", "whole.eps", "mean.eps"}},
      {"38_order_two", {"stress.csv", "summary.csv", "u.eps"}},
      {"39_three_dimensions", {"cubes.mesh", "solution.csv", "summary.csv"}},
      {"matrices", {"a1.csv", "a0.csv", "unknowns.csv"}}};
  for (const auto& [script, files] : scripts) {
    const TemporaryFolder folder;
    std::vector<std::string> options{"-cells", "8", "-out", folder.path()};
    if (script == "00_plain") options.clear();
    if (std::any_of(files.begin(), files.end(),
                    [](const std::string& f) { return f.find(".eps") != f.npos; }))
      options.insert(options.end(), {"-plot", "eps"});
    ASSERT_NO_THROW(freefem::run(script, options)) << script;
    for (const std::string& file : files)
      EXPECT_TRUE(std::filesystem::exists(folder / file)) << script << " " << file;
  }
}

// A script reads from top to bottom: one include, and no macro around the program.
TEST(FreeFemScripts, AreReadWithNoOtherFileThanTheOneInclude) {
  int scripts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ANTILOCK_FREEFEM_FOLDER)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".edp" && path.extension() != ".idp") continue;
    scripts += path.extension() == ".edp";
    std::ifstream in(path);
    int lines = 0;
    for (std::string line; std::getline(in, line); ++lines) {
      // signs, not bytes: a byte 10xxxxxx goes on with a sign of UTF-8
      const auto signs =
          std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      EXPECT_LE(signs, 120) << path << ", line " << lines + 1;
      EXPECT_EQ(line.find("NewMacro"), std::string::npos) << path;
      EXPECT_EQ(line.find("load \""), std::string::npos) << path << ": a plugin";
      if (line.rfind("include", 0) == 0) {
        EXPECT_EQ(line, "include \"common.idp\"") << path;
      }
    }
  }
  EXPECT_GE(scripts, 25);
}

TEST(FreeFemScripts, WriteTheNumbersOfTheLibrary) {
  const auto same = [](const auto& numbers, double bound) {  // a folder for each script
    const TemporaryFolder folder;
    expect_same(numbers(folder.path()), bound);
  };
  using Path = const std::filesystem::path&;
  // body alone, obstacle, Ventcel, layer, layer and obstacle, thin layer and obstacle
  same([](Path folder) { return freefem::effects(16, 1e-2, folder); }, 1e-10);
  same([](Path folder) { return freefem::certificate(8, folder); }, 1e-10);
  // ||u_h^epsilon - u_h^0||_h of Proposition 1: each side knows u to 1e-10 of its largest value,
  // and so both terms
  same([](Path folder) { return freefem::limits(8, folder); }, 1e-9);
  // P1 and P2, in FreeFEM summed into one matrix: at epsilon = 1e-2 that costs four digits of
  // sixteen, hence 1e-9
  for (const int degree : {0, 1}) {
    same([&](Path folder) { return freefem::degrees(8, folder)[degree]; }, 1e-9);
    same([&](Path folder) { return freefem::graded_layers(6, folder)[degree]; }, 1e-9);
  }
  // the library's corrections stop at 1e-10 and contract by far more than that per step
  for (const double epsilon : {1e-2, 1e-6})
    same([&](Path at) { return freefem::by_hand(8, epsilon, at); }, 1e-10);
  same([](Path folder) { return freefem::estimates(8, folder); }, 1e-9);
  same([](Path folder) { return freefem::contact_sets(folder); }, 1e-9);
  same([](Path folder) { return freefem::errors_at_unknowns(folder); }, 1e-9);
  // summed into one matrix in FreeFEM: at epsilon = 1e-2 that costs four digits of sixteen, at 1
  // none
  for (const double epsilon : {1.0, 1e-2})
    same([&](Path at) { return freefem::interior_penalty(8, epsilon, at); }, 1e-9);
  // the library's corrections stop at 1e-10 of u, and a derivative of the stress divides the error
  // by h^2
  for (const double epsilon : {1.0, 1e-2, 0.0})
    same([&](Path at) { return freefem::mixed_bdm1(8, epsilon, at); }, 1e-7);
  // the library's corrections stop at 1e-10 of u
  same([](Path at) { return freefem::three_dimensions(6, at); }, 1e-10);
  // two ways to integrate the glue (Gauss points here, P1dc there), one bilinear form
  same([](Path folder) { return freefem::glued_strings(16, folder); }, 1e-8);
}

// The string is P1 in one dimension, exact at its nodes; no layer, no correction: round-off alone.
TEST(FreeFemScripts, TheStringIsTheSameAndRight) {
  const TemporaryFolder folder;
  const freefem::Numbers numbers = freefem::string_on_an_obstacle(32, folder.path());
  expect_same(numbers, 1e-11);
  const freefem::ScriptTable summary = freefem::read_table(folder / "summary.csv");
  EXPECT_NEAR(summary.column("force")(0), 16,
              1e-10);  // the closed form; its contact ends are nodes
  EXPECT_NEAR(summary.column("energy")(0), -64.0 / 3 + 1.0 / 48,
              1e-10);  // + q^2 h^2 / 48: what P1 leaves between nodes
  EXPECT_LE(summary.column("difference")(0), 1e-10);  // Uzawa against the active set
}

TEST(FreeFemScripts, KernelsByTiesAndByRankAreTheSame) {
  const TemporaryFolder folder;
  const freefem::Numbers numbers = freefem::kernels(8, folder.path());
  expect_same(numbers, 0);
  EXPECT_EQ(numbers.all.size(), 14u);  // five with ranks, two by ties alone, on either mesh
}

// FreeFEM's adaptivity, guided by a locked solution, leaves the layer alone; by one that is not, it
// refines it; and P1 is locked on both. The truth is 0.0450.
TEST(FreeFemScripts, AdaptmeshDoesNotSeeTheLocking) {
  const TemporaryFolder folder;
  freefem::run("adaptmesh", {"-out", folder.path()});
  const freefem::ScriptTable table = freefem::read_table(folder / "adaptmesh.csv", 1);
  ASSERT_EQ(table.rows.rows(), 14);
  const auto at = [&](const char* name, int row) { return table.column(name)(row); };
  // The share of the vertices that lie in the layer, after six rounds. Measured: 0.015 and 0.120
  // with FreeFEM 4.9, 0.015 and 0.099 with 4.15, whose meshes are other ones.
  const double locked = at("in_layer", 6) / at("vertices", 6),
               free = at("in_layer", 13) / at("vertices", 13);
  EXPECT_LT(locked, 0.05);
  EXPECT_GT(free, 5 * locked);
  EXPECT_LT(std::abs(at("p1", 6)), 1e-6);
  EXPECT_LT(std::abs(at("p1", 13)), 0.01);
  EXPECT_NEAR(at("cr", 13), 0.0450, 5e-4);
}

// ---- the model itself, against what neither side shares

TEST(ModelCheck, EverySceneIsTheStrongProblemOnTheTrueLayer) {
  const TemporaryFolder folder;
  for (const freefem::SceneCheck& check : freefem::model_check(folder.path())) {
    EXPECT_LE(check.difference, freefem::model_bound) << check.scene << " / " << check.problem;
    EXPECT_LE(check.energy, freefem::model_bound) << check.scene << " / " << check.problem;
  }
}

// The check can fail: each mistake is seen in every scene that it touches. On half the cells, a
// quarter of the unknowns: scenes without the mistake are within the same bound there, so what is
// seen is the mistake.
TEST(ModelCheck, SeesALoadInTheLayerAMissingStiffnessAndAnObstacleOnTheWrongSide) {
  for (const std::string mistake : {"load", "stiffness", "obstacle"}) {
    const TemporaryFolder folder;
    for (const freefem::SceneCheck& check : freefem::model_check(folder.path(), mistake, 60)) {
      const bool layer = check.problem.find("layer") != std::string::npos;
      const bool contact = check.problem.find("obstacle") != std::string::npos;
      const bool touched = mistake == "obstacle" ? contact : layer;
      if (touched) {
        EXPECT_GE(check.difference, 5 * freefem::model_bound) << mistake << ": " << check.scene;
      } else {
        EXPECT_LE(check.difference, freefem::model_bound) << mistake << ": " << check.scene;
      }
    }
  }
}

// The beam's limit epsilon = 0, in closed form: contact on [1/3, 2/3], force 5 q / 9,
// energy -3758.4; P1 with reduced integration is O(h) in the force (it sits at nodes) and O(h^2) in
// the energy.
TEST(ModelCheck, TheBeamsLimitIsTheClosedForm) {
  const TemporaryFolder folder;
  freefem::run("25_beam", {"-cells", "192", "-epsilon", "1e-10", "-out", folder.path()});
  const freefem::ScriptTable summary = freefem::read_table(folder / "summary.csv", 1);
  EXPECT_NEAR(summary.column("force")(0), 5 * 5832.0 / 9, 0.01 * 3240);
  EXPECT_NEAR(summary.column("energy")(0), -3758.4, 0.001 * 3758.4);
}

// The worst broken H1 error over epsilon, structured meshes, against P1 on a mesh four times finer;
// and against the truth, from which that is not far: the reference's own error is a quarter of what
// is measured; for P1, nested in it, the squares subtract: sqrt(1 - 1/16) = 0.97. 5 %.
TEST(FreeFemScripts, TheWorstErrorOverEpsilonIsTheSame) {
  const TemporaryFolder folder;
  const std::vector<freefem::Numbers> errors = freefem::worst_errors(folder.path());
  const TriangleMesh mesh = structured_mesh(8);
  const Element* const elements[] = {&p1(), &crouzeix_raviart()};
  for (int i = 0; i < 2; ++i) {
    expect_same(errors[i], 1e-10);
    const Space space(mesh, *elements[i]);
    SceneSweep sweep(stiff_scene(1), space);
    double worst = 0;
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0}) {
      sweep.set_epsilon(epsilon);
      const ExactTable exact(ExactSolution(paper_sine_load(), epsilon, true, 12));
      worst = std::max(worst, measure_errors(space, sweep.solve(), epsilon, reference(exact)).h1);
    }
    EXPECT_NEAR(errors[i].all.back().theirs / worst, 1, 0.05) << errors[i].all.back().name;
  }
}

// The error in the energy norm at each epsilon, structured meshes, against P1 on a mesh four times
// finer; below h |f| times what chapter 20 proves.
TEST(FreeFemScripts, TheEnergyErrorIsTheSame) {
  const TemporaryFolder folder;
  const freefem::Numbers errors = freefem::energy_errors(folder.path());
  expect_same(errors, 1e-10);
  const double unit = std::sqrt(2.0) / 8 * std::sqrt(50.0);
  for (const freefem::Number& error : errors.all)
    EXPECT_LT(error.theirs, (error.name.starts_with("CR") ? 1.7 : 1.3) * unit) << error.name;
}

// The worst load of a ball: power iteration there, Lanczos here, one discrete problem. Power
// iteration stops at a change of 1e-12 of the square; at its slowest, 0.9 per step, 1e-11 is left.
// Against the ball in closed form: the reference's own share in the square is 1/16, as above; 5 %.
// Locked P1 on FreeFEM's own mesh is never below l_1 = 0.10945 less that.
TEST(FreeFemScripts, TheWorstLoadIsTheSame) {
  const TemporaryFolder folder;
  expect_same(freefem::worst_loads(4, folder.path()), 1e-9);
  const freefem::ScriptTable table = freefem::read_table(folder / "worst.csv", 1);
  const Space space(structured_mesh(4), p1());
  ErrorForm form(space, LoadModes(12));
  form.set_epsilon(0);
  EXPECT_NEAR(table.column("worst")(3) / form.worst().error, 1, 0.05);
  EXPECT_GT(table.column("worst")(7), 0.95 * 0.10945);
}

// Locking, in FreeFEM's own words: on its own meshes, P1 stays at 0 on the layer, Crouzeix-Raviart
// does not (truth: 0.0457).
TEST(FreeFemScripts, ShowTheLockingOnTheirOwnMeshes) {
  const auto largest_on_gamma_c = [](const std::string& script) {
    const TemporaryFolder folder;
    freefem::run(script, {"-cells", "16", "-epsilon", "1e-6", "-out", folder.path()});
    return freefem::read_table(folder / "contact.csv").column("gap").maxCoeff();
  };
  EXPECT_LE(largest_on_gamma_c("06_p1_unstructured"), 1e-8);
  EXPECT_NEAR(largest_on_gamma_c("08_crouzeix_raviart"), 0.0457, 0.005);
  EXPECT_NEAR(largest_on_gamma_c("05_p1_structured"), 0.0457, 0.005);
}

/// A variable of the environment for the time of a test.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() { ::unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

std::string message_of(const std::string& script, const std::vector<std::string>& options) {
  return refusal([&] { freefem::run(script, options); });
}

TEST(FreeFemRunner, SaysInOneLineThatFreeFemIsMissingTooOldOrBroken) {
  const TemporaryFolder folder;
  {
    const Environment missing("FREEFEM", "no-such-program");
    EXPECT_EQ(message_of("01_domain", {}),
              "freefem/run: no-such-program is not installed; FreeFEM 4.9 or later is needed "
              "(Debian: apt install "
              "freefem++)");
  }
  const auto program = [&](const char* name, const std::string& version) {
    std::ofstream(folder / name) << "#!/bin/sh\necho '-- FreeFem++ v" + version + " (date)'\n";
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
    return (folder / name).string();
  };
  {
    const Environment old("FREEFEM", program("old", "3.61"));
    EXPECT_EQ(message_of("01_domain", {}),
              "freefem/run: FreeFEM 3.61 is too old; 4.9 or later is needed");
  }
  EXPECT_NO_THROW(freefem::check());
  const Environment broken("FREEFEM", program("broken", "4.11"));  // starts, and solves nothing
  EXPECT_EQ(message_of("--check", {}), "freefem/run: " + (folder / "broken").string() +
                                           " 4.11 starts, but does not solve a small system by "
                                           "UMFPACK; a complete FreeFEM 4.9 or later is needed");
}

// FreeFem-sources #236 and #166: a mesh of gmsh, or anything else that is not FreeFEM's own
TEST(FreeFemRunner, NamesTheFormatOfAMeshThatIsNotFreeFemsOwn) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a mesh.msh").string();
  const auto is_no_mesh = [&](const std::string& text, const std::string& why) {
    std::ofstream(path) << text;
    EXPECT_EQ(message_of("08_crouzeix_raviart", {"-mesh", path}),
              "freefem/run: -mesh " + path + ": " + why +
                  "; accepted: FreeFEM's own format (savemesh; a C++ chapter writes it as "
                  "mesh.freefem.msh)");
  };
  is_no_mesh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "is a MSH file of gmsh");
  is_no_mesh("\xef\xbb\xbf$MeshFormat\r\n4.1 0 8\r\n", "is a MSH file of gmsh");
  for (const std::string& text :
       {std::string(), std::string("MeshVersionFormatted 2\n"), std::string("4 2\n0 0 1\n")})
    is_no_mesh(text, "does not begin with three numbers (of vertices, triangles, edges)");
}

TEST(FreeFemRunner, RefusesBadInputInOneLine) {
  const auto refuses = [](const std::string& script, const std::vector<std::string>& options,
                          const std::string& words) {
    EXPECT_EQ(message_of(script, options), script + ": " + words);
  };
  const std::string p1 = "05_p1_structured", number = "; accepted: a number from 0 to 1";
  refuses(p1, {"-mesh", "/no/such.msh"}, "mesh /no/such.msh cannot be read");
  refuses(p1, {"-epsilon", "2"}, "option -epsilon 2" + number);
  refuses(p1, {"-epsilon", "small"}, "option -epsilon small" + number);
  refuses(p1, {"-epsilon", "1-2"},
          "option -epsilon 1-2" + number);  // atof reads 1 (facebook/openzl #225)
  refuses(p1, {"-epsilon", "1.2.3"}, "option -epsilon 1.2.3" + number);
  refuses(p1, {"-cells", "4.5"}, "option -cells 4.5; accepted: a whole number from 2 to 512");
  refuses(p1, {"-epsilon", ""}, "option -epsilon needs a value");
  refuses(p1, {"-epsilonn", "1"},
          "option -epsilonn means nothing to this script; accepted: -epsilon -cells -mesh -out "
          "-stiff -contact -plot");
  refuses(p1, {"-epsilon"}, "option -epsilon needs a value");
  refuses("08_crouzeix_raviart", {"-stiff", "soft"},
          "option -stiff soft; accepted: mixed penalty sum");
  for (const char* script : {"05_p1_structured", "26_elasticity", "28_mixed"})  // before it writes
    refuses(script, {"-stiff", "sum", "-epsilon", "0", "-out", "."},
            "-stiff sum: epsilon = 0 is accepted by -stiff mixed and penalty only");
  EXPECT_NE(message_of("99_nothing", {}).find("no script 99_nothing"), std::string::npos);
  const Environment nowhere("DISPLAY", "");
  EXPECT_EQ(message_of(p1, {"-plot", "window"}),
            "freefem/run: -plot window: there is no display (DISPLAY is empty); accepted without "
            "one: -plot eps");
}

TEST(Match, GoesByPlaceAndRefusesWhatIsNotOneToOne) {
  Points a(3, 2), b(3, 2);
  a << 0, 0, 1, 0, 0, 1;
  b << 0, 1, 1e-16, 0, 1 - 1e-16, 0;
  EXPECT_EQ(freefem::match(a, b), (std::vector<int>{1, 2, 0}));
  b(0, 1) = 0.9;
  EXPECT_THROW(freefem::match(a, b), Error);
  b.row(0) = b.row(1);
  EXPECT_THROW(freefem::match(a, b), Error);
}

}  // namespace
}  // namespace antilock

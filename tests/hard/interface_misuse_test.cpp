// No quiet wrong answer through any interface: what an ordinary mistake at the programming
// interface comes to. Each of these was once answered with a number, or ended the program.
#include <filesystem>
#include <fstream>

#include "antilock/analysis/worst_load.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/exact/exact_plate.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/table.hpp"
#include "hard/adversary.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::hard::interface_misuse_test {

using namespace test;
double down(double, double) { return -10; }

/// A chain of n unknowns, all of them pulled by 1 and held at 0 by a friction of g.
VariationalInequality rubbing_chain(int n, double g) {
  VariationalInequality problem =
      small_problem(chain(n), Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n));
  problem.bounds.upper = problem.bounds.lower;
  problem.bounds.force_limit = Eigen::VectorXd::Constant(n, g);
  return problem;
}

TEST(InterfaceMisuse, SceneAndMeshAgreeOnTheDepthOfTheLayer) {
  const TriangleMesh unit = structured_mesh(4), flat = structured_mesh(4, {0.25});
  const Space on_unit(unit, p1()), on_flat(flat, p1());
  expect_refused([&] { assemble(Scene(Body{down}, ThinLayer{0.25}), on_unit); },
                 "accepted: y = -0.25");
  expect_refused([&] { assemble(Scene(Body{down}, StiffLayer{0.25}), on_flat); },
                 "accepted: y = -1");
  EXPECT_NO_THROW(assemble(Scene(Body{down}, ThinLayer{0.25}), on_flat));
}

TEST(InterfaceMisuse, FrictionMayBearFarMoreThanTheForces) {
  for (const double g : {10.0, 1e10, 1e15, 1e300}) {
    EXPECT_EQ(active_set(rubbing_chain(5, g)).u.lpNorm<Eigen::Infinity>(), 0) << g;
    VariationalInequality two_sided = rubbing_chain(5, g);
    two_sided.bounds.lower.setConstant(-0.3);
    two_sided.bounds.upper.setConstant(0.4);
    // it ends with a step of 1e-10 |u|, from which the error differs by its contraction
    EXPECT_LT((uzawa(two_sided).u.array() - 0.4).abs().maxCoeff(), 1e-9) << g;
  }
}

TEST(InterfaceMisuse, UzawaKnowsNoUnits) {
  for (const double unit : {1e-300, 1e-100, 1e100, 1e300}) {
    VariationalInequality problem = rubbing_chain(5, 0.3 * unit);
    problem.a1 *= unit;
    problem.load *= unit;
    EXPECT_NEAR(uzawa(problem).u.maxCoeff(), 3.15, 1e-8) << unit;
  }
}

// Rows of B decades apart: on the way to u the mix of the corrections is 1e8 to 1e15 times its
// size.
TEST(InterfaceMisuse, TheWayToAnAnswerMayBeLong) {
  for (const unsigned seed : {454U, 696U, 723U, 914U, 986U, 1132U}) {
    const VariationalInequality problem = random_problem(seed);
    const Judgement judgement = judge(problem, test::exact_answer(problem));
    EXPECT_EQ(judgement.outcome, Outcome::right) << seed << " " << judgement.reason;
  }
}

TEST(InterfaceMisuse, TheSpacesOfOneBodyHaveOneMesh) {
  const TriangleMesh coarse = structured_mesh(2, {0}), fine = structured_mesh(4, {0});
  const Space a(coarse, p1()), b(fine, p1()), c(coarse, p2());
  expect_refused([&] { assemble(PlaneStrain{}, {a, b}); }, "different meshes");
  expect_refused(
      [&] {
        assemble(Plate{}, PlateSpace{a, {b, b}, ShearRule::exact});
      },
      "different meshes");
  expect_refused(
      [&] {
        assemble(Plate{}, PlateSpace{a, {c, a}, ShearRule::mean});
      },
      "one element twice");
}

TEST(InterfaceMisuse, APlateHasALoadAndAnObstacleSomewhere) {
  const Space space(disc_mesh(3), p1());
  const PlateSpace on{space, {space, space}, ShearRule::edges};
  Plate plate;
  plate.gap = [](double, double) { return -infinity; };
  expect_refused([&] { assemble(plate, on); }, "the gap is -inf");
  plate = {};
  plate.load = nullptr;
  expect_refused([&] { assemble(plate, on); }, "empty");
}

TEST(InterfaceMisuse, ExactSolutionsRefuseWhatTheyAreNotFor) {
  for (const double t : {nan, -0.1, infinity})
    expect_refused([&] { ExactPlate exact(t); }, "thickness");
  expect_refused([] { ExactPlate(1e-4, infinity); }, "load");
  expect_refused([] { ExactPlate(1e-4, 256, 1e-300); }, "gap");
  const LoadModes modes(3);
  const Eigen::VectorXd f = Eigen::VectorXd::Ones(modes.size());
  for (const double epsilon : {nan, -1.0, 2.0, infinity})
    expect_refused([&] { modes.response(f, epsilon); }, "epsilon");
  expect_refused([&] { modes.value(f.head(1), 0.5, 0.5); }, "coefficients");
  expect_refused([&] { modes.constant_in_y(4, 1); }, "accepted: 1 to 3");
  expect_refused([] { LoadModes(1000000); }, "accepted: 1 to 4096");
}

TEST(InterfaceMisuse, WorstLoadsAreThoseOfTheUnitSquares) {
  const TriangleMesh mesh = structured_mesh(4);
  TriangleMesh wide = mesh;
  wide.vertices.col(0) *= 2;
  const Space space(mesh, p1()), on_wide(wide, p1());
  expect_refused([&] { ErrorForm(space, LoadModes(80)); }, "80 waves");
  expect_refused([&] { ErrorForm(on_wide, LoadModes(3)); }, "accepted: (0, 1) x (-1, 1)");
  EXPECT_NO_THROW(ErrorForm(space, LoadModes(8)));
}

TEST(InterfaceMisuse, EigenvaluesOfAnySizeAndUnit) {
  const auto times = [](double s) {
    return [s](const Eigen::VectorXd& x) { return Eigen::VectorXd(s * x); };
  };
  for (const Eigen::Index n : {1, 2, 5}) EXPECT_EQ(largest_eigenvalue(times(0), n), 0);
  for (const double s : {1e-300, 1e300}) EXPECT_NEAR(largest_eigenvalue(times(s), 4) / s, 1, 1e-12);
  expect_refused([&] { largest_eigenvalue(times(1), 0); }, "no unknowns");
  expect_refused([&] { largest_eigenvalue(times(nan), 5); }, "not finite");
  SparseMatrix one(1, 1);
  one.insert(0, 0) = 3;
  EXPECT_EQ(largest_eigenvalue(one), 3);
}

TEST(InterfaceMisuse, ErrorsAndEnergiesAreOfTheirOwnSpace) {
  const TriangleMesh mesh = structured_mesh(4);
  const Space affine(mesh, p1()), broken(mesh, crouzeix_raviart());
  const VariationalInequality problem = assemble(Scene(Body{down}, StiffLayer{0.1}), affine);
  const Solution u = active_set(problem);
  antilock::Reference none{[](double x, double) { return x == 0.5 ? nan : 0; },
                           [](double, double) { return Eigen::Vector2d(0, 0); },
                           [](double, double) { return 0.0; }};
  EXPECT_TRUE(std::isnan(measure_errors(affine, u, 0.1, none).max));
  EXPECT_TRUE(std::isnan(measure_errors(affine, u, 0.1, none).max_at_unknowns));
  expect_refused([&] { measure_errors(broken, u, 0.1, none); }, "of this space");
  Solution averaged = u;
  averaged.p.conservativeResize(3);
  expect_refused([&] { measure_errors(affine, averaged, 0.1, none); }, "of this space");
  expect_refused([&] { energy(problem, averaged); }, "of this problem");
  expect_refused([] { slope({1, 0.5, 0.25}, {1, 0.5}); }, "one per width");
}

TEST(InterfaceMisuse, ContactLengthsAreThoseOfTheirBasis) {
  const TriangleMesh mesh = structured_mesh(4);
  for (int degree = 2; degree <= 6;
       ++degree) {  // Newton and Cotes: what the clamped ends of Gamma_C keep
    const double at_end[] = {1.0 / 6, 1.0 / 8, 7.0 / 90, 19.0 / 288, 41.0 / 840};
    const Space space(mesh, lagrange(degree));
    EXPECT_NEAR(contact_lengths(space).sum(), 1 - 2 * 0.25 * at_end[degree - 2], 1e-13) << degree;
    EXPECT_GT(contact_lengths(space).minCoeff(), 0) << degree;
  }
}

TEST(InterfaceMisuse, TablesPassOverNothing) {
  Table table({"h", "e,f"});
  table.add({1, 1});
  table.add({0.5, nan});
  EXPECT_TRUE(std::isnan(table.max("e,f")));
  EXPECT_TRUE(std::isnan(table.min("e,f")));
  expect_refused([] { Table({"a", "b", "a"}); }, "'a' twice");
  Table near({"h", "epsilon", "e"});
  near.add({1, 1.00001e-3, 5});
  near.add({1, 1.00002e-3, 6});
  EXPECT_EQ(near.pivot("h", "epsilon", "e").number("0.00100002"), 6);
  const auto path = std::filesystem::temp_directory_path() / "antilock_misuse.csv";
  table.write(path);
  std::ifstream in(path);
  std::string header;
  std::getline(in, header);
  EXPECT_EQ(header, "h,\"e,f\"");
  std::filesystem::remove(path);
}

}  // namespace antilock::hard::interface_misuse_test

// The module study: tables that are asked by name, methods that make their meshes and spaces,
// sweeps over any problem.
#include "antilock/form/gradient_forms.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::study_test::study_test {

/// error = 3 h^2 for P1 and 5 h for CR, two epsilons.
Table power_laws() {
  Table table({"element", "epsilon", "cells", "h", "error"});
  for (const double epsilon : {1.0, 1e-6})
    for (const int cells : {8, 16, 32, 64}) {
      const double h = 1.0 / cells;
      table.add({"P1", epsilon, cells, h, 3 * h * h});
      table.add({"CR", epsilon, cells, h, 5 * h});
    }
  return table;
}

// A CSV that is written reads back to the same doubles, each as short as it can be; a word with a
// comma is quoted.
TEST(Table, WritesNumbersThatReadBackToTheSameDoubles) {
  const test::TemporaryFolder folder;
  Table table({"what", "number"});
  for (const double number : {0.1, 1 / 3.0, 1e-300, -std::acos(-1.0), 1e-6, 2e9, 0.0, 5e-324})
    table.add({"Uzawa, \"Cholesky\"", number});
  table.write(folder / "table.csv");

  std::string text = "what,number\n";
  for (const std::string number : {"0.1", "0.3333333333333333", "1e-300", "-3.141592653589793",
                                   "1e-06", "2000000000", "0", "5e-324"})
    text += "\"Uzawa, \"\"Cholesky\"\"\"," + number + "\n";
  EXPECT_EQ(test::contents(folder / "table.csv"), text);
  for (const double number : table.numbers("number"))
    EXPECT_EQ(std::strtod(TableEntry(number).text().c_str(), nullptr), number);
}

TEST(Table, SelectsByWordNumberAndCondition) {
  const Table table = power_laws();
  EXPECT_EQ(table.size(), 16);
  const Table p1 = table.filter("element", "P1").filter("epsilon", 1e-6);
  EXPECT_EQ(p1.numbers("cells"), (std::vector<double>{8, 16, 32, 64}));
  EXPECT_EQ(p1.filter("cells", 16).number("error"), 3.0 / 256);
  EXPECT_EQ(table.filter_number("cells", [](double cells) { return cells > 16; }).size(), 8);
  EXPECT_EQ(table.filter("element", "P2").size(), 0);
  EXPECT_EQ(table.unique("element"), (std::vector<TableEntry>{"P1", "CR"}));
  EXPECT_EQ(p1.max("error"), 3.0 / 64);
  EXPECT_EQ(p1.min("error"), 3.0 / 4096);
  EXPECT_EQ(p1.first("error"), p1.max("error"));
  EXPECT_EQ(p1.last("error"), p1.min("error"));
  EXPECT_EQ(p1.select({"h", "cells"}).columns(), (std::vector<std::string>{"h", "cells"}));
  EXPECT_EQ(p1.select({"h", "cells"}).last("cells"), 64);
  ASSERT_EQ(p1.rows().size(), 4u);
  EXPECT_EQ(p1.rows()[1].number("cells"), 16);
}

TEST(Table, FindsTheOrderOfAPowerLaw) {
  const Table table = power_laws();
  EXPECT_NEAR(table.filter("element", "P1").order("error", "h"), 2, 1e-13);
  EXPECT_NEAR(table.filter("element", "CR").order("error", "h"), 1, 1e-13);
  EXPECT_NEAR(table.filter("element", "CR").order("error", "cells"), -1, 1e-13);
  // least squares: what is symmetric about the line does not move it
  Table noisy({"x", "y"});
  for (const auto& [x, y] : {std::pair{1.0, 2.0}, {1.0, 0.5}, {8.0, 128.0}, {8.0, 32.0}})
    noisy.add({x, y});
  EXPECT_NEAR(noisy.order("y", "x"), 2, 1e-13);
  Table bent({"x", "y"});
  for (const auto& [x, y] : {std::pair{1.0, 1.0}, {2.0, 2.0}, {4.0, 16.0}}) bent.add({x, y});
  ASSERT_EQ(bent.pairwise_orders("y", "x").size(), 2u);
  EXPECT_NEAR(bent.pairwise_orders("y", "x")[0], 1, 1e-13);
  EXPECT_NEAR(bent.pairwise_orders("y", "x")[1], 3, 1e-13);
  EXPECT_THROW(noisy.pairwise_orders("y", "x"), Error);  // two rows of one x
}

TEST(Table, PivotsToOneQuantityAgainstTwo) {
  const Table pivoted = power_laws().filter("element", "P1").pivot("cells", "epsilon", "error");
  EXPECT_EQ(pivoted.columns(), (std::vector<std::string>{"cells", "1", "1e-06"}));
  EXPECT_EQ(pivoted.filter("cells", 8).number("1e-06"), 3.0 / 64);
  EXPECT_THROW(power_laws().pivot("cells", "epsilon", "error"), Error);  // P1 and CR at one place
}

TEST(Table, PrintsAlignedColumns) {
  Table table({"element", "error"});
  table.add({"P1", 0.0123456});
  table.add({"Crouzeix-Raviart", 152064});
  EXPECT_EQ(table.text(),
            "  element             error\n"
            "  P1                0.01235\n"
            "  Crouzeix-Raviart   152064\n");
}

TEST(Table, RefusesAndSaysWhat) {
  Table table = power_laws();
  EXPECT_EQ(test::refusal([&] { table.numbers("eror"); }),
            "table: no column 'eror'; accepted: element, epsilon, cells, h, error");
  EXPECT_EQ(
      test::refusal([&] {
        table.add({"P1", 1.0});
      }),
      "table: a row of 2 entries; accepted: 5, one per column (element, epsilon, cells, h, error)");
  EXPECT_EQ(table.size(), 16);  // nothing was added
  EXPECT_EQ(test::refusal([&] { table.numbers("element"); }),
            "table: 'P1' in column 'element'; accepted: a number");
  EXPECT_EQ(test::refusal([&] { table.number("error"); }),
            "table: column 'error' of 16 rows; accepted: of one");
  EXPECT_THROW(table.filter("mesh", "structured"), Error);
  EXPECT_THROW(table.filter_number("element", [](double) { return true; }), Error);
  EXPECT_THROW(table.select({"mesh"}), Error);
  EXPECT_THROW(table.add(Table({"element"})), Error);
  EXPECT_THROW(table.filter("element", "P2").max("error"), Error);
  EXPECT_THROW(table.filter("cells", 8).order("error", "h"), Error);  // one place
  table.add({"P1", 1.0, 128, 1.0 / 128, 0.0});
  EXPECT_THROW(table.order("error", "h"), Error);  // log of 0
  EXPECT_THROW(Table({"a"}).write("/dev/null/table.csv"), Error);
}

TEST(Method, MakesItsMeshItsSpaceAndItsName) {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    names.push_back(method.name());
    const TriangleMesh mesh = method.mesh(4);
    EXPECT_EQ(method.space(4).size(),
              method.element->name() == "P1" ? mesh.vertex_count() : mesh.edge_count());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"P1 structured", "P1 unstructured", "CR structured",
                                             "CR unstructured"}));
  EXPECT_EQ(structured({0}, Diagonal::crossed).mesh(3).triangle_count(), 36);
  EXPECT_EQ(methods({&p2()}, {{"jittered", [](int cells) { return jittered_mesh(cells, 0.1); }}})
                .front()
                .name(),
            "P2 jittered");
}

/// Solved to 1e-10; the way there differs.
void expect_same(const Solution& swept, const Solution& alone, double epsilon) {
  EXPECT_LE((swept.u - alone.u).cwiseAbs().maxCoeff(), 1e-8 * alone.u.cwiseAbs().maxCoeff())
      << epsilon;
}

// The beam and rubber are swept as the layer is: one assembly, one factorisation for all small
// epsilon.
TEST(SweepOfAnyProblem, GivesTheAnswersOfTheBeam) {
  Beam beam{.cells = 16};
  Sweep sweep(assemble(beam));
  int factorisations = 0;
  for (const double epsilon : {1e-2, 1e-4, 1e-9, 1e-12, 0.0}) {
    beam.epsilon = epsilon;
    sweep.set_compliance(epsilon);
    const Solution swept = sweep.solve();
    expect_same(swept, active_set(assemble(beam)), epsilon);
    factorisations += swept.counters.factorisations;
  }
  EXPECT_EQ(sweep.total().factorisations, factorisations);
  EXPECT_LT(factorisations, 5);
  sweep.solve({{}, 1e-3, ContactReduction::automatic, 1000, {}});
  EXPECT_EQ(sweep.factor().delta(), 1e-3) << "as asked";
}

TEST(SweepOfAnyProblem, TakesAnotherLoadAndOtherBounds) {
  const Beam beam{.cells = 16};
  VariationalInequality problem = assemble(beam);
  Sweep sweep(problem);
  sweep.solve();
  problem.load *= 0.5;
  problem.bounds.lower *= 0.7;
  sweep.set_load(problem.load);
  sweep.set_bounds(problem.bounds.lower);
  const Solution swept = sweep.solve();
  expect_same(swept, active_set(problem), beam.epsilon);
  EXPECT_EQ(swept.counters.factorisations, 0);
}

TEST(SweepOfAnyProblem, Refuses) {
  Sweep sweep(assemble(Beam{.cells = 8}));
  EXPECT_THROW(sweep.set_compliance(-1), Error);
  EXPECT_THROW(sweep.set_compliance(std::nan("")), Error);
  EXPECT_THROW(sweep.set_load(Eigen::VectorXd::Ones(3)), Error);
  EXPECT_THROW(sweep.set_bounds(Eigen::VectorXd::Constant(7, std::nan(""))), Error);
  EXPECT_THROW(sweep.factor(), Error);
  const Space space(structured_mesh(4, {0}), p1());
  SceneSweep linear(Scene({paper_load}), space);
  EXPECT_THROW(linear.set_compliance(0.5), Error);
  EXPECT_THROW(linear.set_bounds(Eigen::VectorXd()), Error);
  const Scene pulled({paper_load}, StiffLayer{0.1, 1, [](double, double) { return 3; }});
  const Space both(structured_mesh(4), p1());
  SceneSweep layer(pulled, both);
  EXPECT_THROW(layer.set_load([](double x, double) { return std::log(x - 0.5); }), Error);
  layer.set_load([](double x, double) { return x; });
  layer.set_load(paper_load);
  EXPECT_EQ(layer.problem().load, assemble(pulled, both).load);  // what pulls at the layer stays
}

}  // namespace antilock::test::study_test::study_test

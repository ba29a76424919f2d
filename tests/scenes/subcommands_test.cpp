// antilock, the program with subcommands: its numbers against the exact solution, its refusals from
// outside.
#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/exact/exact_table.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test {
namespace {

std::string scene(double epsilon, const std::string& f = "10*sin(2*pi*x)") {
  return fmt::format(
      "[load]\nf = \"{}\"\n[layer]\nepsilon = {}\n[contact]\n[mesh]\nkind = \"structured\"\ncells "
      "= 8\n",
      f, epsilon);
}

/// An answer of the library's, as another program would hand it in: its rows in another order,
/// twelve digits.
void hand_in(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u) {
  std::ofstream out(path);
  out << "x,y,u\n";
  for (Eigen::Index i = space.size(); i-- > 0;)
    out << fmt::format("{:.12g},{:.12g},{:.12g}\n", space.dof_coordinates()(i, 0),
                       space.dof_coordinates()(i, 1), u(i));
}

class Subcommand : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return in_shell((folder / name).string());
  }
  Outcome ask(const std::string& arguments) { return run_antilock(arguments, log); }
  Outcome estimate(const std::string& asked, const Space& space, const Eigen::VectorXd& u,
                   const std::string& options) {
    write_msh(folder / "mesh.msh", space.mesh());
    hand_in(folder / "u.csv", space, u);
    return ask("estimate " + file("scene.toml", asked) + " " + in_shell(folder / "mesh.msh") + " " +
               in_shell(folder / "u.csv") + options);
  }
  TemporaryFolder folder, log;
};

TEST(AsSineLoad, IsRecognisedAndNothingElseIs) {
  const Field sines = [](double x, double y) {
    return 3 * y * y * std::sin(M_PI * x) - (1 - y) * std::sin(31 * M_PI * x);
  };
  const std::optional<SineLoad> found = as_sine_load(sines);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->modes.size(), 2u);
  for (const double x : {0.1, 0.77})
    for (const double y : {0.0, 0.3, 1.0})
      EXPECT_NEAR((*found)(x, y), sines(x, y), 1e-11);  // 1e-13 of its size, 13 nodes
  EXPECT_FALSE(as_sine_load([](double x, double) { return x; }));
  EXPECT_FALSE(
      as_sine_load([](double x, double y) { return std::sin(M_PI * x) * std::exp(9 * y); }));
  EXPECT_FALSE(as_sine_load([](double x, double) { return std::sin(33 * M_PI * x); }));
  EXPECT_FALSE(as_sine_load([](double x, double) { return std::sin(M_PI * x) + 1e-9 * x; }));
  EXPECT_FALSE(as_sine_load(
      [](double x, double) { return std::sin(M_PI * x) + (std::abs(x - 0.3003) < 1e-4); }));
}

TEST_F(Subcommand, ExactGivesTheSolutionAtPoints) {
  const std::string points = file("points.csv", "x,y\n0.25,-1\n0.25,0.5\n-1e-18,1\n");
  const Outcome told = ask("exact " + file("scene.toml", scene(1e-2)) + " --summary " +
                           in_shell((folder / "s.json").string()) + " < " + points);
  ASSERT_EQ(told.status, 0) << told.err;
  const ExactSolution exact(paper_sine_load(), 1e-2);
  const std::string line =
      fmt::format("0.25,-1,{},{},", exact.value(0.25, -1), exact.gradient(0.25, -1)(0));
  EXPECT_NE(told.out.find("x,y,u,u_x,u_y,p\n"), std::string::npos);
  // a mode's sampled profile is right to 1e-13: the first 10 digits are the same
  EXPECT_NE(told.out.find(line.substr(0, 20)), std::string::npos) << told.out;
  const auto summary = nlohmann::json::parse(contents(folder / "s.json"));
  EXPECT_EQ(summary["kind"], "exact");
  EXPECT_NEAR(summary["energy"], exact.energy(), 1e-12);
  // u solves the inequality, 0 and 2 u are in K: a(u, u) = L(u), and J(u) = -a(u, u) / 2. 1e-4 is
  // what the summary promises
  EXPECT_NEAR(summary["norms"]["energy"], std::sqrt(-2 * exact.energy()), 1e-4);
  EXPECT_EQ(summary["load"], "10*sin(2*pi*x)");
  EXPECT_NEAR(summary["contact"][0][0], 0.69753,
              1e-5);  // five digits are printed in the project's table of truths
}

TEST_F(Subcommand, ExactOfAnyOtherLoadIsCertified) {
  const std::string points = file("points.csv", "x,y\n0.25,-0.5\n");
  const Outcome told =
      ask("exact " + file("scene.toml", scene(1e-2, "x*sin(pi*x)")) + " --accuracy 0.1 --summary " +
          in_shell((folder / "s.json").string()) + " < " + points);
  ASSERT_EQ(told.status, 0) << told.err;
  const auto summary = nlohmann::json::parse(contents(folder / "s.json"));
  EXPECT_EQ(summary["kind"], "certified");
  EXPECT_LE(summary["relative"], 0.1);
  EXPECT_LT(summary["energy"][0], summary["energy"][1]);
  // the series is of the unit squares alone
  const std::string other = in_shell(EXAMPLE_SCENES "/l_shape.toml");
  EXPECT_NE(ask("exact " + other + " --accuracy 0.3 < " + file("inside.csv", "x,y\n0.25,0.5\n"))
                .err.find("certified"),
            std::string::npos);
  EXPECT_NE(ask("sweep " + other + " --epsilon 1:0.1:2").out.find("no exact solution"),
            std::string::npos);
}

TEST_F(Subcommand, EstimateBoundsTheErrorOfForeignAnswers) {
  const double epsilon = 1e-3;
  const ExactTable exact(ExactSolution(paper_sine_load(), epsilon));
  for (const auto& [element, mesh, locks] :
       {std::tuple{&p1(), structured_mesh(16), false},
        {&p1(), jittered_mesh(16, 0.2), true},
        {&crouzeix_raviart(), jittered_mesh(16, 0.2), false}}) {
    const Space space(mesh, *element);
    const Solution answer = active_set(stiff_problem(space, epsilon));
    const auto judged_by = [&](const Eigen::VectorXd& u) {
      return estimate(scene(epsilon), space, u,
                      " --accuracy 0.03 --json " + in_shell(folder / "judged.json"));
    };
    const Outcome told = judged_by(answer.u);
    ASSERT_EQ(told.status, 0) << told.err;
    const auto judged = nlohmann::json::parse(contents(folder / "judged.json"));
    const double energy = measure_errors(space, answer, epsilon, reference(exact)).energy;
    // twelve digits of u leave 1e-12 h^-1 epsilon^-1 of the slope that the energy norm counts
    EXPECT_NEAR(judged["errors"]["energy"], energy, 1e-7);
    EXPECT_GE(judged["bound"], energy);
    // P1: the lower bound of J is proved to 3 %, so the square root of J(v) - J loses little. CR:
    // the certificate's root 2
    EXPECT_LE(judged["bound"], (element->conforming() ? 1.05 : 1.6) * energy);
    EXPECT_EQ(told.out.find("P1 locks in this layer") != std::string::npos, locks) << told.out;
    if (!element->conforming()) {  // the bound is of the answer handed in, not of the library's own
      ASSERT_EQ(judged_by(answer.u / 2).status, 0);
      const auto half = nlohmann::json::parse(contents(folder / "judged.json"));
      EXPECT_GE(half["bound"], half["errors"]["energy"]);
    }
    if (locks)
      EXPECT_LT(judged["kept"], 0.05);
    else
      EXPECT_NEAR(judged["kept"], 1, 0.05);
  }
}

TEST_F(Subcommand, EstimateLiftsAnAnswerOutOfTheObstacleAndSaysSo) {
  const Space space(structured_mesh(8), p1());
  Eigen::VectorXd u = active_set(stiff_problem(space, 0.1)).u;
  for (const int i : space.contact_dofs()) u(i) -= 1e-3;
  const Outcome told = estimate(scene(0.1), space, u, " --accuracy 0.2");
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.out.find("for the way into K"), std::string::npos) << told.out;
  EXPECT_EQ(told.out.find("this answer is not it"), std::string::npos) << told.out;
  // half of the right answer is off by half of |u|_a = 0.94, more than 1.3 h |f| on cells of 1/32
  const Space fine_space(structured_mesh(32), p1());
  const Outcome half = estimate(
      scene(0.1), fine_space, active_set(stiff_problem(fine_space, 0.1)).u / 2, " --accuracy 0.2");
  EXPECT_NE(half.out.find("this answer is not it"), std::string::npos) << half.out;
}

TEST_F(Subcommand, EstimateFindsAFaultWhereItWasPut) {
  const TriangleMesh mesh = jittered_mesh(16, 0.2);
  const Space space(mesh, p1());
  const std::string out =
      " --json " + in_shell(folder / "judged.json") + " --where " + in_shell(folder / "where.csv");
  for (const std::string load :
       {"10*sin(2*pi*x)", "10*sin(2*pi*x)+0.1*x"})  // of the first an exact solution is known
    for (const Eigen::RowVector2d& fault :
         {Eigen::RowVector2d(0.3, 0.6), Eigen::RowVector2d(0.6, -0.5)}) {
      Eigen::VectorXd u = active_set(stiff_problem(space, 0.1)).u;
      Eigen::Index at = 0;
      (space.dof_coordinates().rowwise() - fault).rowwise().norm().minCoeff(&at);
      u(at) += 0.3;
      const Outcome told = estimate(scene(0.1, load), space, u, " --accuracy 0.1" + out);
      ASSERT_EQ(told.status, 0) << told.err;
      const auto judged = nlohmann::json::parse(contents(folder / "judged.json"));
      const auto& where = judged["where"];
      EXPECT_EQ(where["exact"], load.size() < 15);
      EXPECT_EQ(told.out.find("an estimate") == std::string::npos, where["exact"]) << told.out;
      // a hat of height 0.3 has about 0.3^2 * 4 of the energy in its six triangles, in the layer up
      // to 100 times as much; the answer without it is off by 0.1, and Antilock's own by 0.1 of
      // 0.94
      EXPECT_NEAR(where["layer"], fault(1) < 0 ? 1 : 0, 0.1) << told.out;
      EXPECT_LE(where["half_lies_in"], 4) << told.out;
      for (const auto& triangle : where["worst"])
        EXPECT_LT(std::hypot(triangle["x"].get<double>() - space.dof_coordinates()(at, 0),
                             triangle["y"].get<double>() - space.dof_coordinates()(at, 1)),
                  1.0 / 16);  // the centroid of a triangle at that vertex is within 2/3 of its
                              // longest edge, 1.3/16
      std::ifstream table(folder / "where.csv");
      std::string line;
      std::getline(table, line);
      EXPECT_EQ(line, "triangle,region,x,y,error");
      double squared = 0;
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        std::getline(table, line);
        EXPECT_EQ(
            line.rfind(fmt::format("{},{},", t, mesh.region[t] == Region::layer ? "layer" : "body"),
                       0),
            0u);
        squared += std::pow(std::stod(line.substr(line.rfind(',') + 1)), 2);
      }
      const double energy = where["exact"] ? judged["errors"]["energy"] : where["energy"];
      EXPECT_NEAR(std::sqrt(squared), energy, 1e-9 * energy);  // 17 digits each, some 1000 of them
      // two functions that far from each other, one within `within` of the exact solution: the
      // bound is of that distance
      EXPECT_LE(energy, judged["bound"].get<double>() + where["within"].get<double>());
    }
  std::filesystem::remove(folder / "where.csv");
  std::ofstream(folder / "u.csv") << "x,y,u\n"
                                  <<
      [&] {  // the columns x and y changed places
        std::string rows;
        for (int i = 0; i < space.size(); ++i)
          rows += fmt::format("{:.12g},{:.12g},0\n", space.dof_coordinates()(i, 1),
                              space.dof_coordinates()(i, 0));
        return rows;
      }();
  const Outcome told = ask("estimate " + file("scene.toml", scene(0.1)) + " " +
                           in_shell(folder / "mesh.msh") + " " + in_shell(folder / "u.csv") + out);
  EXPECT_EQ(told.status, 2);
  EXPECT_NE(told.err.find("is the first of them that is none"), std::string::npos) << told.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "where.csv"));
}

TEST_F(Subcommand, SweepIsTheSceneAskedAgainAndAgain) {
  const Outcome told = ask("sweep " + file("scene.toml", scene(1)) +
                           " --epsilon 1,1e-4,0 --cells 8,16 --at 0.25,-1,0.5,0.5 --out " +
                           in_shell(folder / "sweep.csv"));
  ASSERT_EQ(told.status, 0) << told.err;
  const Csv table = read_csv(folder / "sweep.csv");
  ASSERT_EQ(table.rows.rows(), 6);
  const TriangleMesh mesh = structured_mesh(16);
  const Space space(mesh, p1());
  const Solution answer = active_set(stiff_problem(space, 1e-4));
  int at = -1;
  for (int i = 0; i < space.size(); ++i)
    if (space.dof_coordinates()(i, 0) == 0.25 && space.dof_coordinates()(i, 1) == -1) at = i;
  EXPECT_EQ(table.header.rfind("cells,epsilon,unknowns,u_at_1,u_at_2,ridge,kept", 0), 0u);
  EXPECT_NEAR(table.rows(4, 3), answer.u(at), 1e-9);  // both are solved to 1e-10
  // per mesh: epsilon = 1 has a factor of its own; epsilon^2 = 1e-8 and 0 are below the penalty h^2
  // / 4096 and share one
  const std::vector<double> factored{1, 1, 0, 1, 1, 0};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(table.rows(i, 9), factored[i]) << i;
}

/// Matrix Market, as any program exports it.
void export_matrix(const std::filesystem::path& path, const SparseMatrix& matrix) {
  std::ofstream out(path);
  out << fmt::format("%%MatrixMarket matrix coordinate real general\n% a comment\n{} {} {}\n",
                     matrix.rows(), matrix.cols(), matrix.nonZeros());
  for (int j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
      out << fmt::format("{} {} {}\n", it.row() + 1, it.col() + 1, it.value());
}

TEST_F(Subcommand, LockcheckDiagnosesAndSolvesMatrices) {
  const auto hand_over = [&](const std::string& name, const TriangleMesh& mesh) {
    const Space space(mesh, p1());
    const VariationalInequality problem = stiff_problem(space, 1);
    export_matrix(folder / (name + "a1"), problem.a1);
    export_matrix(folder / (name + "b"), SparseMatrix(problem.b));
    export_matrix(folder / (name + "m"), SparseMatrix(Eigen::MatrixXd(problem.m).sparseView()));
    export_matrix(folder / (name + "load"),
                  SparseMatrix(Eigen::MatrixXd(problem.load).sparseView()));
    std::ofstream fixed(folder / (name + "fixed")), bounds(folder / (name + "bounds"));
    fixed << "unknown,value\n";
    for (const int i : problem.dirichlet_dofs) fixed << i << ",0\n";
    bounds << "unknown,lower\n";
    for (const int i : problem.bounds.unknowns) bounds << i << ",0\n";
    return active_set([&] {
      VariationalInequality limit = problem;
      limit.compliance = 0;
      return limit;
    }());
  };
  const auto path = [&](const std::string& name) { return in_shell(folder / name); };
  for (const bool locks : {true, false}) {
    const auto mesh = [&](int cells) {
      return locks ? jittered_mesh(cells, 0.2) : structured_mesh(cells);
    };
    const Solution limit = hand_over("", mesh(6));
    hand_over("fine_", mesh(12));
    const Outcome told = ask("lockcheck " + path("a1") + " " + path("b") + " " + path("m") + " " +
                             path("load") + " --fixed " + path("fixed") + " --bounds " +
                             path("bounds") + " --finer " + path("fine_a1") + " " + path("fine_b") +
                             " " + path("fine_m") + " --finer-fixed " + path("fine_fixed") +
                             " --finer-bounds " + path("fine_bounds") + " --out " + path("u.csv"));
    ASSERT_EQ(told.status, 0) << told.err;
    EXPECT_EQ(told.out.find("locks completely") != std::string::npos, locks) << told.out;
    const Eigen::MatrixXd answers = read_csv(folder / "u.csv").rows;
    const auto last = answers.bottomRows(limit.u.size());
    EXPECT_LE((last.col(2) - limit.u).cwiseAbs().maxCoeff(),
              1e-10);  // the same matrices, to 17 digits
    EXPECT_NEAR(last.col(3).sum(), limit.lambda.sum(),
                1e-9);  // the forces of the load's lower half, some 1
  }
}

TEST_F(Subcommand, EstimateKnowsWhatItsSeriesAndItsDiagnosisAreOf) {
  TriangleMesh mesh = unstructured_mesh(8);
  const auto told = [&](double times) {
    const Space space(mesh, p1());
    const Outcome outcome = estimate(
        scene(1e-4), space, times * active_set(stiff_problem(space, 1e-4)).u, " --accuracy 0.3");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_NE(told(1).find("P1 locks in this layer"), std::string::npos);
  const std::string half = told(0.5);
  EXPECT_EQ(half.find("P1 locks"), std::string::npos) << half;
  EXPECT_NE(half.find("not the discrete solution on its mesh"), std::string::npos) << half;
  EXPECT_NE(half.find("errors (exact)"), std::string::npos) << half;
  for (const bool sides :
       {false, true}) {  // the top between its corners is lowered, then the corners as well
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (const double x = mesh.vertices(v, 0);
          (x == 0 || x == 1) == sides && mesh.vertices(v, 1) > 0)
        mesh.vertices(v, 1) *= 0.9;
    EXPECT_EQ(told(1).find("errors (exact)"), std::string::npos)
        << "the series is of the unit square";
  }
}

TEST_F(Subcommand, RefusesInOneLine) {
  const std::string one =
      file("one.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n");
  const std::string good = file("scene.toml", scene(1e-2)),
                    points = file("points.csv", "x,y\n0.25,-1\n");
  for (const auto& [arguments, says] :
       {std::pair<std::string, std::string>{"", "antilock SUBCOMMAND"},
        {"fly", "\"fly\" is unknown"},
        {"exact " + good + " < " + file("a.csv", "x,z\n1,2\n"), "accepted: the header x,y"},
        {"exact " + good + " < " + file("b.csv", "x,y\n1,two\n"),
         "line 2: \"two\" is no finite number"},
        {"exact " + good + " < " + file("c.csv", "x,y\n0.5,-2\n"), "outside the domain"},
        {"exact /nowhere.toml < " + points, "/nowhere.toml"},
        {"sweep " + good + " --epsilon 1:2", "accepted: FROM:TO:COUNT"},
        {"sweep " + good + " --epsilon 2", "epsilon = 2 is out of range"},
        {"sweep " + good + " --at 3,3", "outside the mesh"},
        {"sweep " + good + " --at 0.5", "accepted: X,Y"},
        {"lockcheck " +
             file("bad.mtx", "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 1\n") +
             " " + points + " " + points,
         "bad.mtx: line 3: the entry (3, 1) of a matrix 2 x 2"},
        {"lockcheck " + points + " " + points + " " + points, "no Matrix Market header"},
        {"lockcheck " + one + " " + one + " " + one, "accepted: a LOAD, --finer, or both"},
        {"lockcheck " + one + " " + one + " " + one + " " +
             file("huge.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1e200\n"),
         "accepted: a load whose energy is a number"},
        {"lockcheck " + one + " " + one + " " + one + " " + one + " --fixed " +
             file("one.csv", "unknown,value\n1,0\n"),
         "one.csv: line 2: unknown 1; accepted: whole numbers from 0 to 0"},
        {"lockcheck /dev/zero " + one + " " + one, "/dev/zero: is a folder, a device or a pipe"},
        {"lockcheck " + one + " " + one + " " + one + " " + one + " --fixed /dev/zero",
         "/dev/zero: is a folder, a device or a pipe"},
        {"estimate " + good + " " + points + " " + points, "points.csv"}}) {
    const Outcome told = ask(arguments);
    EXPECT_EQ(told.status, 2) << arguments;
    EXPECT_EQ(told.out, "") << arguments;
    EXPECT_NE(told.err.find(says), std::string::npos) << arguments << ": " << told.err;
  }
}

}  // namespace
}  // namespace antilock::test

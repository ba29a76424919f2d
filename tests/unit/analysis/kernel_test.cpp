// Locking is a property of the discretisation, not a bug: P1 on an unstructured mesh must lock, the
// others must not.
#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/inf_sup.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "unit/analysis/helpers.hpp"

namespace antilock::test::analysis_test::kernel_test {

/// The whole displacement of the layer in the truth at small epsilon (max of u on Gamma_C, by the
/// sine series).
constexpr double layer_displacement = 0.0457160;

double largest_on_layer(const Space& space, const Solution& s) {
  double largest = 0;
  for (int i = 0; i < space.size(); ++i)
    if (space.dof_coordinates()(i, 1) <= 0) largest = std::max(largest, std::abs(s.u(i)));
  return largest;
}

TEST(Locking, IsThatOfP1UnstructuredAtSmallEpsilonAlone) {
  const auto on_layer = [](const TriangleMesh& mesh, const Element& element, double epsilon) {
    const Space space(mesh, element);
    return largest_on_layer(space, active_set(stiff_problem(space, epsilon)));
  };
  const TriangleMesh structured = structured_mesh(32), unstructured = unstructured_mesh(32),
                     columns = layered_mesh(32), one_row = layered_mesh(32, 0);
  for (const double epsilon : {1e-6, 0.0})
    for (const auto& [mesh, element] :
         {std::pair{&structured, &p1()}, std::pair{&structured, &crouzeix_raviart()},
          std::pair{&columns, &p1()}, std::pair{&one_row, &p1()},
          std::pair{&unstructured, &crouzeix_raviart()}})
      EXPECT_NEAR(on_layer(*mesh, *element, epsilon) / layer_displacement, 1, 0.03)
          << element->name() << epsilon;
  EXPECT_NEAR(on_layer(unstructured, p1(), 1) / 0.12618750, 1, 0.02);  // the truth: u(.25, 0)
  for (const int cells :
       {16, 32, 64})  // the displacement is lost: what is left of it falls like epsilon^2 / h^2
    EXPECT_LT(on_layer(unstructured_mesh(cells), p1(), 1e-6), 1e-3 * layer_displacement) << cells;
}

TEST(Locking, TheLockedSolutionIsDirichletsOnTheBody) {
  // as the paper says of Figure 7: u vanishes on the layer, and solves the Laplace problem on the
  // body clamped all round
  const Space space(unstructured_mesh(16), p1());
  const Solution locked = active_set(stiff_problem(space, 0));
  EXPECT_LT(largest_on_layer(space, locked), 1e-9);
  VariationalInequality dirichlet = assemble(Scene({paper_load}, StiffLayer{1}), space);
  std::vector<int> fixed;
  for (int i = 0; i < space.size(); ++i) {
    const double x = space.dof_coordinates()(i, 0), y = space.dof_coordinates()(i, 1);
    if (x == 0 || x == 1 || y == 1 || y <= 0) fixed.push_back(i);
  }
  dirichlet.dirichlet_dofs = fixed;
  dirichlet.dirichlet_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fixed.size()));
  EXPECT_LT(relative_difference(locked.u, active_set(dirichlet).u), 1e-8);
}

int kernel_dimension(const Space& space) { return layer_kernel_dimension(stiff_problem(space, 0)); }

// Of degree p: cells * p - 1 functions of x on columns, and on tied triangles x (1 - x) times
// degree p - 2.
TEST(Locking, IsTheDimensionOfTheKernelOfA0) {
  for (const int cells :
       {4, 8}) {  // finer, B nearly misses functions of high degree, and a rank means less
    const TriangleMesh unstructured = unstructured_mesh(cells);
    const auto layer =
        std::count(unstructured.region.begin(), unstructured.region.end(), Region::layer);
    EXPECT_EQ(layer % 2, 0);
    EXPECT_EQ(kernel_dimension(Space(unstructured, crouzeix_raviart())), layer / 2);
    for (const Diagonal diagonal : {Diagonal::right, Diagonal::left}) {
      const TriangleMesh structured = structured_mesh(cells, {}, diagonal);
      EXPECT_EQ(kernel_dimension(Space(structured, crouzeix_raviart())), cells * cells);  // N_T / 2
      for (const Element* element : {&p1(), &p2(), &p3(), &p4()}) {
        const int p = element->degree();
        if (p > 2 && cells > 4) continue;
        EXPECT_EQ(kernel_dimension(Space(structured, *element)), cells * p - 1);
        EXPECT_EQ(kernel_dimension(Space(unstructured, *element)), p - 1);
      }
    }
  }
}

TEST(LockingDiagnosis, RefusesWhatItCannotTell) {
  const TriangleMesh mesh = structured_mesh(4);
  const Space space(mesh, p1());
  const VariationalInequality problem = stiff_problem(space, 0);
  test::expect_refused([&] { diagnose_locking(problem, problem); },
                       "accepted: more on the second mesh");
  VariationalInequality soft = problem;
  soft.b.resize(0, soft.size());
  soft.m.resize(0);
  test::expect_refused([&] { diagnose_locking(problem, soft); }, "B has no rows");
}

TEST(Locking, LeavesP2OneParabolaWhereTheLoadIsNotOddAboutTheMiddle) {
  const Space space(unstructured_mesh(4), p2());
  const auto largest_off_parabola = [&](const SineLoad& load, double& c) {
    const Solution s =
        active_set(assemble(Scene({load}, StiffLayer{0}, UnilateralContact{}), space));
    const Eigen::ArrayXd x = space.dof_coordinates().col(0).array(), parabola = x * (1 - x);
    double off = 0;
    c = s.u(space.contact_dofs()).maxCoeff() * 4;  // at the middle x (1 - x) = 1/4
    for (int i = 0; i < space.size(); ++i)
      if (space.dof_coordinates()(i, 1) <= 0)
        off = std::max(off, std::abs(s.u(i) - c * parabola(i)));
    return off;
  };
  double c = 0;
  // 1e-8: u is right to about 1e-10 of its largest value, 0.3
  EXPECT_LT(largest_off_parabola({{{2, {10.0}}, {1, {5.0}}}}, c), 1e-8);
  EXPECT_GT(c, 0.1);
  EXPECT_LT(largest_off_parabola(paper_sine_load(), c), 1e-8);
  EXPECT_LT(c, 1e-8);  // pulled as much as pressed: nothing is left
}

TEST(Locking, TheEnergyBracketsTheTruthAndDoesNotCloseWhereItLocks) {
  const double exact = ExactSolution(paper_sine_load(), 0).energy();
  EXPECT_NEAR(exact, -0.44154446, 1e-8);
  const auto above = [&](const TriangleMesh& mesh, const Element& element) {
    const Space space(mesh, element);
    const VariationalInequality problem = stiff_problem(space, 0);
    return energy(problem, active_set(problem)) - exact;
  };
  struct Row {
    int cells;
    double p1, cr, cr_unstructured, p1_unstructured;
  };
  // two digits each, measured by a first program that shares no line with this library
  for (const Row& row :
       {Row{16, 1.0e-2, -2.8e-3, -2.1e-3, 1.5e-2}, Row{32, 2.6e-3, -7.2e-4, -5.2e-4, 1.1e-2},
        Row{64, 6.5e-4, -1.8e-4, -1.3e-4, 9.5e-3}}) {
    EXPECT_NEAR(above(structured_mesh(row.cells), p1()) / row.p1, 1, 0.05) << row.cells;
    EXPECT_NEAR(above(structured_mesh(row.cells), crouzeix_raviart()) / row.cr, 1, 0.05)
        << row.cells;
    const TriangleMesh mesh = unstructured_mesh(row.cells);
    EXPECT_NEAR(above(mesh, crouzeix_raviart()) / row.cr_unstructured, 1, 0.2) << row.cells;
    EXPECT_NEAR(above(mesh, p1()) / row.p1_unstructured, 1, 0.2) << row.cells;
  }
}
Eigen::MatrixXd seen_by(const Space& space, int merged = 1) {
  return multiplier_gram(stiff_problem(space, 0), h1_seminorm(space), merged);
}

TEST(InfSup, OfCrouzeixRaviartIsAtLeastOneInTheDualNorm) {
  // Lemma 2: grad I_h v = mean of grad v, so that I_h does not enlarge the norm. A larger V only
  // lowers the constant.
  for (const test::NamedMesh& mesh : test::two_square_meshes(4)) {
    const TriangleMesh fine = refined(mesh.mesh), finer = refined(fine);
    const Space space(mesh.mesh, crouzeix_raviart()), quadratic(fine, p2()), linear(finer, p1());
    EXPECT_GE(inf_sup(seen_by(space), seen_by(linear, 16)), 1 - 1e-10) << mesh.name;
    // P2 has three rows of B a triangle, its quadrature points; four triangles inside their father
    EXPECT_GE(inf_sup(seen_by(space), seen_by(quadratic, 12)), 1 - 1e-10) << mesh.name;
  }
}

TEST(InfSup, InL2FallsLikeHAndIsZeroWhereRowsOfBDependOnEachOther) {
  const auto constant = [](int cells, const Element& element) {
    const Space space(structured_mesh(cells), element);
    return inf_sup(seen_by(space), stiff_problem(space, 0).m.asDiagonal());
  };
  // 1.82 measured: the order comes with h
  EXPECT_NEAR(constant(4, crouzeix_raviart()) / constant(8, crouzeix_raviart()), 2, 0.25);
  EXPECT_EQ(constant(4, p1()), 0);
}

TEST(InfSup, AndCoercivityRefuseWhatDoesNotFit) {
  const Space space(structured_mesh(4), p1()), finer(structured_mesh(40), p1());
  test::expect_refused([&] { seen_by(space, 5); }, "5 a multiplier");
  test::expect_refused([&] { multiplier_gram(stiff_problem(space, 0), SparseMatrix(3, 3)); },
                       "the norm is 3 x 3");
  const Eigen::MatrixXd seen = seen_by(space);
  test::expect_refused([&] { inf_sup(seen, 0 * seen); }, "not positive definite");
  test::expect_refused([&] { coercivity(stiff_problem(space, 0), SparseMatrix(3, 3)); },
                       "the norm is 3 x 3");
  test::expect_refused([&] { coercivity(stiff_problem(finer, 0), h1_seminorm(finer)); },
                       "accepted at most 2000");
}

/// Errors in the broken H1 norm for epsilon = 1, 1e-1, 1e-2, 1e-4, 1e-8, 0.
std::vector<double> h1_errors(const Space& space) {
  static const std::vector<double> epsilons{1, 1e-1, 1e-2, 1e-4, 1e-8, 0};
  static const std::vector<ExactTable> exact = [] {  // 2^13 points: gradients to 2e-6
    std::vector<ExactTable> tables;
    tables.reserve(epsilons.size());
    for (const double epsilon : epsilons)
      tables.emplace_back(ExactSolution(paper_sine_load(), epsilon, true, 13));
    return tables;
  }();
  SceneSweep sweep(test::stiff_scene(1), space);
  std::vector<double> errors;
  for (std::size_t i = 0; i < epsilons.size(); ++i) {
    sweep.set_epsilon(epsilons[i]);
    errors.push_back(measure_errors(space, sweep.solve(), epsilons[i], reference(exact[i])).h1);
  }
  return errors;
}
double worst(const std::vector<double>& errors) {
  return *std::max_element(errors.begin(), errors.end());
}

TEST(UniformConvergence, OfTheoremsFiveAndSevenAndNotOfP1Unstructured) {
  const auto meshes = [](bool structured) {
    return structured ? std::pair(structured_mesh(8), structured_mesh(16))
                      : std::pair(unstructured_mesh(8), unstructured_mesh(16));
  };
  for (const bool structured : {true, false})
    for (const Element* element : {&p1(), &crouzeix_raviart()}) {
      const auto [coarse, fine] = meshes(structured);
      const auto on_coarse = h1_errors(Space(coarse, *element)),
                 on_fine = h1_errors(Space(fine, *element));
      const double ratio = worst(on_fine) / on_fine.front();  // of Babuska and Suri
      if (structured || element != &p1()) {
        EXPECT_NEAR(worst(on_coarse) / worst(on_fine), 2, 0.1)
            << element->name() << structured;  // first order
        EXPECT_LT(ratio, 1.05) << element->name()
                               << structured;  // the worst case is epsilon = 1, or almost
      } else {
        EXPECT_LT(worst(on_coarse) / worst(on_fine), 1.6);
        EXPECT_GT(worst(on_fine),
                  0.138);  // what the layer's displacement is worth, sup over epsilon as h -> 0
        EXPECT_GT(ratio, 1.3 * worst(on_coarse) / on_coarse.front());
      }
    }
}

TEST(Locking, ComesWithTheFirstJitterAndGrowsWithItsShareOfEpsilon) {
  // At fixed h a function of x alone is missed by t h, at the price (t h / epsilon)^2: the answer
  // knows t / epsilon alone, up to the change of the mesh itself, of order t.
  const auto on_layer = [](double t, double epsilon) {
    const Space space(jittered_mesh(8, t), p1());
    EXPECT_EQ(kernel_dimension(space), 0) << t;
    return largest_on_layer(space, active_set(stiff_problem(space, epsilon))) / layer_displacement;
  };
  const double some = on_layer(1e-3, 1e-3), half = on_layer(1e-2, 1e-3),
               most = on_layer(1e-1, 1e-3);
  EXPECT_NEAR(on_layer(1e-4, 1e-4), some, 1e-3);
  EXPECT_NEAR(on_layer(1e-3, 1e-4), half, 1e-2);
  EXPECT_GT(some, 0.9);
  EXPECT_NEAR(half, 0.3, 0.2);  // t h = 1.25 epsilon: neither all nor nothing
  EXPECT_LT(most, 0.05);
}

TEST(BendingLength, IsTheSlopeOfAParabolasInterpolant) {
  const double h = 1.0 / 8;
  for (const MeshFamily& family : mesh_families()) {
    const TriangleMesh mesh = family.mesh(8);
    double sum = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const Eigen::Matrix<double, 3, 2> gradients = barycentric_gradients(mesh, t);
      double slope = 0, around = 1;
      for (int i = 0; i < 3; ++i) {
        slope +=
            0.5 * std::pow(mesh.vertices(mesh.triangles(t, i), 0), 2) * gradients(i, 1);  // w'' = 1
        around *= mesh.edge_length(mesh.triangle_edges(t, i));
      }
      EXPECT_NEAR(bending_length(mesh, t), std::abs(slope), 1e-13) << family.name;
      EXPECT_LE(bending_length(mesh, t), around / (4 * mesh.area(t)) * (1 + 1e-12))
          << family.name;  // circumradius
      if (mesh.region[t] == Region::layer) sum += mesh.area(t) * slope * slope;
    }
    EXPECT_NEAR(bending_length(mesh), std::sqrt(sum), 1e-13)
        << family.name;  // the layer has the area 1
  }
  for (const char* name :
       {"structured", "layered", "columns"})  // gmsh places points to about 1e-12
    EXPECT_LT(bending_length(mesh_family(name).mesh(8)), 1e-11) << name;
  // h^2 / (8 H) in a row of triangles of base h and height H; the halves at the ends lean on the
  // sides
  EXPECT_NEAR(bending_length(mesh_family("staggered").mesh(8)), std::sqrt(15.0 / 16) * h / 8,
              1e-15);
  EXPECT_EQ(bending_length(structured_mesh(4, {0})), 0);
}

using std::numbers::pi;

}  // namespace antilock::test::analysis_test::kernel_test

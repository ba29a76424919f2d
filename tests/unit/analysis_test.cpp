#include <Eigen/LU>

#include "antilock/adapt/bisection.hpp"
#include "antilock/analysis/accurate_enough.hpp"
#include "antilock/analysis/certificate.hpp"
#include "antilock/analysis/detail/ties.hpp"
#include "antilock/analysis/exact_errors.hpp"
#include "antilock/analysis/inf_sup.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/analysis/lost_energy.hpp"
#include "antilock/analysis/nearest.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/exact/truth_distance.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/graded.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/problem/projected.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "backstage/17_ascent.hpp"
#include "backstage/17_worst_load.hpp"
#include "support/bodies.hpp"
#include "support/dense.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::analysis_test {
using namespace tutorial;

/// One question with its answer, and room for what a test does to it.
struct Answered {
  TriangleMesh mesh;
  Scene scene;
  Space space;
  VariationalInequality problem;
  Solution solution;

  Answered(TriangleMesh made, Scene asked)
      : mesh(std::move(made)),
        scene(std::move(asked)),
        space(mesh, crouzeix_raviart()),
        problem(assemble(scene, space)),
        solution(active_set(problem)) {}
  Answered(const Answered&) = delete;
  Answered& operator=(const Answered&) = delete;

  EquilibratedFlux flux() const { return equilibrated_flux(scene, space, problem, solution); }
  Companion strip() const { return strip_companion(scene, space, problem, solution); }
  Certificate certified() const { return certify(scene, space, problem, solution); }
};

/// u and p pushed away from the answer: no equation holds any more.
void disturb(Answered& run, double amount, unsigned seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return amount * (2.0 * random() / std::mt19937::max() - 1); };
  std::vector<char> fixed(run.space.size(), 0);
  for (const int i : run.problem.fixed) fixed[i] = 1;
  const double u = run.solution.u.lpNorm<Eigen::Infinity>(), p = run.solution.p.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < run.space.size(); ++i) run.solution.u(i) += fixed[i] ? 0 : noise() * u;
  for (double& value : run.solution.p) value += noise() * p;
}

// ==== The energy in a bracket, and what is accurate enough.

// J(u_h) - J(u) >= |u_h - u|^2 / 2 in the energy norm of Remark 4: the width bounds the error without the truth.
TEST(EnergyBracket, HoldsTheExactEnergyAndBoundsTheErrorOfP1) {
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    const Truth solved(paper_sine_load(), epsilon, true, 14);
    const TruthTable truth(solved);
    for (const auto& [name, mesh] : two_square_meshes(8)) {
      const Space space(mesh, p1());
      const double error =
          measure_errors(space, active_set(stiff_problem(space, epsilon)), epsilon, reference(truth)).energy;
      const EnergyBracket found = energy_bracket(stiff_scene(epsilon), mesh);
      EXPECT_LE(found.lower, solved.energy()) << name << epsilon;
      EXPECT_GE(found.upper, solved.energy()) << name << epsilon;
      EXPECT_LT(found.width(), 0.2 * std::abs(solved.energy())) << name << epsilon;
      const double bound = std::sqrt(2 * found.width());
      EXPECT_LE(error, bound) << name << epsilon;
      EXPECT_GT(error, 0.5 * bound) << name << epsilon;  // tutorial 17: 0.71 to 0.99 of it
    }
  }
}

// Bumps between the points of the solver's rule; an edge held below 0 beside Gamma_C, where the obstacle rises from it.
TEST(EnergyBracket, IsOfTheLoadItselfAndOfGivenValues) {
  const auto bumps = [](double x, double y) {  // at the centroids of the triangles of structured_mesh(8)
    const double s = 8 * x - std::floor(8 * x), t = 8 * y - std::floor(8 * y), third = s > t ? 1.0 / 3 : 2.0 / 3;
    return 1 + 10 * std::exp(-(std::pow(s - 1 + third, 2) + std::pow(t - third, 2)) / 0.01);
  };
  const auto gap = [](double x) { return 0.4 * std::pow(1 - std::min(std::min(x, 1 - x) / 0.25, 1.0), 4); };
  const Scene rough({bumps}),
      lowered({[](double, double) { return 0.0; }}, NoLayer{}, UnilateralContact{gap, {}},
              {{"rim", EdgeCondition::Kind::displacement, [](double, double) { return -0.4; }}});
  const auto rim = [](double, double) { return held_group(0); };
  for (const auto& [scene, coarse, fine] :
       {std::tuple(rough, structured_mesh(8, {0}), structured_mesh(128, {0})),
        {lowered, retagged(structured_mesh(4, {0}), rim), retagged(structured_mesh(128, {0}), rim)}}) {
    const EnergyBracket found = energy_bracket(scene, coarse), truth = energy_bracket(scene, fine);
    EXPECT_LE(found.lower, truth.upper);
    EXPECT_GE(found.upper, truth.lower);
  }
}

TEST(EnergyBracket, IsNeededTheEnergyOfCrouzeixRaviartAloneIsNoBound) {
  // -lap u = 1 on the unit square, u = 0 around: int u = 0.0351442537 (torsion of a square bar), J = -int u / 2
  constexpr double exact = -0.5 * 0.0351442537;
  const Scene scene({[](double, double) { return 1.0; }});
  const SpaceOn space(structured_mesh(1, {0}), crouzeix_raviart());
  VariationalInequality problem = assemble(scene, space);
  // the edge y = 0 is Sigma, free without contact: clamp it
  for (const int i : space.contact()) problem.fixed.push_back(i);
  std::sort(problem.fixed.begin(), problem.fixed.end());
  problem.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.fixed.size()));
  const Solution solution = active_set(problem);
  EXPECT_NEAR(energy(problem, solution), -1.0 / 144, 1e-15);  // one unknown, by hand
  EXPECT_GT(energy(problem, solution), exact);                // above
  EXPECT_LE(certify(scene, space, problem, solution).energy_lower, exact);
}

// Against the bracket of a mesh eight times as fine: a gap that the chord cuts, fixed values, a solve stopped early.
TEST(EnergyBracket, HoldsWithAGapWithFixedValuesAndAfterAnEarlyStop) {
  const Scene scene({paper_load}, StiffLayer{1e-2}, UnilateralContact{[](double x) { return 0.02 * x * (1 - x); }});
  const TriangleMesh mesh = unstructured_mesh(6), fine = unstructured_mesh(48);
  const EnergyBracket coarse = energy_bracket(scene, mesh), reference = energy_bracket(scene, fine);
  EXPECT_LE(coarse.lower, reference.upper);
  EXPECT_LE(reference.lower, coarse.upper);
  EXPECT_LT(coarse.width(), 0.3 * std::abs(coarse.upper));  // h = 1/6
  // an obstacle that rises between two vertices
  const Scene needle({paper_load}, StiffLayer{1e-2}, UnilateralContact{[](double x) {
                       return 0.02 - 0.5 * std::exp(-std::pow((x - 0.75) / 0.02, 2));
                     }});
  EXPECT_LE(energy_bracket(needle, fine).lower, energy_bracket(needle, mesh).upper);

  double before = reference.upper;
  for (const double noise : {0.0, 0.02, 0.2}) {
    Answered run(mesh, scene);
    disturb(run, noise, 7);
    EXPECT_LT(run.certified().energy_lower, before) << "less is known";
    before = run.certified().energy_lower;
  }
}

TEST(AccurateEnough, FollowsTheBracket) {
  const EnergyBracket bracket{-1, -0.99};
  const AccurateEnough enough = accurate_enough(bracket, 1, 0.5);
  EXPECT_NEAR(enough.relative, 0.005, 1e-15);  // half of 1 %
  EXPECT_NEAR(enough.energy, 0.005 * 0.005, 1e-18);
  EXPECT_NEAR(accurate_enough(bracket, 2, 0.5).relative, enough.relative / 4, 1e-15) << "h^2";
  for (const double bad : {0.0, -1.0, std::nan(""), infinity}) {
    test::expect_refused([&] { accurate_enough(bracket, bad); }, "times as coarse");
    test::expect_refused([&] { accurate_enough(bracket, 1, bad); }, "a share of");
  }
  for (const EnergyBracket& nothing : {EnergyBracket{0, 0}, EnergyBracket{-0.99, -1}, EnergyBracket{-1, NAN}}) {
    EXPECT_EQ(accurate_enough(nothing).energy, 0);
    EXPECT_EQ(accurate_enough(nothing).relative, 0);
  }
}

TEST(AccurateEnough, SavesCorrectionsAndNoAccuracy) {
  const auto save = [](const std::string& element_name, const TriangleMesh& mesh, const TriangleMesh& coarse) {
    const Space space(mesh, element(element_name));
    for (const double epsilon : {1e-6, 0.0}) {
      const TruthTable truth(Truth(paper_sine_load(), epsilon, true, 14));
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Solution full = active_set(problem);
      ActiveSetOptions options;
      options.corrections.tolerance = accurate_enough(energy_bracket(test::stiff_scene(epsilon), coarse), 2).relative;
      const Solution early = active_set(problem, options);
      EXPECT_LT(early.counters.corrections, full.counters.corrections) << element_name << epsilon;
      const Errors a = measure_errors(space, full, epsilon, reference(truth)),
                   b = measure_errors(space, early, epsilon, reference(truth));
      // the promise of accurate_enough
      EXPECT_LT(b.max, 1.01 * a.max) << element_name << epsilon;
      EXPECT_LT(b.energy, 1.01 * a.energy) << element_name << epsilon;
    }
  };
  save("P1", structured_mesh(32), structured_mesh(16));
  save("P1", unstructured_mesh(16), unstructured_mesh(8));  // locked
  save("CR", unstructured_mesh(16), unstructured_mesh(8));
}

// ==== Locking is a property of the discretisation, not a bug: P1 on an unstructured mesh must lock, the others must not.

/// The whole displacement of the layer in the truth at small epsilon (max of u on Gamma_C, by the sine series).
constexpr double layer_displacement = 0.0457160;

double largest_on_layer(const Space& space, const Solution& s) {
  double largest = 0;
  for (int i = 0; i < space.size(); ++i)
    if (space.points()(i, 1) <= 0) largest = std::max(largest, std::abs(s.u(i)));
  return largest;
}

TEST(Locking, IsThatOfP1UnstructuredAtSmallEpsilonAlone) {
  const auto on_layer = [](const TriangleMesh& mesh, const Element& element, double epsilon) {
    const Space space(mesh, element);
    return largest_on_layer(space, active_set(stiff_problem(space, epsilon)));
  };
  const TriangleMesh structured = structured_mesh(32), unstructured = unstructured_mesh(32), columns = layered_mesh(32),
                     one_row = layered_mesh(32, 0);
  for (const double epsilon : {1e-6, 0.0})
    for (const auto& [mesh, element] :
         {std::pair{&structured, &p1()}, std::pair{&structured, &crouzeix_raviart()}, std::pair{&columns, &p1()},
          std::pair{&one_row, &p1()}, std::pair{&unstructured, &crouzeix_raviart()}})
      EXPECT_NEAR(on_layer(*mesh, *element, epsilon) / layer_displacement, 1, 0.03) << element->name() << epsilon;
  EXPECT_NEAR(on_layer(unstructured, p1(), 1) / 0.12618750, 1, 0.02);  // the truth: u(.25, 0)
  for (const int cells : {16, 32, 64})  // the displacement is lost: what is left of it falls like epsilon^2 / h^2
    EXPECT_LT(on_layer(unstructured_mesh(cells), p1(), 1e-6), 1e-3 * layer_displacement) << cells;
}

TEST(Locking, TheLockedSolutionIsDirichletsOnTheBody) {
  // as the paper says of Figure 7: u vanishes on the layer, and solves the Laplace problem on the body clamped all
  // round
  const SpaceOn space(unstructured_mesh(16), p1());
  const Solution locked = active_set(stiff_problem(space, 0));
  EXPECT_LT(largest_on_layer(space, locked), 1e-9);
  VariationalInequality dirichlet = assemble(Scene({paper_load}, StiffLayer{1}), space);
  std::vector<int> fixed;
  for (int i = 0; i < space.size(); ++i) {
    const double x = space.points()(i, 0), y = space.points()(i, 1);
    if (x == 0 || x == 1 || y == 1 || y <= 0) fixed.push_back(i);
  }
  dirichlet.fixed = fixed;
  dirichlet.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fixed.size()));
  EXPECT_LT(relative_difference(locked.u, active_set(dirichlet).u), 1e-8);
}

int kernel_dimension(const Space& space) { return layer_kernel_dimension(stiff_problem(space, 0)); }

// Of degree p: cells * p - 1 functions of x on columns, and on tied triangles x (1 - x) times degree p - 2.
TEST(Locking, IsTheDimensionOfTheKernelOfA0) {
  for (const int cells : {4, 8}) {  // finer, B nearly misses functions of high degree, and a rank means less
    const TriangleMesh unstructured = unstructured_mesh(cells);
    const auto layer = std::count(unstructured.region.begin(), unstructured.region.end(), Region::layer);
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
  test::expect_refused([&] { diagnose_locking(problem, problem); }, "accepted: more on the second mesh");
  VariationalInequality soft = problem;
  soft.b.resize(0, soft.size());
  soft.m.resize(0);
  test::expect_refused([&] { diagnose_locking(problem, soft); }, "B has no rows");
}

TEST(Locking, LeavesP2OneParabolaWhereTheLoadIsNotOddAboutTheMiddle) {
  const SpaceOn space(unstructured_mesh(4), p2());
  const auto largest_off_parabola = [&](const SineLoad& load, double& c) {
    const Solution s = active_set(assemble(Scene({load}, StiffLayer{0}, UnilateralContact{}), space));
    const Eigen::ArrayXd x = space.points().col(0).array(), parabola = x * (1 - x);
    double off = 0;
    c = s.u(space.contact()).maxCoeff() * 4;  // at the middle x (1 - x) = 1/4
    for (int i = 0; i < space.size(); ++i)
      if (space.points()(i, 1) <= 0) off = std::max(off, std::abs(s.u(i) - c * parabola(i)));
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
  const double truth = Truth(paper_sine_load(), 0).energy();
  EXPECT_NEAR(truth, -0.44154446, 1e-8);
  const auto above = [&](const TriangleMesh& mesh, const Element& element) {
    const Space space(mesh, element);
    const VariationalInequality problem = stiff_problem(space, 0);
    return energy(problem, active_set(problem)) - truth;
  };
  struct Row {
    int cells;
    double p1, cr, cr_unstructured, p1_unstructured;
  };
  // two digits each, measured by a first program that shares no line with this library
  for (const Row& row : {Row{16, 1.0e-2, -2.8e-3, -2.1e-3, 1.5e-2}, Row{32, 2.6e-3, -7.2e-4, -5.2e-4, 1.1e-2},
                         Row{64, 6.5e-4, -1.8e-4, -1.3e-4, 9.5e-3}}) {
    EXPECT_NEAR(above(structured_mesh(row.cells), p1()) / row.p1, 1, 0.05) << row.cells;
    EXPECT_NEAR(above(structured_mesh(row.cells), crouzeix_raviart()) / row.cr, 1, 0.05) << row.cells;
    const TriangleMesh mesh = unstructured_mesh(row.cells);
    EXPECT_NEAR(above(mesh, crouzeix_raviart()) / row.cr_unstructured, 1, 0.2) << row.cells;
    EXPECT_NEAR(above(mesh, p1()) / row.p1_unstructured, 1, 0.2) << row.cells;
  }
}

/// Broken H1 seminorm.
SparseMatrix h1_seminorm(const Space& space) { return gradient_form(space, {1, 1}, {1, 1}); }
Eigen::MatrixXd seen_by(const Space& space, int merged = 1) {
  return multiplier_gram(stiff_problem(space, 0), h1_seminorm(space), merged);
}

TEST(InfSup, OfCrouzeixRaviartIsAtLeastOneInTheDualNorm) {
  // Lemma 2: grad I_h v = mean of grad v, so that I_h does not enlarge the norm. A larger V only lowers the constant.
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
    const SpaceOn space(structured_mesh(cells), element);
    return inf_sup(seen_by(space), stiff_problem(space, 0).m.asDiagonal());
  };
  // 1.82 measured: the order comes with h
  EXPECT_NEAR(constant(4, crouzeix_raviart()) / constant(8, crouzeix_raviart()), 2, 0.25);
  EXPECT_EQ(constant(4, p1()), 0);
}

TEST(InfSup, AndCoercivityRefuseWhatDoesNotFit) {
  const SpaceOn space(structured_mesh(4), p1()), finer(structured_mesh(40), p1());
  test::expect_refused([&] { seen_by(space, 5); }, "5 a multiplier");
  test::expect_refused([&] { multiplier_gram(stiff_problem(space, 0), SparseMatrix(3, 3)); }, "the norm is 3 x 3");
  const Eigen::MatrixXd seen = seen_by(space);
  test::expect_refused([&] { inf_sup(seen, 0 * seen); }, "not positive definite");
  test::expect_refused([&] { coercivity(stiff_problem(space, 0), SparseMatrix(3, 3)); }, "the norm is 3 x 3");
  test::expect_refused([&] { coercivity(stiff_problem(finer, 0), h1_seminorm(finer)); }, "accepted at most 2000");
}

/// Errors in the broken H1 norm for epsilon = 1, 1e-1, 1e-2, 1e-4, 1e-8, 0.
std::vector<double> h1_errors(const Space& space) {
  static const std::vector<double> epsilons{1, 1e-1, 1e-2, 1e-4, 1e-8, 0};
  static const std::vector<TruthTable> truth = [] {  // 2^13 points: gradients to 2e-6
    std::vector<TruthTable> tables;
    tables.reserve(epsilons.size());
    for (const double epsilon : epsilons) tables.emplace_back(Truth(paper_sine_load(), epsilon, true, 13));
    return tables;
  }();
  SceneSweep sweep(test::stiff_scene(1), space);
  std::vector<double> errors;
  for (std::size_t i = 0; i < epsilons.size(); ++i) {
    sweep.set_epsilon(epsilons[i]);
    errors.push_back(measure_errors(space, sweep.solve(), epsilons[i], reference(truth[i])).h1);
  }
  return errors;
}
double worst(const std::vector<double>& errors) { return *std::max_element(errors.begin(), errors.end()); }

TEST(UniformConvergence, OfTheoremsFiveAndSevenAndNotOfP1Unstructured) {
  const auto meshes = [](bool structured) {
    return structured ? std::pair(structured_mesh(8), structured_mesh(16))
                      : std::pair(unstructured_mesh(8), unstructured_mesh(16));
  };
  for (const bool structured : {true, false})
    for (const Element* element : {&p1(), &crouzeix_raviart()}) {
      const auto [coarse, fine] = meshes(structured);
      const auto on_coarse = h1_errors(Space(coarse, *element)), on_fine = h1_errors(Space(fine, *element));
      const double ratio = worst(on_fine) / on_fine.front();  // of Babuska and Suri
      if (structured || element != &p1()) {
        EXPECT_NEAR(worst(on_coarse) / worst(on_fine), 2, 0.1) << element->name() << structured;  // first order
        EXPECT_LT(ratio, 1.05) << element->name() << structured;  // the worst case is epsilon = 1, or almost
      } else {
        EXPECT_LT(worst(on_coarse) / worst(on_fine), 1.6);
        EXPECT_GT(worst(on_fine), 0.138);  // what the layer's displacement is worth, sup over epsilon as h -> 0
        EXPECT_GT(ratio, 1.3 * worst(on_coarse) / on_coarse.front());
      }
    }
}

TEST(Locking, ComesWithTheFirstJitterAndGrowsWithItsShareOfEpsilon) {
  // At fixed h a function of x alone is missed by t h, at the price (t h / epsilon)^2: the answer knows t / epsilon
  // alone, up to the change of the mesh itself, of order t.
  const auto on_layer = [](double t, double epsilon) {
    const SpaceOn space(jittered_mesh(8, t), p1());
    EXPECT_EQ(kernel_dimension(space), 0) << t;
    return largest_on_layer(space, active_set(stiff_problem(space, epsilon))) / layer_displacement;
  };
  const double some = on_layer(1e-3, 1e-3), half = on_layer(1e-2, 1e-3), most = on_layer(1e-1, 1e-3);
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
        slope += 0.5 * std::pow(mesh.vertices(mesh.triangles(t, i), 0), 2) * gradients(i, 1);  // w'' = 1
        around *= mesh.edge_length(mesh.triangle_edges(t, i));
      }
      EXPECT_NEAR(bending_length(mesh, t), std::abs(slope), 1e-13) << family.name;
      EXPECT_LE(bending_length(mesh, t), around / (4 * mesh.area(t)) * (1 + 1e-12)) << family.name;  // circumradius
      if (mesh.region[t] == Region::layer) sum += mesh.area(t) * slope * slope;
    }
    EXPECT_NEAR(bending_length(mesh), std::sqrt(sum), 1e-13) << family.name;  // the layer has the area 1
  }
  for (const char* name : {"structured", "layered", "columns"})  // gmsh places points to about 1e-12
    EXPECT_LT(bending_length(mesh_family(name).mesh(8)), 1e-11) << name;
  // h^2 / (8 H) in a row of triangles of base h and height H; the halves at the ends lean on the sides
  EXPECT_NEAR(bending_length(mesh_family("staggered").mesh(8)), std::sqrt(15.0 / 16) * h / 8, 1e-15);
  EXPECT_EQ(bending_length(structured_mesh(4, {0})), 0);
}

// ==== Inf-sup constants under contact.

/// On 4, 8 and 12 cells a side, with the contact set of the solution held or without.
std::vector<double> inf_sup_constants(const Element& element, bool per_vertex, bool contact) {
  std::vector<double> beta;
  for (const int n : {4, 8, 12}) {
    const SpaceOn space(block(n), element);
    const VariationalInequality problem = rubber(space, per_vertex);
    std::vector<bool> active(problem.contact.size());
    if (contact) active = active_set(problem).active;
    const VariationalInequality held = held_in_contact(problem, active);
    beta.push_back(inf_sup(multiplier_gram(held, held.a1), Eigen::MatrixXd(held.m.asDiagonal())));
  }
  return beta;
}

TEST(InfSupUnderContact, StaysForMixedMethodsThatPass) {
  for (const auto& [element, per_vertex] :
       {std::pair{&p1_bubble(), true}, {&p2(), true}, {&crouzeix_raviart(), false}}) {
    const std::vector<double> free = inf_sup_constants(*element, per_vertex, false),
                              held = inf_sup_constants(*element, per_vertex, true);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(held[i], 0.9 * held[0]) << element->name();
      EXPECT_LE(held[i], free[i] * (1 + 1e-10)) << element->name();  // a supremum over fewer functions
      EXPECT_GT(held[i], 0.9 * free[i]) << element->name();
    }
  }
}

TEST(InfSupUnderContact, FallsForP1) {
  const std::vector<double> free = inf_sup_constants(p1(), false, false), held = inf_sup_constants(p1(), false, true);
  EXPECT_NEAR(free[0] / free[2], 3, 0.5);  // like h
  EXPECT_LT(held[2], 0.75 * free[2]);      // contact takes from what was little
  for (const double beta : inf_sup_constants(p1(), true, true)) EXPECT_EQ(beta, 0);  // a pressure that nobody sees
}

/// The marks of a finer mesh: what lies on an edge of Gamma_C both ends of which are held, or on a held vertex.
std::vector<bool> refined_marks(const Space& coarse, const std::vector<bool>& active, const Space& fine) {
  std::map<double, bool> held{{0, true}, {1, true}};  // the corners are clamped
  for (std::size_t i = 0; i < active.size(); ++i) held[coarse.points()(coarse.contact()[i], 0)] = active[i];
  std::vector<bool> marks;
  for (const int i : fine.contact()) {
    const auto right = held.lower_bound(fine.points()(i, 0) - 1e-9);
    const bool vertex = std::abs(right->first - fine.points()(i, 0)) < 1e-9;
    marks.push_back(right->second && (vertex || std::prev(right)->second));
  }
  return marks;
}

/// (23), P1 with means over boxes of side 2h, in the dual norm of the theory: that of P1 on the mesh refined twice,
/// with the same contact held. A box holds the 16 parts of each of its triangles.
double inf_sup_of_boxes(const TriangleMesh& mesh, int n, bool contact) {
  const TriangleMesh fine = refined(refined(mesh));
  const Space space(mesh, p1()), all(fine, p1());
  const VariationalInequality problem = stiff_problem(space, 0);
  const Shares boxes = box_shares(mesh, layer_strain(space), 2.0 / n, 2.0 / n);
  std::vector<Eigen::Triplet<double>> parts;
  for (Eigen::Index g = 0; g < boxes.rows(); ++g)
    for (Shares::InnerIterator share(boxes, g); share; ++share)
      for (int k = 0; k < 16; ++k)
        parts.emplace_back(static_cast<int>(g), 16 * static_cast<int>(share.col()) + k, share.value());
  Shares of_all(boxes.rows(), 16 * boxes.cols());
  of_all.setFromTriplets(parts.begin(), parts.end());
  std::vector<bool> held(problem.contact.size());
  if (contact) held = active_set(projected(problem, boxes, 0.5)).active;
  const VariationalInequality here = held_in_contact(projected(problem, boxes), held),
                              there = held_in_contact(projected(stiff_problem(all, 0), of_all),
                                                      refined_marks(space, held, all));
  return inf_sup(multiplier_gram(here, h1_seminorm(space)), multiplier_gram(there, h1_seminorm(all)));
}

TEST(InfSupUnderContact, OfBoxesStaysOnColumnsAndFallsOffThem) {
  for (const bool contact : {false, true}) {
    // measured: 0.73, 0.73, 0.73 and 0.73, 0.68, 0.73
    for (const int n : {4, 8, 16}) EXPECT_GT(inf_sup_of_boxes(structured_mesh(n), n, contact), 0.6) << n << contact;
    // 0.67, 0.45 and 0.59, 0.40 (at 1/32: 0.26, 0.21): functions of x that change within a box still lock
    const double coarse = inf_sup_of_boxes(unstructured_mesh(8), 8, contact),
                 fine = inf_sup_of_boxes(unstructured_mesh(16), 16, contact);
    EXPECT_GT(coarse, 0.5) << contact;
    EXPECT_LT(fine, 0.8 * coarse) << contact;
    EXPECT_GT(fine, 0.3) << contact;
  }
}

TEST(InfSupUnderContact, IsZeroWhereAConfinedBlockIsHeldAllRound) {
  const TriangleMesh mesh = structured_mesh(6, Domain{0});
  for (const Element* element : {&p1_bubble(), &p2()}) {
    const Space space(mesh, *element);
    VariationalInequality problem = rubber(space, true);
    const VariationalInequality held = held_in_contact(problem, std::vector<bool>(problem.contact.size(), true));
    EXPECT_EQ(inf_sup(multiplier_gram(held, held.a1), Eigen::MatrixXd(held.m.asDiagonal())), 0) << element->name();
    // pushed by .1 into a groove of .083: no motion keeps the volume
    EXPECT_THROW(active_set(problem), NotConverged) << element->name();
    problem.compliance = 1e-8;
    EXPECT_GT(active_set(problem).lambda.sum(), 1e5) << element->name();
  }
}

// ==== The diagnosis of locking held against what is kept: members of the class, elements and meshes, locked and not.

using Problem = std::function<VariationalInequality(int cells)>;

/// What a force on the bounds does at compliance 1e-8, without bounds.
double flexibility(VariationalInequality problem) {
  problem.load.setZero();
  for (const int i : problem.contact) problem.load(i) = 1.0 / static_cast<double>(problem.contact.size());
  problem.fixed_values.setZero();
  problem.compliance = 1e-8;
  const std::vector<bool> none(problem.contact.size());
  return active_set(held_in_contact(problem, none)).u.dot(problem.load);
}

/// `kept` is measured: the flexibility at compliance 1e-8 over that of the method that is known to be right.
LockingDiagnosis expect_right(const std::string& name, const Problem& method, const Problem& right, int cells,
                              bool locks, std::pair<double, double> kept) {
  VariationalInequality coarse = method(cells / 2), fine = method(cells);
  const LockingDiagnosis found = diagnose_locking(coarse, fine);
  EXPECT_EQ(found.locks(), locks) << name << ": " << found.text();
  EXPECT_EQ(found.text().find("locks") != std::string::npos, locks) << found.text();
  const double measured = flexibility(fine) / flexibility(right(cells));
  fmt::print("| {} | {} | {:.3g} |\n", name, found.text(), measured);  // the table of what is told and what is kept
  EXPECT_GE(measured, kept.first) << name;
  EXPECT_LE(measured, kept.second) << name;
  for (const double unit : {1e6, 1e-9}) {  // no unit of A1 is better than another
    coarse.a1 *= unit, fine.a1 *= unit;
    EXPECT_EQ(diagnose_locking(coarse, fine).locks(), locks) << name << unit;
  }
  return found;
}
constexpr std::pair<double, double> all{0.9, 1.15}, nearly_none{-1e-12, 0.1};

TEST(LockingDiagnosis, IsRightForTheScaledLayerOnNineFamiliesOfMeshes) {
  const auto method = [](const std::string& family, const Element& element) -> Problem {
    return [family, &element](int cells) {
      const TriangleMesh mesh = mesh_family(family).mesh(cells);
      return test::stiff_problem(Space(mesh, element), 0);
    };
  };
  const Problem right = method("structured", p2());
  for (const MeshFamily& family : mesh_families()) {
    const bool columns = family.name == "structured" || family.name == "layered" || family.name == "columns";
    const LockingDiagnosis found =
        expect_right(family.name + " P1", method(family.name, p1()), right, 16, !columns, columns ? all : nearly_none);
    EXPECT_EQ(found.verdict() == Verdict::locks_completely, found.fine == 0);
    EXPECT_EQ(found.fine, family.name == "structured" ? 15 : found.fine) << "all move";
    expect_right(family.name + " CR", method(family.name, crouzeix_raviart()), right, 16, false, all);
    // the one parabola that P2 keeps is what this force asks for: other loads find nothing
    const int kept = expect_right(family.name + " P2", method(family.name, p2()), right, 16, !columns, all).fine;
    EXPECT_EQ(kept, family.name == "unstructured" ? 1 : kept);
  }
}

TEST(LockingDiagnosis, FindsThatAHalfIsHeld) {
  const auto method = [](int cells) {  // columns on the left, tied triangles on the right
    TriangleMesh mesh = structured_mesh(cells);
    const TriangleMesh moved = jittered_mesh(cells, 0.2);
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 0) > 0.5 && mesh.vertices(v, 1) < 0) mesh.vertices.row(v) = moved.vertices.row(v);
    return test::stiff_problem(Space(mesh, p1()), 0);
  };
  const LockingDiagnosis found = diagnose_locking(method(8), method(16));
  EXPECT_EQ(found.verdict(), Verdict::locks_in_part) << found.text();
  EXPECT_GT(found.fine, found.coarse) << "it grows, and yet";
}

TEST(LockingDiagnosis, IsRightForRubberWhereTheBoundsMoveInsideOneTriangleAlone) {
  const auto method = [](Diagonal diagonal, bool any, const Element& x, const Element& y) -> Problem {
    return [=, &x, &y](int cells) {
      const TriangleMesh mesh =
          with_free_sides(any ? unstructured_mesh(cells, {0}) : structured_mesh(cells, {0}, diagonal));
      const Space of_x(mesh, x), of_y(mesh, y);
      PlaneStrain rubber;
      rubber.epsilon = 0;
      return assemble(rubber, VectorSpace{of_x, of_y});
    };
  };
  const Element& cr = crouzeix_raviart();
  const Problem right = method(Diagonal::crossed, false, p2(), p2());
  expect_right("rubber P1 right", method(Diagonal::right, false, p1(), p1()), right, 32, true, {0.3, 0.7});
  expect_right("rubber P1 unstructured", method(Diagonal::right, true, p1(), p1()), right, 32, true, {0.3, 0.85});
  expect_right("rubber P1 crossed", method(Diagonal::crossed, false, p1(), p1()), right, 32, false, all);
  expect_right("rubber CR", method(Diagonal::right, true, cr, cr), right, 32, false, all);
  expect_right("rubber P1 / CR", method(Diagonal::right, true, p1(), cr), right, 32, false, all);
}

TEST(LockingDiagnosis, IsRightForBeamAndPlate) {
  const auto beam = [](ShearIntegration shear) -> Problem {
    return [shear](int cells) { return assemble(Beam{.cells = cells, .epsilon = 0, .shear = shear}); };
  };
  expect_right("beam, full", beam(ShearIntegration::full), beam(ShearIntegration::reduced), 32, true, nearly_none);
  expect_right("beam, reduced", beam(ShearIntegration::reduced), beam(ShearIntegration::reduced), 32, false, all);
  // prescribed values do not matter; without bounds all unknowns of the stiff part are counted, and those that B ties
  // are no sign of locking
  VariationalInequality coarse = beam(ShearIntegration::reduced)(16), fine = beam(ShearIntegration::reduced)(32);
  const double softening = diagnose_locking(coarse, fine).softening;
  for (VariationalInequality* problem : {&coarse, &fine}) problem->fixed_values.setOnes();
  EXPECT_EQ(diagnose_locking(coarse, fine).softening, softening);
  for (VariationalInequality* problem : {&coarse, &fine}) problem->contact.clear(), problem->lower.resize(0);
  EXPECT_FALSE(diagnose_locking(coarse, fine).locks());
  const auto plate = [](const Element& deflection, const Element& rotation, ShearRule shear) -> Problem {
    return [=, &deflection, &rotation](int cells) {
      TriangleMesh mesh = unstructured_mesh(cells, {0});
      for (int e = 0; e < mesh.edge_count(); ++e)
        if (mesh.edge_triangles(e, 1) < 0) mesh.edge_tag[e] = EdgeTag::clamped;
      const Space w(mesh, deflection), theta(mesh, rotation);
      return assemble(Plate{.thickness = 0}, PlateSpace{w, {theta, theta}, shear});
    };
  };
  const Problem right = plate(p1(), p1(), ShearRule::edges);
  expect_right("plate P1", plate(p1(), p1(), ShearRule::exact), right, 16, true, nearly_none);
  expect_right("plate P1, one point", plate(p1(), p1(), ShearRule::mean), right, 16, true, nearly_none);
  expect_right("plate Duran-Liberman", right, right, 16, false, all);
  expect_right("plate Arnold-Falk", plate(crouzeix_raviart(), p1_bubble(), ShearRule::mean), right, 16, false,
               {0.8, 1.15});
}

/// A block with a coating, nu = 0.3, whose top is pushed down on a round punch.
VariationalInequality coating(const TriangleMesh& mesh, const Element& of_x, const Element& of_y, double t) {
  const Space x(mesh, of_x), y(mesh, of_y);
  Coating scene;
  scene.thickness = t;
  scene.gap = [](double at) { return (at - 0.5) * (at - 0.5); };
  return assemble(scene, VectorSpace{x, y});
}

// The contact force at t = 1e-6 is the measure; t = 0 in the rows is what the diagnosis is asked for. With u_x
// Crouzeix-Raviart and u_y P1 the kernel grows fast, and none of it moves a bound.
TEST(LockingDiagnosis, IsRightForACoatingInPlaneStrain) {
  const Element &cr = crouzeix_raviart(), &one = p1();
  struct Case {
    std::string name;
    bool columns;
    const Element &x, &y;
    bool locks;
  };
  const auto mesh = [](bool columns, int cells) {
    return with_free_sides(columns ? structured_mesh(cells) : unstructured_mesh(cells));
  };
  constexpr int cells = 16;
  const auto force = [&](const Case& c) {
    return active_set(coating(mesh(c.columns, cells), c.x, c.y, 1e-6)).lambda.sum();
  };
  const Case right{"P2 columns", true, p2(), p2(), false};
  const double reference = force(right);
  for (const Case& c : {right, Case{"P1 columns", true, one, one, false}, Case{"P1 / P1", false, one, one, true},
                        Case{"P2 / P2", false, p2(), p2(), true}, Case{"CR / CR", false, cr, cr, false},
                        Case{"P1 / CR", false, one, cr, false}, Case{"CR / P1", false, cr, one, true}}) {
    const LockingDiagnosis found = diagnose_locking(coating(mesh(c.columns, cells / 2), c.x, c.y, 0),
                                                    coating(mesh(c.columns, cells), c.x, c.y, 0));
    EXPECT_EQ(found.locks(), c.locks) << c.name << ": " << found.text();
    const double off = force(c) / reference - 1;
    fmt::print("| coating {} | {} | force {:+.1f} % |\n", c.name, found.text(), 100 * off);
    EXPECT_EQ(off > 0.1, c.locks) << c.name << ": the contact force is off by " << off;
  }
}

/// (23) in three dimensions: cubes cut in six tetrahedra (Kuhn), inner vertices moved by up to `moved` h; P1 or
/// Crouzeix-Raviart (an unknown per face).
VariationalInequality tetrahedra(int n, double moved, bool nonconforming, double compliance) {
  const auto vertex = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };  // k from z = -1 up
  std::vector<Eigen::Vector3d> at;
  std::mt19937 random(7);
  const auto step = [&] { return moved / n * (2.0 * random() / std::mt19937::max() - 1); };
  for (int k = 0; k <= 2 * n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        Eigen::Vector3d x(i, j, k - n);
        x /= n;
        if (i > 0 && i < n && j > 0 && j < n && k > 0 && k < 2 * n && k != n)
          x += Eigen::Vector3d(step(), step(), step());
        at.push_back(x);
      }
  std::map<std::array<int, 3>, int> faces;
  std::vector<Eigen::Vector3d> places = nonconforming ? std::vector<Eigen::Vector3d>{} : at;
  std::vector<Eigen::Triplet<double>> a1, b;
  std::vector<double> m, loads;
  std::vector<std::pair<int, double>> load;
  const std::array<std::array<int, 3>, 6> orders{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (int k = 0; k < 2 * n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& order : orders) {
          std::array<int, 4> corner{};
          std::array<int, 3> c{i, j, k};
          corner[0] = vertex(c[0], c[1], c[2]);
          for (int s = 0; s < 3; ++s) ++c[order[s]], corner[s + 1] = vertex(c[0], c[1], c[2]);
          Eigen::Matrix4d affine;
          for (int s = 0; s < 4; ++s) affine.row(s) << 1, at[corner[s]].transpose();
          const Eigen::Matrix<double, 3, 4> lambda = pseudo_inverse(affine).bottomRows<3>();
          const double volume = std::abs(affine.determinant()) / 6;
          std::array<int, 4> unknown = corner;
          if (nonconforming)
            for (int s = 0; s < 4; ++s) {
              std::array<int, 3> face{corner[(s + 1) % 4], corner[(s + 2) % 4], corner[(s + 3) % 4]};
              std::sort(face.begin(), face.end());
              const auto [place, fresh] = faces.emplace(face, static_cast<int>(places.size()));
              if (fresh) places.emplace_back((at[face[0]] + at[face[1]] + at[face[2]]) / 3);
              unknown[s] = place->second;
            }
          const Eigen::Matrix<double, 3, 4> gradient = nonconforming ? -3 * lambda : lambda;
          const bool body = k >= n;
          for (int r = 0; r < 4; ++r) {
            for (int s = 0; s < 4; ++s)
              a1.emplace_back(unknown[r], unknown[s],
                              volume * gradient.col(r).head(body ? 3 : 2).dot(gradient.col(s).head(body ? 3 : 2)));
            if (!body) b.emplace_back(static_cast<int>(m.size()), unknown[r], gradient(2, r));
          }
          if (!body) m.push_back(volume);
        }
  VariationalInequality problem;
  const auto size = static_cast<Eigen::Index>(places.size());
  problem.a1.resize(size, size);
  problem.a1.setFromTriplets(a1.begin(), a1.end());
  problem.b.resize(static_cast<Eigen::Index>(m.size()), size);
  problem.b.setFromTriplets(b.begin(), b.end());
  problem.m = Eigen::Map<Eigen::VectorXd>(m.data(), static_cast<Eigen::Index>(m.size()));
  problem.compliance = compliance;
  problem.load = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < size; ++i) {
    const Eigen::Vector3d& x = places[i];
    const bool side = std::min({x(0), x(1), 1 - x(0), 1 - x(1), 1 - x(2)}) < 1e-12;
    if (side) problem.fixed.push_back(i);
    if (!side && x(2) < -1 + 1e-12) problem.contact.push_back(i);
  }
  problem.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.fixed.size()));
  problem.lower = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.contact.size()));
  return problem;
}

TEST(LockingDiagnosis, IsRightForTetrahedra) {
  const auto method = [](double moved, bool nonconforming) -> Problem {
    return [=](int cells) { return tetrahedra(cells, moved, nonconforming, 0); };
  };
  const Problem right = method(0, false);
  expect_right("tetrahedra P1, cubes", right, right, 8, false, all);
  expect_right("tetrahedra P1, moved", method(0.2, false), right, 8, true, nearly_none);
  // the bounds of Crouzeix-Raviart lie nearer to the clamped sides: the same force moves them less, cubes or not
  expect_right("tetrahedra CR, cubes", method(0, true), right, 8, false, {0.6, 1});
  expect_right("tetrahedra CR, moved", method(0.2, true), right, 8, false, {0.6, 1});
}

// ==== What an answer says of its own locking, held against a second solve of the same size whose layer cannot lock.

/// The energy of the same body whose layer is held at u, and nothing else asked of it.
double energy_with_held_layer(const Space& space, VariationalInequality problem, double u) {
  problem = own_rows_summed(std::move(problem));  // a body or a layer that is far stiffer than the other stays
  problem.b.resize(0, problem.size()), problem.m.resize(0);
  problem.contact.clear(), problem.lower.resize(0), problem.upper.resize(0), problem.fixed.clear();
  for (int i = 0; i < problem.size(); ++i)
    if (space.points()(i, 1) < 1e-12 || std::binary_search(space.clamped().begin(), space.clamped().end(), i))
      problem.fixed.push_back(i);
  problem.fixed_values.setConstant(static_cast<Eigen::Index>(problem.fixed.size()), u);
  return energy(problem, active_set(problem));
}

/// The share that is lost, by two more solves: on the same body with a layer in columns, and with the layer held.
double share_by_solving(const Scene& scene, const Space& space, double energy_at_hand) {
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  const Scene scaled(scene.body(), stiff != nullptr ? *stiff : StiffLayer{*scene.epsilon()}, scene.contact(),
                     scene.edges());
  const TriangleMesh columns = extruded(body_of(space.mesh()), *scene.epsilon());
  const Space free_space(columns, space.element());
  const VariationalInequality problem = assemble(scaled, free_space);
  const double best = energy(problem, active_set(problem));
  const double motion = energy_with_held_layer(free_space, problem, 0) - best;
  return motion > 1e-12 * std::abs(best) ? (energy_at_hand - best) / motion : 0;  // round-off of two energies
}

struct Lost {
  LostEnergy energy;
  LayerReport report;
  double share, by_solving;
};

Lost lost_on(const TriangleMesh& mesh, const Element& element, const Scene& scene) {
  const Space space(mesh, element);
  const VariationalInequality problem = assemble(scene, space);
  const Solution solution = active_set(problem);
  const LostEnergy lost = lost_energy(scene, space, problem, solution);
  return {lost, *report_layer(scene, space, problem, solution), lost.share(lost.found),
          share_by_solving(scene, space, energy(problem, solution))};
}

TEST(LostEnergy, LiesBelowWhatTheTruthSays) {
  for (const double epsilon : {1.0, 0.1, 1e-2, 1e-3, 1e-6, 0.0}) {
    const double truth = Truth(paper_sine_load(), epsilon, true, 14).energy();
    for (const int cells : {8, 32}) {
      const TriangleMesh mesh = unstructured_mesh(cells);
      for (const Element* element : {&p1(), &p2()}) {
        const Space space(mesh, *element);
        const Scene scene = test::stiff_scene(epsilon);
        const VariationalInequality problem = assemble(scene, space);
        const Solution solution = active_set(problem);
        const double lost = lost_energy(scene, space, problem, solution).proved, found = energy(problem, solution);
        // 1e-8: the truth is known to 6e-9 of its energy, 0.44
        EXPECT_GE(found - lost, truth - 1e-8) << epsilon << element->name() << cells << ": J(v) >= J(u)";
        // what is left of the error is that of the body's mesh: at 1/h = 32 the smaller part
        if (element == &p1() && epsilon < 1e-3 && cells == 32) {
          EXPECT_GE(lost, 0.5 * (found - truth)) << epsilon;
        }
      }
    }
  }
}

// The corrections in the body come from a small space, and the columns differ: affine in y with exact squares, where the
// second solve has P1 on triangles, which misses (2 pi h)^2 / 12 of the motion, 1.3 % at 1/h = 16.
TEST(LostEnergy, IsTheShareThatASecondSolveFinds) {
  for (const int cells : {16, 32})
    for (const double epsilon : {0.1, 0.03, 1e-2, 1e-3, 1e-6, 0.0})
      for (const std::string family : {"unstructured", "delaunay", "staggered", "jittered"}) {
        const TriangleMesh mesh = mesh_family(family).mesh(cells);
        for (const Element* element : {&p1(), &p2()}) {
          const Lost found = lost_on(mesh, *element, test::stiff_scene(epsilon));
          EXPECT_NEAR(found.share, std::clamp(found.by_solving, 0.0, 1.0), element == &p1() ? 0.004 : 0.01)
              << family << cells << element->name() << epsilon;
        }
      }
}

// Nothing passed over, no false alarm: decided by the second solve.
TEST(LostEnergy, WarnsOfTwoHundredRandomScenesWhereATenthIsLostAndOnlyWhereThereIsLocking) {
  std::mt19937 random(2028);
  const auto uniform = [&] { return random() / (std::mt19937::max() + 1.0); };
  int warned = 0, silent = 0, uniform_methods = 0;
  for (int k = 0; k < 200; ++k) {
    const MeshFamily& family = mesh_families()[random() % mesh_families().size()];
    const int cells = 8 + 2 * static_cast<int>(random() % 9);
    const Element* const element = std::vector<const Element*>{&p1(), &p1(), &p2(), &crouzeix_raviart()}[random() % 4];
    const double epsilon = random() % 8 == 0 ? 0 : std::pow(10, -6 * uniform());
    std::vector<double> modes(3);
    for (double& mode : modes) mode = 20 * uniform() - 10;
    const int shortest = 3 + static_cast<int>(random() % (cells / 3));  // waves of six edges and longer
    const double tilt = 4 * uniform(), depth = 0.02 * uniform(), at = uniform();
    const Field load = [=](double x, double y) {
      double f = 0;
      for (int i = 0; i < 3; ++i) f += modes[i] * std::sin((i < 2 ? i + 1 : shortest) * std::numbers::pi * x);
      return f * (1 + tilt * y);
    };
    std::optional<UnilateralContact> contact;
    switch (random() % 6) {
      case 0:
        break;
      case 1:
        contact = UnilateralContact{};
        break;
      case 2:  // smooth, with a step, with kinks, with waves
        contact = UnilateralContact{[=](double x) { return depth * x * (1 - x); }};
        break;
      case 3:
        contact = UnilateralContact{[=](double x) { return x <= at ? 1.0 : 0.0; }};
        break;
      case 4:
        contact = UnilateralContact{[=](double x) { return std::abs(std::sin((4 + 16 * at) * std::numbers::pi * x)); }};
        break;
      default:
        contact = UnilateralContact{[=](double x) { return 10 * depth * (1 + std::cos(16 * std::numbers::pi * x)); }};
    }
    const Scene scene({load}, StiffLayer{epsilon}, contact);
    const TriangleMesh mesh = family.mesh(cells);
    const Space space(mesh, *element);
    const VariationalInequality problem = assemble(scene, space);
    const Solution solution = active_set(problem);
    const LayerReport report = *report_layer(scene, space, problem, solution);
    const bool says = report.warning.find("locks") != std::string::npos;
    const std::string name =
        fmt::format("scene {}: {} {} 1/{} epsilon {:g}", k, element->name(), family.name, cells, epsilon);
    EXPECT_EQ(says, !report.warning.empty()) << name;
    if (!element->conforming() || find_ties(mesh).in_columns) {
      EXPECT_FALSE(says) << name << ": converges uniformly";
      ++uniform_methods;
      continue;
    }
    const double share = share_by_solving(scene, space, energy(problem, solution));
    EXPECT_TRUE(says || share < 0.1) << name << ": " << share << " lost, reported " << report.lost.value_or(-1);
    EXPECT_TRUE(!says || share > 0.04) << name << ": " << share << " lost, reported " << report.lost.value_or(-1);
    ++(says ? warned : silent);
  }
  EXPECT_GE(warned, 40);
  EXPECT_GE(silent, 20);
  EXPECT_GE(uniform_methods, 40);
}

TEST(LostEnergy, SeesTheThinLayerOf22AsItSees23) {
  // the same layer twice: pressed to its true thickness, and scaled
  const double epsilon = 0.02;
  TriangleMesh mesh = mesh_family("delaunay").mesh(16);
  const double scaled = lost_on(mesh, p1(), test::stiff_scene(epsilon)).share;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertices(v, 1) < 0) mesh.vertices(v, 1) *= epsilon;
  const Lost thin = lost_on(mesh, p1(), Scene({paper_load}, ThinLayer{epsilon}, UnilateralContact{}));
  EXPECT_GT(scaled, 0.3);
  EXPECT_NEAR(thin.share, scaled, 1e-9);
  EXPECT_NE(thin.report.warning.find("locks"), std::string::npos);
}

TEST(LostEnergy, IsProvedOfP1BeyondThePapersScenes) {
  const TriangleMesh mesh =
      retagged(unstructured_mesh(16), [](double, double y) { return y == 1 ? natural_group(0) : EdgeTag::clamped; });
  using Kind = EdgeCondition::Kind;
  const auto on_top = [](Kind kind, double value) {
    return std::vector<EdgeCondition>{{"top", kind, [=](double x, double) { return value * (x + 0.2); }}};
  };
  const Body body{paper_load}, two{paper_load, [](double x, double) { return x > 0.5 ? 10 : 1; }};
  UnilateralContact low;
  low.ceiling = [](double) { return 0.02; };
  for (const double epsilon : {0.02, 1e-4})
    for (const Scene& scene : {Scene(two, StiffLayer{epsilon}, UnilateralContact{}, on_top(Kind::free, 0)),
                               Scene(body, StiffLayer{epsilon, 7}, UnilateralContact{}, on_top(Kind::free, 0)),
                               Scene(body, StiffLayer{epsilon}, low, on_top(Kind::free, 0)),
                               Scene(body, StiffLayer{epsilon}, UnilateralContact{}, on_top(Kind::traction, 3)),
                               Scene(body, StiffLayer{epsilon}, std::nullopt, on_top(Kind::spring, 5))}) {
      const Lost found = lost_on(mesh, p1(), scene);
      // at 0.02 v is constant in y and misses (2 pi epsilon)^2 / 3 of one wave, 0.5 %, and 2 % of two
      EXPECT_NEAR(found.share, found.by_solving, 0.015) << epsilon << scene.beyond_the_paper();
      EXPECT_NE(found.report.warning, "") << epsilon << scene.beyond_the_paper();
    }
}

// Short waves, of three to five edges: P3 and P4 have the unknowns for them, and v has those of u_h on Sigma.
TEST(LostEnergy, IsProvedOfEveryDegreeAndOfALoadOnTheLayer) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const auto waves = [](double k) -> Field {
    return [=](double x, double) { return 10 * std::sin(k * std::numbers::pi * x); };
  };
  const Field press = [](double, double) { return -10.0; }, grows = [](double x, double) { return 1 + x; };
  for (const double epsilon : {0.1, 1e-2, 1e-4})
    for (const auto& [element, body, layer_load] : {std::tuple(&p3(), Body{waves(6)}, Field()),
                                                    {&p3(), Body{waves(10)}, Field()},
                                                    {&p4(), Body{waves(6), grows}, Field()},
                                                    {&p4(), Body{waves(12)}, Field()},
                                                    {&p2(), Body{waves(8), grows}, Field()},
                                                    {&p1(), Body{press}, waves(1)},
                                                    {&p3(), Body{press}, waves(2)}}) {
      const Lost found = lost_on(mesh, *element, Scene(body, StiffLayer{epsilon, 1, layer_load}, UnilateralContact{}));
      EXPECT_NEAR(found.share, std::clamp(found.by_solving, 0.0, 1.0), 0.02) << element->name() << epsilon;
      EXPECT_EQ(!found.report.warning.empty(), found.share > 0.05) << element->name() << epsilon << found.share;
    }
}

// A gap with kinks between the points: v sinks in there as u_h does, and lifting it out costs more than it has gained.
TEST(LostEnergy, IsToldByTheSecondSolveWhereTheGapIsAsFineAsTheMesh) {
  const UnilateralContact kinks{[](double x) { return 0.1 * std::abs(std::sin(9 * std::numbers::pi * x)); }};
  const TriangleMesh mesh = unstructured_mesh(8);
  for (const double epsilon : {1.0, 0.1}) {
    const Scene scene({[](double x, double) { return x < 0.5 ? -10.0 : 10.0; }}, StiffLayer{epsilon}, kinks);
    const Lost found = lost_on(mesh, p1(), scene);
    EXPECT_NEAR(found.share, std::clamp(found.by_solving, 0.0, 1.0), 0.02) << epsilon;
    EXPECT_EQ(found.report.lost.has_value(), epsilon == 1);
    EXPECT_EQ(found.report.warning.find("second solve") != std::string::npos, epsilon < 1) << found.report.warning;
    // J(v') is above J(u): u of a mesh that has eight points where this one has one
    const TriangleMesh fine = extruded(body_of(refined(refined(refined(mesh)))), epsilon);
    const Space space(mesh, p1()), fine_space(fine, p1());
    const VariationalInequality problem = assemble(scene, space), fine_problem = assemble(scene, fine_space);
    const double at_hand = energy(problem, active_set(problem)), best = energy(fine_problem, active_set(fine_problem));
    EXPECT_GT(at_hand - found.energy.proved, best) << epsilon;
  }
}

// Without a load v = 0, and a needle of the obstacle, which no unknown sees, lifts it: in a layer of stiffness S, beside
// which the body's 1 does not count, the price is S / 2 times the square of the slope beside the lifted ends, closed form.
TEST(LostEnergy, PaysForLiftingWhatTheUnknownsDoNotSee) {
  constexpr double needle = 0.01, h = 1.0 / 8, stiffness = 1e6;
  const auto proved = [&](const TriangleMesh& mesh, const Element& element, double floor, double ceiling, double at) {
    const auto bound = [=](double height, double otherwise) -> Profile {
      return [=](double x) { return std::abs(x - at) < 1e-3 ? height : otherwise; };
    };
    const UnilateralContact contact{bound(-floor, 1), {0, 1}, bound(ceiling, 1)};
    return lost_on(mesh, element, Scene({[](double, double) { return 0.0; }}, StiffLayer{0.1, stiffness}, contact))
        .energy.proved;
  };
  const TriangleMesh mesh = unstructured_mesh(8);
  for (const Element* element : {&p1(), &p2(), &p3()})
    for (const auto& [at, lifted] : {std::pair(3 * h + 14 * h / 32, needle), {28 * h / 32, needle * 32 / 28}}) {
      // two edges beside: those of the ends, or of the one free end
      const double price = stiffness * lifted * lifted / h;
      EXPECT_NEAR(proved(mesh, *element, needle, 1, at) / -price, 1, 1e-3) << element->name() << at;
      EXPECT_NEAR(proved(mesh, *element, -1, -needle, at) / -price, 1, 1e-3) << element->name() << at;
      EXPECT_EQ(proved(mesh, *element, needle, -needle, at), -test::infinity) << "no room between";
    }
  // clamped sides that lean over Sigma hold what is below them
  TriangleMesh leaning = mesh;
  for (int v = 0; v < leaning.vertex_count(); ++v)
    if (const double y = leaning.vertices(v, 1); y > 0)
      leaning.vertices(v, 0) += y * (0.5 - leaning.vertices(v, 0)) / 2;
  EXPECT_EQ(proved(leaning, p1(), needle, 1, 1.5 * h), -test::infinity);
  EXPECT_GT(proved(leaning, p1(), needle, 1, 4.5 * h), -2 * stiffness * needle * needle / h);
}

// The obstacle presses the layer in, and a locked layer cannot give way: J(u_h) is far above what the motion is worth. At
// 0.2 even J(v) is above J(v_0), whose layer is straight.
TEST(LostEnergy, IsAllWhereALockedLayerIsPressedIn) {
  for (const double depth : {0.02, 0.2}) {
    const UnilateralContact pressed{[=](double x) { return -depth * std::sin(std::numbers::pi * x); }};
    const Lost found = lost_on(unstructured_mesh(8), p1(), test::stiff_scene(1e-6, pressed));
    EXPECT_EQ(found.share, 1) << depth;
    EXPECT_EQ(found.report.lost, 1) << depth;
  }
}

// A layer that bears on the obstacle at a distance: held straight it would do work on the contact forces as well.
TEST(LostEnergy, IsAShareOfWhatTheContactForcesTakeToo) {
  const UnilateralContact deep{[](double) { return 0.03; }};
  for (const double epsilon : {0.05, 0.1}) {
    const Lost found = lost_on(unstructured_mesh(16), p1(), test::stiff_scene(epsilon, deep));
    EXPECT_NEAR(found.share, found.by_solving, 0.004) << epsilon;
  }
}

// Pressed in by g sin(pi x) below a body that does not give way: v_0 is not admissible, and the motion is |v - v_0|^2 / 2.
// v = sinh(k y) / sinh(k) of that, k = pi epsilon: g^2 k coth(k) / (4 epsilon^2), nearly all of it in the stiff form.
TEST(LostEnergy, ItsMotionIsTheEnergyOfALayerThatIsPressedIn) {
  const Body rigid{[](double, double) { return 0.0; }, [](double, double) { return 1e6; }};
  const UnilateralContact pressed{[](double x) { return -0.1 * std::sin(std::numbers::pi * x); }};
  for (const double epsilon : {0.3, 0.1, 0.03}) {
    const Scene scene(rigid, StiffLayer{epsilon}, pressed);
    const double k = std::numbers::pi * epsilon, law = 0.01 * k / (4 * epsilon * epsilon * std::tanh(k));
    // columns that are affine in y: 0.2 % at 1/h = 16
    EXPECT_NEAR(lost_on(unstructured_mesh(16), p2(), scene).energy.motion / law, 1, 0.005) << epsilon;
  }
}

// A gap that bends the layer: what is lost and what is moved are s times the same, whatever the body.
TEST(LostEnergy, IsTheSameShareHoweverStiffALayerIsThatItsGapBends) {
  const UnilateralContact wavy{[](double x) { return -0.05 * std::sin(6 * std::numbers::pi * x); }};
  const auto share = [&](double s) {
    const Scene scene({[](double, double) { return 0.0; }}, StiffLayer{.epsilon = 0.1, .s = s}, wavy);
    return lost_on(unstructured_mesh(16), p1(), scene).share;
  };
  const double stiff = share(1e5);
  EXPECT_GT(stiff, 0.1);
  for (const double s : {1e7, 1e9, 1e11}) EXPECT_NEAR(share(s), stiff, 1e-4) << s;  // the body is 1 / s of it
}

TEST(LostEnergy, IsNoneWhereTheObstacleHoldsTheLayer) {
  // pressed down everywhere: the layer has nowhere to go, and a locked layer is the right one
  const Scene down({[](double x, double) { return -10 * std::sin(std::numbers::pi * x); }}, StiffLayer{1e-6},
                   UnilateralContact{});
  const Lost found = lost_on(unstructured_mesh(16), p1(), down);
  EXPECT_EQ(found.share, 0);
  EXPECT_EQ(found.report.warning, "");
}

// Where the body is low some of the hats reach no vertex; where it is flatter than the edges of Sigma are long they are as
// high as it is.
TEST(LostEnergy, IsFoundUnderABodyThatIsNoSquare) {
  const std::function<double(double x)> heights[] = {[](double x) { return x > 0.5 ? 1.4 - 0.8 * x : 1; },
                                                     [](double) { return 0.05; }};
  for (const auto& height : heights) {
    TriangleMesh mesh = unstructured_mesh(16);
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 1) > 0) mesh.vertices(v, 1) *= height(mesh.vertices(v, 0));
    for (const double epsilon : {1e-4, 0.02, 0.05}) {
      const Lost found = lost_on(mesh, p1(), test::stiff_scene(epsilon));
      EXPECT_NEAR(found.share, found.by_solving, 0.01) << height(1) << epsilon;
      EXPECT_EQ(found.report.warning.empty(), found.by_solving < 0.05) << height(1) << epsilon;
    }
  }
}

// What presses a thin layer is the mean over its depth: v, with one row, has the load where u_h has it.
TEST(LostEnergy, KnowsALoadThatChangesOverTheDepthAsTheAnswerDoes) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const auto lost = [&](const Profile& over_depth) {
    const Field load = [=](double x, double y) { return 10 * std::sin(std::numbers::pi * x) * over_depth(y); };
    return lost_on(mesh, p1(), Scene({paper_load}, StiffLayer{1e-4, 1, load}, UnilateralContact{})).energy;
  };
  const LostEnergy even = lost([](double) { return 1.0; }),
                   wavy = lost([](double y) { return 1 + 5 * std::cos(8 * std::numbers::pi * y); });
  // 0.02: four edges per wave, which the quadrature of degree 5 integrates to 1 % of its amplitude 5, and less here
  EXPECT_NEAR(wavy.proved / even.proved, 1, 0.02);
}

TEST(LostEnergy, IsFoundUnderPiecesOfSigmaThatAreFarApart) {
  TriangleMesh mesh = extruded(test::bridge(32), 0.5);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    double& x = mesh.vertices(v, 0);
    const bool end = x == 0 || x == 0.25 || x == 0.75 || x == 1;
    if (mesh.vertices(v, 1) < 0 && !end) x += 0.01 * std::sin(7 * v);
    x += 40 * std::clamp(2 * x - 0.5, 0.0, 1.0);  // the right foot moves away, what is between them is stretched
  }
  const Lost found = lost_on(mesh, p1(), test::stiff_scene(1e-4));
  EXPECT_GT(found.by_solving, 0.9);
  EXPECT_NEAR(found.share, found.by_solving, 0.02);
}

// A layer of few rows is coarse, which is not locking: the same mesh in columns has the same energy.
TEST(LostEnergy, IsNotWhatACoarseLayerCosts) {
  TriangleMesh mesh = extruded(unstructured_mesh(16, {0}), 0);
  ASSERT_EQ(mesh.vertices.col(1).minCoeff(), -1);
  const double columns = lost_on(mesh, p1(), test::stiff_scene(1)).by_solving;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (const double x = mesh.vertices(v, 0); mesh.vertices(v, 1) == -1 && x > 0 && x < 1)
      mesh.vertices(v, 0) += 0.02 * std::sin(7 * v);
  ASSERT_FALSE(find_ties(mesh).in_columns);
  const Lost found = lost_on(mesh, p1(), test::stiff_scene(1));
  EXPECT_NEAR(found.by_solving, columns, 0.02) << "one row where the second solve has sixteen";
  EXPECT_GT(columns, 0.3);
  EXPECT_LT(found.share, 0.01);
  EXPECT_EQ(found.report.warning, "");
}

/// An unstructured mesh of 1/h = 8 whose clamped edges are a group that may be given values.
TriangleMesh with_given_sides() {
  return retagged(unstructured_mesh(8), [](double, double) { return held_group(0); });
}

// Beside given values that are affine in x on all that is held, and an obstacle that is raised by as much, all is the
// same up to round-off: energies of the values U themselves leave round-off of s U^2, 1e-6 at U = 30, where the motion
// is worth 2e-8.
TEST(LostEnergy, IsTheSameBesideGivenValuesThatAreAffine) {
  const TriangleMesh mesh = with_given_sides();
  const Space space(mesh, p1());
  const auto lost = [&](const StiffLayer& layer, const Profile& gap, const Field& load, double left, double right) {
    const auto given = [=](double x, double) { return left + (right - left) * x; };
    const UnilateralContact contact{[=](double x) { return gap(x) - given(x, 0); }, {}};
    const Scene scene({load}, layer, contact, {{"sides", EdgeCondition::Kind::displacement, given}});
    const VariationalInequality problem = assemble(scene, space);
    ActiveSetOptions options;
    options.corrections.tolerance = 1e-15;  // of U: a stiff layer moves by 3e-12 of it
    return lost_energy(scene, space, problem, active_set(problem, options));
  };
  const auto wavy = [](double height) -> Profile {
    return [=](double x) { return height * std::sin(3 * std::numbers::pi * x); };
  };
  const auto pull = [](double force) -> Field {
    return [=](double x, double) { return force * std::sin(4 * std::numbers::pi * x); };
  };
  const StiffLayer soft{1e-2}, stiff{0.1, 1e6};
  const std::vector<std::pair<double, double>> small{{-0.05, 0}, {0, -0.05}, {-0.02, 0.01}},
      large{{30, 30}, {30, -30}, {300, 300}, {300, -300}, {3e4, 3e4}, {3e4, -3e4}};
  for (const auto& [layer, gap, load, ends, off] :
       {std::tuple(soft, Profile([](double) { return 0.01; }), Field(paper_load), small, 1e-7),
        {stiff, wavy(0), pull(40), large, 1e-3},
        {stiff, wavy(1e-6), pull(40), large, 1e-3},
        {stiff, wavy(0.01), pull(0), large, 1e-3}}) {
    const LostEnergy plain = lost(layer, gap, load, 0, 0);
    EXPECT_GT(plain.share(plain.found), 0.1) << gap(0.5);
    EXPECT_GT(plain.proved, 0) << gap(0.5);
    for (const auto& [left, right] : ends) {
      const LostEnergy found = lost(layer, gap, load, left, right);
      for (const auto part : {&LostEnergy::found, &LostEnergy::proved, &LostEnergy::motion})
        EXPECT_NEAR(found.*part / plain.motion, plain.*part / plain.motion, off) << gap(0.5) << left << right;
    }
  }
  // the layer moves by 1e-7, and of 1e9 ten digits more are no digits: nothing is told, least of all as proved
  EXPECT_EQ(lost(stiff, wavy(0), pull(40), 1e9, 1e9).motion, 0);
}

// Nothing pulls, and nothing touches: what u leaves of its forces is round-off, of a soft layer and of a stiff one.
TEST(LostEnergy, HasNoMotionWhereAllIsAtRest) {
  const TriangleMesh mesh = with_given_sides();
  for (const Element* element : {&p1(), &p2()})
    for (const double tilt : {0.0, 0.3})
      for (const double epsilon : {1e-1, 1e-3, 1e-5, 1e-8, 0.0})
        for (const double s : {1e-5, 1e-3, 1e-2, 1.0, 1e6})
          for (const double u : {0.3, 1.7, 1e4}) {
            const Space space(mesh, *element);
            const auto given = [=](double x, double) { return u + tilt * x; };
            const Scene scene({[](double, double) { return 0.0; }}, StiffLayer{epsilon, s},
                              UnilateralContact{[](double) { return 1000.0; }, {}},
                              {{"sides", EdgeCondition::Kind::displacement, given}});
            const VariationalInequality problem = assemble(scene, space);
            EXPECT_EQ(lost_energy(scene, space, problem, active_set(problem)).motion, 0)
                << element->name() << tilt << ' ' << epsilon << ' ' << s << ' ' << u;
          }
}

// A ceiling over a part of the bottom, and a mesh with one unknown in contact: u_h's bounds are read between its points.
TEST(LostEnergy, ReadsBoundsThatAreInfiniteOrOne) {
  UnilateralContact half;
  half.ceiling = [](double x) { return x < 0.4 ? 0.01 : test::infinity; };
  const Lost low = lost_on(unstructured_mesh(16), p1(), test::stiff_scene(1e-3, half));
  EXPECT_NEAR(low.share, low.by_solving, 0.01);
  const Field even = [](double, double) { return 10.0; };
  const Lost one = lost_on(jittered_mesh(2, 0.2), p1(), Scene({even}, StiffLayer{1e-3}, UnilateralContact{}));
  EXPECT_NEAR(one.share, one.by_solving, 0.02);
}

// Beside a free end v_0 has the value of the other end, and with two of them that of u_h, wherever the zero of u is.
TEST(LostEnergy, KnowsNoZeroBesideFreeEnds) {
  struct Free {  // no structured binding: clang 14 captures none
    bool left, right;
  };
  for (const Free free : {Free{true, false}, {false, true}, {true, true}}) {
    const TriangleMesh mesh = retagged(unstructured_mesh(16), [&](double x, double) {
      return (free.left && x == 0) || (free.right && x == 1) ? natural_group(0) : held_group(1);
    });
    const Space space(mesh, p1());
    const auto lost = [&](double u) {
      const std::vector<EdgeCondition> edges{
          {"free", EdgeCondition::Kind::free, {}},
          {"held", EdgeCondition::Kind::displacement, [=](double, double) { return u; }}};
      const UnilateralContact contact{[=](double) { return 0.01 - u; }, {}};
      const Scene scene({paper_load}, StiffLayer{1e-3}, contact, edges);
      const VariationalInequality problem = assemble(scene, space);
      const Solution solution = active_set(problem);
      const LostEnergy found = lost_energy(scene, space, problem, solution);
      if (free.left && free.right) return found;
      const double best = energy(problem, solution) - found.found;
      EXPECT_NEAR((energy_with_held_layer(space, problem, u) - best) / found.motion, 1, 0.01) << free.left << u;
      return found;
    };
    const LostEnergy plain = lost(0), raised = lost(5);
    EXPECT_GT(plain.share(plain.found), 0.1);
    EXPECT_NEAR(raised.motion / plain.motion, 1, 1e-6);
    EXPECT_NEAR(raised.found / plain.found, 1, 1e-6);
    // with v_0 at 0 under an end that is free, the way from there to u = 5 would be worth 12
    EXPECT_LT(raised.motion, 1);
  }
}

TEST(LostEnergy, IsAskedOfConformingElementsWithALayerAlone) {
  const TriangleMesh mesh = unstructured_mesh(4), body = unstructured_mesh(4, {0});
  const auto refuse = [](const TriangleMesh& on, const Element& element, const Scene& scene) {
    const Space space(on, element);
    const VariationalInequality problem = assemble(scene, space);
    test::expect_refused([&] { lost_energy(scene, space, problem, active_set(problem)); }, "lost energy: accepted: ");
  };
  refuse(mesh, crouzeix_raviart(), test::stiff_scene(1));
  refuse(body, p1(), Scene({paper_load}));
  refuse(body, p1(), Scene({paper_load}, VentcelLayer{}));
  const Space space(mesh, p1());
  VariationalInequality problem = test::stiff_problem(space, 1e-2);
  for (std::size_t k = 0; k < problem.fixed.size(); ++k)
    if (space.points()(problem.fixed[k], 1) < 0) problem.fixed_values(static_cast<Eigen::Index>(k)) = 0.01;
  test::expect_refused([&] { lost_energy(test::stiff_scene(1e-2), space, problem, active_set(problem)); },
                       "whose sides have the value of Sigma's end");
  const TriangleMesh pulled =
      retagged(mesh, [](double, double y) { return y < 0 ? natural_group(0) : EdgeTag::clamped; });
  for (const auto kind : {EdgeCondition::Kind::traction, EdgeCondition::Kind::spring})
    refuse(pulled, p1(), Scene({paper_load}, StiffLayer{1}, {}, {{"sides", kind, [](double, double) { return 1.0; }}}));
}

TEST(Ties, LeaveAGroupPerColumnWhereThereAreColumns) {
  for (const MeshFamily& family : mesh_families()) {
    const bool columns = family.name == "structured" || family.name == "layered" || family.name == "columns";
    const TriangleMesh mesh = family.mesh(8);
    EXPECT_EQ(find_ties(mesh).in_columns, columns) << family.name;
    EXPECT_EQ(find_ties(mesh).groups > 1, columns) << family.name;
  }
  // crossed cells: triangles without a vertical edge, which tie no neighbour
  const std::vector<double> x{0, 0.25, 0.5, 0.75, 1}, y{-1, -0.5, 0, 0.5, 1};
  TriangleMesh crossed = tensor_mesh(x, y, Diagonal::crossed);
  EXPECT_TRUE(find_ties(crossed).in_columns);
  // its right half sheared: four groups have become two, which are side by side as well
  for (int v = 0; v < crossed.vertex_count(); ++v)
    if (crossed.vertices(v, 0) == 0.75 && crossed.vertices(v, 1) < 0) crossed.vertices(v, 0) = 0.76;
  EXPECT_FALSE(find_ties(crossed).in_columns);
}

// ==== The nearest element of K_h and of K_0h, dual norms, and the numbers of (5) that they are compared with.

// A function of K that P1 holds on a structured mesh with a line x = 1/2; not constant across the layer.
const Reference tent{
    [](double x, double y) { return std::min(x, 1 - x) * (1 - y); },
    [](double x, double y) { return Eigen::Vector2d(std::copysign(1 - y, 0.5 - x), -std::min(x, 1 - x)); },
    [](double, double) { return 0.0; }};

TEST(Nearest, AFunctionOfTheSetIsItsOwnNearestElement) {
  const Reference flat{[](double x, double y) { return std::min(x, 1 - x) * (y > 0 ? 1 - y : 1); },
                       [](double x, double y) {
                         const double slope = std::copysign(1.0, 0.5 - x);
                         return y > 0 ? Eigen::Vector2d(slope * (1 - y), -std::min(x, 1 - x))
                                      : Eigen::Vector2d(slope, 0);
                       },
                       [](double, double) { return 0.0; }};
  // bilinear in the body: nearest in P2, exact for no triangle of P1
  const Discretisation on(structured_mesh(4), p2());
  const auto problem = test::stiff_problem(on.space(), 0);
  for (const Within within : {Within::k_h, Within::k_0h}) {
    const Nearest found = nearest(on.space(), problem, flat, within);
    EXPECT_LT(found.distance, 1e-7);
    EXPECT_NEAR(found.value, found.distance * found.distance, 1e-12);
  }
}

TEST(Nearest, TheKernelIsFartherAndHoldsItsCondition) {
  const Discretisation on(structured_mesh(8), p1());
  const auto problem = test::stiff_problem(on.space(), 0);
  const Nearest any = nearest(on.space(), problem, tent, Within::k_h),
                kernel = nearest(on.space(), problem, tent, Within::k_0h);
  EXPECT_LT(any.distance, 0.5 * kernel.distance);  // what it cannot have: |d/dy v| in the layer
  EXPECT_LT((problem.b * kernel.v).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT((problem.b * any.v).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Nearest, TheFunctionalIsPartOfWhatIsMinimised) {
  const Discretisation on(structured_mesh(8), p1());
  auto problem = test::stiff_problem(on.space(), 0);
  problem.contact.clear();  // then the derivative of |u - v|_h^2 + load . v vanishes at the smallest value
  problem.lower.resize(0);
  const Eigen::VectorXd load = load_vector(on.space(), paper_load);
  const Nearest found = nearest(on.space(), problem, tent, Within::k_h, load);
  Eigen::VectorXd derivative = 2 * (h1_norm(on.space()) * found.v - h1_products(on.space(), tent)) + load;
  for (const int i : problem.fixed) derivative(i) = 0;
  EXPECT_LT(derivative.cwiseAbs().maxCoeff(), 1e-10 * load.cwiseAbs().maxCoeff());
  EXPECT_NEAR(found.value, found.distance * found.distance + load.dot(found.v), 1e-12);
}

TEST(DualNorm, OfARieszRepresentativeIsItsNorm) {
  const Discretisation on(unstructured_mesh(6), crouzeix_raviart());
  const auto problem = test::stiff_problem(on.space(), 0);
  const SparseMatrix norm = h1_norm(on.space());
  Eigen::VectorXd w = (3 * on.space().points().col(0).array()).sin() * on.space().points().col(1).array();
  for (const int i : problem.fixed) w(i) = 0;
  const double all = dual_norm(problem, norm, norm * w), in_kernel = dual_norm(problem, norm, norm * w, true);
  VariationalInequality other = problem;  // a norm knows no bounds and no given values
  other.upper = Eigen::VectorXd::Ones(other.lower.size());
  other.fixed_values.setOnes();
  EXPECT_EQ(dual_norm(other, norm, norm * w), all);
  EXPECT_NEAR(all, std::sqrt(w.dot(norm * w)), 1e-10 * all);
  EXPECT_LT(in_kernel, 0.99 * all);  // w is not in the kernel
  EXPECT_GT(in_kernel, 0);
}

TEST(StressNorm, IsTheIntegralOfTheLayerStress) {
  for (const double epsilon : {1.0, 0.1, 0.0}) {
    const Truth truth(paper_sine_load(), epsilon, true, 12);
    double sum = 0;
    constexpr int n = 40;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double p = truth.layer_stress((i + 0.5) / n, (j + 0.5) / n - 1);
        sum += p * p / (n * n);
      }
    EXPECT_NEAR(stress_norm(truth), std::sqrt(sum), 0.01 * std::sqrt(sum))
        << epsilon;  // the rule's h^2, and a jump of p
  }
}

// The limit on the layer is a function of x, and u^0 - u^c on the body is its harmonic extension: both by midpoints.
TEST(LayerNorm, AndWhatClampingCostsAreIntegralsOfTheLimit) {
  constexpr double pi = std::numbers::pi;
  const Truth limit(paper_sine_load(), 0, true, 14);
  constexpr int n = 400;
  double layer = 0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    layer += (std::pow(limit.value(x, -0.5), 2) + std::pow(limit.gradient(x, -0.5).x(), 2)) / n;
  }
  EXPECT_NEAR(layer_norm(limit), std::sqrt(layer), 1e-4 * std::sqrt(layer));  // the rules' h^2
  double body = 0;
  for (int k = 1; k <= 60; ++k) {  // the waves of u^0 on Sigma fall like k^-3
    double w = 0, square = 0;
    for (int i = 0; i < n; ++i) w += 2.0 / n * limit.value((i + 0.5) / n, 0) * std::sin(k * pi * (i + 0.5) / n);
    for (int j = 0; j < 4 * n; ++j) {
      const double a = k * pi, y = (j + 0.5) / (4 * n), scale = 1 / std::sinh(a);
      const double v = scale * std::sinh(a * (1 - y)), slope = a * scale * std::cosh(a * (1 - y));
      square += (v * v + a * a * v * v + slope * slope) / (4 * n);
    }
    body += 0.5 * w * w * square;
  }
  EXPECT_NEAR(clamped_distance(limit), std::sqrt(layer + body), 1e-4 * std::sqrt(layer));
}

// ==== The supremum of the error over a ball of loads: the exact side in closed form, the quadratic form of the error, its
// largest eigenvalue.

using std::numbers::pi;
/// E column by column.
Eigen::MatrixXd matrix_of(ErrorForm& form) {
  const int n = form.modes().size();
  Eigen::MatrixXd e(n, n);
  for (int j = 0; j < n; ++j) e.col(j) = form.apply(Eigen::VectorXd::Unit(n, j));
  return e;
}

// a(u, u) = (f, S f) = -2 J(u). The load constant in y falls like 1/m in the modes, its work like m^-4: 40 waves leave
// out less than 1e-4 of it.
TEST(LoadModes, WorkIsTheTruths) {
  const LoadModes modes(40);
  for (const double epsilon : {1.0, 0.1, 1e-6, 1e-20, 0.0})
    for (const int k : {1, 2, 5}) {
      const Eigen::VectorXd f = modes.constant_in_y(k, 10);
      const Truth truth(SineLoad{{{k, {10}}}}, epsilon, false, 10);
      EXPECT_NEAR(f.dot(modes.response(f, epsilon)) / (-2 * truth.energy()), 1, 1e-4) << epsilon << " " << k;
    }
}

TEST(LoadModes, AreOrthonormal) {
  const LoadModes modes(3);
  const auto [points, weights] = gauss_rule(20);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(modes.size(), modes.size());
  for (int i = 0; i < points.size(); ++i)
    for (int j = 0; j < points.size(); ++j) {
      Eigen::VectorXd values(modes.size());
      for (int l = 0; l < modes.size(); ++l)
        values(l) = modes.value(Eigen::VectorXd::Unit(modes.size(), l), points(i), points(j));
      gram += weights(i) * weights(j) * values * values.transpose();
    }
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(modes.size(), modes.size())).cwiseAbs().maxCoeff(), 1e-12);
}

// The load 2 sin(k pi x) cos(pi y / 2), its cosine as a polynomial (1e-8), measured point by point against the sine
// series: for a polynomial V_h exact but for the quadrature of the error (degree 12 or so) and the table (1e-6).
TEST(ErrorForm, IsTheMeasuredErrorOfEveryElement) {
  const TriangleMesh mesh = unstructured_mesh(6);
  for (const Element* element : {&p1(), &p2(), &p3(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    ErrorForm form(space, LoadModes(6));
    for (const double epsilon : {1.0, 1e-2, 0.0})
      for (const int k : {1, 3}) {
        form.set_epsilon(epsilon);
        Eigen::VectorXd f = Eigen::VectorXd::Zero(form.modes().size());
        for (int j = 0; j < f.size(); ++j) f(j) = form.modes().k()(j) == k && form.modes().m()(j) == 1;
        const SineLoad load = load_of_modes(Eigen::VectorXd::Unit(k, k - 1));
        const TruthTable table(Truth(load, epsilon, false, 12), 1 << 11);
        const Solution solution = active_set(assemble(Scene(Body{load}, StiffLayer{epsilon}), space));
        const double measured = measure_errors(space, solution, epsilon, reference(table)).energy;
        EXPECT_NEAR(form.error(f) / measured, 1, 1e-3) << element->name() << " " << epsilon << " " << k;
      }
  }
}

// A mesh so small that nothing has to be iterated: S - F' A^-1 F with A summed and inverted, the load of each mode by
// load_vector (degree 5 and more on triangles of 1/4 of a wave: 1e-3 in E).
TEST(ErrorForm, ItsLargestIsTheDenseEigenvalue) {
  const TriangleMesh mesh = unstructured_mesh(3);
  for (const Element* element : {&p1(), &p4()})
    for (const double epsilon : {1.0, 0.1}) {
      const Space space(mesh, *element);
      ErrorForm form(space, LoadModes(3));
      form.set_epsilon(epsilon);
      const VariationalInequality problem =
          assemble(Scene(Body{[](double, double) { return 0.0; }}, StiffLayer{epsilon}), space);
      Eigen::MatrixXd a =
          Eigen::MatrixXd(problem.a1) + test::gram(Eigen::MatrixXd(problem.b), problem.m) / (epsilon * epsilon);
      for (const int i : problem.fixed) {
        a.row(i).setZero();
        a.col(i).setZero();
        a(i, i) = 1;
      }
      const int n = form.modes().size();
      Eigen::MatrixXd dense(n, n), u(space.size(), n), loads(space.size(), n);
      for (int j = 0; j < n; ++j) {
        const Eigen::VectorXd one = Eigen::VectorXd::Unit(n, j);
        loads.col(j) = load_vector(space, [&](double x, double y) { return form.modes().value(one, x, y); });
        for (const int i : problem.fixed) loads(i, j) = 0;
        u.col(j) = test::lu_solve(a, loads.col(j));
        dense.col(j) = form.modes().response(one, epsilon);
      }
      dense -= test::product(loads.transpose(), u);
      const double largest = symmetric_eigenvalues(0.5 * (dense + dense.transpose())).maxCoeff();
      EXPECT_NEAR(std::pow(form.worst(1e-6).error, 2) / largest, 1, 0.01) << element->name() << " " << epsilon;
    }
}

TEST(ErrorForm, IsSymmetricAndNowhereNegative) {
  const TriangleMesh mesh = unstructured_mesh(4);
  for (const Element* element : {&p1(), &p2(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    ErrorForm form(space, LoadModes(6));
    for (const double epsilon : {1.0, 1e-3, 0.0}) {
      form.set_epsilon(epsilon);
      const Eigen::MatrixXd e = matrix_of(form);
      const Eigen::VectorXd values = symmetric_eigenvalues(0.5 * (e + e.transpose()));
      // the solves stop at 1e-10, and S is 0.1; CR's interpolant and loads are two quadratures of waves, 1e-8
      EXPECT_LT((e - e.transpose()).cwiseAbs().maxCoeff(), 1e-8) << element->name();
      EXPECT_GT(values.minCoeff(), -1e-7) << element->name();
      const WorstLoad worst = form.worst(1e-6);
      EXPECT_NEAR(worst.error * worst.error / values.maxCoeff(), 1, 1e-6) << element->name();
      EXPECT_NEAR(form.error(worst.load) / worst.error, 1, 1e-6);
      EXPECT_NEAR(worst.load.norm(), 1, 1e-12);
    }
  }
}

// dim G_h = p - 1 on the layer: of the first p waves one combination is lost whole, however fine the mesh. P1 and P2
// keep functions of one symmetry each, so that the bound by the kernel's dimension is the limit.
TEST(WorstLoad, LimitsByDegreeAndWidths) {
  for (const int p : {1, 2}) EXPECT_NEAR(loss_of_degree(p) / loss_of_wave(p), 1, 1e-9) << p;
  for (const int p : {3, 4, 5}) {
    EXPECT_GT(loss_of_degree(p), 1.05 * loss_of_wave(p)) << p;
    EXPECT_LT(loss_of_degree(p), loss_of_degree(p - 1)) << p;
  }
  // |e_1| / |e_1|_a of e_1 = psi(y) sin(pi x), psi = sinh(pi (1 - y)) / sinh(pi) in the body and 1 in the layer
  const auto [points, weights] = gauss_rule(20);
  const Eigen::ArrayXd at = pi * (1 - points.array()), psi = at.sinh() / std::sinh(pi),
                       slope = pi * at.cosh() / std::sinh(pi), w = weights.array();
  const double square = (w * psi.square()).sum(), energy = (w * slope.square()).sum() + pi * pi * (square + 1);
  EXPECT_NEAR(loss_of_wave(1), std::sqrt(square / energy), 1e-14);
  // k^2 + m^2 in order: 2, 5, 5, 8, 10, 10, 13
  EXPECT_NEAR(width_of_ball(0), 1 / (pi * std::sqrt(2)), 1e-15);
  EXPECT_NEAR(width_of_ball(2), 1 / (pi * std::sqrt(5)), 1e-15);
  EXPECT_NEAR(width_of_ball(6), 1 / (pi * std::sqrt(13)), 1e-15);
  // Weyl: n = pi r^2 / 4 - r of them have k^2 + m^2 <= r^2, up to terms that grow more slowly than r
  EXPECT_NEAR(1 / (pi * width_of_ball(10000)), std::sqrt(40000 / pi) + 2 / pi, 1);
}

TEST(ErrorForm, EveryDegreeLosesWhatItsKernelCannotHold) {
  for (const Element* element : {&p1(), &p2(), &p3(), &p4()})
    for (const int cells : {4, 8}) {
      const SpaceOn space(unstructured_mesh(cells), *element);
      ErrorForm form(space, LoadModes(2 * cells));  // waves 1 to 4 are among them
      form.set_epsilon(0);
      const double rigid = form.worst().error;
      const double limit = loss_of_degree(element->degree());
      EXPECT_GT(std::hypot(rigid, form.modes().beyond()), limit) << element->name();
      EXPECT_NEAR(rigid / limit, 1, cells == 8 ? 0.04 : 0.15) << element->name();
      form.set_epsilon(1e-20);
      EXPECT_NEAR(form.worst().error / rigid, 1, 1e-3) << element->name();
    }
}

// What is left out of the ball adds at most beyond()^2 to the square, and nothing is taken away.
TEST(ErrorForm, MoreWavesAddNoMoreThanIsProved) {
  const SpaceOn space(structured_mesh(6), p1());
  ErrorForm few(space, LoadModes(6)), many(space, LoadModes(18));
  for (const double epsilon : {0.0, 1.0}) {
    few.set_epsilon(epsilon);
    many.set_epsilon(epsilon);
    const double low = few.worst().error, high = many.worst().error;
    EXPECT_GT(high, 0.999 * low);
    EXPECT_LT(high, std::hypot(low, few.modes().beyond()));
  }
}

TEST(ErrorForm, RefusesWhatItCannotServe) {
  expect_refused([] { LoadModes(0); }, "waves");
  const TriangleMesh mesh = structured_mesh(2), body = structured_mesh(2, Domain{0});
  const Space space(mesh, p1()), no_layer(body, p1());
  ErrorForm form(space, LoadModes(2));
  expect_refused([&] { form.set_epsilon(2); }, "epsilon");
  expect_refused([&] { form.set_epsilon(std::nan("")); }, "epsilon");
  expect_refused([&] { form.apply(Eigen::VectorXd::Ones(1)); }, "coefficients");
  expect_refused([&] { ErrorForm(no_layer, LoadModes(2)); }, "layer");
  expect_refused([&] { ErrorForm(space, LoadModes(7)); }, "accepted: up to 6");  // 3 per cell side
}

TEST(LoadAscent, ClimbsAndKeepsTheBestOfItsStarts) {
  const auto first = [](const Eigen::VectorXd& at) { return at(0); };
  EXPECT_EQ(ascend(first, {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}, 0), 1);
  EXPECT_GT(ascend(first, {Eigen::Vector2d(0, 1)}, 100), std::cos(0.02));  // within its last step
}

// ==== The certificate: never below the true error, close to it at every epsilon, and true however the solve ended.

TEST(Certificate, IsCloseToTheErrorAndFlatInEpsilon) {
  const std::vector<double> epsilons{1, 1e-1, 1e-2, 1e-4, 1e-6, 1e-12, 0};
  std::map<double, Truth> truths;
  std::map<double, TruthTable> truth;
  for (const double epsilon : epsilons) {
    truths.emplace(epsilon, Truth(paper_sine_load(), epsilon));
    truth.emplace(epsilon, truths.at(epsilon));
  }
  for (const bool structured : {true, false})
    for (const int cells : {8, 16, 32}) {
      double least = 1e9, most = 0;
      for (const double epsilon : epsilons) {
        const Answered run(structured ? structured_mesh(cells) : unstructured_mesh(cells), test::stiff_scene(epsilon));
        const Companion v = run.strip();
        const ExactErrors exact = exact_errors(run.mesh, run.flux(), v, truth.at(epsilon));
        const Certificate found = run.certified();
        const double ratio = found.gradient / exact.gradient;
        const std::string at = fmt::format("{} 1/h = {} epsilon = {:g}", structured, cells, epsilon);
        EXPECT_GE(ratio, 1) << at;
        EXPECT_LE(ratio, structured ? 1.5 : 1.4) << at;
        EXPECT_GE(found.displacement, exact.displacement) << at;
        EXPECT_LE(found.displacement, 1.35 * exact.displacement) << at;
        EXPECT_LE(found.energy_lower, truths.at(epsilon).energy()) << at;
        EXPECT_GE(found.energy_upper, truths.at(epsilon).energy()) << at;
        EXPECT_GE(found.indicator.minCoeff(), 0) << at;
        if (epsilon > 0.1) continue;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
      EXPECT_LE(most, 1.02 * least) << structured << cells;
    }
  // the midpoint: v in the layer lives on the mesh itself here
  for (const double epsilon : epsilons)
    for (const int cells : {16, 32}) {
      const Answered run(layered_mesh(cells, epsilon), test::stiff_scene(epsilon));
      const ExactErrors exact = exact_errors(run.mesh, run.flux(), run.strip(), truth.at(epsilon));
      const double ratio = run.certified().stress / exact.stress;
      EXPECT_GE(ratio, 1) << cells << epsilon;
      EXPECT_LE(ratio, 1.02) << cells << epsilon;
    }
}

/// |q|^2 of a combination q of A grad v and sigma, summed over the elements by itself.
template <class Combination>
double flux_norm2(const Answered& run, const EquilibratedFlux& flux, const Companion& v, Combination combination) {
  const Quadrature& rule = triangle_rule(6);
  double sum = 0;
  int row = 0;
  for (int t = 0; t < run.mesh.triangle_count(); ++t) {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (int i = 0; i < 3; ++i)
      gradient += v.at_vertices(run.mesh.triangles(t, i)) * barycentric_gradients(run.mesh, t).row(i).transpose();
    const bool layer = run.mesh.region[t] == Region::layer;
    if (layer) gradient(1) = v.stress(row++);
    const double stiffness = layer ? flux.law.stiffness : stiffness_on(run.scene.body().stiffness, run.mesh, t);
    gradient *= stiffness;
    const Eigen::MatrixX2d tau = flux.tau(run.mesh, t, rule.points);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d sigma = flux.cell[t].s + (layer ? Eigen::Vector2d(0, 0) : tau.row(q).transpose());
      const Eigen::Vector2d d = combination(gradient, sigma);
      sum += run.mesh.area(t) * rule.weights(q) * (layer ? flux.law.squared(d) : d.squaredNorm() / stiffness);
    }
  }
  return sum;
}

/// The left side of the identity, m^2 / 2 + C, summed over elements and edges by itself.
double left_side(const Answered& run, const EquilibratedFlux& flux, const Companion& v, const Profile& gap) {
  double sum = flux_norm2(run, flux, v, [](const auto& a, const auto& b) -> Eigen::Vector2d { return a - b; }) / 2;
  for (std::size_t i = 0; i < run.problem.contact.size(); ++i) {
    const auto ends = run.mesh.edges.row(run.problem.contact[i]);
    for (const auto& [theta, weight] : {std::pair{0.0, 1.0 / 6}, {0.5, 4.0 / 6}, {1.0, 1.0 / 6}}) {  // a cubic gap
      const double x = (1 - theta) * run.mesh.vertices(ends(0), 0) + theta * run.mesh.vertices(ends(1), 0);
      sum += flux.lambda(static_cast<Eigen::Index>(i)) * weight *
             ((1 - theta) * v.at_vertices(ends(0)) + theta * v.at_vertices(ends(1)) + gap(x));
    }
  }
  return sum;
}

TEST(Certificate, RestsOnAnIdentityThatNeedsNoCommonMesh) {
  const Profile gap = [](double x) { return 0.05 - 0.9 * x * (1 - x) * (1 + 0.5 * x); };
  using Kind = EdgeCondition::Kind;
  // on the layer's side the displacement is that of Sigma's end
  const std::vector<EdgeCondition> edges{
      {"held", Kind::displacement, [](double x, double y) { return 0.3 * (x - 0.4) * (y + 0.2) + 0.03; }},
      {"pulled", Kind::traction, [](double, double y) { return std::sin(3 * y); }}};
  const Body body{paper_load, [](double, double) { return 2.5; }};
  for (const double epsilon : {1.0, 1e-2})
    for (const double amount : {0.0, 0.05}) {
      TriangleMesh mesh = retagged(layered_mesh(6, epsilon), [](double x, double y) {
        return x < 1 ? held_group(0) : y > 0 ? natural_group(1) : EdgeTag::free;
      });
      Answered run(std::move(mesh), Scene(body, StiffLayer{epsilon, 3}, UnilateralContact{gap}, edges));
      disturb(run, amount, 7);
      const EquilibratedFlux flux = run.flux();
      const Companion v = run.strip();
      ASSERT_FALSE(v.layer);
      const Certificate found = certify(run.scene, run.space, run.problem, run.solution, {.companion = &v});
      const double left = left_side(run, flux, v, gap);
      EXPECT_GT(flux.lambda.sum(), 0.1);
      EXPECT_NEAR(found.mismatch * found.mismatch / 2 + found.contact_work, left, 1e-10);
      const double middle =
          flux_norm2(run, flux, v, [](const auto& a, const auto& b) -> Eigen::Vector2d { return (a + b) / 2; });
      EXPECT_NEAR(found.midpoint_norm * found.midpoint_norm, middle, 1e-10);
      // Y^2 = (m + q) Y + C and (X - q / 2)^2 = (m + q)^2 / 4 + C
      const double q = found.oscillation + found.imbalance, both = found.mismatch + q, y = found.displacement;
      EXPECT_GT(found.contact_work, 1e-4);
      EXPECT_GT(y, both);
      EXPECT_NEAR(y * y, both * y + found.contact_work, 1e-12);
      EXPECT_NEAR(std::pow(found.stress - q / 2, 2), both * both / 4 + found.contact_work, 1e-12);
      EXPECT_EQ(found.imbalance > 1e-3, amount > 0);
      double balance = 0;  // R(v)
      for (int e = 0; e < run.mesh.edge_count(); ++e)
        balance += flux.imbalance(e) * (v.at_vertices(run.mesh.edges(e, 0)) + v.at_vertices(run.mesh.edges(e, 1))) / 2;
      EXPECT_EQ(std::abs(balance) > 1e-4, amount > 0);
      EXPECT_NEAR(found.energy_upper - flux.dual - balance, left, 1e-10) << epsilon << amount;

      // the same v as a function on columns of its own
      Companion apart = v;
      apart.layer.emplace(run.mesh, v.at_vertices, v.stress);
      const Certificate other = certify(run.scene, run.space, run.problem, run.solution, {.companion = &apart});
      EXPECT_NEAR(other.displacement, found.displacement, 1e-10);
      EXPECT_NEAR(other.gradient, found.gradient, 1e-10);
      EXPECT_NEAR(other.stress, found.stress, 1e-10);
      EXPECT_NEAR(other.energy_lower, found.energy_lower, 1e-10);
      EXPECT_NEAR((other.indicator - found.indicator).lpNorm<Eigen::Infinity>(), 0, 1e-10);
    }
}

// Too little or too much of everything: r1 is along A u, so that R(v) is far larger than what the width forgives. The
// strain stays right, eps^2 p = B u, and costs nothing. Factor 0 is a solve that stopped before it began.
TEST(Certificate, BoundsTheEnergyOfAScaledSolution) {
  for (const double epsilon : {1.0, 1e-2})
    for (const double factor : {0.0, 0.9, 1.1}) {
      const double energy = Truth(paper_sine_load(), epsilon, true, 14).energy();
      Answered run(unstructured_mesh(32), test::stiff_scene(epsilon));
      run.solution.u *= factor;
      run.solution.p *= factor;
      const Certificate found = run.certified();
      EXPECT_GT(found.imbalance, 0.08);
      EXPECT_LE(found.energy_lower, energy) << epsilon << factor;
      // J is a minimum, a tenth off costs a hundredth; of nothing nothing is known
      EXPECT_GE(found.energy_lower, factor > 0 ? 1.05 * energy : -INFINITY) << epsilon << factor;
      EXPECT_GE(found.energy_upper, energy) << epsilon << factor;
    }
  // p against the strain of u: a bound that did not count |r2| would be -0.02
  Answered run(structured_mesh(8), test::stiff_scene(1));
  for (int i = 0; i < run.space.size(); ++i)
    if (const Eigen::RowVector2d at = run.space.points().row(i); at(1) < 0)
      run.solution.u(i) = 10 * std::sin(std::numbers::pi * at(0)) * at(1);
  run.solution.u(run.problem.fixed).setZero();
  run.solution.p = -0.5 * (run.problem.b * run.solution.u);
  EXPECT_LE(run.certified().energy_lower, Truth(paper_sine_load(), 1, true, 14).energy());
}

// Next to a clamped end the one free vertex alone keeps v above the obstacle: not below it, and no higher than needed.
TEST(Companion, IsLiftedBesideAClampedEndAsFarAsTheObstacleAsks) {
  const UnilateralContact contact{[](double x) { return 0.05 - 0.1 * std::exp(-std::pow((x - 0.05) / 0.03, 2)); }};
  const TriangleMesh mesh = unstructured_mesh(8);
  const Space space(mesh, p1());
  for (const double held : {0.0, 0.03}) {
    const Eigen::VectorXd near =
        (mesh.vertices.col(0).array() < 0.5).select(Eigen::VectorXd::Constant(mesh.vertex_count(), held), 0);
    const Eigen::VectorXd lower = admissible_bounds(contact, space, near);
    const double end = mesh.vertices(space.contact().front(), 0);  // the first free vertex, right of x = 0
    EXPECT_GT(lower(0), -contact.gap(end)) << "the bound at the vertex is not enough";
    double least = 1;
    for (int k = 0; k <= 32; ++k) {
      const double theta = k / 32.0;
      least = std::min(least, (1 - theta) * held + theta * lower(0) + contact.gap(theta * end));
    }
    EXPECT_NEAR(least, 0, 1e-12) << held;
  }
}

// |u|_a >= |v|_a - |u - v|_a, and the same with the midpoint: the larger of the two is in the denominator.
TEST(Certificate, IsRelativeToWhatIsProvedOfTheNorm) {
  Certificate found;
  found.displacement = 1;
  found.stress = 0.5;
  found.norm = 3;
  EXPECT_EQ(found.relative(Quantity::displacement), 1 / 2.0);
  found.midpoint_norm = 3;
  EXPECT_EQ(found.relative(Quantity::displacement), 1 / 2.5);
  EXPECT_EQ(found.relative(Quantity::stress), 0.5 / 2.5);
  found.norm = found.midpoint_norm = 0.4;
  EXPECT_TRUE(std::isinf(found.relative(Quantity::displacement))) << "u = 0 cannot be excluded";
}

TEST(ColumnFunction, IsTheP1FunctionAnywhereAndItsMeansAreExact) {
  const TriangleMesh mesh = extruded(test::bridge(8), 0.7);
  std::mt19937 random(3);
  Eigen::VectorXd v(mesh.vertex_count());
  for (double& value : v) value = random() / 4e9;
  const ColumnFunction f(mesh, v, Eigen::VectorXd::Zero(mesh.triangle_count()));
  for (int t = f.first_triangle(); t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3d lambda(0.2, 0.5, 0.3);
    const Eigen::Vector3d corners = v(mesh.triangles.row(t));
    EXPECT_NEAR(f.value(point_in(mesh, t, lambda)), lambda.dot(corners), 1e-13);
    const double slope = barycentric_gradients(mesh, t).col(0).dot(corners);
    EXPECT_NEAR(f.flux(point_in(mesh, t, lambda))(0), slope, 1e-11);
  }
  for (const auto& [a, b] : {std::pair{Eigen::Vector2d(0.01, -0.97), Eigen::Vector2d(0.24, -0.03)},
                             {Eigen::Vector2d(0.9, -1), Eigen::Vector2d(0.8, -0.2)},
                             {Eigen::Vector2d(0.1, -1), Eigen::Vector2d(0.2, -1)},
                             {Eigen::Vector2d(0.03, -0.3), Eigen::Vector2d(0.03, -0.9)}}) {
    double mean = 0;
    constexpr int parts = 200000;
    for (int k = 0; k < parts; ++k) mean += f.value(a + (k + 0.5) / parts * (b - a)) / parts;
    EXPECT_NEAR(f.mean(a, b), mean, 1e-8);
  }
}

// A few contact steps, a contact set that is wrong, corrections left out: r1 tells, and the bound stays one.
TEST(Certificate, HoldsForUzawaAfterAFewSteps) {
  const double epsilon = 1e-2;
  Answered run(unstructured_mesh(16), test::stiff_scene(epsilon));
  const TruthTable truth{Truth(paper_sine_load(), epsilon)};
  PenaltyFactor factor(run.problem, run.problem.compliance);  // no correction is needed: K is the problem's own
  const auto& free = factor.numbering().unknown;
  const Eigen::MatrixXd& block = factor.contact_block();
  const auto compliance = [&](const Eigen::VectorXd& force) -> Eigen::VectorXd {
    const Eigen::VectorXd half = block.triangularView<Eigen::Lower>().solve(force);
    return block.transpose().triangularView<Eigen::Upper>().solve(half);
  };
  const double step = 2 / largest_eigenvalue(compliance, block.rows());
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(run.problem.contact.size()));
  double ratio = 0;
  for (int steps = 0; steps <= 100; ++steps) {
    Eigen::VectorXd force = run.problem.load;
    for (Eigen::Index i = 0; i < lambda.size(); ++i) force(run.problem.contact[i]) += lambda(i);
    run.solution.u.setZero();
    run.solution.u(free) = factor.dense().backward(factor.dense().forward(force(free)));
    run.solution.p = run.problem.b * run.solution.u / run.problem.compliance;
    if (steps == 0 || steps == 1 || steps == 3 || steps == 10 || steps == 100) {
      const ExactErrors exact = exact_errors(run.mesh, run.flux(), run.strip(), truth);
      const Certificate found = run.certified();
      ratio = found.gradient / exact.gradient;
      EXPECT_GE(ratio, 1) << steps;
      EXPECT_LE(ratio, steps < 10 ? 1.7 : 1.35) << steps;  // 1.56, 1.37, 1.31, 1.30, 1.30 in a prototype
    }
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      lambda(i) = std::max(0.0, lambda(i) - 0.5 * step * run.solution.u(run.problem.contact[i]));
  }
}

TEST(Certificate, CountsWhatIsLeftOfTheForcesByTheFactorInHand) {
  Answered run(unstructured_mesh(8), test::stiff_scene(1e-4));
  disturb(run, 1e-2, 3);
  PenaltyFactor factor(run.problem);
  const double rho = unbalanced(run.problem, run.flux(), &factor);
  EXPECT_GT(rho, 1e-3);
  EXPECT_EQ(unbalanced(run.problem, run.flux()), rho) << "a factor of its own is the same";
  // rho^2 = max |r1' w|^2 / w' K w, reached by w = K^-1 r1
  const auto& free = factor.numbering().unknown;
  const Eigen::VectorXd r1 = run.flux().imbalance(free), w = factor.dense().backward(factor.dense().forward(r1));
  EXPECT_NEAR(rho * rho, r1.dot(w), 1e-12 * rho * rho);
}

TEST(Certificate, BoundsAP1SolutionAndNamesTheLayerWhereItLocks) {
  const double epsilon = 1e-6;
  const TruthTable truth{Truth(paper_sine_load(), epsilon)};
  for (const bool locks : {true, false}) {
    const Answered run(locks ? unstructured_mesh(32) : layered_mesh(32, 1), test::stiff_scene(epsilon));
    const Space conforming(run.mesh, p1());
    const Companion v = p1_companion(active_set(test::stiff_problem(conforming, epsilon)));
    const Certificate found = certify(run.scene, run.space, run.problem, run.solution, {.companion = &v});
    EXPECT_GE(found.displacement, exact_errors(run.mesh, run.flux(), v, truth).displacement);
    EXPECT_EQ(found.displacement > 0.1, locks);
    EXPECT_EQ(found.layer_share > 0.5, locks) << found.layer_share;
  }
}

// |u - w| <= |u - v| + |v - w| for P2 and P1; nothing is lost where w = v.
TEST(Certificate, BoundsOtherElementsByTheirDistance) {
  for (const double epsilon : {1.0, 1e-2, 1e-6, 0.0}) {
    const Truth solved(paper_sine_load(), epsilon, true, 14);
    const TruthTable truth(solved);
    const Answered run(layered_mesh(16, epsilon), test::stiff_scene(epsilon));
    const Companion v = run.strip();
    const Certificate found = certify(run.scene, run.space, run.problem, run.solution, {.companion = &v});
    for (const Element* element : {&p1(), &p2()}) {
      const Space space(run.mesh, *element);
      const VariationalInequality problem = test::stiff_problem(space, epsilon);
      const Solution w = active_set(problem);
      const double bound = certified_distance(found, v, space, problem, w);
      EXPECT_GE(bound, measure_errors(space, w, epsilon, reference(truth)).energy) << element->name() << epsilon;
      EXPECT_GT(bound, found.displacement);
      EXPECT_LT(bound, 3 * found.displacement);
    }
    const Space linear(run.mesh, p1());
    const VariationalInequality problem = test::stiff_problem(linear, epsilon);
    const Solution same = active_set(problem);
    const Companion own = p1_companion(same);
    EXPECT_EQ(certified_distance(found, own, linear, problem, same), found.displacement);
    const Answered other(unstructured_mesh(8), test::stiff_scene(epsilon));
    expect_refused([&] { certified_distance(found, other.strip(), linear, problem, same); }, "columns of its own");
    expect_refused([&] { certified_distance(found, p1_companion(same), other.space, other.problem, other.solution); },
                   "both on one mesh");
  }
}

TEST(Certificate, HoldsForTheThinLayerAndTheBodyAlone) {
  // against the energy on a mesh four times as fine: |u - v|^2 / 2 <= J(v) - J(u)
  for (const Layer& layer : {Layer(ThinLayer{0.25}), Layer(NoLayer{})}) {
    const Scene scene({paper_load}, layer, UnilateralContact{});
    const Domain domain{scene.layer_depth()};
    const Answered run(unstructured_mesh(8, domain), scene), fine(unstructured_mesh(64, domain), scene);
    const Certificate coarse = run.certified(), reference = fine.certified();
    EXPECT_LT(reference.displacement, 0.2 * coarse.displacement);
    const double gap = coarse.energy_upper - reference.energy_lower;  // >= J(v) - J(u)
    EXPECT_GE(coarse.displacement, 0.9 * std::sqrt(2 * gap)) << "not far above";
    EXPECT_GE(coarse.displacement + reference.displacement,
              std::sqrt(2 * (coarse.energy_upper - reference.energy_upper)));
    EXPECT_LE(coarse.energy_lower, reference.energy_upper);
    EXPECT_LE(reference.energy_lower, coarse.energy_upper);
    EXPECT_LT(coarse.energy_upper - coarse.energy_lower, 0.2 * std::abs(coarse.energy_upper));
  }
}

TEST(Certificate, KeepsItsCompanionOutOfACurvedObstacle) {
  // a needle that rises between two vertices, and a gap that closes at a clamped end
  const Profile needle = [](double x) { return 0.02 - 0.05 * std::exp(-std::pow((x - 0.71) / 0.02, 2)); };
  const Profile closing = [](double x) { return 0.3 * x * x * (1 - x) * (1 - x); };
  for (const Profile& gap : {needle, closing})
    for (const double epsilon : {1.0, 1e-3}) {
      const Answered run(unstructured_mesh(8), test::stiff_scene(epsilon, {gap}));
      const Companion v = run.strip();
      ASSERT_TRUE(v.layer);
      for (int k = 0; k <= 1000; ++k)
        EXPECT_GE(v.layer->value({k / 1000.0, -1}) + gap(k / 1000.0), -2e-4) << k;  // between the samples
      const Certificate coarse = run.certified();
      const Answered fine(unstructured_mesh(64), test::stiff_scene(epsilon, {gap}));
      const Certificate reference = fine.certified();
      EXPECT_LE(coarse.energy_lower, reference.energy_upper);
      EXPECT_LE(reference.energy_lower, coarse.energy_upper);
    }
}

TEST(Certificate, IntegratesALoadThatTheSolversRuleMisses) {
  // half a wave on less than a triangle: the finer rule's difference is a part of r1
  const SineLoad load{{{9, {4.0, -9.0}}, {1, {3.0}}}};
  for (const int cells : {2, 3, 4})
    for (const bool structured : {true, false}) {
      const Answered run(structured ? structured_mesh(cells) : unstructured_mesh(cells),
                         Scene({load}, StiffLayer{1e-2}, UnilateralContact{}));
      const Truth truth(load, 1e-2, true, 14);
      const Certificate found = run.certified();
      EXPECT_GT(found.imbalance, 1e-4) << "the rule does miss something";
      EXPECT_GE(found.gradient, exact_errors(run.mesh, run.flux(), run.strip(), TruthTable(truth)).gradient) << cells;
      EXPECT_LE(found.energy_lower, truth.energy()) << cells;
      EXPECT_GE(found.energy_upper, truth.energy()) << cells;
    }
}

// The affine parts of f and of G + 1 are 0 on every triangle and edge, so that u_h = v = x, and osc alone stands before the
// error w = u - x. Per cell of size h, f is P3, Legendre's polynomial of degree 3, along x: w' = -h (P4 - P2) / 14, and
// |w|_a^2 = h^2 / 630. Or G = cos(k y) - 1 at x = 0: w = cos(k y) sinh(k (1 - x)) / (k cosh k).
TEST(Certificate, CountsALoadThatTheMeshDoesNotSee) {
  constexpr int n = 4;
  constexpr double h = 1.0 / n, pi = std::numbers::pi, k = 2 * pi * n;
  using Kind = EdgeCondition::Kind;
  const Field legendre = [](double x, double) {
    const double s = n * x - std::floor(n * x);
    return ((20 * s - 30) * s + 12) * s - 1;
  };
  for (const bool pulled : {false, true}) {
    TriangleMesh mesh = retagged(structured_mesh(n, {0}), [](double x, double) {
      return x == 0 ? natural_group(0) : x == 1 ? held_group(1) : EdgeTag::free;
    });
    const std::vector<EdgeCondition> edges{
        {"left", Kind::traction, [=](double, double y) { return pulled ? std::cos(k * y) - 1 : -1; }},
        {"right", Kind::displacement, [](double x, double) { return x; }}};
    const Body body{pulled ? Field([](double, double) { return 0.0; }) : legendre};
    const Answered run(std::move(mesh), Scene(body, NoLayer{}, {}, edges));
    const Certificate found = run.certified();
    // |P3|^2 = 1/7 on triangles with the longest edge h sqrt(2); C_E |G + 1|_E on n of them
    const double osc = pulled ? std::sqrt(2 * (1 + 1 / pi) / pi * h) : std::sqrt(2.0 / 7) * h / pi,
                 error = std::sqrt(pulled ? std::tanh(k) / (2 * k) : h * h / 630);
    EXPECT_NEAR(found.mismatch, 0, 1e-13);                   // round-off of terms below 1
    EXPECT_LE(found.imbalance, pulled ? error / 5 : 1e-13);  // the solver's rule on edges sees something of G
    EXPECT_NEAR(found.oscillation, osc, 1e-12);
    for (const double bound : {found.displacement, found.gradient, found.stress}) EXPECT_GE(bound, error);
    EXPECT_LE(found.energy_lower, found.energy_upper - error * error / 2);  // J(u) = J(v) - |w|_a^2 / 2
  }
}

TEST(Certificate, RefusesWhatItCannotProve) {
  Answered run(unstructured_mesh(4), test::stiff_scene(1e-2));
  const auto with = [&](const Scene& scene) { certify(scene, run.space, run.problem, run.solution); };
  expect_refused([&] { with(Scene({[](double, double) { return 1.0; }}, StiffLayer{1e-2}, UnilateralContact{})); },
                 "the problem is not the scene's");
  expect_refused([&] { with(Scene({paper_load}, StiffLayer{1e-2})); }, "do not agree whether there is contact");
  const Space conforming(run.mesh, p1());
  const auto p1_problem = test::stiff_problem(conforming, 1e-2);
  const Solution p1_solution = active_set(p1_problem);
  expect_refused([&] { certify(run.scene, conforming, p1_problem, p1_solution); }, "element P1");
  const Answered ventcel(structured_mesh(4, {0}), Scene({paper_load}, VentcelLayer{}, UnilateralContact{}));
  expect_refused([&] { ventcel.certified(); }, "epsilon = 0");
  using Kind = EdgeCondition::Kind;
  const auto one = [](double, double) { return 1.0; };
  const auto on_top = [&](const EdgeCondition& edge, const Field& stiffness = {}) {
    const EdgeTag top = edge.kind == Kind::displacement ? held_group(0) : natural_group(0);
    TriangleMesh mesh =
        retagged(structured_mesh(4, {0}), [&](double, double y) { return y == 1 ? top : EdgeTag::clamped; });
    Answered(std::move(mesh), Scene(Body{paper_load, stiffness}, NoLayer{}, {}, {edge})).certified();
  };
  expect_refused([&] { on_top({"top", Kind::spring, one}); }, "no flux for a spring on the group top");
  expect_refused([&] { on_top({"top", Kind::displacement, one}); }, "values that do not jump");
  expect_refused(
      [&] {
        on_top({"top", Kind::displacement, [](double x, double) { return x * (1 - x); }});
      },
      "affine on every edge");
  expect_refused([&] { on_top({"top"}, [](double x, double) { return 1 + x; }); }, "one number per triangle");
  Companion low = p1_companion(p1_solution);
  for (const int i : p1_problem.contact) low.at_vertices(i) -= 0.1;
  expect_refused([&] { certify(run.scene, run.space, run.problem, run.solution, {.companion = &low}); },
                 "below the obstacle");
  Companion off = p1_companion(p1_solution);
  off.at_vertices(conforming.clamped().front()) = 0.1;
  expect_refused([&] { certify(run.scene, run.space, run.problem, run.solution, {.companion = &off}); }, "prescribed");
  const Companion wrong{.at_vertices = Eigen::VectorXd::Zero(3), .stress = {}, .layer = std::nullopt};
  expect_refused([&] { certify(run.scene, run.space, run.problem, run.solution, {.companion = &wrong}); },
                 "another number of values");
  run.problem.fixed_values(0) = 1;
  run.solution = active_set(run.problem);
  expect_refused([&] { run.certified(); }, "the scene's values");
  run.solution.u(5) = std::nan("");
  expect_refused([&] { run.certified(); }, "not finite");
}

/// u = a(x) b(y) on the unit square, b affine and a smooth on the halves x < 1/2 and x > 1/2, whose stiffness differs: the
/// flux is continuous. u is given at the left, a traction at the right and on top. Below, u lies on the obstacle under a
/// pressure of its own.
struct Pulled {
  double k[2], slope, wave[2], bend[2], b0, b1;

  int half(double x) const { return x < 0.5 ? 0 : 1; }
  double stiffness(double x) const { return k[half(x)]; }
  double a(double x, int order = 0) const {  // its derivatives: the flux k a' is `slope` at 1/2
    const int i = half(x);
    const double s = x - 0.5, w = wave[i];
    if (order == 0) return 2 + slope / k[i] * s + bend[i] * (1 - std::cos(w * s));
    if (order == 1) return slope / k[i] + bend[i] * w * std::sin(w * s);
    return bend[i] * w * w * std::cos(w * s);
  }
  double b(double y) const { return b0 + b1 * y; }
  Eigen::Vector2d flux(double x, double y) const { return stiffness(x) * Eigen::Vector2d(a(x, 1) * b(y), a(x) * b1); }
  Scene scene() const {
    using Kind = EdgeCondition::Kind;
    const auto u = *this;
    return Scene(Body{[u](double x, double y) { return -u.stiffness(x) * u.a(x, 2) * u.b(y); },
                      [u](double x, double) { return u.stiffness(x); }},
                 NoLayer{}, UnilateralContact{[u](double x) { return -u.a(x) * u.b0; }, {}},
                 {{"left", Kind::displacement, [u](double x, double y) { return u.a(x) * u.b(y); }},
                  {"right", Kind::traction, [u](double x, double y) { return u.flux(x, y)(0); }},
                  {"top", Kind::traction, [u](double x, double y) { return u.flux(x, y)(1); }}});
  }
};

TEST(Certificate, IsNeverBelowTheErrorOfTwentyPulledBodies) {
  std::mt19937 random(33);
  const auto between = [&](double low, double high) { return low + (high - low) * random() / std::mt19937::max(); };
  const Quadrature& rule = triangle_rule(12);
  double sharpest = 1e9, bluntest = 0;
  for (int k = 0; k < 20; ++k) {
    const bool jumps = k % 2 == 0;  // the stiffness, on a mesh that follows it
    Pulled u{{between(0.5, 5), between(0.5, 5)}, between(-1, 1), {between(1, 9), between(1, 9)}, {}, between(-1, 1), 0};
    for (double& bend : u.bend) bend = between(-0.4, 0.4);
    if (!jumps) u.k[1] = u.k[0], u.wave[1] = u.wave[0], u.bend[1] = u.bend[0];
    u.b1 = -between(0.2, 2);  // a > 0 and b' < 0: the obstacle presses everywhere
    const int cells = 2 * (2 + k / 3);
    TriangleMesh mesh =
        retagged(jumps ? structured_mesh(cells, {0}) : unstructured_mesh(cells, {0}),
                 [](double x, double) { return x == 0 ? held_group(0) : natural_group(x == 1 ? 1 : 2); });
    Answered run(std::move(mesh), u.scene());
    if (k % 5 == 4) disturb(run, 0.02, static_cast<unsigned>(k));
    const EquilibratedFlux flux = run.flux();
    const Companion v = run.strip();
    const Certificate found = certify(run.scene, run.space, run.problem, run.solution, {.companion = &v});
    double displacement = 0, gradient = 0, stress = 0, energy = 0;
    for (int t = 0; t < run.mesh.triangle_count(); ++t) {
      const Eigen::Vector3d corners = v.at_vertices(run.mesh.triangles.row(t));
      const double kappa = stiffness_on(run.scene.body().stiffness, run.mesh, t);
      const Eigen::Vector2d of_v = kappa * barycentric_gradients(run.mesh, t).transpose() * corners;
      const Eigen::MatrixX2d tau = flux.tau(run.mesh, t, rule.points);
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::Vector2d x = point_in(run.mesh, t, rule.points.row(q)), exact = u.flux(x(0), x(1)),
                              s = flux.cell[t].s, sigma = s + tau.row(q).transpose();
        const double weight = run.mesh.area(t) * rule.weights(q) / kappa;
        displacement += weight * (exact - of_v).squaredNorm();
        gradient += weight * (exact - s).squaredNorm();
        stress += weight * (exact - (sigma + of_v) / 2).squaredNorm();
        energy +=
            weight * (exact.squaredNorm() / 2 - kappa * run.scene.body().load(x(0), x(1)) * u.a(x(0)) * u.b(x(1)));
      }
    }
    const auto [points, weights] = gauss_rule(40);
    for (const double side : {0.0, 0.5})  // the traction's work, half by half
      for (Eigen::Index q = 0; q < points.size(); ++q) {
        const double x = side + points(q) / 2;
        energy -= weights(q) / 2 * (u.flux(x, 1)(1) * u.a(x) * u.b(1) + u.flux(1, x)(0) * u.a(1) * u.b(x));
      }
    const std::string at = fmt::format("case {}, {} cells", k, cells);
    EXPECT_GE(found.displacement, std::sqrt(displacement)) << at;
    EXPECT_GE(found.gradient, std::sqrt(gradient)) << at;
    EXPECT_GE(found.stress, std::sqrt(stress)) << at;
    EXPECT_LE(found.energy_lower, energy + 1e-9 * std::abs(energy)) << at;  // the rules: 1e-11
    EXPECT_GE(found.energy_upper, energy - 1e-9 * std::abs(energy)) << at;
    if (k % 5 == 4) continue;
    EXPECT_LE(found.imbalance, 1e-3 * found.displacement) << at << ": the flux takes the traction as it is";
    sharpest = std::min(sharpest, found.displacement / std::sqrt(displacement));
    bluntest = std::max(bluntest, found.displacement / std::sqrt(displacement));
  }
  fmt::print("bound / error of pulled bodies: {:.3f} to {:.3f}\n", sharpest, bluntest);
  EXPECT_LT(bluntest, 2.7);  // 2.30 seen: v must clear a curved obstacle that presses everywhere
}

// (a) for a cubic w: the flux takes an affine load and an affine traction as they are.
TEST(Certificate, ItsFluxIsInEquilibriumWithAnAffineTraction) {
  const Field load = [](double x, double y) { return 1 + 2 * x - y; },
              traction = [](double x, double) { return 3 * x - 1; };
  TriangleMesh mesh =
      retagged(structured_mesh(4, {0}), [](double, double y) { return y == 1 ? natural_group(0) : EdgeTag::clamped; });
  const Answered run(std::move(mesh), Scene(Body{load, [](double, double) { return 2.0; }}, NoLayer{}, {},
                                            {{"top", EdgeCondition::Kind::traction, traction}}));
  const EquilibratedFlux flux = run.flux();
  const auto w = [](const Eigen::Vector2d& x) { return x(0) * x(0) * x(1); };
  const Quadrature& rule = triangle_rule(6);
  double off = 0;
  for (int t = 0; t < run.mesh.triangle_count(); ++t) {
    const Eigen::MatrixX2d tau = flux.tau(run.mesh, t, rule.points);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(run.mesh, t, rule.points.row(q)), slope(2 * x(0) * x(1), x(0) * x(0));
      const Eigen::Vector2d sigma = flux.cell[t].s + tau.row(q).transpose();
      off += run.mesh.area(t) * rule.weights(q) * (sigma.dot(slope) - load(x(0), x(1)) * w(x));
    }
  }
  const auto [points, weights] = gauss_rule(4);
  for (int e = 0; e < run.mesh.edge_count(); ++e)
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const Eigen::Vector2d x = (1 - points(q)) * run.mesh.vertices.row(run.mesh.edges(e, 0)) +
                                points(q) * run.mesh.vertices.row(run.mesh.edges(e, 1));
      const double pull = run.mesh.edge_tag[e] == natural_group(0) ? run.mesh.edge_length(e) * traction(x(0), 1) : 0;
      off -= weights(q) * (pull + flux.residual(e)) * w(x);
    }
  EXPECT_NEAR(off, 0, 1e-13);  // round-off of sums of a few hundred terms below 1
}

// Body, layer and load twice as stiff and large: the same u, and sqrt(2) times every norm.
TEST(Certificate, ScalesWithTheStiffness) {
  const auto proved = [](double k) {
    return Answered(unstructured_mesh(8), Scene(Body{[k](double x, double y) { return k * paper_load(x, y); },
                                                     [k](double, double) { return k; }},
                                                StiffLayer{1e-3, k}, UnilateralContact{}))
        .certified();
  };
  const Certificate one = proved(1), two = proved(2);
  EXPECT_NEAR(two.displacement, std::sqrt(2) * one.displacement, 1e-10);
  EXPECT_NEAR(two.stress, std::sqrt(2) * one.stress, 1e-10);
  EXPECT_NEAR(two.energy_lower, 2 * one.energy_lower, 1e-10);
}

// Random loads, meshes and epsilons; a third of the solves is disturbed or comes with another contact set.
TEST(Certificate, IsNeverBelowTheErrorInThreeHundredCases) {
  constexpr int cases = 300;
  const std::vector<double> epsilons{1, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 0};
  std::mt19937 random(20040);
  const auto uniform = [&] { return random() / (std::mt19937::max() + 1.0); };
  const auto pick = [&](int n) { return static_cast<int>(uniform() * n); };
  double sharpest = 1e9, bluntest = 0;
  for (int k = 0; k < cases; ++k) {
    SineLoad load;
    for (int modes = 1 + pick(4); modes > 0; --modes)
      load.modes.push_back({1 + pick(4), {20 * uniform() - 10, 20 * uniform() - 10}});
    const double epsilon = epsilons[k % epsilons.size()];
    const int cells = 6 + pick(13), kind = k % 4;
    TriangleMesh mesh = kind == 0   ? structured_mesh(cells)
                        : kind == 1 ? jittered_mesh(cells, 0.2 * uniform())
                        : kind == 2 ? unstructured_mesh(cells)
                                    : layered_mesh(cells, epsilon);
    for (int level = 0; kind == 2 && level < k % 5; ++level) {  // as refinement leaves it, every seventh triangle cut
      std::vector<bool> marks(mesh.triangle_count());
      for (std::size_t t = 0; t < marks.size(); t += 7) marks[t] = true;
      mesh = bisected(longest_edge_first(mesh), marks);
    }
    Answered run(std::move(mesh), Scene({load}, StiffLayer{epsilon}, UnilateralContact{}));
    if (k % 3 == 0) disturb(run, std::pow(10, -1 - 4 * uniform()), static_cast<unsigned>(k));
    const Truth solved(load, epsilon, true, 12);
    const TruthTable truth(solved, 1 << 12);  // as fine as the series
    const double energy = solved.energy();
    const Companion v = run.strip();
    const ExactErrors exact = exact_errors(run.mesh, run.flux(), v, truth);
    const Certificate found = certify(run.scene, run.space, run.problem, run.solution, {.companion = &v});
    const std::string at = fmt::format("case {}: kind {}, {} cells, epsilon = {:g}", k, kind, cells, epsilon);
    EXPECT_GE(found.gradient, exact.gradient) << at;
    EXPECT_GE(found.displacement, exact.displacement) << at;
    EXPECT_GE(found.stress, exact.stress) << at;
    EXPECT_LE(found.energy_lower, energy + 1e-12) << at;
    EXPECT_GE(found.energy_upper, energy - 1e-12) << at;
    if (k % 3 == 0) continue;
    sharpest = std::min(sharpest, found.gradient / exact.gradient);
    bluntest = std::max(bluntest, found.gradient / exact.gradient);
  }
  RecordProperty("sharpest", std::to_string(sharpest));
  RecordProperty("bluntest", std::to_string(bluntest));
  EXPECT_LT(bluntest, 2.1);  // 1.30 to 2.03 in a prototype: the worst where f oscillates on a triangle
  fmt::print("bound / error of the undisturbed cases: {:.3f} to {:.3f}\n", sharpest, bluntest);
}

}  // namespace antilock::test::analysis_test

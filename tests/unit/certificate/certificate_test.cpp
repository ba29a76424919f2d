// The certificate: never below the true error, close to it at every epsilon, and true however the
// solve ended.
#include <optional>
#include <string>

#include "antilock/adapt/bisection.hpp"
#include "antilock/certificate/certificate.hpp"
#include "antilock/certificate/exact_errors.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"
#include "support/bodies.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "unit/analysis/helpers.hpp"

namespace antilock::test::certificate_test::certificate_test {

using namespace analysis_test;

using std::numbers::pi;

TEST(Certificate, IsCloseToTheErrorAndFlatInEpsilon) {
  const std::vector<double> epsilons{1, 1e-1, 1e-2, 1e-4, 1e-6, 1e-12, 0};
  std::map<double, ExactSolution> truths;
  std::map<double, ExactTable> exact_solution;
  for (const double epsilon : epsilons) {
    truths.emplace(epsilon, ExactSolution(paper_sine_load(), epsilon));
    exact_solution.emplace(epsilon, truths.at(epsilon));
  }
  for (const bool structured : {true, false})
    for (const int cells : {8, 16, 32}) {
      double least = 1e9, most = 0;
      for (const double epsilon : epsilons) {
        const Answered run(structured ? structured_mesh(cells) : unstructured_mesh(cells),
                           test::stiff_scene(epsilon));
        const ConformingCompanion v = run.strip();
        const ExactErrors exact =
            exact_errors(run.space.mesh(), run.flux(), v, exact_solution.at(epsilon));
        const Certificate found = run.certified();
        const double ratio = found.gradient / exact.gradient;
        const std::string at =
            fmt::format("{} 1/h = {} epsilon = {:g}", structured, cells, epsilon);
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
      const ExactErrors exact =
          exact_errors(run.space.mesh(), run.flux(), run.strip(), exact_solution.at(epsilon));
      const double ratio = run.certified().stress / exact.stress;
      EXPECT_GE(ratio, 1) << cells << epsilon;
      EXPECT_LE(ratio, 1.02) << cells << epsilon;
    }
}

/// |q|^2 of a combination q of A grad v and sigma, summed over the elements by itself.
template <class Combination>
double flux_norm2(const Answered& run, const EquilibratedFlux& flux, const ConformingCompanion& v,
                  Combination combination) {
  const Quadrature& rule = triangle_rule(6);
  double sum = 0;
  int row = 0;
  for (int t = 0; t < run.space.mesh().triangle_count(); ++t) {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (int i = 0; i < 3; ++i)
      gradient += v.at_vertices(run.space.mesh().triangles(t, i)) *
                  barycentric_gradients(run.space.mesh(), t).row(i).transpose();
    const bool layer = run.space.mesh().region[t] == Region::layer;
    if (layer) gradient(1) = v.stress(row++);
    const double stiffness =
        layer ? flux.law.stiffness : stiffness_on(run.scene.body().stiffness, run.space.mesh(), t);
    gradient *= stiffness;
    const Eigen::MatrixX2d tau = flux.tau(run.space.mesh(), t, rule.points);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d sigma =
          flux.cell[t].s + (layer ? Eigen::Vector2d(0, 0) : tau.row(q).transpose());
      const Eigen::Vector2d d = combination(gradient, sigma);
      sum += run.space.mesh().area(t) * rule.weights(q) *
             (layer ? flux.law.squared(d) : d.squaredNorm() / stiffness);
    }
  }
  return sum;
}

/// The left side of the identity, m^2 / 2 + C, summed over elements and edges by itself.
double left_side(const Answered& run, const EquilibratedFlux& flux, const ConformingCompanion& v,
                 const Profile& gap) {
  double sum = flux_norm2(run, flux, v,
                          [](const auto& a, const auto& b) -> Eigen::Vector2d { return a - b; }) /
               2;
  for (std::size_t i = 0; i < run.problem.bounds.unknowns.size(); ++i) {
    const auto ends = run.space.mesh().edges.row(run.problem.bounds.unknowns[i]);
    for (const auto& [theta, weight] :
         {std::pair{0.0, 1.0 / 6}, {0.5, 4.0 / 6}, {1.0, 1.0 / 6}}) {  // a cubic gap
      const double x = (1 - theta) * run.space.mesh().vertices(ends(0), 0) +
                       theta * run.space.mesh().vertices(ends(1), 0);
      sum += flux.lambda(static_cast<Eigen::Index>(i)) * weight *
             ((1 - theta) * v.at_vertices(ends(0)) + theta * v.at_vertices(ends(1)) + gap(x));
    }
  }
  return sum;
}

TEST(Certificate, RestsOnAnIdentityThatNeedsNoCommonMesh) {
  const Profile gap = [](double x) { return 0.05 - 0.9 * x * (1 - x) * (1 + 0.5 * x); };
  using Kind = BoundaryCondition::Kind;
  // on the layer's side the displacement is that of Sigma's end
  const std::vector<BoundaryCondition> edges{
      {"held", Kind::displacement,
       [](double x, double y) { return 0.3 * (x - 0.4) * (y + 0.2) + 0.03; }},
      {"pulled", Kind::traction, [](double, double y) { return std::sin(3 * y); }}};
  const Body body{paper_load, [](double, double) { return 2.5; }};
  for (const double epsilon : {1.0, 1e-2})
    for (const double amount : {0.0, 0.05}) {
      TriangleMesh mesh = retagged(layered_mesh(6, epsilon), [](double x, double y) {
        return x < 1 ? dirichlet_group(0) : y > 0 ? natural_group(1) : EdgeTag::free;
      });
      Answered run(std::move(mesh),
                   Scene(body, StiffLayer{epsilon, 3}, UnilateralContact{gap}, edges));
      disturb(run, amount, 7);
      const EquilibratedFlux flux = run.flux();
      const ConformingCompanion v = run.strip();
      ASSERT_FALSE(v.layer);
      const Certificate found = certify(run.scene, run, {.companion = &v});
      const double left = left_side(run, flux, v, gap);
      EXPECT_GT(flux.lambda.sum(), 0.1);
      EXPECT_NEAR(found.constitutive_error * found.constitutive_error / 2 + found.contact_work,
                  left, 1e-10);
      const double middle =
          flux_norm2(run, flux, v,
                     [](const auto& a, const auto& b) -> Eigen::Vector2d { return (a + b) / 2; });
      EXPECT_NEAR(found.midpoint_norm * found.midpoint_norm, middle, 1e-10);
      // Y^2 = (m + q) Y + C and (X - q / 2)^2 = (m + q)^2 / 4 + C
      const double q = found.oscillation + found.algebraic_residual_norm,
                   both = found.constitutive_error + q, y = found.displacement;
      EXPECT_GT(found.contact_work, 1e-4);
      EXPECT_GT(y, both);
      EXPECT_NEAR(y * y, both * y + found.contact_work, 1e-12);
      EXPECT_NEAR(std::pow(found.stress - q / 2, 2), both * both / 4 + found.contact_work, 1e-12);
      EXPECT_EQ(found.algebraic_residual_norm > 1e-3, amount > 0);
      double balance = 0;  // R(v)
      for (int e = 0; e < run.space.mesh().edge_count(); ++e)
        balance += flux.imbalance(e) *
                   (v.at_vertices(run.space.mesh().edges(e, 0)) +
                    v.at_vertices(run.space.mesh().edges(e, 1))) /
                   2;
      EXPECT_EQ(std::abs(balance) > 1e-4, amount > 0);
      EXPECT_NEAR(found.energy_upper - flux.dual_energy - balance, left, 1e-10)
          << epsilon << amount;

      // the same v as a function on columns of its own
      ConformingCompanion apart = v;
      apart.layer.emplace(run.space.mesh(), v.at_vertices, v.stress);
      const Certificate other = certify(run.scene, run, {.companion = &apart});
      EXPECT_NEAR(other.displacement, found.displacement, 1e-10);
      EXPECT_NEAR(other.gradient, found.gradient, 1e-10);
      EXPECT_NEAR(other.stress, found.stress, 1e-10);
      EXPECT_NEAR(other.energy_lower, found.energy_lower, 1e-10);
      EXPECT_NEAR((other.indicator - found.indicator).lpNorm<Eigen::Infinity>(), 0, 1e-10);
    }
}

// Too little or too much of everything: r1 is along A u, so that R(v) is far larger than what the
// width forgives. The strain stays right, eps^2 p = B u, and costs nothing. Factor 0 is a solve
// that stopped before it began.
TEST(Certificate, BoundsTheEnergyOfAScaledSolution) {
  for (const double epsilon : {1.0, 1e-2})
    for (const double factor : {0.0, 0.9, 1.1}) {
      const double energy = ExactSolution(paper_sine_load(), epsilon, true, 14).energy();
      Answered run(unstructured_mesh(32), test::stiff_scene(epsilon));
      run.solution.u *= factor;
      run.solution.p *= factor;
      const Certificate found = run.certified();
      EXPECT_GT(found.algebraic_residual_norm, 0.08);
      EXPECT_LE(found.energy_lower, energy) << epsilon << factor;
      // J is a minimum, a tenth off costs a hundredth; of nothing nothing is known
      EXPECT_GE(found.energy_lower, factor > 0 ? 1.05 * energy : -INFINITY) << epsilon << factor;
      EXPECT_GE(found.energy_upper, energy) << epsilon << factor;
    }
  // p against the strain of u: a bound that did not count |r2| would be -0.02
  Answered run(structured_mesh(8), test::stiff_scene(1));
  for (int i = 0; i < run.space.size(); ++i)
    if (const Eigen::RowVector2d at = run.space.dof_coordinates().row(i); at(1) < 0)
      run.solution.u(i) = 10 * std::sin(std::numbers::pi * at(0)) * at(1);
  run.solution.u(run.problem.dirichlet_dofs).setZero();
  run.solution.p = -0.5 * (run.problem.b * run.solution.u);
  EXPECT_LE(run.certified().energy_lower, ExactSolution(paper_sine_load(), 1, true, 14).energy());
}

// Next to a clamped end the one free vertex alone keeps v above the obstacle: not below it, and no
// higher than needed.
TEST(ConformingCompanion, IsLiftedBesideAClampedEndAsFarAsTheObstacleAsks) {
  const UnilateralContact contact{
      [](double x) { return 0.05 - 0.1 * std::exp(-std::pow((x - 0.05) / 0.03, 2)); }};
  const TriangleMesh mesh = unstructured_mesh(8);
  const Space space(mesh, p1());
  for (const double held : {0.0, 0.03}) {
    const Eigen::VectorXd near =
        (mesh.vertices.col(0).array() < 0.5)
            .select(Eigen::VectorXd::Constant(mesh.vertex_count(), held), 0);
    const Eigen::VectorXd lower = admissible_bounds(contact, space, near);
    const double end =
        mesh.vertices(space.contact_dofs().front(), 0);  // the first free vertex, right of x = 0
    EXPECT_GT(lower(0), -contact.gap(end)) << "the bound at the vertex is not enough";
    double least = 1;
    for (int k = 0; k <= 32; ++k) {
      const double theta = k / 32.0;
      least = std::min(least, (1 - theta) * held + theta * lower(0) + contact.gap(theta * end));
    }
    EXPECT_NEAR(least, 0, 1e-12) << held;
  }
}

// |u|_a >= |v|_a - |u - v|_a, and the same with the midpoint: the larger of the two is in the
// denominator.
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

TEST(ExtrudedP1Function, IsTheP1FunctionAnywhereAndItsMeansAreExact) {
  const TriangleMesh mesh = extruded(test::bridge(8), 0.7);
  std::mt19937 random(3);
  Eigen::VectorXd v(mesh.vertex_count());
  for (double& value : v) value = random() / 4e9;
  const ExtrudedP1Function f(mesh, v, Eigen::VectorXd::Zero(mesh.triangle_count()));
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

// A few contact steps, a contact set that is wrong, corrections left out: r1 tells, and the bound
// stays one.
TEST(Certificate, HoldsForUzawaAfterAFewSteps) {
  const double epsilon = 1e-2;
  Answered run(unstructured_mesh(16), test::stiff_scene(epsilon));
  const ExactTable exact_solution{ExactSolution(paper_sine_load(), epsilon)};
  PenalisedCholesky factor(
      run.problem, run.problem.compliance);  // no correction is needed: K is the problem's own
  const auto& free = factor.ordering().dof;
  const Eigen::MatrixXd& block = factor.contact_block();
  const auto compliance = [&](const Eigen::VectorXd& force) -> Eigen::VectorXd {
    const Eigen::VectorXd half = block.triangularView<Eigen::Lower>().solve(force);
    return block.transpose().triangularView<Eigen::Upper>().solve(half);
  };
  const double step = 2 / largest_eigenvalue(compliance, block.rows());
  Eigen::VectorXd lambda =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(run.problem.bounds.unknowns.size()));
  double ratio = 0;
  for (int steps = 0; steps <= 100; ++steps) {
    Eigen::VectorXd force = run.problem.load;
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      force(run.problem.bounds.unknowns[i]) += lambda(i);
    run.solution.u.setZero();
    run.solution.u(free) = factor.cholesky().backward(factor.cholesky().forward(force(free)));
    run.solution.p = run.problem.b * run.solution.u / run.problem.compliance;
    if (steps == 0 || steps == 1 || steps == 3 || steps == 10 || steps == 100) {
      const ExactErrors exact =
          exact_errors(run.space.mesh(), run.flux(), run.strip(), exact_solution);
      const Certificate found = run.certified();
      ratio = found.gradient / exact.gradient;
      EXPECT_GE(ratio, 1) << steps;
      EXPECT_LE(ratio, steps < 10 ? 1.7 : 1.35)
          << steps;  // 1.56, 1.37, 1.31, 1.30, 1.30 in a prototype
    }
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      lambda(i) =
          std::max(0.0, lambda(i) - 0.5 * step * run.solution.u(run.problem.bounds.unknowns[i]));
  }
}

TEST(Certificate, CountsWhatIsLeftOfTheForcesByTheFactorInHand) {
  Answered run(unstructured_mesh(8), test::stiff_scene(1e-4));
  disturb(run, 1e-2, 3);
  PenalisedCholesky factor(run.problem);
  const double rho = residual_norm(run.problem, run.flux(), &factor);
  EXPECT_GT(rho, 1e-3);
  EXPECT_EQ(residual_norm(run.problem, run.flux()), rho) << "a factor of its own is the same";
  // rho^2 = max |r1' w|^2 / w' K w, reached by w = K^-1 r1
  const auto& free = factor.ordering().dof;
  const Eigen::VectorXd r1 = run.flux().imbalance(free),
                        w = factor.cholesky().backward(factor.cholesky().forward(r1));
  EXPECT_NEAR(rho * rho, r1.dot(w), 1e-12 * rho * rho);
}

TEST(Certificate, BoundsAP1SolutionAndNamesTheLayerWhereItLocks) {
  const double epsilon = 1e-6;
  const ExactTable exact_solution{ExactSolution(paper_sine_load(), epsilon)};
  for (const bool locks : {true, false}) {
    const Answered run(locks ? unstructured_mesh(32) : layered_mesh(32, 1),
                       test::stiff_scene(epsilon));
    const Space conforming(run.space, p1());
    const ConformingCompanion v =
        p1_companion(active_set(test::stiff_problem(conforming, epsilon)));
    const Certificate found = certify(run.scene, run, {.companion = &v});
    EXPECT_GE(found.displacement,
              exact_errors(run.space.mesh(), run.flux(), v, exact_solution).displacement);
    EXPECT_EQ(found.displacement > 0.1, locks);
    EXPECT_EQ(found.layer_share > 0.5, locks) << found.layer_share;
  }
}

// |u - w| <= |u - v| + |v - w| for P2 and P1; nothing is lost where w = v.
TEST(Certificate, BoundsOtherElementsByTheirDistance) {
  for (const double epsilon : {1.0, 1e-2, 1e-6, 0.0}) {
    const ExactSolution solved(paper_sine_load(), epsilon, true, 14);
    const ExactTable exact_solution(solved);
    const Answered run(layered_mesh(16, epsilon), test::stiff_scene(epsilon));
    const ConformingCompanion v = run.strip();
    const Certificate found = certify(run.scene, run, {.companion = &v});
    for (const Element* element : {&p1(), &p2()}) {
      const Space space(run.space, *element);
      const VariationalInequality problem = test::stiff_problem(space, epsilon);
      const Solution w = active_set(problem);
      const double bound = certified_distance(found, v, {space, problem, w});
      EXPECT_GE(bound, measure_errors(space, w, epsilon, reference(exact_solution)).energy)
          << element->name() << epsilon;
      EXPECT_GT(bound, found.displacement);
      EXPECT_LT(bound, 3 * found.displacement);
    }
    const Space linear(run.space, p1());
    const VariationalInequality problem = test::stiff_problem(linear, epsilon);
    const Solution same = active_set(problem);
    const ConformingCompanion own = p1_companion(same);
    EXPECT_EQ(certified_distance(found, own, {linear, problem, same}), found.displacement);
    const Answered other(unstructured_mesh(8), test::stiff_scene(epsilon));
    expect_refused(
        [&] {
          certified_distance(found, other.strip(), {linear, problem, same});
        },
        "columns of its own");
    expect_refused([&] { certified_distance(found, p1_companion(same), other); },
                   "both on one mesh");
  }
}

TEST(Certificate, HoldsForTheThinLayerAndTheBodyAlone) {
  // against the energy on a mesh four times as fine: |u - v|^2 / 2 <= J(v) - J(u)
  for (const Layer& layer : {Layer(ThinLayer{0.25}), Layer(NoLayer{})}) {
    const Scene scene({paper_load}, layer, UnilateralContact{});
    const Domain domain{scene.layer_depth()};
    const Answered run(unstructured_mesh(8, domain), scene),
        fine(unstructured_mesh(64, domain), scene);
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
  const Profile needle = [](double x) {
    return 0.02 - 0.05 * std::exp(-std::pow((x - 0.71) / 0.02, 2));
  };
  const Profile closing = [](double x) { return 0.3 * x * x * (1 - x) * (1 - x); };
  for (const Profile& gap : {needle, closing})
    for (const double epsilon : {1.0, 1e-3}) {
      const Answered run(unstructured_mesh(8), test::stiff_scene(epsilon, {gap}));
      const ConformingCompanion v = run.strip();
      ASSERT_TRUE(v.layer);
      for (int k = 0; k <= 1000; ++k)
        EXPECT_GE(v.layer->value({k / 1000.0, -1}) + gap(k / 1000.0), -2e-4)
            << k;  // between the samples
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
      const ExactSolution exact_solution(load, 1e-2, true, 14);
      const Certificate found = run.certified();
      EXPECT_GT(found.algebraic_residual_norm, 1e-4) << "the rule does miss something";
      EXPECT_GE(found.gradient,
                exact_errors(run.space.mesh(), run.flux(), run.strip(), ExactTable(exact_solution))
                    .gradient)
          << cells;
      EXPECT_LE(found.energy_lower, exact_solution.energy()) << cells;
      EXPECT_GE(found.energy_upper, exact_solution.energy()) << cells;
    }
}

// The affine parts of f and of G + 1 are 0 on every triangle and edge, so that u_h = v = x, and osc
// alone stands before the error w = u - x. Per cell of size h, f is P3, Legendre's polynomial of
// degree 3, along x: w' = -h (P4 - P2) / 14, and
// |w|_a^2 = h^2 / 630. Or G = cos(k y) - 1 at x = 0: w = cos(k y) sinh(k (1 - x)) / (k cosh k).
TEST(Certificate, CountsALoadThatTheMeshDoesNotSee) {
  constexpr int n = 4;
  constexpr double h = 1.0 / n, pi = std::numbers::pi, k = 2 * pi * n;
  using Kind = BoundaryCondition::Kind;
  const Field legendre = [](double x, double) {
    const double s = n * x - std::floor(n * x);
    return ((20 * s - 30) * s + 12) * s - 1;
  };
  for (const bool pulled : {false, true}) {
    TriangleMesh mesh = retagged(structured_mesh(n, {0}), [](double x, double) {
      return x == 0 ? natural_group(0) : x == 1 ? dirichlet_group(1) : EdgeTag::free;
    });
    const std::vector<BoundaryCondition> edges{
        {"left", Kind::traction,
         [=](double, double y) { return pulled ? std::cos(k * y) - 1 : -1; }},
        {"right", Kind::displacement, [](double x, double) { return x; }}};
    const Body body{pulled ? Field([](double, double) { return 0.0; }) : legendre};
    const Answered run(std::move(mesh), Scene(body, NoLayer{}, {}, edges));
    const Certificate found = run.certified();
    // |P3|^2 = 1/7 on triangles with the longest edge h sqrt(2); C_E |G + 1|_E on n of them
    const double osc = pulled ? std::sqrt(2 * (1 + 1 / pi) / pi * h) : std::sqrt(2.0 / 7) * h / pi,
                 error = std::sqrt(pulled ? std::tanh(k) / (2 * k) : h * h / 630);
    EXPECT_NEAR(found.constitutive_error, 0, 1e-13);  // round-off of terms below 1
    EXPECT_LE(found.algebraic_residual_norm,
              pulled ? error / 5 : 1e-13);  // the solver's rule on edges sees something of G
    EXPECT_NEAR(found.oscillation, osc, 1e-12);
    for (const double bound : {found.displacement, found.gradient, found.stress})
      EXPECT_GE(bound, error);
    EXPECT_LE(found.energy_lower,
              found.energy_upper - error * error / 2);  // J(u) = J(v) - |w|_a^2 / 2
  }
}

TEST(Certificate, RefusesWhatItCannotProve) {
  Answered run(unstructured_mesh(4), test::stiff_scene(1e-2));
  const auto with = [&](const Scene& scene) { certify(scene, run); };
  expect_refused(
      [&] {
        with(Scene({[](double, double) { return 1.0; }}, StiffLayer{1e-2}, UnilateralContact{}));
      },
      "the problem is not the scene's");
  expect_refused([&] { with(Scene({paper_load}, StiffLayer{1e-2})); },
                 "do not agree whether there is contact");
  const Space conforming(run.space, p1());
  const auto p1_problem = test::stiff_problem(conforming, 1e-2);
  const Solution p1_solution = active_set(p1_problem);
  expect_refused([&] { certify(run.scene, {conforming, p1_problem, p1_solution}); }, "element P1");
  const Answered ventcel(structured_mesh(4, {0}),
                         Scene({paper_load}, VentcelLayer{}, UnilateralContact{}));
  expect_refused([&] { ventcel.certified(); }, "epsilon = 0");
  using Kind = BoundaryCondition::Kind;
  const auto one = [](double, double) { return 1.0; };
  const auto on_top = [&](const BoundaryCondition& edge, const Field& stiffness = {}) {
    const EdgeTag top = edge.kind == Kind::displacement ? dirichlet_group(0) : natural_group(0);
    TriangleMesh mesh = retagged(structured_mesh(4, {0}),
                                 [&](double, double y) { return y == 1 ? top : EdgeTag::clamped; });
    Answered(std::move(mesh), Scene(Body{paper_load, stiffness}, NoLayer{}, {}, {edge}))
        .certified();
  };
  expect_refused(
      [&] {
        on_top({"top", Kind::spring, one});
      },
      "no flux for a spring on the group top");
  expect_refused([&] { on_top({"top", Kind::displacement, one}); }, "values that do not jump");
  expect_refused(
      [&] {
        on_top({"top", Kind::displacement, [](double x, double) { return x * (1 - x); }});
      },
      "affine on every edge");
  expect_refused([&] { on_top({"top"}, [](double x, double) { return 1 + x; }); },
                 "one number per triangle");
  ConformingCompanion low = p1_companion(p1_solution);
  for (const int i : p1_problem.bounds.unknowns) low.at_vertices(i) -= 0.1;
  expect_refused([&] { certify(run.scene, run, {.companion = &low}); }, "below the obstacle");
  ConformingCompanion off = p1_companion(p1_solution);
  off.at_vertices(conforming.dirichlet_dofs().front()) = 0.1;
  expect_refused([&] { certify(run.scene, run, {.companion = &off}); }, "prescribed");
  const ConformingCompanion wrong{
      .at_vertices = Eigen::VectorXd::Zero(3), .stress = {}, .layer = std::nullopt};
  expect_refused([&] { certify(run.scene, run, {.companion = &wrong}); },
                 "another number of values");
  run.problem.dirichlet_values(0) = 1;
  run.solution = active_set(run.problem);
  expect_refused([&] { run.certified(); }, "the scene's values");
  run.solution.u(5) = std::nan("");
  expect_refused([&] { run.certified(); }, "not finite");
}

/// u = a(x) b(y) on the unit square, b affine and a smooth on the halves x < 1/2 and x > 1/2, whose
/// stiffness differs: the flux is continuous. u is given at the left, a traction at the right and
/// on top. Below, u lies on the obstacle under a pressure of its own.
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
  Eigen::Vector2d flux(double x, double y) const {
    return stiffness(x) * Eigen::Vector2d(a(x, 1) * b(y), a(x) * b1);
  }
  Scene scene() const {
    using Kind = BoundaryCondition::Kind;
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
  const auto between = [&](double low, double high) {
    return low + (high - low) * random() / std::mt19937::max();
  };
  const Quadrature& rule = triangle_rule(12);
  double sharpest = 1e9, bluntest = 0;
  for (int k = 0; k < 20; ++k) {
    const bool jumps = k % 2 == 0;  // the stiffness, on a mesh that follows it
    Pulled u{{between(0.5, 5), between(0.5, 5)},
             between(-1, 1),
             {between(1, 9), between(1, 9)},
             {},
             between(-1, 1),
             0};
    for (double& bend : u.bend) bend = between(-0.4, 0.4);
    if (!jumps) u.k[1] = u.k[0], u.wave[1] = u.wave[0], u.bend[1] = u.bend[0];
    u.b1 = -between(0.2, 2);  // a > 0 and b' < 0: the obstacle presses everywhere
    const int cells = 2 * (2 + k / 3);
    TriangleMesh mesh = retagged(
        jumps ? structured_mesh(cells, {0}) : unstructured_mesh(cells, {0}), [](double x, double) {
          return x == 0 ? dirichlet_group(0) : natural_group(x == 1 ? 1 : 2);
        });
    Answered run(std::move(mesh), u.scene());
    if (k % 5 == 4) disturb(run, 0.02, static_cast<unsigned>(k));
    const EquilibratedFlux flux = run.flux();
    const ConformingCompanion v = run.strip();
    const Certificate found = certify(run.scene, run, {.companion = &v});
    double displacement = 0, gradient = 0, stress = 0, energy = 0;
    for (int t = 0; t < run.space.mesh().triangle_count(); ++t) {
      const Eigen::Vector3d corners = v.at_vertices(run.space.mesh().triangles.row(t));
      const double kappa = stiffness_on(run.scene.body().stiffness, run.space.mesh(), t);
      const Eigen::Vector2d of_v =
          kappa * barycentric_gradients(run.space.mesh(), t).transpose() * corners;
      const Eigen::MatrixX2d tau = flux.tau(run.space.mesh(), t, rule.points);
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::Vector2d x = point_in(run.space.mesh(), t, rule.points.row(q)),
                              exact = u.flux(x(0), x(1)), s = flux.cell[t].s,
                              sigma = s + tau.row(q).transpose();
        const double weight = run.space.mesh().area(t) * rule.weights(q) / kappa;
        displacement += weight * (exact - of_v).squaredNorm();
        gradient += weight * (exact - s).squaredNorm();
        stress += weight * (exact - (sigma + of_v) / 2).squaredNorm();
        energy += weight * (exact.squaredNorm() / 2 -
                            kappa * run.scene.body().load(x(0), x(1)) * u.a(x(0)) * u.b(x(1)));
      }
    }
    const auto [points, weights] = gauss_rule(40);
    for (const double side : {0.0, 0.5})  // the traction's work, half by half
      for (Eigen::Index q = 0; q < points.size(); ++q) {
        const double x = side + points(q) / 2;
        energy -= weights(q) / 2 *
                  (u.flux(x, 1)(1) * u.a(x) * u.b(1) + u.flux(1, x)(0) * u.a(1) * u.b(x));
      }
    const std::string at = fmt::format("case {}, {} cells", k, cells);
    EXPECT_GE(found.displacement, std::sqrt(displacement)) << at;
    EXPECT_GE(found.gradient, std::sqrt(gradient)) << at;
    EXPECT_GE(found.stress, std::sqrt(stress)) << at;
    EXPECT_LE(found.energy_lower, energy + 1e-9 * std::abs(energy)) << at;  // the rules: 1e-11
    EXPECT_GE(found.energy_upper, energy - 1e-9 * std::abs(energy)) << at;
    if (k % 5 == 4) continue;
    EXPECT_LE(found.algebraic_residual_norm, 1e-3 * found.displacement)
        << at << ": the flux takes the traction as it is";
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
  TriangleMesh mesh = retagged(structured_mesh(4, {0}), [](double, double y) {
    return y == 1 ? natural_group(0) : EdgeTag::clamped;
  });
  const Answered run(std::move(mesh),
                     Scene(Body{load, [](double, double) { return 2.0; }}, NoLayer{}, {},
                           {{"top", BoundaryCondition::Kind::traction, traction}}));
  const EquilibratedFlux flux = run.flux();
  const auto w = [](const Eigen::Vector2d& x) { return x(0) * x(0) * x(1); };
  const Quadrature& rule = triangle_rule(6);
  double off = 0;
  for (int t = 0; t < run.space.mesh().triangle_count(); ++t) {
    const Eigen::MatrixX2d tau = flux.tau(run.space.mesh(), t, rule.points);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(run.space.mesh(), t, rule.points.row(q)),
                            slope(2 * x(0) * x(1), x(0) * x(0));
      const Eigen::Vector2d sigma = flux.cell[t].s + tau.row(q).transpose();
      off +=
          run.space.mesh().area(t) * rule.weights(q) * (sigma.dot(slope) - load(x(0), x(1)) * w(x));
    }
  }
  const auto [points, weights] = gauss_rule(4);
  for (int e = 0; e < run.space.mesh().edge_count(); ++e)
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const Eigen::Vector2d x =
          (1 - points(q)) * run.space.mesh().vertices.row(run.space.mesh().edges(e, 0)) +
          points(q) * run.space.mesh().vertices.row(run.space.mesh().edges(e, 1));
      const double pull = run.space.mesh().edge_tag[e] == natural_group(0)
                              ? run.space.mesh().edge_length(e) * traction(x(0), 1)
                              : 0;
      off -= weights(q) * (pull + flux.residual(e)) * w(x);
    }
  EXPECT_NEAR(off, 0, 1e-13);  // round-off of sums of a few hundred terms below 1
}

// Body, layer and load twice as stiff and large: the same u, and sqrt(2) times every norm.
TEST(Certificate, ScalesWithTheStiffness) {
  const auto proved = [](double k) {
    return Answered(unstructured_mesh(8),
                    Scene(Body{[k](double x, double y) { return k * paper_load(x, y); },
                               [k](double, double) { return k; }},
                          StiffLayer{1e-3, k}, UnilateralContact{}))
        .certified();
  };
  const Certificate one = proved(1), two = proved(2);
  EXPECT_NEAR(two.displacement, std::sqrt(2) * one.displacement, 1e-10);
  EXPECT_NEAR(two.stress, std::sqrt(2) * one.stress, 1e-10);
  EXPECT_NEAR(two.energy_lower, 2 * one.energy_lower, 1e-10);
}

// Random loads, meshes and epsilons; a third of the solves is disturbed or comes with another
// contact set.
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
    for (int level = 0; kind == 2 && level < k % 5;
         ++level) {  // as refinement leaves it, every seventh triangle cut
      std::vector<bool> marks(mesh.triangle_count());
      for (std::size_t t = 0; t < marks.size(); t += 7) marks[t] = true;
      mesh = bisected(longest_edge_first(mesh), marks);
    }
    Answered run(std::move(mesh), Scene({load}, StiffLayer{epsilon}, UnilateralContact{}));
    if (k % 3 == 0) disturb(run, std::pow(10, -1 - 4 * uniform()), static_cast<unsigned>(k));
    const ExactSolution solved(load, epsilon, true, 12);
    const ExactTable exact_solution(solved, 1 << 12);  // as fine as the series
    const double energy = solved.energy();
    const ConformingCompanion v = run.strip();
    const ExactErrors exact = exact_errors(run.space.mesh(), run.flux(), v, exact_solution);
    const Certificate found = certify(run.scene, run, {.companion = &v});
    const std::string at =
        fmt::format("case {}: kind {}, {} cells, epsilon = {:g}", k, kind, cells, epsilon);
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
  EXPECT_LT(bluntest,
            2.1);  // 1.30 to 2.03 in a prototype: the worst where f oscillates on a triangle
  fmt::print("bound / error of the undisturbed cases: {:.3f} to {:.3f}\n", sharpest, bluntest);
}

}  // namespace antilock::test::certificate_test::certificate_test

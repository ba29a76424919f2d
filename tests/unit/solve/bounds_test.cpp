// Bounds of other shapes: from above, from both sides, on constraints of several unknowns. The same
// solvers, the same report.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numeric>

#include "antilock/certificate/certificate.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/solve/contact_systems.hpp"
#include "antilock/solve/residual.hpp"
#include "antilock/solve/summed.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/sweep.hpp"
#include "support/brute_force.hpp"
#include "support/exact_rational.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test::bounds_test {

RowMatrix rows_of(const Eigen::MatrixXd& rows) {
  RowMatrix sparse = rows.sparseView();
  sparse.makeCompressed();
  return sparse;
}

// ---- A string between a floor and a ceiling.

/// -u'' = f on (0, 1), u = 0 at the ends, f = Q on the left half and -Q on the right one, -floor <=
/// u <= ceiling. A parabola of curvature Q leaves each bound with slope 0. From the clamp to the
/// ceiling it takes c_1, from the floor to the clamp c_2 and from the middle to either s:
///     ceiling = Q c_1^2 / 2,   floor = Q c_2^2 / 2,   ceiling + floor = Q s^2.
/// With c_1 = 7 h, c_2 = h, s = 5 h the ends of contact are nodes, and P1 is exact at the nodes,
/// forces included.
struct String {
  int n = 32;
  double h = 1.0 / 32, load = 3, ceiling = load * 49 * h * h / 2, floor = load * h * h / 2;
  VariationalInequality problem;
  Eigen::VectorXd u, lambda;  ///< the truth at all nodes and at the bounded ones

  String() {
    std::vector<Eigen::Triplet<double>> a1;
    for (int cell = 0; cell < n; ++cell)
      for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}})
        a1.emplace_back(cell + i, cell + j, (i == j ? 1 : -1) / h);
    problem.a1.resize(n + 1, n + 1);
    problem.a1.setFromTriplets(a1.begin(), a1.end());
    problem.b.resize(0, n + 1);
    problem.load.resize(n + 1);
    for (int i = 0; i <= n; ++i)
      problem.load(i) = i == n / 2 ? 0 : i < n / 2 ? load * h : -load * h;
    problem.dirichlet_dofs = {0, n};
    problem.dirichlet_values = Eigen::Vector2d::Zero();
    std::vector<int> inside(n - 1);
    std::iota(inside.begin(), inside.end(), 1);
    problem.bounds = {
        inside,
        {Eigen::VectorXd::Constant(n - 1, -floor), Eigen::VectorXd::Constant(n - 1, ceiling)}};
    u.setZero(n + 1);
    lambda.setZero(n - 1);
    const int on = 7, off = n / 2 - 5, down = n / 2 + 5, up = n - 1;
    for (int i = 1; i < n; ++i) {
      const auto parabola = [&](int from) { return load * h * h * (i - from) * (i - from) / 2; };
      u(i) = i < on       ? ceiling - parabola(on)
             : i <= off   ? ceiling
             : i <= n / 2 ? ceiling - parabola(off)
             : i < down   ? parabola(down) - floor
             : i <= up    ? -floor
                          : parabola(up) - floor;
      if (i >= on && i <= off) lambda(i - 1) = -load * h * (i == on || i == off ? 0.5 : 1);
      if (i >= down && i <= up) lambda(i - 1) = load * h * (i == down || i == up ? 0.5 : 1);
    }
  }
};

TEST(StringBetweenFloorAndCeiling, IsTheClosedForm) {
  const String string;
  for (const Solution& s : {active_set(string.problem), uzawa(string.problem)}) {
    const double round_off = s.solver == "uzawa" ? 1e-7 : 1e-13;
    EXPECT_LT(relative_difference(s.u, string.u), round_off) << s.solver;
    EXPECT_LT(relative_difference(s.lambda, string.lambda), round_off) << s.solver;
    EXPECT_EQ(s.warning, "") << s.solver;
    for (std::size_t i = 0; i < s.active.size(); ++i)
      EXPECT_EQ(s.active[i], string.lambda(static_cast<Eigen::Index>(i)) != 0) << s.solver << i;
  }
}

TEST(StringBetweenFloorAndCeiling, AsCombinationsIsTheSame) {
  // each bounded value is minus three times an unknown: floor and ceiling change places
  String string;
  VariationalInequality& problem = string.problem;
  const int bounds = problem.bounds.count();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(bounds, problem.size());
  for (int k = 0; k < bounds; ++k) rows(k, problem.bounds.unknowns[k]) = -3;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(bounds);
  problem.bounds = {{}, {-3 * string.ceiling * ones, 3 * string.floor * ones}, rows_of(rows)};
  const Solution s = active_set(problem);
  EXPECT_LT(relative_difference(s.u, string.u), 1e-13);
  EXPECT_LT(relative_difference(s.lambda, -string.lambda / 3), 1e-13);
}

TEST(StringBetweenFloorAndCeiling, TheDualityGapOfUzawaBoundsWhatIsLeft) {
  const String string;
  UzawaOptions options;
  int steps = 0;
  for (const double energy : {1e-4, 1e-6, 1e-8}) {
    options.stop_at = {energy, 1e-2};
    const Solution s = uzawa(string.problem, options);
    const Eigen::VectorXd e = s.u - string.u;
    EXPECT_LE(0.5 * e.dot(string.problem.a1 * e), energy);
    EXPECT_GT(s.counters.contact_iterations, steps) << "more asked, more steps";
    steps = s.counters.contact_iterations;
  }
  EXPECT_LT(2 * steps, uzawa(string.problem).counters.contact_iterations);
}

TEST(StringBetweenFloorAndCeiling, TheNestedStartKnowsTheSides) {
  const String string;
  Eigen::MatrixXd s = Eigen::MatrixXd(string.problem.a1).block(1, 1, string.n - 1, string.n - 1);
  const Eigen::VectorXd q = string.problem.load.segment(1, string.n - 1);
  const BoundLimits& bounds = string.problem.bounds;
  SchurComplementContact system(s, q);
  EXPECT_LE(solve_contact(system, bounds, system.nested_start(bounds, 100), 100).steps, 3);
}

TEST(StringBetweenFloorAndCeiling, ASweepKeepsTheSides) {
  const String string;
  Sweep sweep(string.problem);
  sweep.solve();
  EXPECT_EQ(sweep.solve().counters.contact_iterations, 1) << "the same question again";
  sweep.set_bounds(string.problem.bounds.lower, Eigen::VectorXd::Constant(string.n - 1, infinity));
  VariationalInequality from_below = string.problem;
  from_below.bounds = Bounds::lower_on(string.problem.bounds.unknowns, string.problem.bounds.lower);
  const Eigen::VectorXd below = active_set(from_below).u;
  EXPECT_LT(relative_difference(sweep.solve().u, below), 1e-13);
  sweep.set_bounds(string.problem.bounds.lower, string.problem.bounds.upper);
  sweep.solve();
  sweep.set_bounds(string.problem.bounds.lower, Eigen::VectorXd::Constant(string.n - 1, infinity));
  EXPECT_LT(relative_difference(sweep.solve().u, below), 1e-13)
      << "no upper bound is left to start from";
  expect_refused([&] { sweep.set_bounds(string.problem.bounds.lower, Eigen::VectorXd()); },
                 "upper has 0 entries");
  expect_refused(
      [&] { sweep.set_bounds(string.problem.bounds.upper, string.problem.bounds.lower); },
      "accepted: lower <= upper");
  EXPECT_EQ(sweep.problem().bounds.upper(0), infinity) << "as before";
}

// ---- Signs and equations.

TEST(UpperBounds, AreLowerBoundsOfMinusU) {
  const Space space(unstructured_mesh(6), crouzeix_raviart());
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    const VariationalInequality below =
        stiff_problem(space, epsilon, {[](double x) { return x * (x - 0.4) * (1 - x); }});
    VariationalInequality above = below;
    above.load *= -1;
    above.bounds.upper = -below.bounds.lower;
    above.bounds.lower.setConstant(-infinity);
    const Solution one = active_set(below), other = active_set(above);
    EXPECT_GT(std::count(one.active.begin(), one.active.end(), true), 0);
    EXPECT_EQ(other.u, -one.u) << epsilon;  // bit by bit
    EXPECT_EQ(other.lambda, -one.lambda) << epsilon;
    EXPECT_EQ(other.active, one.active) << epsilon;
    EXPECT_EQ(other.kkt.min_gap, one.kkt.min_gap);
    EXPECT_EQ(other.kkt.min_pressure, one.kkt.min_pressure);
    EXPECT_EQ(other.kkt.complementarity, one.kkt.complementarity);
    const Solution slow = uzawa(above);
    EXPECT_EQ(slow.u, -uzawa(below).u) << epsilon;
  }
}

TEST(Equations, ArePrescribedValuesWithTheirReaction) {
  const Space space(structured_mesh(6), p1());
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    VariationalInequality held = stiff_problem(space, epsilon);
    for (Eigen::Index i = 0; i < held.bounds.lower.size(); ++i)
      held.bounds.lower(i) = i % 2 == 0 ? 0.01 : -0.01;
    held.bounds.upper = held.bounds.lower;
    held.bounds.upper(0) = infinity;  // one bound beside them
    const Solution s = active_set(held);
    for (std::size_t i = 1; i < held.bounds.unknowns.size(); ++i)
      EXPECT_EQ(s.u(held.bounds.unknowns[i]), held.bounds.lower(static_cast<Eigen::Index>(i)));
    VariationalInequality fixed = held;
    fixed.dirichlet_dofs.insert(fixed.dirichlet_dofs.end(), held.bounds.unknowns.begin() + 1,
                                held.bounds.unknowns.end());
    fixed.dirichlet_values.conservativeResize(
        static_cast<Eigen::Index>(fixed.dirichlet_dofs.size()));
    fixed.dirichlet_values.tail(held.bounds.lower.size() - 1) =
        held.bounds.lower.tail(held.bounds.lower.size() - 1);
    fixed.bounds = Bounds::lower_on({held.bounds.unknowns[0]}, held.bounds.lower.head(1));
    const Solution exact = active_set(fixed);
    EXPECT_LT(relative_difference(s.u, exact.u), 1e-9) << epsilon;
    const Eigen::VectorXd reaction = -exact_residual(fixed, exact.u, exact.p, exact.lambda).r1;
    for (std::size_t i = 1; i < held.bounds.unknowns.size(); ++i)
      EXPECT_NEAR(s.lambda(static_cast<Eigen::Index>(i)), reaction(held.bounds.unknowns[i]), 1e-9)
          << epsilon;
    EXPECT_LT(s.lambda.minCoeff() * s.lambda.maxCoeff(), 0)
        << "reactions of both signs: the test means something";
    EXPECT_EQ(s.warning, "");
  }
}

// ---- Against all sets of bounds.

/// Two layers with their bodies on top of each other, their lines Gamma_C facing one another: u^1 -
/// u^2 >= -gap there.
VariationalInequality two_bodies(const VariationalInequality& one,
                                 const VariationalInequality& other, double gap) {
  const auto beside = [](const auto& a, const auto& b) {
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
    both.topLeftCorner(a.rows(), a.cols()) = Eigen::MatrixXd(a);
    both.bottomRightCorner(b.rows(), b.cols()) = Eigen::MatrixXd(b);
    return both;
  };
  const auto then = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (Eigen::VectorXd(a.size() + b.size()) << a, b).finished();
  };
  VariationalInequality both;
  both.a1 = beside(one.a1, other.a1).sparseView();
  both.b = rows_of(beside(one.b, other.b));
  both.m = then(one.m, other.m);
  both.load = then(one.load, other.load);
  both.compliance = one.compliance;
  both.dirichlet_dofs = one.dirichlet_dofs;
  for (const int i : other.dirichlet_dofs) both.dirichlet_dofs.push_back(one.size() + i);
  both.dirichlet_values = then(one.dirichlet_values, other.dirichlet_values);
  Eigen::MatrixXd gaps =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(one.bounds.unknowns.size()), both.size());
  for (Eigen::Index k = 0; k < gaps.rows(); ++k) {
    gaps(k, one.bounds.unknowns[k]) = 1;
    gaps(k, one.size() + other.bounds.unknowns[k]) = -1;
  }
  both.bounds = {{}, BoundLimits(Eigen::VectorXd::Constant(gaps.rows(), -gap)), rows_of(gaps)};
  return both;
}

TEST(TwoBodies, OfEqualShapeMeetHalfWay) {
  // the second body is the image of the first in the plane between them: each sees an obstacle at
  // half the gap
  for (const NamedSpace& space : two_square_spaces(8, {&p1(), &crouzeix_raviart()})) {
    if (&space.element() == &p1() && space.name.starts_with("unstructured"))
      continue;  // locks: lambda has no bound
    for (const double compliance : {1.0, 1e-6, 0.0}) {
      SCOPED_TRACE(space.name + std::to_string(compliance));
      constexpr double gap = 1e-5;
      const VariationalInequality one =
          stiff_problem(space, std::sqrt(compliance), {[](double) { return gap / 2; }});
      VariationalInequality image = one;
      image.load *= -1;
      const Solution half = active_set(one);
      const VariationalInequality problem = two_bodies(one, image, gap);
      EXPECT_GT(std::count(half.active.begin(), half.active.end(), true), 1);
      for (const Solution& s : {active_set(problem), uzawa(problem)}) {
        const double within = s.solver == "uzawa" ? 1e-7 : 1e-9;
        EXPECT_LT(relative_difference(s.u.head(one.size()), half.u), within) << s.solver;
        EXPECT_LT(relative_difference(s.u.tail(one.size()), -half.u), within) << s.solver;
        EXPECT_LT(relative_difference(s.lambda, half.lambda), 10 * within) << s.solver;
        EXPECT_EQ(s.active, half.active) << s.solver;
        EXPECT_EQ(s.warning, "") << s.solver;
      }
    }
  }
}

TEST(Bounds, OfAllShapesAreTheBruteForceAnswer) {
  // a layer with its first contact unknown between two bounds, the second from above, the third in
  // a combination with the unknown over it and a clamped one, whose value is not zero
  const Space space(structured_mesh(4), p1());
  for (const double epsilon : {1.0, 1e-2, 1e-4})
    for (const double load : {1.0, -1.0, 0.1}) {
      VariationalInequality problem = stiff_problem(space, epsilon);
      problem.load *= load;
      problem.dirichlet_values(0) = 0.02;
      std::vector<char> taken(problem.size(), 0);
      for (const int i : problem.dirichlet_dofs) taken[i] = 1;
      for (const int i : problem.bounds.unknowns) taken[i] = 1;
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, problem.size());
      const int third = problem.bounds.unknowns[2];
      problem.bounds.unknowns.pop_back();
      const int beside = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
      rows(0, third) = 1;
      rows(0, beside) = -0.3;
      rows(0, problem.dirichlet_dofs[0]) = 0.7;
      rows(1, beside) = 1e3;
      rows(1, problem.bounds.unknowns[0]) = -2e3;  // bounded by itself
      const Eigen::Vector4d lower(-0.001, -infinity, 0, -0.5), upper(0.002, 0.001, infinity, 0.5);
      problem.bounds = {problem.bounds.unknowns, {lower, upper}, rows_of(rows)};
      const test::BruteForce exact = test::brute_force(problem);
      for (const Solution& s : {active_set(problem), uzawa(problem)}) {
        const double within = s.solver == "uzawa" ? 1e-7 : 1e-9;
        EXPECT_LT(relative_difference(s.u, exact.u), within)
            << s.solver << epsilon << ", load " << load;
        EXPECT_LT(relative_difference(s.lambda, exact.lambda), 10 * within)
            << s.solver << epsilon << ", load " << load;
        EXPECT_EQ(s.active, exact.active) << s.solver << epsilon << ", load " << load;
        EXPECT_EQ(s.u(problem.dirichlet_dofs[0]), 0.02);
      }
    }
}

// ---- A block on a slope.

/// The platen of plane strain, turned by `angle`: clamped above and pushed 0.1 into an obstacle
/// below.
struct Turned {
  Space x, y;
  VariationalInequality problem;

  Turned(TriangleMesh flat, double angle, const Element& element, double epsilon)
      : x(turned(std::move(flat), angle), element), y(x) {
    problem = assemble(platen(epsilon, element.conforming() ? 0 : 1), {x, y});
    // the clamped edges move along the turned axis; the bounds are on the turned normal
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
      problem.dirichlet_values(static_cast<Eigen::Index>(i)) =
          problem.dirichlet_dofs[i] < x.size() ? 0.1 * s : -0.1 * c;
    const auto along = [&](int i) {
      return c * x.dof_coordinates()(i, 0) + s * x.dof_coordinates()(i, 1);
    };
    std::sort(problem.bounds.unknowns.begin(), problem.bounds.unknowns.end(), [&](int i, int j) {
      return along(i - x.size()) < along(j - x.size());
    });  // as on the flat one
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(problem.bounds.lower.size(), problem.size());
    for (Eigen::Index k = 0; k < normal.rows(); ++k) {
      const int i = problem.bounds.unknowns[k] - x.size();
      problem.bounds.lower(k) = -std::pow(along(i) - 0.5, 2);
      normal(k, i) = -s;
      normal(k, x.size() + i) = c;
    }
    problem.bounds = {{}, BoundLimits(problem.bounds.lower), rows_of(normal)};
  }

  static TriangleMesh turned(TriangleMesh mesh, double angle) {
    mesh.vertices *= Eigen::Rotation2Dd(angle).toRotationMatrix().transpose();
    return mesh;
  }
};

TEST(BlockOnASlope, IsTheFlatOneTurned) {
  const TriangleMesh crossed = with_free_sides(structured_mesh(8, Domain{0}, Diagonal::crossed)),
                     right = with_free_sides(structured_mesh(8, Domain{0}));
  for (const auto& [mesh, element] : {std::pair{&crossed, &p1()}, {&right, &crouzeix_raviart()}})
    for (const double epsilon : {1.0, 1e-6, 0.0}) {
      const Space x(*mesh, *element), y(*mesh, *element);
      const Solution flat =
          active_set(assemble(platen(epsilon, element->conforming() ? 0 : 1), {x, y}));
      EXPECT_GT(std::count(flat.active.begin(), flat.active.end(), true), 2);
      EXPECT_GT(std::count(flat.active.begin(), flat.active.end(), false), 2);
      for (const double angle : {0.5, 2.2, -1.5707963267948966}) {
        SCOPED_TRACE(element->name() + ", epsilon " + std::to_string(epsilon) + ", angle " +
                     std::to_string(angle));
        const Turned slope(*mesh, angle, *element, epsilon);
        const Solution s = active_set(slope.problem);
        const Eigen::MatrixX2d back =
            s.u.reshaped(x.size(), 2) *
            Eigen::Rotation2Dd(angle).toRotationMatrix();  // a point per row
        EXPECT_LT(relative_difference(back.reshaped(), flat.u), 1e-10);
        EXPECT_LT(relative_difference(s.lambda, flat.lambda), 1e-9);
        EXPECT_EQ(s.active, flat.active);
        EXPECT_EQ(s.warning, "");
        EXPECT_LT(worst_violation(s.kkt), 1e-9);
      }
    }
}

// ---- Bounds on constraints.

/// Three points (u_x, u_y) on springs.
VariationalInequality springs(const Eigen::MatrixXd& rows, const Eigen::VectorXd& load) {
  VariationalInequality problem =
      small_problem(Eigen::MatrixXd::Identity(load.size(), load.size()), load);
  problem.bounds = {{}, BoundLimits(Eigen::VectorXd::Zero(rows.rows())), rows_of(rows)};
  return problem;
}

TEST(Combinations, APointInAGrooveStandsOnBothWalls) {
  // walls of normals (sin a, cos a) and (-sin a, cos a): no unknown is one wall's alone. Pressed
  // into the edge u = 0.
  const double a = 0.7;
  Eigen::MatrixXd walls(2, 2);
  walls << std::sin(a), std::cos(a), -std::sin(a), std::cos(a);
  const Eigen::Vector2d load(0.3, -1);
  const Solution s = active_set(springs(walls, load));
  EXPECT_LT(s.u.norm(), 1e-15);
  const Eigen::Vector2d exact = walls.transpose().inverse() * -load;
  EXPECT_GT(exact.minCoeff(), 0);
  EXPECT_LT((s.lambda - exact).norm(), 1e-15);
  // pulled up along one wall and into it, it slides there, held by this wall alone
  const Eigen::Vector2d up(-std::cos(a), std::sin(a));
  const Solution t = active_set(springs(walls, up - 0.1 * walls.row(0).transpose()));
  EXPECT_LT((t.u - up).norm(), 1e-15);
  EXPECT_LT((t.lambda - Eigen::Vector2d(0.1, 0)).norm(), 1e-15);
}

TEST(Combinations, MayShareUnknownsAndDependOnEachOther) {
  const Eigen::Vector4d load(1, -2, 3, -4);
  const auto right = [](const VariationalInequality& problem) {
    const test::ExactAnswer exact = test::exact_answer(problem);
    ASSERT_EQ(exact.what, test::Exactly::solved);
    for (const Solution& s : {active_set(problem), uzawa(problem)})
      EXPECT_LT((s.u - exact.u).lpNorm<Eigen::Infinity>(), 1e-8 * exact.u.lpNorm<Eigen::Infinity>())
          << s.solver;
  };
  Eigen::MatrixXd rows(3, 4);
  rows << 1, -1, 0, 0, 0, 1, -1, 0, 1, 0, -1, 0;  // the third is the sum of the others
  right(springs(rows, load));
  rows(2, 2) = -1 + 1e-3;
  right(springs(rows, load));
  // more rows than unknowns
  Eigen::MatrixXd many(5, 4);
  many << 1, 0.5, 0, 0, 0, 1, 0.25, 0, 0, 0, 1, 0.5, 1, 1, 1, 1, 0.5, 0, 0, -1;
  right(springs(many, load));
}

TEST(Combinations, TheUnitsOfARowAndOfForcesDoNotMatter) {
  Eigen::MatrixXd rows(2, 4);
  rows << 1, -0.5, 0, 0, 0, 0.3, 1, 1;
  VariationalInequality problem = springs(rows, Eigen::Vector4d(-1, 2, -3, 0.5));
  problem.bounds.lower << -0.1, -0.2;
  problem.bounds.upper = Eigen::Vector2d(0.1, infinity);
  const Solution one = active_set(problem);
  EXPECT_EQ(std::count(one.active.begin(), one.active.end(), true), 2);
  for (const auto& [unit, force] : {std::pair{0x1p-60, 1.0}, {0x1p60, 1.0}, {1.0, 0x1p60}}) {
    VariationalInequality other = problem;
    other.bounds.constraints *= unit;
    other.bounds.lower *= unit;
    other.bounds.upper *= unit;
    other.a1 *= force, other.load *= force;
    const Solution s = active_set(other);
    EXPECT_EQ(s.u, one.u);  // powers of two: bit by bit
    EXPECT_EQ(s.lambda, one.lambda * (force / unit));
    EXPECT_EQ(s.kkt.min_gap, one.kkt.min_gap);
    EXPECT_EQ(s.kkt.complementarity, one.kkt.complementarity);
    EXPECT_EQ(s.kkt.min_pressure, one.kkt.min_pressure);
  }
}

// ---- What cannot be met, and what is refused.

TEST(Bounds, ThatNoUCanMeetAreRefusedUnderAnyLoad) {
  // compliance 0 and B: u_0 - u_1 = 0; the bounds ask for u_0 - u_1 >= 0.05, in three shapes
  for (const double load : {1.0, 1e6, 1e12, 1e18})
    for (const int shape : {0, 1, 2}) {
      VariationalInequality problem =
          springs(Eigen::MatrixXd(0, 3), load * Eigen::Vector3d(1, 2, -3));
      problem.b = rows_of(Eigen::RowVector3d(1, -1, 0));
      problem.m = Eigen::VectorXd::Ones(1);
      problem.compliance = 0;
      if (shape == 0) {
        const RowMatrix row = rows_of(Eigen::RowVector3d(1, -1, 0));
        problem.bounds = {{}, BoundLimits(Eigen::VectorXd::Constant(1, 0.05)), row};
      } else {
        const Eigen::Vector2d lower(0.05, shape == 1 ? -1 : -infinity), upper(infinity, 0);
        problem.bounds = {{0, 1}, {lower, upper}};
      }
      EXPECT_THROW(active_set(problem), NotConverged) << load << ", shape " << shape;
      problem.bounds.upper = Eigen::VectorXd::Constant(problem.bounds.count(), infinity);
      problem.bounds.lower(0) = -0.05;
      if (shape > 0) problem.bounds.upper(1) = 0;
      if (load < 1e12) {
        EXPECT_NO_THROW(active_set(problem)) << load << ", shape " << shape;
      }
    }
}

TEST(Bounds, AGreatUElsewhereHidesNoUpperBound) {
  // where a bound or B may be impossible to meet every violation counts: u_1 stops at 0.1 though
  // u_0 is 1e14
  VariationalInequality problem = springs(Eigen::MatrixXd(0, 4), Eigen::Vector4d(1e14, 0.2, 1, -1));
  problem.b = rows_of(Eigen::RowVector4d(0, 0, 1, 0));
  problem.m = Eigen::VectorXd::Ones(1);
  problem.compliance = 0;
  problem.bounds = {{1, 3}, {Eigen::Vector2d(-infinity, 0.01), Eigen::Vector2d(0.1, infinity)}};
  const Solution s = active_set(problem);
  EXPECT_NEAR(s.u(1), 0.1, 1e-12);
  EXPECT_NEAR(s.u(3), 0.01, 1e-12);
  EXPECT_NEAR(s.lambda(0), -0.1, 1e-12);
}

TEST(KktOfBounds, ReportsEachSideOfABoundByItself) {
  const String string;
  const Solution right = active_set(string.problem);
  const double u = right.u.lpNorm<Eigen::Infinity>(), f = right.lambda.lpNorm<Eigen::Infinity>();
  const int top = 8, bottom = 24, between = 15;  // nodes; the bound of node i is i - 1
  Solution wrong = right;
  wrong.u(top) = string.ceiling + 0.1 * u;  // the largest u now
  EXPECT_NEAR(kkt_report(string.problem, wrong).min_gap, -0.1 / 1.1, 1e-12);
  wrong = right;
  wrong.u(bottom) = -string.floor - 0.1 * u;
  EXPECT_NEAR(kkt_report(string.problem, wrong).min_gap, -0.1, 1e-12);
  // a force that is right at one side is none at the other: the gap times the force tells
  wrong = right;
  wrong.lambda(top - 1) *= -1;
  EXPECT_NEAR(kkt_report(string.problem, wrong).complementarity,
              (string.ceiling + string.floor) / u, 1e-12);
  wrong = right;
  wrong.lambda(between - 1) = 0.1 * f;
  EXPECT_NEAR(kkt_report(string.problem, wrong).complementarity,
              0.1 * (right.u(between) + string.floor) / u, 1e-12);
  // from above alone, a push from below is wrong whatever the gap
  VariationalInequality above = string.problem;
  above.bounds.lower.setConstant(-infinity);
  wrong = active_set(above);
  wrong.lambda(top - 1) = 0.1 * wrong.lambda.lpNorm<Eigen::Infinity>();
  EXPECT_LT(kkt_report(above, wrong).min_pressure, -0.05);
  EXPECT_THROW(check_kkt(above, wrong), NotConverged);
}

TEST(KktOfBounds, ReportsCombinationsInTheirOwnUnits) {
  Eigen::MatrixXd rows(1, 3);
  rows << 1e3, -1e3, 0;
  VariationalInequality problem = springs(rows, Eigen::Vector3d(-1, 1, 5));
  const Solution right = active_set(problem);
  EXPECT_NEAR(right.lambda(0), 1e-3, 1e-15);
  const double u = right.u.lpNorm<Eigen::Infinity>();
  EXPECT_EQ(u, 5);
  Solution wrong = right;
  wrong.u(0) -= 0.1 * u;
  EXPECT_NEAR(kkt_report(problem, wrong).min_gap, -0.05,
              1e-12);  // of 1e3 (u_0 - u_1), at most 2e3 |u|
  wrong = right;
  wrong.lambda(0) = -1e-4;
  EXPECT_LT(kkt_report(problem, wrong).min_pressure, -0.01)
      << "a pull on two soft unknowns beside a great load";
  EXPECT_GT(kkt_report(problem, wrong).residual, 0.01);
}

TEST(CheckBounds, RefusesBoundsThatAreNone) {
  const String string;
  const auto refused = [&](const std::function<void(VariationalInequality&)>& spoil,
                           const std::string& words) {
    VariationalInequality bad = string.problem;
    spoil(bad);
    expect_refused([&] { check(bad); }, words);
    expect_refused([&] { active_set(bad); }, words);
    expect_refused([&] { uzawa(bad); }, words);
    expect_refused([&] { kkt_report(bad, Solution{}); }, words);
  };
  using P = VariationalInequality;
  const double nan = std::nan("");
  refused([](P& p) { p.bounds.lower(3) = p.bounds.upper(3) + 1e-9; }, "accepted: lower <= upper");
  refused([](P& p) { p.bounds.lower(3) = -infinity, p.bounds.upper(3) = infinity; },
          "bound 3 is not finite");
  refused([](P& p) { p.bounds.lower(3) = infinity; }, "bound 3 is not finite");
  refused([](P& p) { p.bounds.upper(3) = -infinity; }, "bound 3 is not finite");
  refused([nan](P& p) { p.bounds.upper(3) = nan; }, "not finite");
  refused([](P& p) { p.bounds.upper.conservativeResize(5); }, "upper has 5 entries");
  refused([](P& p) { p.bounds.constraints.resize(1, 3); }, "constraints have 3 columns");
  const auto with_row = [](P& p, double value) {
    p.bounds.unknowns.pop_back();
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, p.size());
    row(0, p.size() - 2) = 1;
    p.bounds.constraints = rows_of(row);
    p.bounds.constraints.valuePtr()[0] = value;
  };
  refused([&](P& p) { with_row(p, nan); }, "an entry of constraints is not finite");
  refused([&](P& p) { with_row(p, 0); }, "constraint 0 holds no free unknown");
  refused([&](P& p) { with_row(p, 1), p.bounds.lower.conservativeResize(3); },
          "one bound per contact unknown and per");
  refused([&](P& p) { with_row(p, 1), p.bounds.constraints.uncompress(); }, "compressed");
}

TEST(Refused, WhereABoundOfAnotherShapeIsNotKnown) {
  const Space space(structured_mesh(4), crouzeix_raviart());
  const Scene scene = test::stiff_scene(1);
  VariationalInequality above = assemble(scene, space), combined = above;
  above.bounds.upper = Eigen::VectorXd::Constant(above.bounds.lower.size(), 1.0);
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, combined.size());
  row(0, combined.bounds.unknowns.back()) = 1;
  combined.bounds.unknowns.pop_back();
  combined.bounds.constraints = rows_of(row);
  for (const VariationalInequality* problem : {&above, &combined}) {
    const Solution s = active_set(*problem);
    const std::string words = "accepted: lower bounds on unknowns";
    expect_refused([&] { certify(scene, {space, *problem, s}); }, words);
    expect_refused([&] { uzawa_cg_ilut(*problem); }, words);
    expect_refused([&] { naive_summed_solve(*problem, SummedFactor::cholesky); }, words);
  }
  const Solution s = active_set(above);
  const Eigen::MatrixX3d table = contact_table({space, above, s});
  EXPECT_GE(table.col(1).minCoeff(), -1e-15);
  EXPECT_EQ(contact_zone({space, above, s}).active,
            std::count(s.active.begin(), s.active.end(), true));
  const std::string words = "accepted: bounds on unknowns";
  const Solution c = active_set(combined);
  expect_refused([&] { contact_table({space, combined, c}); }, words);
  expect_refused([&] { contact_zone({space, combined, c}); }, words);
  // a combination of one unknown is that unknown, by a factor made before and in a sweep, too
  PenalisedCholesky factor(combined);
  const Eigen::VectorXd u = active_set(assemble(scene, space)).u;
  for (const Solution& answer :
       {c, active_set(combined, factor), uzawa(combined, factor), Sweep(combined).solve()})
    EXPECT_LT(relative_difference(answer.u, u), 1e-8) << answer.solver;
}

}  // namespace antilock::test::solve_test::bounds_test

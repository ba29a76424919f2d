// Rubber with Fortin and Soulie's element: order 2 up to lambda = infinity, without jump terms.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "antilock/form/elasticity_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/solve/active_set.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::fortin_soulie_test {

/// A divergence-free u = (s g', -s' g) without traction on y = 0 and 0 on the other sides of the
/// unit square, with s = x^2 (1 - x)^2 and g = y^3 (1 - y)^2. With p = pressure * y, which is 0 on
/// y = 0, the load -lap u - grad p belongs to it.
struct Swirl {
  double pressure = 0;

  static std::array<double, 4> s(double x) {  // s and its derivatives
    return {x * x * (1 - x) * (1 - x), 2 * x - 6 * x * x + 4 * x * x * x, 2 - 12 * x + 12 * x * x,
            -12 + 24 * x};
  }
  static std::array<double, 4> g(double y) {
    return {y * y * y * (1 - y) * (1 - y), y * y * (3 - 8 * y + 5 * y * y),
            y * (6 - 24 * y + 20 * y * y), 6 - 48 * y + 60 * y * y};
  }
  static double load_x(double x, double y) { return -s(x)[2] * g(y)[1] - s(x)[0] * g(y)[3]; }
  double load_y(double x, double y) const {
    return s(x)[3] * g(y)[0] + s(x)[1] * g(y)[2] - pressure;
  }
  static Eigen::Matrix2d gradient(double x, double y) {
    Eigen::Matrix2d rows;
    rows << s(x)[1] * g(y)[1], s(x)[0] * g(y)[2], -s(x)[2] * g(y)[0], -s(x)[1] * g(y)[1];
    return rows;
  }
};

VariationalInequality swirl_problem(const VectorSpace& space, double epsilon, const Swirl& exact) {
  PlaneStrain scene;
  scene.prescribed_displacement = 0;
  scene.epsilon = epsilon;
  VariationalInequality problem = assemble(scene, space);
  problem.bounds = {};
  problem.load << load_vector(space.x, Swirl::load_x),
      load_vector(space.y, [&](double x, double y) { return exact.load_y(x, y); });
  return problem;
}

/// The error of the gradient in L2, with a rule of degree 8.
double gradient_error(const VectorSpace& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.x.mesh();
  const Quadrature& rule = triangle_rule(8);
  double squared = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d lambda = rule.points.row(q);
      const Eigen::Vector2d x = point_in(mesh, t, lambda);
      Eigen::Matrix2d off = Swirl::gradient(x(0), x(1));
      int row = 0;
      for (const auto& [part, first] : {std::pair<const Space*, int>{&space.x, 0},
                                        std::pair<const Space*, int>{&space.y, space.x.size()}}) {
        const Eigen::VectorXi unknowns =
            (part->cell_dofs().row(t).transpose().array() + first).matrix();
        off.row(row++) -= u(unknowns).transpose() * part->element().derivative(lambda) *
                          barycentric_gradients(mesh, t);
      }
      squared += mesh.area(t) * rule.weights(q) * off.squaredNorm();
    }
  return std::sqrt(squared);
}

double swirl_error(const Element& element, int cells, double epsilon, const Swirl& exact) {
  const Space one(structured_mesh(cells, Domain{0}), element);
  const VectorSpace space{one, one};
  return gradient_error(space, active_set(swirl_problem(space, epsilon, exact)).u);
}

double order(const Element& element, double epsilon, const Swirl& exact) {
  std::vector<double> h, errors;
  for (const int cells : {8, 16, 32}) {
    h.push_back(1.0 / cells);
    errors.push_back(swirl_error(element, cells, epsilon, exact));
  }
  return slope(h, errors);
}

// The second program integrates the load by another rule, whose difference is of a higher order.
TEST(FortinSoulie, HasTheErrorsOfASecondProgram) {
  EXPECT_NEAR(swirl_error(fortin_soulie(), 16, 1, Swirl{}), 4.418e-4, 4e-6);
  EXPECT_NEAR(swirl_error(fortin_soulie(), 16, 0, Swirl{}), 5.546e-4, 5e-6);
  EXPECT_NEAR(swirl_error(fortin_soulie(), 16, 0, Swirl{.pressure = 3}), 5.546e-4, 5e-6);
}

// The intervals hold what the coarsest of three meshes is off.
TEST(FortinSoulie, HasOrderTwoAtEveryLambda) {
  for (const double epsilon : {1.0, 1e-4, 0.0})
    EXPECT_NEAR(order(fortin_soulie(), epsilon, Swirl{}), 2, 0.2) << epsilon;
  EXPECT_NEAR(order(fortin_soulie(), 0, Swirl{.pressure = 3}), 2, 0.2);
  EXPECT_NEAR(order(crouzeix_raviart(), 0, Swirl{}), 1, 0.2) << "with its jumps";
}

/// The rows of B that are equations of the element, those with a fixed compliance.
Eigen::MatrixXd equations(const VariationalInequality& problem) {
  const Eigen::Index count = problem.fixed_compliances.size();
  return Eigen::MatrixXd(problem.b.bottomRows(count));
}

TEST(FortinSoulie, SolutionsSatisfyTheEquationOfEachTriangle) {
  const Space one(block(8), fortin_soulie());
  const VectorSpace space{one, one};
  for (const double epsilon : {1.0, 0.0}) {
    const VariationalInequality problem = assemble(platen(epsilon), space);
    ASSERT_EQ(problem.fixed_compliances.size(), 2 * one.mesh().triangle_count());
    const Solution solution = active_set(problem);
    // the tolerance of the solver is 1e-10 of the largest |u|
    EXPECT_LT((equations(problem) * solution.u).cwiseAbs().maxCoeff(), 1e-9) << epsilon;
    EXPECT_GT(solution.lambda.sum(), 0);
    EXPECT_LE(solution.counters.corrections, 15) << epsilon;  // those of one penalty
  }
}

// u = (.1/(1 + 2 epsilon) x, -.1 y) is the exact solution on a flat obstacle.
TEST(FortinSoulie, PassesThePatchTest) {
  for (const TriangleMesh& mesh : {block(4), with_free_sides(unstructured_mesh(4, Domain{0}))})
    for (const double epsilon : {1.0, 1e-8, 0.0}) {
      const Space one(mesh, fortin_soulie());
      PlaneStrain scene;
      scene.epsilon = epsilon;
      scene.sliding = true;
      const Eigen::VectorXd u = active_set(assemble(scene, {one, one})).u;
      const double stretch = 0.1 / (1 + 2 * epsilon);
      Eigen::VectorXd exact(u.size());
      exact << stretch * one.dof_coordinates().col(0), -0.1 * one.dof_coordinates().col(1);
      EXPECT_LT((u - exact).lpNorm<Eigen::Infinity>(), 1e-9) << epsilon;
    }
}

/// The smallest eigenvalue of A1 against the gradient norm, on the free unknowns that satisfy the
/// equations, or on all free ones.
double korn(const VectorSpace& space, bool with_equations) {
  const VariationalInequality problem = assemble(platen(0), space);
  const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
  std::vector<int> free;
  for (int i = 0; i < problem.size(); ++i)
    if (!std::binary_search(problem.dirichlet_dofs.begin(), problem.dirichlet_dofs.end(), i))
      free.push_back(i);
  const Eigen::MatrixXd a1 = problem.a1.toDense()(free, free);
  const Eigen::MatrixXd norm = strain_form(space, one, one).toDense()(free, free);
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(size, size);
  if (with_equations) {
    const Eigen::MatrixXd rows = equations(problem)(Eigen::all, free);
    basis = rows.fullPivLu().kernel();
  }
  const Eigen::MatrixXd left = basis.transpose() * a1 * basis;
  const Eigen::MatrixXd right = basis.transpose() * norm * basis;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(left, right);
  return solver.eigenvalues().minCoeff();
}

// Without the equations the element is hybrid_bdm1, which has no Korn inequality. A second program,
// in another language, has 0.1512 and 0.1511.
TEST(FortinSoulie, HasAKornInequalityByItsEquations) {
  for (const int cells : {4, 6}) {
    const Space one(block(cells), fortin_soulie());
    const double constant = korn({one, one}, true);
    EXPECT_NEAR(constant, 0.151, 0.001) << cells;
    EXPECT_LT(korn({one, one}, false), 1e-10) << cells;
  }
}

TEST(FortinSoulie, IsRefusedWhereItsEquationsAreNotAppended) {
  const Space layered(structured_mesh(2), fortin_soulie());
  expect_refused([&] { assemble(stiff_scene(1), layered); }, "FS is not accepted");
  expect_refused([&] { assemble(Coating{}, {layered, layered}); }, "FS is not accepted");
}

}  // namespace antilock::test::models_test::fortin_soulie_test

// Mixed methods of rubber.
#include "antilock/mesh/quadrature.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "support/dense.hpp"
#include "support/measures.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::mixed_rubber_test {

TEST(Mixed, StrainsAndDivergencesAreExact) {
  const TriangleMesh mesh = unstructured_mesh(4, Domain{0});
  for (const Element* element : {&p1(), &p1_bubble(), &p2(), &p3(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const VectorSpace both{space, space};
    const auto field = [&](auto&& of_x, auto&& of_y) {
      Eigen::VectorXd u(both.size());
      for (int i = 0; i < space.size(); ++i) {
        const double x = space.dof_coordinates()(i, 0), y = space.dof_coordinates()(i, 1);
        u(i) = of_x(x, y);
        u(space.size() + i) = of_y(x, y);
      }
      return u;
    };
    const SparseMatrix strains = strain_form(both);
    const FactoredForm div = divergence(both);
    // a turn costs nothing; (2 x, 3 y) has 2 eps:eps = 26 and div = 5
    const Eigen::VectorXd turn = field([](double, double y) { return 1 - y; },
                                       [](double x, double) { return x; }),
                          linear = field([](double x, double) { return 2 * x; },
                                         [](double, double y) { return 3 * y; }),
                          square = field([](double x, double) { return x * x; },
                                         [](double, double y) { return y * y; });
    EXPECT_LT((strains * turn).norm(), 1e-12) << element->name();
    EXPECT_LT(value(div, turn), 1e-20) << element->name();
    EXPECT_NEAR(linear.dot(strains * linear), 26, 1e-11) << element->name();
    EXPECT_NEAR(value(div, linear), 25, 1e-11) << element->name();
    if (element != &p2() && element != &p3()) continue;
    EXPECT_NEAR(square.dot(strains * square), 16.0 / 3, 1e-11)
        << element->name();                                               // 2 int 4 x^2 + 4 y^2
    EXPECT_NEAR(value(div, square), 14.0 / 3, 1e-11) << element->name();  // int 4 (x + y)^2
  }
}

TEST(Mixed, AtEpsilonZeroIsTheSaddlePoint) {
  // MINI and Taylor-Hood as they are written down: A1 u + D' p = 0, D u = 0, D = int phi_i div, by
  // a rule of degree 6
  const TriangleMesh mesh = block(3);
  for (const Element* element : {&p1_bubble(), &p2()}) {
    const Space space(mesh, *element);
    const VariationalInequality problem = rubber(space, true);
    const Solution ours = active_set(problem);
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(mesh.vertex_count(), problem.size());
    const Quadrature& rule = triangle_rule(6);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::MatrixXd gradient =
            element->derivative(rule.points.row(q)) * barycentric_gradients(mesh, t);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < element->dofs(); ++j)
            for (const int k : {0, 1})
              d(mesh.triangles(t, i), space.cell_dofs()(t, j) + k * space.size()) +=
                  rule.weights(q) * mesh.area(t) * rule.points(q, i) * gradient(j, k);
      }
    const VariationalInequality held = equality_constrained(problem, ours.active);
    const auto n = problem.size(), m = mesh.vertex_count();
    Eigen::MatrixXd saddle = Eigen::MatrixXd::Zero(n + m, n + m);
    saddle << problem.a1.toDense(), d.transpose(), d, Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
    for (std::size_t i = 0; i < held.dirichlet_dofs.size(); ++i) {
      saddle.row(held.dirichlet_dofs[i]).setZero();
      saddle(held.dirichlet_dofs[i], held.dirichlet_dofs[i]) = 1;
      right(held.dirichlet_dofs[i]) = held.dirichlet_values(static_cast<Eigen::Index>(i));
    }
    const Eigen::VectorXd theirs = test::lu_solve(saddle, right);
    EXPECT_LT((ours.u - theirs.head(n)).lpNorm<Eigen::Infinity>(), 1e-9) << element->name();
    EXPECT_LT((ours.p - theirs.tail(m)).lpNorm<Eigen::Infinity>(), 1e-7) << element->name();
  }
}

TEST(Mixed, ForceIsThatOfAFineReference) {
  // 0.259166: Taylor-Hood on graded meshes, FreeFEM. Taylor-Hood here: better than first order
  std::vector<double> error;
  for (const int n : {8, 32}) {
    const Space space(block(n), p2());
    error.push_back(std::abs(active_set(rubber(space, true)).lambda.sum() / 0.259166 - 1));
  }
  EXPECT_LT(error.back(), 1e-3);
  EXPECT_GT(std::log2(error.front() / error.back()), 3);
}

}  // namespace antilock::test::models_test::mixed_rubber_test

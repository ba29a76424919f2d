// The supremum of the error over a ball of loads: the exact side in closed form, the quadratic form
// of the error, its largest eigenvalue.
#include "antilock/analysis/worst_load.hpp"
#include "antilock/analysis/load_ascent.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::analysis_test::worst_load_test {

using std::numbers::pi;
/// E column by column.
Eigen::MatrixXd matrix_of(ErrorForm& form) {
  const int n = form.modes().size();
  Eigen::MatrixXd e(n, n);
  for (int j = 0; j < n; ++j) e.col(j) = form.apply(Eigen::VectorXd::Unit(n, j));
  return e;
}

// a(u, u) = (f, S f) = -2 J(u). The load constant in y falls like 1/m in the modes, its work like
// m^-4: 40 waves leave out less than 1e-4 of it.
TEST(LoadModes, WorkIsTheTruths) {
  const LoadModes modes(40);
  for (const double epsilon : {1.0, 0.1, 1e-6, 1e-20, 0.0})
    for (const int k : {1, 2, 5}) {
      const Eigen::VectorXd f = modes.constant_in_y(k, 10);
      const ExactSolution exact(SineLoad{{{k, {10}}}}, epsilon, false, 10);
      EXPECT_NEAR(f.dot(modes.response(f, epsilon)) / (-2 * exact.energy()), 1, 1e-4)
          << epsilon << " " << k;
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
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(modes.size(), modes.size())).cwiseAbs().maxCoeff(),
            1e-12);
}

// The load 2 sin(k pi x) cos(pi y / 2), its cosine as a polynomial (1e-8), measured point by point
// against the sine series: for a polynomial V_h exact but for the quadrature of the error (degree
// 12 or so) and the table (1e-6).
TEST(ErrorForm, IsTheMeasuredErrorOfEveryElement) {
  const TriangleMesh mesh = unstructured_mesh(6);
  for (const Element* element : {&p1(), &p2(), &p3(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    ErrorForm form(space, LoadModes(6));
    for (const double epsilon : {1.0, 1e-2, 0.0})
      for (const int k : {1, 3}) {
        form.set_epsilon(epsilon);
        Eigen::VectorXd f = Eigen::VectorXd::Zero(form.modes().size());
        for (int j = 0; j < f.size(); ++j)
          f(j) = form.modes().k()(j) == k && form.modes().m()(j) == 1;
        const SineLoad load = load_of_modes(Eigen::VectorXd::Unit(k, k - 1));
        const ExactTable table(ExactSolution(load, epsilon, false, 12), 1 << 11);
        const Solution solution =
            active_set(assemble(Scene(Body{load}, StiffLayer{epsilon}), space));
        const double measured = measure_errors(space, solution, epsilon, reference(table)).energy;
        EXPECT_NEAR(form.error(f) / measured, 1, 1e-3)
            << element->name() << " " << epsilon << " " << k;
      }
  }
}

// A mesh so small that nothing has to be iterated: S - F' A^-1 F with A summed and inverted, the
// load of each mode by load_vector (degree 5 and more on triangles of 1/4 of a wave: 1e-3 in E).
TEST(ErrorForm, ItsLargestIsTheDenseEigenvalue) {
  const TriangleMesh mesh = unstructured_mesh(3);
  for (const Element* element : {&p1(), &p4()})
    for (const double epsilon : {1.0, 0.1}) {
      const Space space(mesh, *element);
      ErrorForm form(space, LoadModes(3));
      form.set_epsilon(epsilon);
      const VariationalInequality problem =
          assemble(Scene(Body{[](double, double) { return 0.0; }}, StiffLayer{epsilon}), space);
      Eigen::MatrixXd a = Eigen::MatrixXd(problem.a1) +
                          test::gram(Eigen::MatrixXd(problem.b), problem.m) / (epsilon * epsilon);
      for (const int i : problem.dirichlet_dofs) {
        a.row(i).setZero();
        a.col(i).setZero();
        a(i, i) = 1;
      }
      const int n = form.modes().size();
      Eigen::MatrixXd dense(n, n), u(space.size(), n), loads(space.size(), n);
      for (int j = 0; j < n; ++j) {
        const Eigen::VectorXd one = Eigen::VectorXd::Unit(n, j);
        loads.col(j) =
            load_vector(space, [&](double x, double y) { return form.modes().value(one, x, y); });
        for (const int i : problem.dirichlet_dofs) loads(i, j) = 0;
        u.col(j) = test::lu_solve(a, loads.col(j));
        dense.col(j) = form.modes().response(one, epsilon);
      }
      dense -= test::product(loads.transpose(), u);
      const double largest = symmetric_eigenvalues(0.5 * (dense + dense.transpose())).maxCoeff();
      EXPECT_NEAR(std::pow(form.worst(1e-6).error, 2) / largest, 1, 0.01)
          << element->name() << " " << epsilon;
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
      // the solves stop at 1e-10, and S is 0.1; CR's interpolant and loads are two quadratures of
      // waves, 1e-8
      EXPECT_LT((e - e.transpose()).cwiseAbs().maxCoeff(), 1e-8) << element->name();
      EXPECT_GT(values.minCoeff(), -1e-7) << element->name();
      const WorstLoad worst = form.worst(1e-6);
      EXPECT_NEAR(worst.error * worst.error / values.maxCoeff(), 1, 1e-6) << element->name();
      EXPECT_NEAR(form.error(worst.load) / worst.error, 1, 1e-6);
      EXPECT_NEAR(worst.load.norm(), 1, 1e-12);
    }
  }
}

// dim G_h = p - 1 on the layer: of the first p waves one combination is lost whole, however fine
// the mesh. P1 and P2 keep functions of one symmetry each, so that the bound by the kernel's
// dimension is the limit.
TEST(WorstLoad, LimitsByDegreeAndWidths) {
  for (const int p : {1, 2}) EXPECT_NEAR(loss_of_degree(p) / loss_of_wave(p), 1, 1e-9) << p;
  for (const int p : {3, 4, 5}) {
    EXPECT_GT(loss_of_degree(p), 1.05 * loss_of_wave(p)) << p;
    EXPECT_LT(loss_of_degree(p), loss_of_degree(p - 1)) << p;
  }
  // |e_1| / |e_1|_a of e_1 = psi(y) sin(pi x), psi = sinh(pi (1 - y)) / sinh(pi) in the body and 1
  // in the layer
  const auto [points, weights] = gauss_rule(20);
  const Eigen::ArrayXd at = pi * (1 - points.array()), psi = at.sinh() / std::sinh(pi),
                       slope = pi * at.cosh() / std::sinh(pi), w = weights.array();
  const double square = (w * psi.square()).sum(),
               energy = (w * slope.square()).sum() + pi * pi * (square + 1);
  EXPECT_NEAR(loss_of_wave(1), std::sqrt(square / energy), 1e-14);
  // k^2 + m^2 in order: 2, 5, 5, 8, 10, 10, 13
  EXPECT_NEAR(kolmogorov_width(0), 1 / (pi * std::sqrt(2)), 1e-15);
  EXPECT_NEAR(kolmogorov_width(2), 1 / (pi * std::sqrt(5)), 1e-15);
  EXPECT_NEAR(kolmogorov_width(6), 1 / (pi * std::sqrt(13)), 1e-15);
  // Weyl: n = pi r^2 / 4 - r of them have k^2 + m^2 <= r^2, up to terms that grow more slowly than
  // r
  EXPECT_NEAR(1 / (pi * kolmogorov_width(10000)), std::sqrt(40000 / pi) + 2 / pi, 1);
}

TEST(ErrorForm, EveryDegreeLosesWhatItsKernelCannotHold) {
  for (const Element* element : {&p1(), &p2(), &p3(), &p4()})
    for (const int cells : {4, 8}) {
      const Space space(unstructured_mesh(cells), *element);
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
  const Space space(structured_mesh(6), p1());
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

}  // namespace antilock::test::analysis_test::worst_load_test

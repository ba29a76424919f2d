// Norms against integrals done by hand; rates, contact zones and energy.
#include <Eigen/Core>

#include "antilock/exact/exact_table.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"
#include "unit/measure/helpers.hpp"

namespace antilock::test::measure_test::errors_test {

/// u = x y.
Reference product(double epsilon) {
  return {[](double x, double y) { return x * y; },
          [](double x, double y) { return Eigen::Vector2d(y, x); },
          [epsilon](double x, double) { return x / (epsilon * epsilon); }};
}

TEST(Errors, VanishForFunctionsOfTheSpace) {
  constexpr double epsilon = 0.5;
  for (const NamedSpace& space : two_square_spaces(4, elements())) {
    for (const Reference& u : {affine(epsilon), product(epsilon)}) {
      if (space.element().degree() == 1 && u.value(1, 1) == 1) continue;  // x y is quadratic
      const Errors e = measure_errors(space, interpolant(space, u, epsilon), epsilon, u);
      for (const double norm : {e.max, e.max_at_unknowns, e.l2, e.h1, e.energy})
        EXPECT_LT(norm, 1e-11) << space.name;
    }
  }
}

TEST(Errors, AreTheNormsOfTheReferenceWhereTheSolutionIsZero) {
  constexpr double epsilon = 0.5;
  for (const NamedSpace& space : two_square_spaces(5, elements())) {
    Solution zero;
    zero.u = Eigen::VectorXd::Zero(space.size());
    zero.p = Eigen::VectorXd::Zero(layer_strain(space).m.size());
    const Errors e = measure_errors(space, zero, epsilon, product(epsilon));
    EXPECT_NEAR(e.max, 1, 1e-11) << space.name;  // at (1, 1) and (1, -1)
    EXPECT_NEAR(e.l2, std::sqrt(2.0 / 9), 1e-11) << space.name;
    EXPECT_NEAR(e.h1, std::sqrt(2.0 / 9 + 4.0 / 3), 1e-11) << space.name;
    // body x^2 + y^2, layer y^2 + epsilon^-2 x^2
    EXPECT_NEAR(e.energy, std::sqrt(2.0 / 3 + 1.0 / 3 + 1 / (3 * epsilon * epsilon)), 1e-11)
        << space.name;
    EXPECT_LE(e.max_at_unknowns, e.max);
    EXPECT_GT(e.max_at_unknowns, 0.8);
  }
}

TEST(Errors, SeeTheJumpsOfCrouzeixRaviart) {
  // one unknown of 1: at the vertex opposite its edge the function is -1, which no unknown shows
  const Space space(structured_mesh(4), crouzeix_raviart());
  Solution s;
  s.u = Eigen::VectorXd::Zero(space.size());
  s.p = Eigen::VectorXd::Zero(layer_strain(space).m.size());
  s.u(space.size() / 2) = 1;
  const Reference zero{[](double, double) { return 0.5; },
                       [](double, double) { return Eigen::Vector2d(0, 0); },
                       [](double, double) { return 0.0; }};
  const Errors e = measure_errors(space, s, 1, zero);
  EXPECT_NEAR(e.max_at_unknowns, 0.5, 1e-14);
  EXPECT_NEAR(e.max, 1.5, 1e-14);
}

TEST(Errors, WithoutLayerTheEnergyNormIsTheGradients) {
  const Space space(structured_mesh(4, {0}), p1());
  Solution zero;
  zero.u = Eigen::VectorXd::Zero(space.size());
  const Errors e = measure_errors(space, zero, 0, product(1));
  EXPECT_NEAR(e.energy, std::sqrt(2.0 / 3), 1e-12);
  EXPECT_NEAR(e.h1, std::sqrt(2.0 / 3 + 1.0 / 9), 1e-12);
}

TEST(Slope, IsExactForPowersOfH) {
  const std::vector<double> h{0.5, 0.25, 0.1, 0.02};
  std::vector<double> errors;
  errors.reserve(h.size());
  for (const double one : h) errors.push_back(7 * std::pow(one, 1.5));
  EXPECT_NEAR(slope(h, errors), 1.5, 1e-12);
}

TEST(Energy, OfAnAffineFunctionByHand) {
  const Space space(structured_mesh(4), p1());
  const VariationalInequality problem =
      assemble(Scene({[](double, double) { return 1.0; }}, StiffLayer{0.5}), space);
  const Solution s = interpolant(space, affine(0.5), 0.5);
  // a: body 9 + 4, layer 9 + 4 / 0.25; L: the mean of 0.2 + 3 x - 2 y over the body is 0.7
  EXPECT_NEAR(energy(problem, s), 0.5 * (13 + 9 + 16) - 0.7, 1e-11);
}

TEST(ContactZone, LengthsFillGammaC) {
  for (const auto& [name, mesh] : two_square_meshes(8)) {
    const Eigen::VectorXd p1_lengths = contact_lengths(Space(mesh, p1()));
    const Eigen::VectorXd cr_lengths = contact_lengths(Space(mesh, crouzeix_raviart()));
    ASSERT_EQ(p1_lengths.size(), 7);
    ASSERT_EQ(cr_lengths.size(), 8);
    for (Eigen::Index i = 0; i < 7; ++i) EXPECT_NEAR(p1_lengths(i), 1.0 / 8, 1e-10) << name;
    for (Eigen::Index i = 0; i < 8; ++i) EXPECT_NEAR(cr_lengths(i), 1.0 / 8, 1e-10) << name;
  }
}

TEST(ContactZone, TableAndZoneReportTheContact) {
  const TriangleMesh mesh = unstructured_mesh(16);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const auto problem = stiff_problem(space, 1, {[](double x) { return 1e-4 * x; }});
    const Solution s = active_set(problem);
    const ContactZone zone = contact_zone({space, problem, s});
    const Eigen::MatrixX3d table = contact_table({space, problem, s});
    ASSERT_EQ(table.rows(), zone.points);
    int active = 0;
    double from = 2, to = -1;
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      EXPECT_GE(table(i, 1), -1e-12);
      EXPECT_GE(table(i, 2), -1e-12);
      if (i > 0) {
        EXPECT_GT(table(i, 0), table(i - 1, 0));
      }
      EXPECT_NEAR(table(i, 1), s.u(problem.bounds.unknowns[i]) + 1e-4 * table(i, 0), 1e-15);
      EXPECT_NEAR(table(i, 2) / 16, s.lambda(i), 1e-9);
      if (table(i, 2) > 0) {
        ++active;
        from = std::min(from, table(i, 0));
        to = std::max(to, table(i, 0));
      }
    }
    EXPECT_EQ(zone.active, active);
    EXPECT_GT(active, 0);
    EXPECT_EQ(zone.from, from);
    EXPECT_EQ(zone.to, to);
    const ContactForce force = contact_force({space, problem, s});
    EXPECT_NEAR(force.normal, s.lambda.sum(), 1e-14);
    EXPECT_NEAR(force.moment, s.lambda.dot(table.col(0)), 1e-14);
    EXPECT_FALSE(force.tangential);
  }
}

TEST(ContactZone, EndsBetweenNeighbours) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, 0.125, 0.625);
  using Interval = std::pair<double, double>;
  const ContactZone inside = contact_zone(x, {false, true, false, true, false}, {0, 1});
  EXPECT_EQ(inside.active, 2);
  EXPECT_EQ(inside.from_within, Interval(x(0), x(1)));
  EXPECT_EQ(inside.to_within, Interval(x(3), x(4)));
  const ContactZone all = contact_zone(x, std::vector<bool>(5, true), {0, 1});
  EXPECT_EQ(all.from_within, Interval(0, x(0)));
  EXPECT_EQ(all.to_within, Interval(x(4), 1));
}

TEST(ContactZone, ReachesFromEndToEndOfGammaC) {
  EXPECT_EQ(contact_ends(structured_mesh(4)), std::pair(0.0, 1.0));
}

TEST(ContactZone, IsEmptyWhereNothingTouches) {
  const Space space(structured_mesh(4), p1());
  const auto problem = stiff_problem(space, 1, {[](double) { return 10.0; }});
  const ContactZone zone = contact_zone({space, problem, active_set(problem)});
  EXPECT_EQ(zone.points, 3);
  EXPECT_EQ(zone.active, 0);
  EXPECT_FALSE(zone.from || zone.to || zone.from_within || zone.to_within);
}

TEST(ExactResidual, IsTheWorkOfTheContactPressureOnConformingSpaces) {
  constexpr double epsilon = 0.1;
  const ExactSolution exact(paper_sine_load(), epsilon, true, 14);
  const ExactTable table(exact);
  std::vector<double> ends;
  for (const auto& [from, to] : exact.contact_zones()) ends.insert(ends.end(), {from, to});
  for (const NamedSpace& space : two_square_spaces(8, {&p1(), &p2()})) {
    Eigen::VectorXd residual =
        consistency_residual(space, load_vector(space, paper_load), reference(table), ends);
    Eigen::VectorXd work = contact_work(space, [&](double x) { return exact.pressure(x); });
    for (const int i : space.dirichlet_dofs()) residual(i) = work(i) = 0;  // reactions
    // 1e-3: the stress rises like a square root at the end of contact, within one column of
    // triangles
    EXPECT_LT((residual - work).cwiseAbs().maxCoeff(), 1e-3 * work.maxCoeff()) << space.name;
  }
}

TEST(ExactResidual, OfCrouzeixRaviartIsItsFormAtTheInterpolant) {
  // the means over the edges fix the mean gradient (Lemma 2): a(u, v_h) = a(I_h u, v_h) for every
  // v_h
  const Reference u = product(1);
  for (const auto& [name, mesh] : two_square_meshes(4)) {
    const Space space(mesh, crouzeix_raviart());
    const Eigen::VectorXd form =
        consistency_residual(space, Eigen::VectorXd::Zero(space.size()), u, {0.3});
    const Eigen::VectorXd discrete =
        gradient_form(space, {1, 1}, {1, 1}) * interpolant(space, u.value);
    EXPECT_LT((form - discrete).cwiseAbs().maxCoeff(), 1e-12) << name;
  }
}

TEST(H1Norm, IsTheNormOfTheReferenceAndItsProducts) {
  for (const NamedSpace& space : two_square_spaces(4, {&p2(), &p4()})) {
    const Eigen::VectorXd u = interpolant(space, product(1).value);
    EXPECT_NEAR(u.dot(h1_gram_matrix(space) * u), 2.0 / 9 + 4.0 / 3, 1e-12)
        << space.name;  // x y on both squares, by hand
    EXPECT_LT((h1_gram_matrix(space) * u - h1_products(space, product(1))).cwiseAbs().maxCoeff(),
              1e-12)
        << space.name;
  }
}

}  // namespace antilock::test::measure_test::errors_test

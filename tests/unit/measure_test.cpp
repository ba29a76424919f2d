// Norms against integrals done by hand; rates, contact zones and energy.
#include "antilock/analysis/accurate_enough.hpp"
#include "antilock/analysis/detail/energy_bracket.hpp"
#include "antilock/analysis/negative_part.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/detail/contact_trace.hpp"
#include "antilock/measure/residual.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::measure_test {

std::vector<const Element*> elements() { return {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart()}; }

/// u = 0.2 + 3 x - 2 y, exactly in every space; layer stress -2 / epsilon^2.
Reference affine(double epsilon) {
  return {[](double x, double y) { return 0.2 + 3 * x - 2 * y; }, [](double, double) { return Eigen::Vector2d(3, -2); },
          [epsilon](double, double) { return -2 / (epsilon * epsilon); }};
}
/// u = x y.
Reference product(double epsilon) {
  return {[](double x, double y) { return x * y; }, [](double x, double y) { return Eigen::Vector2d(y, x); },
          [epsilon](double x, double) { return x / (epsilon * epsilon); }};
}

Solution interpolant(const Space& space, const Reference& reference, double epsilon) {
  Solution s;
  s.u.resize(space.size());
  for (int i = 0; i < space.size(); ++i) s.u(i) = reference.value(space.points()(i, 0), space.points()(i, 1));
  s.p = layer_strain(space).b * s.u / (epsilon * epsilon);
  return s;
}

TEST(Errors, VanishForFunctionsOfTheSpace) {
  constexpr double epsilon = 0.5;
  for (const SpaceOn& space : two_square_spaces(4, elements())) {
    for (const Reference& u : {affine(epsilon), product(epsilon)}) {
      if (space.element().degree() == 1 && u.value(1, 1) == 1) continue;  // x y is quadratic
      const Errors e = measure_errors(space, interpolant(space, u, epsilon), epsilon, u);
      for (const double norm : {e.max, e.max_at_unknowns, e.l2, e.h1, e.energy}) EXPECT_LT(norm, 1e-11) << space.name;
    }
  }
}

TEST(Errors, AreTheNormsOfTheReferenceWhereTheSolutionIsZero) {
  constexpr double epsilon = 0.5;
  for (const SpaceOn& space : two_square_spaces(5, elements())) {
    Solution zero;
    zero.u = Eigen::VectorXd::Zero(space.size());
    zero.p = Eigen::VectorXd::Zero(layer_strain(space).m.size());
    const Errors e = measure_errors(space, zero, epsilon, product(epsilon));
    EXPECT_NEAR(e.max, 1, 1e-11) << space.name;  // at (1, 1) and (1, -1)
    EXPECT_NEAR(e.l2, std::sqrt(2.0 / 9), 1e-11) << space.name;
    EXPECT_NEAR(e.h1, std::sqrt(2.0 / 9 + 4.0 / 3), 1e-11) << space.name;
    // body x^2 + y^2, layer y^2 + epsilon^-2 x^2
    EXPECT_NEAR(e.energy, std::sqrt(2.0 / 3 + 1.0 / 3 + 1 / (3 * epsilon * epsilon)), 1e-11) << space.name;
    EXPECT_LE(e.max_at_unknowns, e.max);
    EXPECT_GT(e.max_at_unknowns, 0.8);
  }
}

TEST(Errors, SeeTheJumpsOfCrouzeixRaviart) {
  // one unknown of 1: at the vertex opposite its edge the function is -1, which no unknown shows
  const SpaceOn space(structured_mesh(4), crouzeix_raviart());
  Solution s;
  s.u = Eigen::VectorXd::Zero(space.size());
  s.p = Eigen::VectorXd::Zero(layer_strain(space).m.size());
  s.u(space.size() / 2) = 1;
  const Reference zero{[](double, double) { return 0.5; }, [](double, double) { return Eigen::Vector2d(0, 0); },
                       [](double, double) { return 0.0; }};
  const Errors e = measure_errors(space, s, 1, zero);
  EXPECT_NEAR(e.max_at_unknowns, 0.5, 1e-14);
  EXPECT_NEAR(e.max, 1.5, 1e-14);
}

TEST(Errors, WithoutLayerTheEnergyNormIsTheGradients) {
  const SpaceOn space(structured_mesh(4, {0}), p1());
  Solution zero;
  zero.u = Eigen::VectorXd::Zero(space.size());
  const Errors e = measure_errors(space, zero, 0, product(1));
  EXPECT_NEAR(e.energy, std::sqrt(2.0 / 3), 1e-12);
  EXPECT_NEAR(e.h1, std::sqrt(2.0 / 3 + 1.0 / 9), 1e-12);
}

TEST(Rates, AreExactForPowersOfH) {
  const std::vector<double> h{0.5, 0.25, 0.1, 0.02};
  std::vector<double> errors;
  errors.reserve(h.size());
  for (const double one : h) errors.push_back(7 * std::pow(one, 1.5));
  const std::vector<double> r = rates(h, errors);
  ASSERT_EQ(r.size(), 3U);
  for (const double rate : r) EXPECT_NEAR(rate, 1.5, 1e-12);
  EXPECT_NEAR(slope(h, errors), 1.5, 1e-12);
}

TEST(Energy, IsHalfTheWorkOfTheLoadWithoutContact) {
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    const SpaceOn space(unstructured_mesh(6), crouzeix_raviart());
    const VariationalInequality problem = assemble(Scene({paper_load}, StiffLayer{epsilon}), space);
    const Solution s = active_set(problem);
    EXPECT_NEAR(energy(problem, s), -0.5 * problem.load.dot(s.u), 1e-9) << epsilon;  // a(u, u) = L(u)
    EXPECT_LT(energy(problem, s), -0.1);
  }
}

TEST(Energy, OfAnAffineFunctionByHand) {
  const SpaceOn space(structured_mesh(4), p1());
  const VariationalInequality problem = assemble(Scene({[](double, double) { return 1.0; }}, StiffLayer{0.5}), space);
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
    const Eigen::VectorXd p2_lengths = contact_lengths(Space(mesh, p2()));
    EXPECT_NEAR(p2_lengths.sum(), 1 - 2.0 / 8 / 6, 1e-12) << name;  // the clamped ends have the rest
  }
}

TEST(ContactZone, TableAndZoneReportTheContact) {
  const TriangleMesh mesh = unstructured_mesh(16);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const auto problem = stiff_problem(space, 1, {[](double x) { return 1e-4 * x; }});
    const Solution s = active_set(problem);
    const ContactZone zone = contact_zone(space, problem, s);
    const Eigen::MatrixX3d table = contact_table(space, problem, s);
    ASSERT_EQ(table.rows(), zone.points);
    int active = 0;
    double from = 2, to = -1;
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      EXPECT_GE(table(i, 1), -1e-12);
      EXPECT_GE(table(i, 2), -1e-12);
      if (i > 0) {
        EXPECT_GT(table(i, 0), table(i - 1, 0));
      }
      EXPECT_NEAR(table(i, 1), s.u(problem.contact[i]) + 1e-4 * table(i, 0), 1e-15);
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
  }
}

TEST(ContactZone, IsEmptyWhereNothingTouches) {
  const SpaceOn space(structured_mesh(4), p1());
  const auto problem = stiff_problem(space, 1, {[](double) { return 10.0; }});
  const ContactZone zone = contact_zone(space, problem, active_set(problem));
  EXPECT_EQ(zone.points, 3);
  EXPECT_EQ(zone.active, 0);
  EXPECT_FALSE(zone.from || zone.to);
}

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
      EXPECT_LE(error, found.error_bound()) << name << epsilon;
      EXPECT_GT(error, 0.5 * found.error_bound()) << name << epsilon;  // tutorial 17: 0.71 to 0.99 of it
    }
  }
}

TEST(EnergyBracket, HoldsItWhereTheLoadIsFarFromConstantOnTriangles) {
  const SineLoad load{{{5, {4.0, -9.0}}, {1, {3.0}}}};  // half a wave on less than two triangles
  const double exact = Truth(load, 1e-2, true, 14).energy();
  for (const int cells : {2, 4, 8})
    for (const auto& [name, mesh] : two_square_meshes(cells)) {
      const EnergyBracket found = energy_bracket(Scene({load}, StiffLayer{1e-2}, UnilateralContact{}), mesh);
      EXPECT_LE(found.lower, exact) << name << cells;
      EXPECT_GE(found.upper, exact) << name << cells;
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
  EXPECT_LE(energy_lower_bound(scene, space, problem, solution), exact);
  EXPECT_NEAR(energy_lower_bound(scene, space, problem, solution), -1.0 / 144 - 4.0 / 288, 1e-15);  // f^2 |T| s_T / 288
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

  const auto lower_bound = [&](const TriangleMesh& on, double value, double noise) {
    const Space space(on, crouzeix_raviart());
    VariationalInequality problem = assemble(scene, space);
    problem.fixed_values.setConstant(value);
    Solution solution = active_set(problem);
    std::vector<char> fixed(space.size(), 0);
    for (const int i : problem.fixed) fixed[i] = 1;
    for (int i = 0; i < space.size(); ++i) solution.u(i) += fixed[i] ? 0 : noise * std::sin(7.0 * i);
    for (Eigen::Index k = 0; k < solution.p.size(); ++k) solution.p(k) += noise * std::cos(5.0 * double(k));
    return energy_lower_bound(scene, space, problem, solution);
  };
  // fixed values of 1 lift u off the obstacle: J(1 + w) = J_0(w) - L(1), L(1) = 0 for this load
  const Scene free({paper_load}, StiffLayer{1e-2});
  const EnergyBracket lifted = energy_bracket(free, fine);
  EXPECT_LE(lower_bound(mesh, 1, 0), lifted.upper);
  EXPECT_NEAR(lower_bound(mesh, 1, 0), lifted.lower, 0.1 * std::abs(lifted.lower));
  double before = lower_bound(mesh, 0, 0);
  EXPECT_LE(before, reference.upper);
  for (const double noise : {1e-3, 1e-2}) {
    EXPECT_LT(lower_bound(mesh, 0, noise), before) << "less is known";
    before = lower_bound(mesh, 0, noise);
  }
}

TEST(EnergyBracket, RefusesWhatItCannotBound) {
  const TriangleMesh mesh = structured_mesh(4), body = structured_mesh(4, {0});
  const Space conforming(mesh, p1()), nonconforming(mesh, crouzeix_raviart()), on_body(body, crouzeix_raviart());
  const auto bound = [](const Scene& scene, const Space& space, const Scene& assembled) {
    const VariationalInequality problem = assemble(assembled, space);
    return energy_lower_bound(scene, space, problem, active_set(problem));
  };
  const Scene stiff = test::stiff_scene(1);
  test::expect_refused([&] { bound(stiff, conforming, stiff); }, "P1");
  test::expect_refused(
      [&] {
        bound(Scene({[](double x, double) { return x; }}, StiffLayer{1}, UnilateralContact{}), nonconforming, stiff);
      },
      "its load above all");
  const Scene ventcel({paper_load}, VentcelLayer{}, UnilateralContact{});
  test::expect_refused([&] { bound(ventcel, on_body, ventcel); }, "Ventcel");
  for (const EnergyBracket& none : {EnergyBracket{-0.99, -1}, EnergyBracket{-1, NAN}})
    test::expect_refused([&] { none.error_bound(); }, "no width");
}

TEST(AccurateEnough, FollowsTheBracket) {
  const EnergyBracket bracket{-1, -0.99};
  const AccurateEnough enough = accurate_enough(bracket, 1, 0.5);
  EXPECT_NEAR(enough.relative, 0.005, 1e-15);  // half of 1 %
  EXPECT_NEAR(enough.energy, 0.005 * 0.005, 1e-18);
  EXPECT_NEAR(accurate_enough(bracket, 2, 0.5).relative, enough.relative / 4, 1e-15) << "h^2";
  for (const EnergyBracket& nothing : {EnergyBracket{0, 0}, EnergyBracket{-0.99, -1}, EnergyBracket{-1, NAN}}) {
    EXPECT_EQ(accurate_enough(nothing).energy, 0);
    EXPECT_EQ(accurate_enough(nothing).relative, 0);
  }
}

// The second difference matrix of n unknowns has the eigenvalues 2 - 2 cos(k pi / (n + 1)).
TEST(Eigenvalues, OfTheSecondDifferenceAreThoseOfTheFormula) {
  constexpr int n = 200;
  SparseMatrix upper(n, n);
  for (int i = 0; i < n; ++i) {
    if (i > 0) upper.insert(i - 1, i) = -1;
    upper.insert(i, i) = 2;
  }
  const auto value = [](int k) { return 2 - 2 * std::cos(k * M_PI / (n + 1)); };
  EXPECT_NEAR(largest_eigenvalue(upper) / value(n), 1, 1e-5);  // the iteration stops at 1e-6
  EXPECT_NEAR(smallest_eigenvalue(upper) / value(1), 1, 1e-5);
}

TEST(ExactResidual, IsTheWorkOfTheContactPressureOnConformingSpaces) {
  constexpr double epsilon = 0.1;
  const Truth truth(paper_sine_load(), epsilon, true, 14);
  const TruthTable table(truth);
  std::vector<double> ends;
  for (const auto& [from, to] : truth.contact_zones()) ends.insert(ends.end(), {from, to});
  for (const SpaceOn& space : two_square_spaces(8, {&p1(), &p2()})) {
    Eigen::VectorXd residual = exact_residual(space, load_vector(space, paper_load), reference(table), ends);
    Eigen::VectorXd work = contact_work(space, [&](double x) { return truth.pressure(x); });
    for (const int i : space.clamped()) residual(i) = work(i) = 0;  // reactions
    // 1e-3: the stress rises like a square root at the end of contact, within one column of triangles
    EXPECT_LT((residual - work).cwiseAbs().maxCoeff(), 1e-3 * work.maxCoeff()) << space.name;
  }
}

TEST(ExactResidual, OfCrouzeixRaviartIsItsFormAtTheInterpolant) {
  // the means over the edges fix the mean gradient (Lemma 2): a(u, v_h) = a(I_h u, v_h) for every v_h
  const Reference u = product(1);
  for (const auto& [name, mesh] : two_square_meshes(4)) {
    const Space space(mesh, crouzeix_raviart());
    const Eigen::VectorXd form = exact_residual(space, Eigen::VectorXd::Zero(space.size()), u, {0.3});
    const Eigen::VectorXd discrete = gradient_form(space, {1, 1}, {1, 1}) * interpolant(space, u.value);
    EXPECT_LT((form - discrete).cwiseAbs().maxCoeff(), 1e-12) << name;
  }
}

TEST(H1Norm, IsTheNormOfTheReferenceAndItsProducts) {
  for (const SpaceOn& space : two_square_spaces(4, {&p2(), &p4()})) {
    const Eigen::VectorXd u = interpolant(space, product(1).value);
    EXPECT_NEAR(u.dot(h1_norm(space) * u), 2.0 / 9 + 4.0 / 3, 1e-12) << space.name;  // x y on both squares, by hand
    EXPECT_LT((h1_norm(space) * u - h1_products(space, product(1))).cwiseAbs().maxCoeff(), 1e-12) << space.name;
  }
}

TEST(ContactTrace, IsTheFunctionOnGammaC) {
  for (const SpaceOn& space : two_square_spaces(4, elements())) {
    const Eigen::MatrixX3d trace = contact_trace(space, interpolant(space, affine(1).value));
    EXPECT_NEAR(trace.col(2).sum(), 1, 1e-12) << space.name;
    const Eigen::ArrayXd exact = 0.2 + 3 * trace.col(0).array() + 2;                  // y = -1
    EXPECT_LT((trace.col(1).array() - exact).abs().maxCoeff(), 1e-11) << space.name;  // gmsh: 1e-12 off
  }
}

/// The samples of an edge (s = (k + 1/2) / 32, values v_k) minus their mean, or minus the chords 0 - 1/2 - 1 of the
/// parabola through three of them.
Eigen::VectorXd hidden(const Eigen::VectorXd& v, bool parabola) {
  if (!parabola) return v.array() - v.mean();
  const auto place = [](int k) { return (k + 0.5) / 32; };
  const auto value = [&](double s) {
    double sum = 0;
    for (const int i : {0, 15, 31}) {
      double phi = 1;
      for (const int j : {0, 15, 31})
        if (j != i) phi *= (s - place(j)) / (place(i) - place(j));
      sum += phi * v(i);
    }
    return sum;
  };
  Eigen::VectorXd rest(32);
  for (int k = 0; k < 32; ++k) {
    const double left = k < 16 ? 0 : 0.5, r = 2 * (place(k) - left);
    rest(k) = v(k) - (1 - r) * value(left) - r * value(left + 0.5);
  }
  return rest;
}

TEST(ContactTrace, TheConstantIsTheLargestHiddenPartOfSampledFunctions) {
  for (const SpaceOn& space : two_square_spaces(3, {&p2(), &crouzeix_raviart()})) {
    std::vector<int> free;
    for (int i = 0; i < space.size(); ++i)
      if (!std::binary_search(space.clamped().begin(), space.clamped().end(), i)) free.push_back(i);
    Eigen::MatrixXd samples(3 * 32, free.size());  // three edges on Gamma_C
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Eigen::MatrixX3d trace = contact_trace(space, Eigen::VectorXd::Unit(space.size(), free[i]));
      for (int e = 0; e < 3; ++e)
        samples.col(i).segment(32 * e, 32) = hidden(trace.col(1).segment(32 * e, 32), &space.element() == &p2())
                                                 .cwiseProduct(trace.col(2).segment(32 * e, 32).cwiseSqrt());
    }
    const Eigen::MatrixXd norm = Eigen::MatrixXd(h1_norm(space))(free, free);
    const double largest = generalised_eigenvalues(test::product(samples.transpose(), samples), norm).maxCoeff();
    const double constant = negative_part(space, stiff_problem(space, 1), h1_norm(space)).constant;
    EXPECT_NEAR(constant / std::sqrt(largest), 1, 5e-3) << space.name;  // midpoint sums: 32^-2
  }
}

TEST(ContactTrace, WhatLiesBelowZeroIsBoundedByTheConstantTimesTheNorm) {
  for (const SpaceOn& space : two_square_spaces(6, {&p1(), &p2(), &crouzeix_raviart()})) {
    const Eigen::SparseMatrix<double> norm = h1_norm(space);
    const double constant = negative_part(space, stiff_problem(space, 1), norm).constant;
    double closest = 0;
    for (int k = 1; k <= 20; ++k) {
      Eigen::VectorXd v(space.size());  // of K_h, otherwise wild
      for (int i = 0; i < space.size(); ++i) v(i) = std::sin(k * 1.7 * i * i + i);
      for (const int i : space.clamped()) v(i) = 0;
      for (const int i : space.contact()) v(i) = std::max(0.0, v(i));
      const Eigen::MatrixX3d trace = contact_trace(space, v);
      const double below = std::sqrt((trace.col(1).array().min(0).square() * trace.col(2).array()).sum());
      EXPECT_LE(below, constant * std::sqrt(v.dot(norm * v))) << space.name;
      if (below > 0) closest = std::max(closest, below / (constant * std::sqrt(v.dot(norm * v))));
    }
    EXPECT_EQ(closest > 0, &space.element() != &p1()) << space.name;  // P1 never; the others do
  }
  const SpaceOn cubic(structured_mesh(2), p3());
  test::expect_refused([&] { negative_part(cubic, stiff_problem(cubic, 1), h1_norm(cubic)); }, "P3");
}

TEST(AccurateEnough, SavesCorrectionsAndNoAccuracy) {
  const auto save = [](const std::string& element_name, const TriangleMesh& mesh, const TriangleMesh& coarse) {
    const Space space(mesh, element(element_name));
    for (const double epsilon : {1e-6, 0.0}) {
      const TruthTable truth(Truth(paper_sine_load(), epsilon, true, 14));
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Solution full = active_set(problem);
      ActiveSetOptions options;
      options.corrections = corrections_until(accurate_enough(energy_bracket(test::stiff_scene(epsilon), coarse), 2));
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

}  // namespace antilock::test::measure_test

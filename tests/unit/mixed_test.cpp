// Means of the rows of B: projected and mixed forms, and what they need under contact.
#include "antilock/analysis/inf_sup.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/nearest.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/problem/projected.hpp"
#include "support/dense.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::mixed_test {

double value(const FactoredForm& form, const Eigen::VectorXd& u) {
  const Eigen::VectorXd bu = form.b * u;
  return bu.dot(form.m.cwiseProduct(bu));
}
Eigen::VectorXd noise(int size) {
  std::mt19937 generator(7);
  Eigen::VectorXd u(size);
  for (double& entry : u) entry = std::uniform_real_distribution(-1.0, 1.0)(generator);
  return u;
}
Shares identity(Eigen::Index rows) {
  Shares shares(rows, rows);
  shares.setIdentity();
  return shares;
}
double slope(const std::vector<double>& values) { return std::log2(values.front() / values.back()); }

// ---- averaged

TEST(Averaged, WithSharesOfOneIsTheFormItself) {
  const SpaceOn space(unstructured_mesh(4), p1());
  const FactoredForm strain = layer_strain(space), same = averaged(strain, identity(strain.m.size()));
  EXPECT_EQ((same.m - strain.m).norm(), 0);
  EXPECT_LT((same.b - strain.b).norm(), 1e-14 * strain.b.norm());
  EXPECT_EQ(same.cell, strain.cell);
}

TEST(Averaged, IsNeverLargerAndKeepsWhatItsMeansSee) {
  const TriangleMesh mesh = unstructured_mesh(8);
  for (const Element* element : {&p1(), &p2(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const FactoredForm strain = layer_strain(space);
    // u = 2 x + 3 y has one strain; u = y^2 has several per mean, so that something is lost
    const Eigen::VectorXd linear = 2 * space.points().col(0) + 3 * space.points().col(1),
                          bent = space.points().col(1).array().square(), any = noise(space.size());
    for (const Shares& shares :
         {box_shares(mesh, strain, 0.25, 0.25), vertex_shares(mesh, strain, strain_rule(*element))}) {
      const FactoredForm mean = averaged(strain, shares);
      EXPECT_NEAR(mean.m.sum(), 1, 1e-12);  // the area of the layer
      EXPECT_NEAR(value(mean, linear), 9, 1e-11);
      EXPECT_LT(value(mean, any), 0.9 * value(strain, any));
      EXPECT_LT(value(mean, bent), value(strain, bent) - 1e-3);
      EXPECT_EQ(mean.cell.size(), static_cast<std::size_t>(mean.m.size()));
    }
  }
}

TEST(Averaged, OfBoxesIsTheProjectionOntoConstantsPerBox) {
  const TriangleMesh mesh = structured_mesh(4);
  const Space space(mesh, p1());
  const FactoredForm strain = layer_strain(space);
  const FactoredForm mean = averaged(strain, box_shares(mesh, strain, 0.5, 0.5));
  ASSERT_EQ(mean.m.size(), 4);
  EXPECT_LT((mean.m.array() - 0.25).abs().maxCoeff(), 1e-14);
  // the mean of d/dy u over a square of the mesh is the difference of its edges; u = y^3 at the vertices
  const Eigen::VectorXd u = space.points().col(1).array().cube(), means = mean.b * u;
  Eigen::VectorXd sorted = means;
  std::sort(sorted.begin(), sorted.end());
  const double upper = std::pow(0.5, 3) / 0.5, lower = (1 - std::pow(0.5, 3)) / 0.5;  // (b^3 - a^3) / (b - a)
  EXPECT_NEAR(sorted(0), upper, 1e-13);
  EXPECT_NEAR(sorted(1), upper, 1e-13);
  EXPECT_NEAR(sorted(2), lower, 1e-13);
  EXPECT_NEAR(sorted(3), lower, 1e-13);
  // columns see the difference of two boundaries alone
  const FactoredForm column = averaged(strain, box_shares(mesh, strain, 0.25, 1));
  ASSERT_EQ(column.m.size(), 4);
  EXPECT_LT(((column.b * u).array() - 1).abs().maxCoeff(), 1e-13);
}

TEST(Averaged, OfHatFunctionsIsTheIntegralAgainstThem) {
  const TriangleMesh mesh = unstructured_mesh(4, Domain{0});
  const Space quadratic(mesh, p2()), bubble(mesh, p1_bubble());
  const auto rows = [&](const Space& space) {
    const VectorSpace both{space, space};
    const FactoredForm div = divergence(both);
    return averaged(div, vertex_shares(mesh, div, divergence_rule(both)));
  };
  Eigen::VectorXd hat = Eigen::VectorXd::Zero(mesh.vertex_count()), against_x = hat;  // int phi_i, int 2 x phi_i
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3i v = mesh.triangles.row(t);
    const Eigen::Vector3d x = mesh.vertices.col(0)(v);
    hat(v).array() += mesh.area(t) / 3;
    against_x(v).array() += 2 * mesh.area(t) / 12 * (x.sum() + x.array());
  }
  Eigen::VectorXd square = Eigen::VectorXd::Zero(2 * quadratic.size());  // u = (x^2, 0)
  square.head(quadratic.size()) = quadratic.points().col(0).array().square();
  const FactoredForm taylor_hood = rows(quadratic), mini = rows(bubble);
  EXPECT_LT((taylor_hood.m - hat).norm(), 1e-14);
  EXPECT_LT((taylor_hood.b * square - against_x.cwiseQuotient(hat)).norm(), 1e-12);
  // int phi_i d/dy b = -int b d/dy phi_i = -9/20 |T| d/dy phi_i: 27 l0 l1 l2 has the mean 27 * 2 / 5!
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::VectorXd column = mini.b.col(bubble.size() + mesh.vertex_count() + t);
    const Eigen::Vector3d expected = -0.45 * mesh.area(t) * barycentric_gradients(mesh, t).col(1);
    for (int i = 0; i < 3; ++i) {
      const int v = mesh.triangles(t, i);
      EXPECT_NEAR(column(v) * hat(v), expected(i), 1e-14);
    }
  }
}

TEST(Averaged, RefusesSharesThatDoNotFit) {
  const TriangleMesh mesh = structured_mesh(2);
  const Space space(mesh, p1()), quadratic(mesh, p2());
  const FactoredForm strain = layer_strain(space);
  const auto rows = strain.m.size();
  Shares half = 0.5 * identity(rows), negative = identity(rows), empty(rows + 1, rows);
  negative.coeffRef(0, 0) = -1;
  for (Eigen::Index r = 0; r < rows; ++r) empty.insert(r, r) = 1;
  expect_refused([&] { averaged(strain, identity(3)); }, "shares of 3 rows");
  expect_refused([&] { averaged(strain, half); }, "sum to 0.5");
  expect_refused([&] { averaged(strain, (1 + 1e-9) * identity(rows)); }, "sum to 1.000000001");
  expect_refused([&] { averaged(strain, negative); }, "share -1 of row 0");
  expect_refused([&] { averaged(strain, empty); }, "has no row of B");
  expect_refused([&] { box_shares(mesh, strain, 0, 1); }, "accepted: positive lengths");
  EXPECT_EQ(box_shares(mesh, strain, 1e-8, 2).rows(), 4) << "a box per place in x of the centroids";
  FactoredForm cut = layer_strain(quadratic), outside = strain;
  cut.cell.pop_back();
  expect_refused([&] { vertex_shares(mesh, cut, strain_rule(p2())); }, "not a point of the rule");
  outside.cell.back() = mesh.triangle_count();
  expect_refused([&] { box_shares(mesh, outside, 1, 1); }, "in cell 16 of a mesh of 16");
  expect_refused([&] { vertex_shares(mesh, strain, strain_rule(p2())); }, "not a point of the rule");
}

// ---- projected

TEST(Projected, WithSharesOfOneIsTheSameProblem) {
  const SpaceOn space(unstructured_mesh(8), p1());
  for (const double epsilon : {0.9, 0.1, 1e-6, 1e-20, 0.0})
    for (const double kept : {0.0, 0.5, 0.9}) {
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Eigen::VectorXd u = active_set(problem).u;
      const Eigen::VectorXd same = active_set(projected(problem, identity(problem.m.size()), kept)).u;
      EXPECT_LT((same - u).lpNorm<Eigen::Infinity>(), 1e-9 * u.lpNorm<Eigen::Infinity>()) << epsilon << " " << kept;
    }
}

TEST(Projected, IsAsCoerciveAsThePartThatIsKept) {
  // (H1): a1 + kept a0 + (1 - kept) a0_h >= kept (a1 + a0). Nothing kept, a zigzag across the layer costs h^2.
  std::vector<double> nothing, half;
  for (const int n : {4, 8, 16}) {
    const TriangleMesh mesh = structured_mesh(n);
    const Space space(mesh, p1());
    const Shares boxes = box_shares(mesh, layer_strain(space), 2.0 / n, 2.0 / n);
    const VariationalInequality problem = stiff_problem(space, 1);
    const SparseMatrix norm = h1_norm(space);
    nothing.push_back(coercivity(projected(problem, boxes), norm));
    half.push_back(coercivity(projected(problem, boxes, 0.5), norm));
    EXPECT_GE(half.back(), 0.5 * coercivity(problem, norm)) << n;
  }
  EXPECT_NEAR(slope(nothing), 4, 0.6);  // two halvings of h
  EXPECT_LT(slope(half), 0.2);
}

TEST(Projected, SurvivesEveryContactAtEveryEpsilon) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const Space space(mesh, p1());
  const Shares boxes = box_shares(mesh, layer_strain(space), 0.125, 0.125);
  for (const double epsilon : {1.0, 1e-2, 1e-6, 1e-20, 0.0}) {
    VariationalInequality problem = stiff_problem(space, epsilon);
    const Eigen::VectorXd load = problem.load;
    const auto solve = [&](double factor, bool one_sign) {
      problem.load = factor * (one_sign ? Eigen::VectorXd(load.cwiseAbs()) : load);
      return active_set(projected(problem, boxes, 0.5));
    };
    const auto touching = [](const Solution& s) { return std::count(s.active.begin(), s.active.end(), true); };
    const Solution lifted = solve(1, true), pressed = solve(-1, true), part = solve(1, false), none = solve(0, false);
    EXPECT_EQ(touching(lifted), 0) << epsilon;
    EXPECT_EQ(touching(pressed), static_cast<long>(problem.contact.size())) << epsilon;
    EXPECT_GT(touching(part), 0) << epsilon;
    EXPECT_LT(touching(part), static_cast<long>(problem.contact.size())) << epsilon;
    EXPECT_EQ(none.u.norm(), 0) << epsilon;  // gap 0 and force 0 everywhere
    // a load 1e12 times as large: the same shape
    EXPECT_LT((solve(1e12, false).u / 1e12 - part.u).norm(), 1e-9 * part.u.norm()) << epsilon;
  }
}

TEST(Projected, ALockedUThatComesDownSlowlyIsFollowed) {
  // Patches leave nothing in K_0h but 0 on the layer, and their rows of B are nearly dependent. A conforming kernel
  // hides no slope; that of v is a force of size 1, so the norm is round-off.
  for (const int cells : {16, 32}) {
    const TriangleMesh mesh = unstructured_mesh(cells);
    const Space space(mesh, p1());
    const FactoredForm strain = layer_strain(space);
    const auto patches = projected(stiff_problem(space, 1), vertex_shares(mesh, strain, strain_rule(p1())), 0.5);
    const auto slope = load_vector(
        space, [](double x, double y) { return std::sin(std::numbers::pi * x) * std::cos(std::numbers::pi * y); },
        Region::layer);
    EXPECT_LT(dual_norm(patches, h1_norm(space), slope, true), 1e-6) << cells;
  }
}

TEST(Projected, RefusesWhatCannotBeKept) {
  EXPECT_EQ(projected_compliance(0.25, 0), 0.25);
  EXPECT_EQ(projected_compliance(1, 0.5), 1);
  EXPECT_EQ(projected_compliance(0, 0.5), 0);
  expect_refused([] { projected_compliance(0.5, 1); }, "kept = 1; accepted");
  expect_refused([] { projected_compliance(0.5, -0.1); }, "kept = -0.1; accepted");
  expect_refused([] { projected_compliance(2, 0.5); }, "compliance 2 with kept = 0.5");
  expect_refused([] { projected_compliance(NAN, 0.5); }, "compliance nan");
}

// ---- mixed methods of rubber

VariationalInequality rubber(const Space& space, bool per_vertex, double epsilon = 0) {
  PlaneStrain scene = platen(epsilon, space.element().conforming() ? 0 : 1);
  scene.continuous_pressure = per_vertex;
  return assemble(scene, {space, space});
}
TriangleMesh block(int cells) { return with_free_sides(structured_mesh(cells, Domain{0})); }

TEST(Mixed, StrainsAndDivergencesAreExact) {
  const TriangleMesh mesh = unstructured_mesh(4, Domain{0});
  for (const Element* element : {&p1(), &p1_bubble(), &p2(), &p3(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const VectorSpace both{space, space};
    const auto field = [&](auto&& of_x, auto&& of_y) {
      Eigen::VectorXd u(both.size());
      for (int i = 0; i < space.size(); ++i) {
        const double x = space.points()(i, 0), y = space.points()(i, 1);
        u(i) = of_x(x, y);
        u(space.size() + i) = of_y(x, y);
      }
      return u;
    };
    const SparseMatrix strains = strain_form(both);
    const FactoredForm div = divergence(both);
    // a turn costs nothing; (2 x, 3 y) has 2 eps:eps = 26 and div = 5
    const Eigen::VectorXd turn = field([](double, double y) { return 1 - y; }, [](double x, double) { return x; }),
                          linear =
                              field([](double x, double) { return 2 * x; }, [](double, double y) { return 3 * y; }),
                          square =
                              field([](double x, double) { return x * x; }, [](double, double y) { return y * y; });
    EXPECT_LT((strains * turn).norm(), 1e-12) << element->name();
    EXPECT_LT(value(div, turn), 1e-20) << element->name();
    EXPECT_NEAR(linear.dot(strains * linear), 26, 1e-11) << element->name();
    EXPECT_NEAR(value(div, linear), 25, 1e-11) << element->name();
    if (element != &p2() && element != &p3()) continue;
    EXPECT_NEAR(square.dot(strains * square), 16.0 / 3, 1e-11) << element->name();  // 2 int 4 x^2 + 4 y^2
    EXPECT_NEAR(value(div, square), 14.0 / 3, 1e-11) << element->name();            // int 4 (x + y)^2
  }
}

TEST(Mixed, AtEpsilonZeroIsTheSaddlePoint) {
  // MINI and Taylor-Hood as they are written down: A1 u + D' p = 0, D u = 0, D = int phi_i div, by a rule of degree 6
  const TriangleMesh mesh = block(3);
  for (const Element* element : {&p1_bubble(), &p2()}) {
    const Space space(mesh, *element);
    const VariationalInequality problem = rubber(space, true);
    const Solution ours = active_set(problem);
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(mesh.vertex_count(), problem.size());
    const Quadrature& rule = triangle_rule(6);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::MatrixXd gradient = element->derivative(rule.points.row(q)) * barycentric_gradients(mesh, t);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < element->unknowns(); ++j)
            for (const int k : {0, 1})
              d(mesh.triangles(t, i), space.unknowns()(t, j) + k * space.size()) +=
                  rule.weights(q) * mesh.area(t) * rule.points(q, i) * gradient(j, k);
      }
    const VariationalInequality held = held_in_contact(problem, ours.active);
    const auto n = problem.size(), m = mesh.vertex_count();
    Eigen::MatrixXd saddle = Eigen::MatrixXd::Zero(n + m, n + m);
    saddle << problem.a1.toDense(), d.transpose(), d, Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
    for (std::size_t i = 0; i < held.fixed.size(); ++i) {
      saddle.row(held.fixed[i]).setZero();
      saddle(held.fixed[i], held.fixed[i]) = 1;
      right(held.fixed[i]) = held.fixed_values(static_cast<Eigen::Index>(i));
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
    const SpaceOn space(block(n), p2());
    error.push_back(std::abs(active_set(rubber(space, true)).lambda.sum() / 0.259166 - 1));
  }
  EXPECT_LT(error.back(), 1e-3);
  EXPECT_GT(slope(error), 3);
}

// ---- the contact set

TEST(HeldInContact, HasTheSameSolution) {
  const TriangleMesh mesh = block(8);
  for (const Element* element : {&p1_bubble(), &crouzeix_raviart()})
    for (const double epsilon : {1.0, 1e-6, 0.0}) {
      const Space space(mesh, *element);
      const VariationalInequality problem = rubber(space, element->conforming(), epsilon);
      const Solution solution = active_set(problem);
      const VariationalInequality held = held_in_contact(problem, solution.active);
      EXPECT_TRUE(held.contact.empty());
      EXPECT_TRUE(std::is_sorted(held.fixed.begin(), held.fixed.end()));
      EXPECT_LT((active_set(held).u - solution.u).lpNorm<Eigen::Infinity>(), 1e-9) << element->name() << epsilon;
    }
}

TEST(HeldInContact, RefusesWhatDoesNotFit) {
  const SpaceOn space(block(4), p2());
  VariationalInequality problem = rubber(space, true);
  expect_refused([&] { held_in_contact(problem, {true}); }, "1 marks; accepted: 9");
  problem.upper = Eigen::VectorXd::Constant(problem.lower.size(), 1);
  expect_refused([&] { held_in_contact(problem, std::vector<bool>(9)); }, "held_in_contact: upper bounds");
}

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
  const auto seminorm = [](const Space& space) { return gradient_form(space, {1, 1}, {1, 1}); };
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
  return inf_sup(multiplier_gram(here, seminorm(space)), multiplier_gram(there, seminorm(all)));
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

}  // namespace antilock::test::mixed_test

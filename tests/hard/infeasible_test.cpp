// Problems that have no solution at epsilon = 0, because K_h and the kernel G_h do not meet, and
// problems close to them: foretold by the hypotheses' check, refused by the solver, never answered.
#include "antilock/analysis/hypotheses.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::infeasible_test {

VariationalInequality beam(ShearIntegration shear) {
  Beam b;
  b.cells = 16;
  b.shear = shear;
  return assemble(b);
}
/// The obstacle lifts the beam by a tenth: with full integration it cannot bend.
VariationalInequality lifted_beam(ShearIntegration shear) {
  VariationalInequality problem = beam(shear);
  problem.bounds.lower.setConstant(0.1);
  return problem;
}
/// The clamps turn both ends the same way, and hold them at one height: theta = w' = 1 cannot be.
VariationalInequality turned_beam() {
  VariationalInequality problem = beam(ShearIntegration::full);
  problem.dirichlet_values(1) = problem.dirichlet_values(3) = 1;
  return problem;
}

VariationalInequality block(const TriangleMesh& mesh, const Element& element) {
  const Space x(mesh, element), y(mesh, element);
  return assemble(test::platen(1e-8, element.conforming() ? 0 : 1), {x, y});
}
VariationalInequality platen(const Element& element) {
  return block(with_free_sides(structured_mesh(6, Domain{0})), element);
}
/// Held all round: what the plate pushes in has nowhere to go.
VariationalInequality confined(const Element& element) {
  return block(structured_mesh(6, Domain{0}), element);
}

/// The obstacle lifts the layer by a tenth; a locked layer stays at 0.
VariationalInequality lifted_layer(const TriangleMesh& mesh, const Element& element) {
  const UnilateralContact contact{[](double x) { return -0.4 * x * (1 - x); }};
  return assemble(Scene(Body{paper_load}, StiffLayer{1e-3}, contact), Space(mesh, element));
}

struct Case {
  std::string name;
  VariationalInequality problem;
  bool feasible;
};
std::vector<Case> cases() {
  return {{"beam, reduced", beam(ShearIntegration::reduced), true},
          {"beam, full", beam(ShearIntegration::full),
           true},  // locked, but at rest it meets everything
          {"lifted beam, reduced", lifted_beam(ShearIntegration::reduced), true},
          {"lifted beam, full", lifted_beam(ShearIntegration::full), false},
          {"turned beam", turned_beam(), false},
          {"platen, P1", platen(p1()), true},
          {"platen, CR", platen(crouzeix_raviart()), true},
          {"confined block, P1", confined(p1()), false},
          {"confined block, CR", confined(crouzeix_raviart()), false},
          {"lifted layer, P1 structured", lifted_layer(structured_mesh(8), p1()), true},
          {"lifted layer, P1 unstructured", lifted_layer(unstructured_mesh(8), p1()), false},
          {"lifted layer, CR unstructured", lifted_layer(unstructured_mesh(8), crouzeix_raviart()),
           true}};
}

TEST(Infeasible, TheDistanceToTheKernelForetellsTheRefusal) {
  for (auto& [name, problem, feasible] : cases()) {
    SCOPED_TRACE(name);
    const double distance = distance_to_kernel(problem);
    // measured: below 1e-8 where they meet, above 1e-3 where they do not
    if (feasible)
      EXPECT_LT(distance, 1e-6);
    else
      EXPECT_GT(distance, 1e-3);
    problem.compliance = 0;
    try {
      const Solution s = active_set(problem);
      EXPECT_TRUE(feasible);
      EXPECT_LT(worst_violation(s.kkt), 1e-8);
    } catch (const NotConverged& refusal) {
      EXPECT_FALSE(feasible) << refusal.what();
      EXPECT_EQ(std::string(refusal.what()).find('\n'),
                std::string::npos);  // one line, which names the cause
      EXPECT_NE(std::string(refusal.what()).find("infeasible"), std::string::npos)
          << refusal.what();
    }
  }
}

TEST(Infeasible, CloseToItTheAnswerIsRightOrRefused) {
  // As epsilon -> 0 the forces of an infeasible problem grow like 1/epsilon: epsilon times the
  // force tends to a limit.
  for (auto& [name, problem, feasible] : cases()) {
    if (feasible) continue;
    problem.compliance = 1e-8;
    const double limit = 1e-8 * active_set(problem).p.lpNorm<Eigen::Infinity>();
    int answers = 0;
    for (const double epsilon : {1e-9, 1e-10, 1e-11, 1e-12}) {
      SCOPED_TRACE(name + ", epsilon " + std::to_string(std::log10(epsilon)));
      problem.compliance = epsilon;
      try {
        const Solution s = active_set(problem);
        ++answers;
        EXPECT_LT(worst_violation(s.kkt), 1e-6);
        EXPECT_NEAR(epsilon * s.p.lpNorm<Eigen::Infinity>() / limit, 1,
                    0.01);  // measured: 0.0025 at most
      } catch (const NotConverged& refusal) {
        EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos);
      }
    }
    EXPECT_GE(answers, 1) << name;
  }
}

/// Gram matrix of the broken H1 seminorm, for a displacement: a norm, since something is clamped.
SparseMatrix gradients(const Space& space) { return gradient_form(space, {1, 1}, {1, 1}); }

TEST(Hypotheses, HoldWhereTheTheorySaysSo) {
  const TriangleMesh mesh = unstructured_mesh(6);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const Hypotheses h = check_hypotheses(test::stiff_problem(space, 1e-6), gradients(space));
    EXPECT_NEAR(h.coercivity, 1, 1e-9) << element->name();  // a1 + a0 is the gradient form itself
    int body = 0;  // unknowns that a0 does not see: the kernel's, always
    for (int i = 0; i < space.size(); ++i) body += space.dof_coordinates()(i, 1) > 0;
    for (const int i : space.dirichlet_dofs()) body -= space.dof_coordinates()(i, 1) > 0;
    if (element == &p1())
      EXPECT_EQ(h.kernel, body);
    else
      EXPECT_GT(h.kernel, body + mesh.triangle_count() /
                                     8);  // half the layer's triangles, as measured elsewhere
    EXPECT_EQ(h.free, space.free_count());
    EXPECT_TRUE(h.coercive() && h.intersects_kernel());
  }
}

TEST(Hypotheses, APieceThatIsHeldByNothingIsNotCoercive) {
  // Crouzeix-Raviart with the symmetric gradient and no jumps: triangles that turn
  const TriangleMesh mesh = with_free_sides(structured_mesh(4, Domain{0}));
  const Space x(mesh, crouzeix_raviart()), y(mesh, crouzeix_raviart());
  SparseMatrix norm(x.size() + y.size(), x.size() + y.size());
  norm.setIdentity();
  for (const double weight : {0.0, 1.0}) {
    const Hypotheses h = check_hypotheses(assemble(test::platen(1e-8, weight), {x, y}), norm);
    EXPECT_EQ(h.coercive(), weight > 0);
    EXPECT_EQ(std::isnan(h.distance), weight == 0);
  }
}

}  // namespace antilock::test::infeasible_test

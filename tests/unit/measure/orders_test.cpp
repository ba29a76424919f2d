// How fast, and how accurate: slopes against manufactured solutions, the accuracy table against the
// truth.
#include "antilock/exact/exact_table.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"
#include "support/manufactured.hpp"
#include "support/scenes.hpp"

namespace antilock::test::measure_test::orders_test {

/// The order in H1, and what the errors on 1/h = 64 must stay below, relative to b + c, the size of
/// the second derivatives of the exact solution: 10 to 20 % above what was measured over the cases
/// below.
struct Caps {
  double max, l2, gradient;
  int order = 1;
};
Caps caps(const Element& element) {
  if (&element == &p1()) return {2.6e-4, 1.1e-4, 1.9e-2};
  if (&element == &p2()) return {1.2e-6, 2.7e-7, 1.5e-4, 2};
  if (&element == &crouzeix_raviart()) return {5.0e-4, 6.5e-5, 1.7e-2};
  if (&element == &hybrid_bdm1()) return {2.0e-6, 2.1e-7, 1.15e-4, 2};
  return {infinity, infinity, infinity, &element == &p3() ? 3 : 4};
}

/// Solves without contact on 1/h = 8 ... 64: slopes within 0.1 of (k + 1, k + 1, k, k) over the
/// last three meshes, and the last error below its cap. Degrees 3 and 4 on 1/h = 4, 8, 16 within
/// 0.2: finer meshes come near the floor of the solver, 1e-10.
void check_convergence(const Layer& layer, const Manufactured& exact, const Element& element,
                       bool structured) {
  std::vector<double> h, max, l2, h1, energy;
  const Caps cap = caps(element);
  const int k = cap.order;
  for (const int cells : k > 2 ? std::vector{4, 8, 16} : std::vector{8, 16, 32, 64}) {
    const Domain domain{std::holds_alternative<StiffLayer>(layer) ? 1.0 : 0.0};
    const Space space(
        structured ? structured_mesh(cells, domain) : unstructured_mesh(cells, domain), element);
    const Solution s = active_set(assemble(Scene({exact.load()}, layer), space));
    const Errors e = measure_errors(space, s, exact.epsilon, exact.reference());
    h.push_back(1.0 / cells);
    max.push_back(e.max);
    l2.push_back(e.l2);
    h1.push_back(e.h1);
    energy.push_back(e.energy);
  }
  const auto last_three = [&](const std::vector<double>& e) {
    return slope({h.end() - 3, h.end()}, {e.end() - 3, e.end()});
  };
  const std::string where = element.name() + (structured ? " structured" : " unstructured");
  const double within = k > 2 ? 0.2 : 0.1;
  // the maximum feels single triangles of an unstructured mesh: there its slope is looser
  EXPECT_NEAR(last_three(max), k + 1, structured ? within : 0.35) << where << " maximum";
  EXPECT_NEAR(last_three(l2), k + 1, within) << where << " L2";
  EXPECT_NEAR(last_three(h1), k, within) << where << " H1";
  EXPECT_NEAR(last_three(energy), k, within) << where << " energy";
  const double size = exact.b + exact.c;
  EXPECT_LT(max.back(), cap.max * size) << where << " maximum";
  EXPECT_LT(l2.back(), cap.l2 * size) << where << " L2";
  EXPECT_LT(h1.back(), cap.gradient * size) << where << " H1";
  EXPECT_LT(energy.back(), cap.gradient * size) << where << " energy";
}

TEST(Convergence, HasTheOrderOfTheDegreeWhereTheLayerIsNotStiff) {
  for (const auto& [layer, exact] :
       {std::pair<Layer, Manufactured>{NoLayer{}, Manufactured::no_layer()},
        {StiffLayer{1}, Manufactured::stiff_layer(1)},
        {VentcelLayer{}, Manufactured::ventcel()}})
    for (const Element* element : {&p1(), &crouzeix_raviart(), &p2(), &hybrid_bdm1()})
      for (const bool structured : {true, false})
        if (element->degree() == 1 || !std::holds_alternative<VentcelLayer>(layer))
          check_convergence(layer, exact, *element, structured);
}

TEST(Convergence, HasTheOrderOfTheDegreeAtEveryEpsilonWhereNothingLocks) {
  for (const double epsilon : {1e-2, 1e-6, 0.0}) {
    const auto check = [&](const Element& element, bool structured) {
      check_convergence(StiffLayer{epsilon}, Manufactured::stiff_layer(epsilon), element,
                        structured);
    };
    check(p1(), true);
    check(crouzeix_raviart(), true);
    check(crouzeix_raviart(), false);
    check(hybrid_bdm1(), true);
    check(hybrid_bdm1(), false);
  }
  for (const double epsilon : {1.0, 1e-2})
    for (const Element* element : {&p3(), &p4()})
      check_convergence(StiffLayer{epsilon}, Manufactured::stiff_layer(epsilon), *element, true);
}

using Meshes = std::vector<TriangleMesh>;
/// Max-norm errors at the unknowns on 1/h = 16, 32, ..., and where the contact starts on the
/// finest.
struct Study {
  std::vector<double> h, errors;
  double contact_from = 0;
};
Study study(const Meshes& meshes, const Element& element, double epsilon,
            const ExactSolution& exact_solution) {
  const ExactTable table(exact_solution);
  Study study;
  double h = 1.0 / 16;
  for (const TriangleMesh& mesh : meshes) {
    const Space space(mesh, element);
    const VariationalInequality problem = stiff_problem(space, epsilon);
    const Solution s = active_set(problem);
    double error = 0;
    for (int i = 0; i < space.size(); ++i)
      error = std::max(error, std::abs(s.u(i) - table.value(space.dof_coordinates()(i, 0),
                                                            space.dof_coordinates()(i, 1))));
    study.h.push_back(h);
    study.errors.push_back(error);
    study.contact_from = contact_zone({space, problem, s}).from.value_or(-1);
    h /= 2;
  }
  return study;
}

/// The truth against which tables are made; 2^14 points: 1e-7 and better, errors here are 1e-5 and
/// more.
ExactSolution exact_solution(double epsilon) {
  return ExactSolution(paper_sine_load(), epsilon, true, 14);
}

TEST(AccuracyTable, StructuredMeshes) {
  // errors measured by a first program that shares no line with this library, two or three digits
  // (1 %); diagonal / as in Figure 3
  Meshes meshes;
  for (const int cells : {16, 32, 64, 128}) meshes.push_back(structured_mesh(cells));
  struct Row {
    double epsilon;
    const Element* element;
    double at_16, at_64, rate, rate_within;
  };
  for (const Row& row :
       {Row{1e-2, &p1(), 1.26e-3, 7.97e-5, 2, 0.2}, Row{1e-6, &p1(), 1.26e-3, 7.99e-5, 2, 0.2},
        Row{1e-2, &crouzeix_raviart(), 3.56e-3, 2.81e-4, 1.85, 0.15},
        Row{1e-6, &crouzeix_raviart(), 3.56e-3, 2.81e-4, 1.85, 0.15}}) {
    const Study s = study(meshes, *row.element, row.epsilon, exact_solution(row.epsilon));
    const std::string where = row.element->name() + ", epsilon " + std::to_string(row.epsilon);
    EXPECT_NEAR(s.errors[0] / row.at_16, 1, 0.01) << where;
    EXPECT_NEAR(s.errors[2] / row.at_64, 1, 0.01) << where;
    EXPECT_NEAR(slope(s.h, s.errors), row.rate, row.rate_within) << where;
    if (row.epsilon == 1e-6) {
      EXPECT_NEAR(s.contact_from, 0.7020, 1.0 / 128) << where;
    }
  }
}

TEST(AccuracyTable, UnstructuredMeshes) {
  // measured likewise, on another mesh of the same size, so "about"
  Meshes meshes;
  for (const int cells : {16, 32, 64, 128}) meshes.push_back(unstructured_mesh(cells));
  for (const double epsilon : {1e-2, 1e-6}) {
    const Study cr = study(meshes, crouzeix_raviart(), epsilon, exact_solution(epsilon));
    EXPECT_NEAR(cr.errors[0] / 2.65e-3, 1, 0.4) << epsilon;
    EXPECT_NEAR(cr.errors[2] / 5.06e-4, 1, 0.4) << epsilon;
    EXPECT_GT(slope(cr.h, cr.errors), 1.2) << epsilon;
    // where contact begins the gap opens from zero slope: a nonconforming gap may close an edge too
    // early
    EXPECT_NEAR(cr.contact_from, epsilon == 1e-6 ? 0.7020 : 0.69753, 2.0 / 128) << epsilon;
  }
  const Study locked = study(meshes, p1(), 1e-6, exact_solution(1e-6));
  EXPECT_NEAR(locked.errors[0] / 4.57e-2, 1, 0.01);
  EXPECT_NEAR(locked.errors[2] / 4.57e-2, 1, 0.01);
  EXPECT_NEAR(slope(locked.h, locked.errors), 0, 0.1);
  meshes.pop_back();
  const Study locking = study(meshes, p1(), 1e-2, exact_solution(1e-2));
  EXPECT_NEAR(locking.errors[0] / 3.84e-2, 1, 0.1);
  EXPECT_NEAR(locking.errors[2] / 3.25e-3, 1, 0.4);  // the mesh resolves epsilon = 1e-2 at last
}

}  // namespace antilock::test::measure_test::orders_test

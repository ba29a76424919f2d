// Inf-sup constants under contact.
#include "antilock/analysis/inf_sup.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/project_strain.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/space/space.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "unit/analysis/helpers.hpp"

namespace antilock::test::analysis_test::inf_sup_test {

/// On 4, 8 and 12 cells a side, with the contact set of the solution held or without.
std::vector<double> inf_sup_constants(const Element& element, bool per_vertex, bool contact) {
  std::vector<double> beta;
  for (const int n : {4, 8, 12}) {
    const Space space(block(n), element);
    const VariationalInequality problem = rubber(space, per_vertex);
    std::vector<bool> active(problem.bounds.unknowns.size());
    if (contact) active = active_set(problem).active;
    const VariationalInequality held = equality_constrained(problem, active);
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
      EXPECT_LE(held[i], free[i] * (1 + 1e-10))
          << element->name();  // a supremum over fewer functions
      EXPECT_GT(held[i], 0.9 * free[i]) << element->name();
    }
  }
}

TEST(InfSupUnderContact, FallsForP1) {
  const std::vector<double> free = inf_sup_constants(p1(), false, false),
                            held = inf_sup_constants(p1(), false, true);
  EXPECT_NEAR(free[0] / free[2], 3, 0.5);  // like h
  EXPECT_LT(held[2], 0.75 * free[2]);      // contact takes from what was little
  for (const double beta : inf_sup_constants(p1(), true, true))
    EXPECT_EQ(beta, 0);  // a pressure that nobody sees
}

/// The marks of a finer mesh: what lies on an edge of Gamma_C both ends of which are held, or on a
/// held vertex.
std::vector<bool> refined_marks(const Space& coarse, const std::vector<bool>& active,
                                const Space& fine) {
  std::map<double, bool> held{{0, true}, {1, true}};  // the corners are clamped
  for (std::size_t i = 0; i < active.size(); ++i)
    held[coarse.dof_coordinates()(coarse.contact_dofs()[i], 0)] = active[i];
  std::vector<bool> marks;
  for (const int i : fine.contact_dofs()) {
    const auto right = held.lower_bound(fine.dof_coordinates()(i, 0) - 1e-9);
    const bool vertex = std::abs(right->first - fine.dof_coordinates()(i, 0)) < 1e-9;
    marks.push_back(right->second && (vertex || std::prev(right)->second));
  }
  return marks;
}

/// (23), P1 with means over boxes of side 2h, in the dual norm of the theory: that of P1 on the
/// mesh refined twice, with the same contact held. A box holds the 16 parts of each of its
/// triangles.
double inf_sup_of_boxes(const TriangleMesh& mesh, int n, bool contact) {
  const TriangleMesh fine = refined(refined(mesh));
  const Space space(mesh, p1()), all(fine, p1());
  const VariationalInequality problem = stiff_problem(space, 0);
  const StrainProjection boxes = box_projection(mesh, layer_strain(space), 2.0 / n, 2.0 / n);
  std::vector<Eigen::Triplet<double>> parts;
  for (Eigen::Index g = 0; g < boxes.rows(); ++g)
    for (StrainProjection::InnerIterator share(boxes, g); share; ++share)
      for (int k = 0; k < 16; ++k)
        parts.emplace_back(static_cast<int>(g), 16 * static_cast<int>(share.col()) + k,
                           share.value());
  StrainProjection of_all(boxes.rows(), 16 * boxes.cols());
  of_all.setFromTriplets(parts.begin(), parts.end());
  std::vector<bool> held(problem.bounds.unknowns.size());
  if (contact) held = active_set(project_strain(problem, boxes, 0.5)).active;
  const VariationalInequality here = equality_constrained(project_strain(problem, boxes), held),
                              there = equality_constrained(
                                  project_strain(stiff_problem(all, 0), of_all),
                                  refined_marks(space, held, all));
  return inf_sup(multiplier_gram(here, h1_seminorm(space)),
                 multiplier_gram(there, h1_seminorm(all)));
}

TEST(InfSupUnderContact, OfBoxesStaysOnColumnsAndFallsOffThem) {
  for (const bool contact : {false, true}) {
    // measured: 0.73, 0.73, 0.73 and 0.73, 0.68, 0.73
    for (const int n : {4, 8, 16})
      EXPECT_GT(inf_sup_of_boxes(structured_mesh(n), n, contact), 0.6) << n << contact;
    // 0.67, 0.45 and 0.59, 0.40 (at 1/32: 0.26, 0.21): functions of x that change within a box
    // still lock
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
    const VariationalInequality held =
        equality_constrained(problem, std::vector<bool>(problem.bounds.unknowns.size(), true));
    EXPECT_EQ(inf_sup(multiplier_gram(held, held.a1), Eigen::MatrixXd(held.m.asDiagonal())), 0)
        << element->name();
    // pushed by .1 into a groove of .083: no motion keeps the volume
    EXPECT_THROW(active_set(problem), NotConverged) << element->name();
    problem.compliance = 1e-8;
    EXPECT_GT(active_set(problem).lambda.sum(), 1e5) << element->name();
  }
}

using std::numbers::pi;

}  // namespace antilock::test::analysis_test::inf_sup_test

// The symmetric interior penalty form: its sum of squares is compared with the sum over edges.
#include "antilock/form/interior_penalty.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/space.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::form_test::interior_penalty_test {

/// Row vectors of all unknowns: the values of u on one side of an edge, and its constant gradient
/// there.
struct Side {
  int triangle;
  double weight;
  Eigen::MatrixXd gradient;  // 2 x N

  Eigen::RowVectorXd value(const Space& space, const Eigen::Vector2d& x) const {
    const TriangleMesh& mesh = space.mesh();
    // lambda_i(x) = 1/3 + grad lambda_i . (x - centroid)
    const Eigen::Vector2d off = x - point_in(mesh, triangle, Eigen::Vector3d::Constant(1.0 / 3));
    const Eigen::Vector3d lambda = (barycentric_gradients(mesh, triangle) * off).array() + 1.0 / 3;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(space.size());
    const Eigen::VectorXd basis = space.element().basis(lambda);
    for (int i = 0; i < 3; ++i) row(space.cell_dofs()(triangle, i)) = basis(i);
    return row;
  }
};

Side side(const Space& space, int triangle, double weight) {
  Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(2, space.size());
  const Eigen::MatrixX2d local = space.element().derivative(Eigen::Vector3d::Constant(1.0 / 3)) *
                                 barycentric_gradients(space.mesh(), triangle);
  for (int i = 0; i < 3; ++i)
    gradient.col(space.cell_dofs()(triangle, i)) = local.row(i).transpose();
  return {triangle, weight, gradient};
}

/// Returns the weighted sides of an edge for the form of one region, none if the edge does not
/// belong to it.
std::vector<Side> sides(const Space& space, Region region, int e) {
  const TriangleMesh& mesh = space.mesh();
  const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
  if (mesh.edge_tag[e] == EdgeTag::clamped && mesh.region[a] == region) return {side(space, a, 1)};
  if (b < 0) return {};
  if (mesh.edge_tag[e] != EdgeTag::sigma)
    return mesh.region[a] == region ? std::vector{side(space, a, 0.5), side(space, b, 0.5)}
                                    : std::vector<Side>{};
  if (region == Region::layer) return {};
  const bool body_first = mesh.region[a] == Region::body;
  return {side(space, body_first ? a : b, 1), side(space, body_first ? b : a, 0)};
}

/// Returns the form as a sum over edges, as in Arnold, Brezzi, Cockburn and Marini (2002).
Eigen::MatrixXd textbook_form(const Space& space, Region region, int axis, double gamma,
                              PenalisedJump penalised) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(space.size(), space.size());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == region) {
      const Eigen::RowVectorXd slope = side(space, t, 1).gradient.row(axis);
      form += mesh.area(t) * slope.transpose() * slope;
    }
  const auto [points, weights] = gauss_rule(penalised == PenalisedJump::whole ? 2 : 1);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const std::vector<Side> both = sides(space, region, e);
    if (both.empty()) continue;
    const Eigen::Vector2d from = mesh.vertices.row(mesh.edges(e, 0)),
                          to = mesh.vertices.row(mesh.edges(e, 1));
    const double length = (to - from).norm();
    Eigen::Vector2d normal(to(1) - from(1), from(0) - to(0));
    normal /= length;
    const Eigen::Vector2d centroid =
        point_in(mesh, both[0].triangle, Eigen::Vector3d::Constant(1.0 / 3));
    if (normal.dot(from - centroid) < 0) normal = -normal;  // from the first side to the second
    double eta = 0;
    Eigen::RowVectorXd flux = Eigen::RowVectorXd::Zero(space.size());
    for (const Side& one : both) {
      eta += gamma * 3 * one.weight * one.weight * length / mesh.area(one.triangle);
      flux += one.weight * normal(axis) * one.gradient.row(axis);
    }
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const Eigen::Vector2d x = from + points(q) * (to - from);
      Eigen::RowVectorXd jump = both[0].value(space, x);
      if (both.size() == 2) jump -= both[1].value(space, x);
      const double weight = length * weights(q);
      form -= weight * (flux.transpose() * jump + jump.transpose() * flux);
      form += weight * eta * normal(axis) * normal(axis) * jump.transpose() * jump;
    }
  }
  return form;
}

// Entries are sums of some ten products of numbers up to 1/h, gamma/h. Relative to the largest
// entry 1e-13 is their round-off.
TEST(InteriorPenalty, IsTheFormOfTheTextbookAsASumOfSquares) {
  for (const auto& [name, mesh] : two_square_meshes(3))
    for (const PenalisedJump penalised : {PenalisedJump::whole, PenalisedJump::mean})
      for (const Region region : {Region::body, Region::layer})
        for (const int axis : {0, 1}) {
          const Space space(mesh, discontinuous_p1());
          const FactoredForm form = interior_penalty_form(space, region, axis, {2.5, penalised});
          const Eigen::MatrixXd expected = textbook_form(space, region, axis, 2.5, penalised);
          EXPECT_LT((gram(form.b, form.m) - expected).cwiseAbs().maxCoeff(),
                    1e-13 * expected.cwiseAbs().maxCoeff())
              << name << " axis " << axis;
          EXPECT_GT(form.m.minCoeff(), 0);
        }
}

TEST(InteriorPenalty, HasOneSlopePerTriangleFirst) {
  const Space space(unstructured_mesh(4), discontinuous_p1());
  const TriangleMesh& mesh = space.mesh();
  const FactoredForm form = interior_penalty_form(space, Region::layer, 1, {});
  const Eigen::VectorXd affine =
      2 * space.dof_coordinates().col(0) + 3 * space.dof_coordinates().col(1);
  const Eigen::VectorXd slopes = form.b * affine;
  Eigen::Index row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    EXPECT_EQ(form.cell[row], t);
    EXPECT_EQ(form.m(row), mesh.area(t));
    EXPECT_NEAR(slopes(row++), 3,
                1e-12);  // a continuous function does not jump; the sides are vertical
  }
  EXPECT_LT(slopes.tail(slopes.size() - row).cwiseAbs().maxCoeff(), 1e-11);
}

// The reason for the limit of gamma: above 1 no eigenvalue is negative, and with hardly any penalty
// one is.
TEST(InteriorPenalty, IsNotPositiveWithoutEnoughPenalty) {
  const Space space(unstructured_mesh(3), discontinuous_p1());
  const auto smallest = [&](double gamma) {
    const Eigen::MatrixXd form = textbook_form(space, Region::layer, 1, gamma, PenalisedJump::mean);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(form).eigenvalues()(0) /
           form.cwiseAbs().maxCoeff();
  };
  EXPECT_GT(smallest(1.001), -1e-13);  // round-off
  EXPECT_LT(smallest(0.05), -1e-2);
}

TEST(InteriorPenalty, RefusesOtherElementsAndTooSmallAPenaltyInOneLine) {
  const TriangleMesh mesh = structured_mesh(3);
  for (const Element* element : {&p1(), &crouzeix_raviart(), &p1_bubble()})
    expect_refused([&] { interior_penalty_form(Space(mesh, *element), Region::layer, 1, {}); },
                   "P1dc");
  const Space space(mesh, discontinuous_p1());
  for (const double gamma : {1.0, 0.5, 0.0, -2.0, nan, infinity}) {
    const auto act = [&] { interior_penalty_form(space, Region::layer, 1, {gamma}); };
    EXPECT_THROW(act(), NotConverged) << gamma;
    expect_refused(act, "accepted: more than 1");
  }
}

}  // namespace antilock::test::form_test::interior_penalty_test

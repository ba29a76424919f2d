// The obstacle problem on a square whose solution is radial, as in PETSc's example
// src/snes/tutorials/ex9.c: a membrane on (-2, 2)^2 over the upper half of the unit ball.
#include "antilock/form/gradient_forms.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "support/scenes.hpp"

namespace antilock::test::obstacle_on_a_square_test {

/// The radius of contact: the root of a^2 (log 2 - log a) = 1 - a^2.
constexpr double contact_radius = 0.697965148223374;

/// The half ball, continued by its tangent cone from r = 0.9 on, where the membrane is free.
double obstacle(double r) {
  constexpr double end = 0.9;
  if (r <= end) return std::sqrt(1 - r * r);
  const double height = std::sqrt(1 - end * end);
  return height - end / height * (r - end);
}

/// The slope of the solution is -slope / r outside of contact.
double slope() {
  return contact_radius * contact_radius / std::sqrt(1 - contact_radius * contact_radius);
}

double exact(double r) {
  return r <= contact_radius ? obstacle(r) : slope() * (std::log(2) - std::log(r));
}

Space square_space(int cells) {
  TriangleMesh mesh = structured_mesh(cells, Domain{0});
  mesh.vertices = (4 * mesh.vertices.array() - 2).matrix();
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0) mesh.edge_tag[e] = EdgeTag::clamped;
  return Space(std::move(mesh), p1());
}

VariationalInequality membrane(const Space& space) {
  VariationalInequality problem;
  problem.a1 = gradient_form(space, Stiffness{}, Stiffness{});
  problem.b.resize(0, space.size());
  problem.load = Eigen::VectorXd::Zero(space.size());
  const Eigen::VectorXd r = space.dof_coordinates().rowwise().norm();
  std::map<int, double> rim;
  for (const int i : space.dirichlet_dofs()) rim[i] = exact(r(i));
  set_dirichlet(problem, rim);
  std::vector<int> inside;
  for (int i = 0; i < space.size(); ++i)
    if (!rim.contains(i)) inside.push_back(i);
  const Eigen::VectorXd lower = r(inside).unaryExpr([](double x) { return obstacle(x); });
  problem.bounds = Bounds::lower_on(inside, lower);
  return problem;
}

TEST(ObstacleOnASquare, HasTheRadialSolution) {
  // P1 on this mesh is the five-point star. The numbers are those of another program, which solves
  // it by an active set in numpy: largest error at the vertices, and sum of the forces.
  const struct {
    int cells;
    double error, force;
  } known[] = {{16, 0.014281817707, 4.215229087417}, {32, 0.005746855748, 4.257014788588}};
  for (const auto& [cells, error, force] : known) {
    const Space space = square_space(cells);
    const VariationalInequality problem = membrane(space);
    const Solution s = active_set(problem);
    const Eigen::VectorXd r = space.dof_coordinates().rowwise().norm();
    double largest = 0, radius = 0;
    for (int i = 0; i < space.size(); ++i)
      largest = std::max(largest, std::abs(s.u(i) - exact(r(i))));
    for (std::size_t c = 0; c < problem.bounds.unknowns.size(); ++c)
      if (s.active[c]) radius = std::max(radius, r(problem.bounds.unknowns[c]));
    // the tolerance of the solve is 1e-10
    EXPECT_NEAR(largest, error, 1e-8) << cells;
    EXPECT_NEAR(s.lambda.sum(), force, 1e-7) << cells;
    EXPECT_NEAR(radius, contact_radius, std::sqrt(2) * 4 / cells) << cells;  // a diagonal
    // 2 pi r |u'| on a circle around the contact; 1.4 % and 0.4 % on these meshes
    const double total = 2 * std::numbers::pi * slope();
    EXPECT_NEAR(s.lambda.sum(), total, 5.0 / (cells * cells) * total);
  }
}

}  // namespace antilock::test::obstacle_on_a_square_test

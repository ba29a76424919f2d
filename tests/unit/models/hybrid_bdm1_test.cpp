// The problems of hybrid_bdm1: a second program from the definition, patch tests, kernel,
// coercivity, refusals.
#include <Eigen/Dense>

#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/negative_part.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/problem/bounds.hpp"
#include "support/brute_force.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::hybrid_bdm1_test {

const std::vector<std::string> families{"structured", "columns", "jittered", "rows", "delaunay"};

/// Lifts the left part of the layer. For small epsilon it presses the right part on the obstacle.
double quadratic_load(double x, double y) { return 10 - 20 * x + 2 * y * y + 4 * x * y; }

/// The same problem from the definition, dense: G follows from 3 x 3 systems and not from a
/// formula, and the basis from a 7 x 7 system. Unknown 2 e + i is the mean on edge e with the hat
/// function of its vertex i, 2 E + t that of triangle t.
struct DenseProgram {
  Eigen::MatrixXd a1, b;
  Eigen::VectorXd load;

  explicit DenseProgram(const TriangleMesh& mesh) {
    const int means = 2 * mesh.edge_count(), size = means + mesh.triangle_count();
    a1 = Eigen::MatrixXd::Zero(size, size);
    b = Eigen::MatrixXd::Zero(3 * std::count(mesh.region.begin(), mesh.region.end(), Region::layer),
                              size);
    load = Eigen::VectorXd::Zero(size);
    Eigen::Index row = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      Eigen::Matrix<double, 3, 2> at;
      for (int i = 0; i < 3; ++i) at.row(i) = mesh.vertices.row(mesh.triangles(t, i));
      const Eigen::RowVector2d centroid = at.colwise().mean();
      Eigen::Matrix3d q;  // at vertex i the functions 1, x, y about the centroid
      for (int i = 0; i < 3; ++i) q.row(i) << 1, at.row(i) - centroid;
      Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
      for (int j = 0; j < 3; ++j) {
        const Eigen::RowVector3d middle = 0.5 * (q.row((j + 1) % 3) + q.row((j + 2) % 3));
        gram += mesh.area(t) / 3 * middle.transpose() * middle;
      }
      std::array<Eigen::Matrix<double, 3, 7>, 2> right;  // (P): per component of q
      std::array<int, 7> unknown{};
      for (auto& component : right) component.setZero();
      for (int j = 0; j < 3; ++j) {
        const int from = (j + 1) % 3, to = (j + 2) % 3, e = mesh.triangle_edges(t, j);
        const Eigen::RowVector2d along = at.row(to) - at.row(from), normal(along(1), -along(0));
        for (const auto& [local, end] : {std::pair{2 * j, from}, {2 * j + 1, to}}) {
          unknown[local] = 2 * e + (mesh.edges(e, 0) == mesh.triangles(t, end) ? 0 : 1);
          // int v_j q over the edge: each mean meets the value of the affine q at its own end
          for (int d = 0; d < 2; ++d)
            right[d].col(local) += 0.5 * normal(d) * q.row(end).transpose();
        }
      }
      unknown[6] = means + t;
      for (int d = 0; d < 2; ++d) right[d](d + 1, 6) -= mesh.area(t);
      const bool layer = mesh.region[t] == Region::layer;
      for (int d = 0; d < 2; ++d) {
        const Eigen::Matrix<double, 3, 7> g = gram.ldlt().solve(right[d]);
        const Eigen::Matrix<double, 7, 7> energy = g.transpose() * gram * g;
        const Eigen::Matrix<double, 3, 7> rows = gram.llt().matrixU() * g;
        for (int i = 0; i < 7; ++i) {
          for (int k = 0; k < 7 && !(layer && d == 1); ++k)
            a1(unknown[i], unknown[k]) += energy(i, k);
          for (int k = 0; k < 3 && layer && d == 1; ++k) b(row + k, unknown[i]) = rows(k, i);
        }
      }
      if (layer) row += 3;
      if (!layer) add_load(mesh, t, unknown);
    }
  }

 private:
  static Eigen::Matrix<double, 1, 7> functions(const Eigen::Vector3d& l) {
    Eigen::Matrix<double, 1, 7> values;
    values << 1, l(0), l(1), l(0) * l(0), l(0) * l(1), l(1) * l(1),
        (l(0) - l(1)) * (l(1) - l(2)) * (l(2) - l(0));
    return values;
  }

  void add_load(const TriangleMesh& mesh, int t, const std::array<int, 7>& unknown) {
    const auto [s, weights] = gauss_rule(6);
    const Quadrature& rule = triangle_rule(8);
    Eigen::Matrix<double, 7, 7> dual = Eigen::Matrix<double, 7, 7>::Zero();
    for (int j = 0; j < 3; ++j)
      for (Eigen::Index k = 0; k < s.size(); ++k) {
        const auto values = functions(on_edge(j, s(k)));
        dual.row(2 * j) += 2 * weights(k) * (1 - s(k)) * values;
        dual.row(2 * j + 1) += 2 * weights(k) * s(k) * values;
      }
    for (Eigen::Index k = 0; k < rule.weights.size(); ++k)
      dual.row(6) += rule.weights(k) * functions(rule.points.row(k));
    const Eigen::Matrix<double, 7, 7> coefficients = dual.inverse();
    for (Eigen::Index k = 0; k < rule.weights.size(); ++k) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(k));
      const Eigen::Matrix<double, 1, 7> basis = functions(rule.points.row(k)) * coefficients;
      for (int i = 0; i < 7; ++i)
        load(unknown[i]) += mesh.area(t) * rule.weights(k) * quadratic_load(x(0), x(1)) * basis(i);
    }
  }
};

TEST(HybridBdm1, AgreesWithADenseProgramFromTheDefinition) {
  for (const char* family : {"structured", "jittered"}) {
    const Space space(mesh_family(family).mesh(3), hybrid_bdm1());
    const DenseProgram dense(space.mesh());
    for (const double epsilon : {1.0, 0.1, 0.0}) {
      const Scene scene({quadratic_load}, StiffLayer{epsilon}, UnilateralContact{});
      const VariationalInequality problem = assemble(scene, space);
      const Eigen::MatrixXd a0 = problem.b.transpose() * problem.m.asDiagonal() * problem.b;
      // sums of some 10 products of numbers up to 20
      EXPECT_LT((Eigen::MatrixXd(problem.a1) - dense.a1).cwiseAbs().maxCoeff(), 1e-12) << family;
      EXPECT_LT((a0 - dense.b.transpose() * dense.b).cwiseAbs().maxCoeff(), 1e-12) << family;
      EXPECT_LT((problem.load - dense.load).cwiseAbs().maxCoeff(), 1e-14) << family;
      VariationalInequality second = problem;
      second.a1 = dense.a1.sparseView();
      second.b = RowMatrix(dense.b.sparseView());
      second.m = Eigen::VectorXd::Ones(dense.b.rows());
      second.load = dense.load;
      const BruteForce known = brute_force(second);
      const Solution solution = active_set(problem);
      EXPECT_EQ(known.answers, 1);
      EXPECT_EQ(solution.active, known.active);
      const auto touching = std::count(known.active.begin(), known.active.end(), true);
      EXPECT_EQ(touching > 0, epsilon < 1) << family << epsilon;
      EXPECT_LT(touching, 6) << family << epsilon;
      EXPECT_LT(relative_difference(solution.u, known.u), 1e-9)
          << family << epsilon;  // the solver's tolerance is 1e-10
      EXPECT_LT((solution.lambda - known.lambda).cwiseAbs().maxCoeff(),
                1e-8 * problem.load.cwiseAbs().maxCoeff())
          << family << epsilon;
    }
  }
}

/// Unknowns on edges of the boundary.
std::map<int, double> boundary_values(const Space& space, const Field& u) {
  const Eigen::VectorXd values = dof_values(space, u);
  std::map<int, double> at;
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; i < 6; ++i)
      if (space.mesh().edge_triangles(space.mesh().triangle_edges(t, i / 2), 1) < 0)
        at[space.cell_dofs()(t, i)] = values(space.cell_dofs()(t, i));
  return at;
}

// A quadratic has an affine gradient, which is its own projection, and the work of a constant load
// depends on the means alone.
TEST(HybridBdm1, PassesThePatchTestOfQuadratics) {
  const auto u = [](double x, double y) { return 3 * x * x - 2 * x * y + y * y + x - 5; };
  for (const TriangleMesh& mesh : {structured_mesh(4, {0}), unstructured_mesh(4, {0})}) {
    const Space space(mesh, hybrid_bdm1());
    VariationalInequality problem = assemble(Scene({[](double, double) { return -8.0; }}), space);
    set_dirichlet(problem, boundary_values(space, u));
    EXPECT_LT(relative_difference(active_set(problem).u, dof_values(space, u)), 1e-12);
  }
}

// u = x (1 - x) in a layer without vertical strain: flux (1 - 2 x, p) with p = 2 (y + 1), and the
// same flux above.
TEST(HybridBdm1, PassesThePatchTestOfABentLayer) {
  const auto u = [](double x, double y) {
    return y < 0 ? x * (1 - x) : x * (1 - x) + 2 * y + y * y;
  };
  for (const std::string& family : families) {
    const Space space(mesh_family(family).mesh(5), hybrid_bdm1());
    VariationalInequality problem =
        assemble(Scene({[](double, double) { return 0.0; }}, StiffLayer{0}), space);
    std::map<int, double> given = boundary_values(space, u);
    for (const int i : space.contact_dofs()) given.erase(i);  // free, with p = 0
    set_dirichlet(problem, given);
    const Solution solution = active_set(problem);
    EXPECT_LT(relative_difference(solution.u, dof_values(space, u)), 1e-9)
        << family;  // ten times the tolerance
  }
}

// One motion per triangle: N_T, and the edges on Sigma and Gamma_C, less those on the two sides.
TEST(HybridBdm1, HasAMotionWithoutStrainPerTriangleOfTheLayer) {
  for (const std::string& family : families)
    for (const int cells : {4, 6}) {
      const TriangleMesh mesh = mesh_family(family).mesh(cells);
      auto expected =
          static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
      for (int e = 0; e < mesh.edge_count(); ++e) {
        const bool below = mesh.region[mesh.edge_triangles(e, 0)] == Region::layer;
        if (mesh.edge_tag[e] == EdgeTag::sigma || mesh.edge_tag[e] == EdgeTag::contact) ++expected;
        if (is_dirichlet(mesh.edge_tag[e]) && below) --expected;
      }
      EXPECT_EQ(layer_kernel_dimension(stiff_problem(Space(mesh, hybrid_bdm1()), 0)), expected)
          << family << cells;
    }
}

// Without a stabilisation |G v|^2 >= beta (|v_T|^2 + |G v|^2), beta = m / (1 + m) = 0.913 with the
// smallest eigenvalue m = pi^2 + (pi/4)^2 of -laplace on the domain, which is 2 high, clamped on
// three sides and free on the fourth.
TEST(HybridBdm1, IsCoerciveWithoutStabilisationOnAnyMesh) {
  const double pi = std::numbers::pi, least = pi * pi * (1 + 1.0 / 16);
  for (const std::string& family : families) {
    const Space space(mesh_family(family).mesh(6), hybrid_bdm1());
    SparseMatrix norm = gradient_form(space, {1, 1}, {1, 1});
    for (int t = 0; t < space.mesh().triangle_count(); ++t) {
      const int mean = space.cell_dofs()(t, 6);
      norm.coeffRef(mean, mean) += space.mesh().area(t);
    }
    EXPECT_NEAR(coercivity(stiff_problem(space, 1), norm), least / (1 + least), 0.005) << family;
  }
}

// The gap enters by its hat means, so that the interpolant of an admissible function is admissible.
TEST(HybridBdm1, TheObstacleIsTheHatMeansOfTheGap) {
  const Space space(unstructured_mesh(5), hybrid_bdm1());
  const auto gap = [](double x) { return x * x; };
  const VariationalInequality problem = stiff_problem(space, 0.1, {gap});
  const TriangleMesh& mesh = space.mesh();
  ASSERT_EQ(problem.bounds.unknowns.size(), 10U);
  for (std::size_t k = 0; k < problem.bounds.unknowns.size(); ++k) {
    const int e = problem.bounds.unknowns[k] / 2;
    const double from = mesh.vertices(mesh.edges(e, problem.bounds.unknowns[k] % 2), 0);
    const double to = mesh.vertices(mesh.edges(e, 1 - problem.bounds.unknowns[k] % 2), 0);
    // 2 int_0^1 (1 - s) (from + s (to - from))^2 ds
    const double mean = from * from + 2 * from * (to - from) / 3 + (to - from) * (to - from) / 6;
    EXPECT_NEAR(problem.bounds.lower(static_cast<Eigen::Index>(k)), -mean, 1e-15);
  }
}

TEST(HybridBdm1, IsRefusedWhereItServesNothing) {
  const TriangleMesh mesh = structured_mesh(2, {0});
  const Space space(mesh, hybrid_bdm1()), affine(mesh, p1());
  PlaneStrain rubber;
  expect_refused([&] { assemble(rubber, {space, space}); }, "has no Korn inequality");
  expect_refused([&] { assemble(rubber, {affine, space}); }, "has no Korn inequality");
  expect_refused([&] { assemble(Scene({paper_load}, VentcelLayer{}), space); },
                 "BDM1-hybrid is not accepted; P1 or CR");
  const Space layered(structured_mesh(2), hybrid_bdm1());
  const VariationalInequality problem = stiff_problem(layered, 1);
  expect_refused([&] { negative_part(layered, problem, h1_gram_matrix(layered)); },
                 "BDM1-hybrid is not accepted");
}

}  // namespace antilock::test::models_test::hybrid_bdm1_test

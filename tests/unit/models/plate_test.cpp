// Reissner and Mindlin's plate over an obstacle: the class in two dimensions, bounds under all of
// it.
#include "antilock/models/plate.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/exact_plate.hpp"
#include "antilock/form/plate_forms.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/coating.hpp"
#include "support/bodies.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::plate_test {

struct PlateElement {
  std::string name;
  const Element &deflection, &rotation;
  ShearRule shear;
};
const PlateElement exact_shear{"P1, exact", p1(), p1(), ShearRule::exact};
const PlateElement one_point{"P1, one point", p1(), p1(), ShearRule::mean};
const PlateElement duran_liberman{"Duran-Liberman", p1(), p1(), ShearRule::edges};
const PlateElement arnold_falk{"Arnold-Falk", crouzeix_raviart(), p1_bubble(), ShearRule::mean};

struct On {
  On(const PlateElement& method, const TriangleMesh& mesh)
      : w(mesh, method.deflection),
        theta(mesh, method.rotation),
        space{w, {theta, theta}, method.shear} {}
  Space w, theta;
  PlateSpace space;
};

/// A mesh of the unit square, clamped all round.
TriangleMesh clamped(TriangleMesh mesh) {
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0) mesh.edge_tag[e] = EdgeTag::clamped;
  return mesh;
}

/// No load and no obstacle; the rim bends the plate to w = x^2 + x y - y^2 / 2.
Plate bent(double thickness) {
  Plate plate{.thickness = thickness, .load = [](double, double) { return 0.0; }};
  plate.gap = [](double, double) { return infinity; };
  plate.boundary_deflection = [](double x, double y) { return x * x + x * y - y * y / 2; };
  plate.boundary_rotation_x = [](double x, double y) { return 2 * x + y; };
  plate.boundary_rotation_y = [](double x, double y) { return x - y; };
  return plate;
}

TEST(Plate, BendsExactlyWithConstantCurvature) {
  // grad w is affine: the rotations hold it, and the edge means of w make the shear 0. Whatever the
  // mesh and t.
  for (const TriangleMesh& mesh : {disc_mesh(6), clamped(unstructured_mesh(6, Domain{0}))})
    for (const PlateElement& method : {duran_liberman, arnold_falk})
      for (const double t : {1.0, 1e-3, 1e-20, 0.0}) {
        SCOPED_TRACE(method.name + ", t = " + std::to_string(t));
        const On on(method, mesh);
        const VariationalInequality problem = assemble(bent(t), on.space);
        const Solution s = active_set(problem);
        // to what is claimed: the rate is one of p in the Euclidean norm, the error one of u in the
        // maximum norm
        EXPECT_LE(s.error, CorrectionOptions{}.tolerance);
        const double off = 10 * s.error * s.u.lpNorm<Eigen::Infinity>();
        for (int i = 0; i < mesh.vertex_count(); ++i) {
          const double x = mesh.vertices(i, 0), y = mesh.vertices(i, 1);
          ASSERT_NEAR(s.u(on.space.theta_x() + i), 2 * x + y, off);
          ASSERT_NEAR(s.u(on.space.theta_y() + i), x - y, off);
          if (on.w.element().conforming()) {
            ASSERT_NEAR(s.u(i), x * x + x * y - y * y / 2, off);
          }
        }
        EXPECT_LE(s.counters.corrections, 3)
            << "what the dependent rows of the edges leave of p is round-off";
        // bending energy of the curvatures 2, -1 and twist 1: (1 - nu)(4 + 1 + 2) + nu (2 - 1)^2
        // per area
        EXPECT_NEAR(s.u.dot(problem.a1 * s.u), (0.7 * 7 + 0.3) * area(mesh, Region::body), 1e-10);
      }
}

TEST(Plate, TheOtherRulesHaveTheShearThatTheySee) {
  // any w and theta: the square of the strain, or of its mean over each triangle, by a rule of
  // degree 5
  const TriangleMesh mesh = disc_mesh(3);
  const Quadrature& rule = radon_rule();
  for (const PlateElement& method : {exact_shear, one_point, arnold_falk}) {
    const On on(method, mesh);
    const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(on.space.size(), 0, 40).array().sin();
    double exact = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const Eigen::VectorXd w = u(on.w.cell_dofs().row(t)),
                            x = u.segment(on.space.theta_x(),
                                          on.theta.size())(on.theta.cell_dofs().row(t)),
                            y = u.segment(on.space.theta_y(),
                                          on.theta.size())(on.theta.cell_dofs().row(t));
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      double square = 0;
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::Vector3d at = rule.points.row(q);
        const Eigen::VectorXd phi = on.theta.element().basis(at);
        const Eigen::Vector2d strain =
            (on.w.element().derivative(at) * barycentric_gradients(mesh, t)).transpose() * w -
            Eigen::Vector2d(phi.dot(x), phi.dot(y));
        mean += rule.weights(q) * strain;
        square += rule.weights(q) * strain.squaredNorm();
      }
      exact += mesh.area(t) * (method.shear == ShearRule::exact ? square : mean.squaredNorm());
    }
    EXPECT_NEAR(value(shear_form(on.space), u), exact, 1e-12 * exact) << method.name;
  }
}

// theta = 6 lambda_j lambda_k tau, g = grad 6 lambda_j lambda_k: (1 - nu) |eps|^2 + nu (tr eps)^2
// is ((1 - nu) |g|^2 + (1 + nu) (g.tau)^2) / 2, and int g g' = 3 area (2 jj' + 2 kk' + jk' + kj'),
// j and k the gradients of the coordinates.
TEST(Plate, TheBubblesOfTheEdgesHaveTheirExactBendingEnergy) {
  const TriangleMesh mesh = disc_mesh(3);
  const On on(duran_liberman, mesh);
  const SparseMatrix a = bending_form(on.space, 0.3);
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(mesh.edge_count());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      const Eigen::Matrix<double, 3, 2> d = barycentric_gradients(mesh, t);
      const Eigen::RowVector2d j = d.row((i + 1) % 3), k = d.row((i + 2) % 3),
                               tau = (mesh.vertices.row(mesh.edges(e, 1)) -
                                      mesh.vertices.row(mesh.edges(e, 0)))
                                         .normalized();
      const Eigen::Matrix2d g =
          3 * mesh.area(t) *
          (2 * (j.transpose() * j + k.transpose() * k) + j.transpose() * k + k.transpose() * j);
      exact(e) += (0.7 * g.trace() + 1.3 * tau.dot(tau * g)) / 2;
    }
  for (int e = 0; e < mesh.edge_count(); ++e)
    EXPECT_NEAR(a.coeff(on.space.on_edges() + e, on.space.on_edges() + e), exact(e),
                1e-12 * exact(e));
}

// What is prescribed on the rim has its own means there: of w, and of theta along the edge, whose
// unknown of the edge rule multiplies a bubble of mean 1. Simpson's rule is exact for cubic w and
// quadratic theta.
TEST(Plate, TheRimHasTheMeansOfWhatIsPrescribed) {
  const TriangleMesh mesh = disc_mesh(3);
  Plate plate = bent(1);
  plate.boundary_deflection = [](double x, double y) { return x * x * x - x * y; };
  plate.boundary_rotation_x = [](double x, double y) { return x * x - y; };
  plate.boundary_rotation_y = [](double x, double y) { return x * y + y * y; };
  const auto [points, weights] = gauss_rule(2);  // exact to degree 3
  for (const PlateElement& method : {duran_liberman, arnold_falk}) {
    const On on(method, mesh);
    const VariationalInequality problem = assemble(plate, on.space);
    std::map<int, double> fixed;
    for (std::size_t k = 0; k < problem.dirichlet_dofs.size(); ++k)
      fixed[problem.dirichlet_dofs[k]] = problem.dirichlet_values(static_cast<Eigen::Index>(k));
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (mesh.edge_tag[e] != EdgeTag::clamped) continue;
      const Eigen::RowVector2d a = mesh.vertices.row(mesh.edges(e, 0)),
                               b = mesh.vertices.row(mesh.edges(e, 1));
      const Eigen::RowVector2d along = (b - a).normalized();
      double w = 0, theta = 0;
      for (int q = 0; q < 2; ++q) {
        const Eigen::RowVector2d x = a + points(q) * (b - a);
        w += weights(q) * plate.boundary_deflection(x(0), x(1));
        theta += weights(q) * (plate.boundary_rotation_x(x(0), x(1)) * along(0) +
                               plate.boundary_rotation_y(x(0), x(1)) * along(1));
      }
      if (method.shear == ShearRule::edges) {
        double ends = 0;
        for (const int v : {mesh.edges(e, 0), mesh.edges(e, 1)})
          ends += (fixed.at(on.space.theta_x() + v) * along(0) +
                   fixed.at(on.space.theta_y() + v) * along(1)) /
                  2;
        EXPECT_NEAR(ends + fixed.at(on.space.on_edges() + e), theta, 1e-14);
      } else {
        EXPECT_NEAR(fixed.at(e), w, 1e-14);
      }
    }
  }
}

TEST(Plate, TheEdgeRuleHasTheExactShearOfItsOwnFields) {
  // w = 0, theta = -(a + b (-y, x)): the shear strain a + b (-y, x) is in every triangle's space of
  // the edge rule, and the form is its exact integral, by a rule of degree 5. The polar moment of
  // each triangle is in it, in b alone.
  for (const TriangleMesh& mesh : {disc_mesh(3), clamped(unstructured_mesh(6, Domain{0}))})
    for (const Eigen::Vector3d& field : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.3, -0.7, 2)}) {
      const On on(duran_liberman, mesh);
      const auto strain = [&](const Eigen::Vector2d& x) {
        return Eigen::Vector2d(field(0) - field(2) * x(1), field(1) + field(2) * x(0));
      };
      Eigen::VectorXd u = Eigen::VectorXd::Zero(on.space.size());
      for (int i = 0; i < mesh.vertex_count(); ++i) {
        const Eigen::Vector2d theta = -strain(mesh.vertices.row(i));
        u(on.space.theta_x() + i) = theta(0);
        u(on.space.theta_y() + i) = theta(1);
      }
      double exact = 0;
      for (int t = 0; t < mesh.triangle_count(); ++t)
        for (Eigen::Index q = 0; q < radon_rule().weights.size(); ++q)
          exact += mesh.area(t) * radon_rule().weights(q) *
                   strain(point_in(mesh, t, radon_rule().points.row(q))).squaredNorm();
      EXPECT_NEAR(value(shear_form(on.space), u), exact, 1e-12 * exact);
    }
}

TEST(Plate, P1CannotBendAtAllInTheLimit) {
  for (const PlateElement& method : {exact_shear, one_point}) {
    const TriangleMesh mesh = disc_mesh(5);
    const On on(method, mesh);
    EXPECT_EQ(kernel_dimension(assemble(Plate{}, on.space)), 0);
    EXPECT_THROW(active_set(assemble(bent(0), on.space)),
                 NotConverged);  // B u = 0 has no solution with this rim
  }
}

TEST(Plate, TheCuresLeaveAsManyFunctionsAsCounted) {
  for (const int n : {3, 6}) {
    const TriangleMesh mesh = disc_mesh(n);
    const On edges(duran_liberman, mesh), mean(arnold_falk, mesh);
    const int inner = 3 * n * n - 3 * n + 1;
    EXPECT_EQ(kernel_dimension(assemble(Plate{}, edges.space)), 3 * inner);
    // w and P1 rotations: the bubbles are determined by them
    EXPECT_EQ(kernel_dimension(assemble(Plate{}, mean.space)), 9 * n * n - 3 * n + 2 * inner);
  }
}

/// A clamped plate on the unit square without obstacle: w0 = 1e4 g(x) g(y), g = x^3 (x - 1)^3,
/// theta = grad w0, w = w0 - t^2 Laplace w0, load = Laplace^2 w0 (a check by hand: the shear force
/// is -grad Laplace w0).
struct Square {
  double t;
  static double g(double x, int derivative) {
    const double x2 = x * x;
    if (derivative == 0) return x2 * x * std::pow(x - 1, 3);
    if (derivative == 1) return 3 * x2 * (x - 1) * (x - 1) * (2 * x - 1);
    if (derivative == 2) return 30 * x2 * x2 - 60 * x2 * x + 36 * x2 - 6 * x;
    return 360 * x2 - 360 * x + 72;  // the fourth
  }
  double deflection(double x, double y) const {
    return 1e4 * (g(x, 0) * g(y, 0) - t * t * (g(x, 2) * g(y, 0) + g(x, 0) * g(y, 2)));
  }
  Plate plate() const {
    Plate p{.thickness = t};
    p.load = [](double x, double y) {
      return 1e4 * (g(x, 4) * g(y, 0) + 2 * g(x, 2) * g(y, 2) + g(x, 0) * g(y, 4));
    };
    p.gap = [](double, double) { return infinity; };
    return p;
  }
};

/// Root mean squares of the errors of w at its unknowns and of theta_x at the vertices, relative to
/// those of w and theta.
std::pair<double, double> errors(const PlateElement& method, const TriangleMesh& mesh,
                                 const Square& exact) {
  const On on(method, mesh);
  const Solution s = active_set(assemble(exact.plate(), on.space));
  double w = 0, w2 = 0, theta = 0, theta2 = 0;
  for (int i = 0; i < on.w.size(); ++i) {
    const double value =
        exact.deflection(on.w.dof_coordinates()(i, 0), on.w.dof_coordinates()(i, 1));
    w += std::pow(s.u(i) - value, 2);
    w2 += value * value;
  }
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const double value =
        1e4 * Square::g(mesh.vertices(i, 0), 1) * Square::g(mesh.vertices(i, 1), 0);
    theta += std::pow(s.u(on.space.theta_x() + i) - value, 2);
    theta2 += value * value;
  }
  return {std::sqrt(w / w2), std::sqrt(theta / theta2)};
}

// The deflection in the middle of a clamped square plate under a uniform load, side, load and
// stiffness 1: 0.00126532 for Kirchhoff's plate, by Ritz's method in another program. Table 35 of S.
// Timoshenko and S. Woinowsky-Krieger, Theory of Plates and Shells, has 0.00126.
TEST(Plate, ASquareHasKirchhoffsDeflectionUnlessItLocks) {
  constexpr double kirchhoff = 0.00126532;
  Plate plate{.thickness = 1e-4, .load = [](double, double) { return -1.0; }};
  plate.gap = [](double, double) { return infinity; };
  const TriangleMesh mesh = clamped(structured_mesh(32, Domain{0}));
  const auto middle = [&](const PlateElement& method) {
    const On on(method, mesh);
    const Solution s = active_set(assemble(plate, on.space));
    for (int i = 0; i < mesh.vertex_count(); ++i)
      if (mesh.vertices(i, 0) == 0.5 && mesh.vertices(i, 1) == 0.5) return s.u(i);
    return nan;
  };
  // ConvergesLikeHSquaredUniformlyInTheThickness: below 2 % in the mean on such a mesh
  EXPECT_NEAR(middle(duran_liberman), -kirchhoff, 0.03 * kirchhoff);
  EXPECT_LT(std::abs(middle(exact_shear)), 0.01 * kirchhoff);
}

TEST(Plate, ConvergesLikeHSquaredUniformlyInTheThickness) {
  // Arnold and Falk 1989, Duran and Liberman 1992: C h^2 in L2, C without t, on any mesh
  const std::vector<TriangleMesh> meshes{clamped(unstructured_mesh(8, Domain{0})),
                                         clamped(unstructured_mesh(16, Domain{0})),
                                         clamped(unstructured_mesh(32, Domain{0}))};
  const auto order = [](const std::vector<double>& error) {
    return std::log2(error.front() / error.back()) / 2;
  };
  for (const PlateElement& method : {duran_liberman, arnold_falk})
    for (const double t : {1.0, 0.1, 1e-2, 1e-4, 0.0}) {
      SCOPED_TRACE(method.name + ", t = " + std::to_string(t));
      std::vector<double> w, theta;
      for (const TriangleMesh& mesh : meshes) {
        const auto [in_w, in_theta] = errors(method, mesh, {t});
        w.push_back(in_w);
        theta.push_back(in_theta);
      }
      EXPECT_GT(order(w), 1.7) << w[0] << " " << w[2];
      EXPECT_GT(order(theta), 1.7) << theta[0] << " " << theta[2];
      EXPECT_LT(w.back(), 0.02);
      EXPECT_LT(theta.back(), 0.02);
    }
  for (const PlateElement& method : {exact_shear, one_point})
    EXPECT_GT(errors(method, meshes[1], {1e-4}).first, 0.99);
}

TEST(Plate, ThePressedPlateFulfilsTheConditionsOnBothRoads) {
  const TriangleMesh mesh = disc_mesh(8);
  for (const PlateElement& method : {duran_liberman, arnold_falk})
    for (const double t : {1.0, 1e-2, 1e-8, 1e-20, 0.0}) {
      SCOPED_TRACE(method.name + ", t = " + std::to_string(t));
      const On on(method, mesh);
      const VariationalInequality problem = assemble(Plate{.thickness = t}, on.space);
      ActiveSetOptions on_sparse, on_dense;
      on_sparse.reduction = ContactReduction::sparse;
      on_dense.reduction = ContactReduction::schur_complement;
      const Solution dense = active_set(problem, on_dense), sparse = active_set(problem, on_sparse);
      EXPECT_LT(worst_violation(kkt_report(problem, dense)), 1e-9);
      EXPECT_LT((dense.u - sparse.u).norm(), 1e-8 * dense.u.norm());
      EXPECT_LE(dense.counters.corrections, 4);
      EXPECT_EQ(dense.warning, "");
    }
}

TEST(Plate, TheContactForceTendsToTheExactOne) {
  for (const PlateElement& method : {duran_liberman, arnold_falk})
    for (const double t : {0.1, 1e-2, 0.0}) {
      std::vector<double> off;
      for (const int n : {6, 12}) {
        const TriangleMesh mesh = disc_mesh(n);
        const On on(method, mesh);
        off.push_back(std::abs(active_set(assemble(Plate{.thickness = t}, on.space)).lambda.sum() /
                                   ExactPlate(t).contact_force() -
                               1));
      }
      EXPECT_LT(off.back(), 0.01) << method.name << t;
      EXPECT_LT(off.back(), off.front()) << method.name << t;
    }
}

TEST(Plate, AnObstacleThatP1CannotReachIsRefused) {
  const TriangleMesh mesh = disc_mesh(6);
  Plate lifted{.thickness = 0};
  lifted.gap = [](double x, double y) { return -0.1 * (1 - x * x - y * y); };
  for (const PlateElement& method : {exact_shear, one_point})
    EXPECT_THROW(active_set(assemble(lifted, On(method, mesh).space)), NotConverged) << method.name;
  for (const PlateElement& method : {duran_liberman, arnold_falk})
    EXPECT_LT(worst_violation(active_set(assemble(lifted, On(method, mesh).space)).kkt), 1e-9)
        << method.name;
}

TEST(Plate, ValuesOutOfRangeAreRefused) {
  const TriangleMesh mesh = disc_mesh(2);
  const On on(arnold_falk, mesh);
  for (const double t : {-1e-9, 1.1, std::nan("")})
    test::expect_refused([&] { assemble(Plate{.thickness = t}, on.space); }, "accepted 0 to 1");
  for (const double nu : {-0.1, 1.0})
    test::expect_refused([&] { assemble(Plate{.poisson = nu}, on.space); }, "Poisson");
  Plate below_obstacle;  // below the obstacle on a part of the rim
  const TriangleMesh group = retagged(mesh, [](double, double) { return dirichlet_group(0); });
  const On named(arnold_falk, group);
  EXPECT_TRUE(
      assemble(below_obstacle, named.space).a1.isApprox(assemble(below_obstacle, on.space).a1))
      << "held under whatever name";
  below_obstacle.gap = [](double x, double) { return x > 0.9 ? -0.1 : 1.0; };
  for (const On* rim : {&on, &named})
    test::expect_refused([&] { assemble(below_obstacle, rim->space); },
                         "below the obstacle at 0.1");
  below_obstacle.gap = [](double x, double) {
    return x < 0 ? 0.1 : 1e13;
  };  // large elsewhere: hides nothing
  below_obstacle.boundary_deflection = [](double, double) { return -1.0; };
  test::expect_refused([&] { assemble(below_obstacle, on.space); }, "below the obstacle at -0.1");
  below_obstacle.boundary_deflection = [](double, double) {
    return 0.0;
  };  // a thousandth of the gap beside it below
  below_obstacle.gap = [](double x, double y) { return x * x + y * y > 0.99 ? -1e-4 : 0.1; };
  test::expect_refused([&] { assemble(below_obstacle, on.space); }, "below the obstacle at 0.0001");
  TriangleMesh rounded =
      mesh;  // an obstacle that meets the rim, whose corners are where they are to 1e-9
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::clamped)
      rounded.vertices.row(mesh.edges(e, 0)) = (1 - 1e-9) * mesh.vertices.row(mesh.edges(e, 0));
  Plate touching;
  touching.gap = [](double x, double y) { return -0.1 * (1 - x * x - y * y); };
  EXPECT_NO_THROW(assemble(touching, On(arnold_falk, rounded).space));
  const On wrong({"", p2(), p2(), ShearRule::mean}, mesh),
      edges({"", p1(), p1_bubble(), ShearRule::edges}, mesh);
  test::expect_refused([&] { assemble(Plate{}, wrong.space); }, "accepted P1 and P1");
  test::expect_refused([&] { assemble(Plate{}, edges.space); }, "accepted P1 and P1");
}

}  // namespace antilock::test::models_test::plate_test

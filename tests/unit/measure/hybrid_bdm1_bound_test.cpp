// The theorem of tutorials/guides/order_two.md, with numbers: the a priori bound with constant 1,
// the flux in equilibrium, order 2 at every epsilon on every family of meshes.
#include <Eigen/Dense>

#include "antilock/certificate/certificate.hpp"
#include "antilock/certificate/companion.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/space.hpp"
#include "support/manufactured.hpp"
#include "support/scenes.hpp"

namespace antilock::test::measure_test::hybrid_bdm1_bound_test {

const std::vector<std::string> families{"structured", "columns", "jittered", "rows", "delaunay"};

/// A solution without a condition on Gamma_C, or with contact.
struct Solved {
  Space space;
  Solution solution;

  Solved(const TriangleMesh& mesh, double epsilon, const Field& f, bool contact)
      : space(mesh, hybrid_bdm1()) {
    VariationalInequality problem =
        assemble(Scene({f}, StiffLayer{epsilon},
                       contact ? std::optional(UnilateralContact{}) : std::nullopt),
                 space);
    problem.load = mean_load_vector(space, f);  // A G u_h is in equilibrium with the mean of f
    solution = active_set(problem);
  }

  /// The flux A G u_h on triangle t, its values at the corners (3 x 2): (u_x, p) in the layer. p is
  /// affine and known at the edge midpoints, in the order of the opposite vertices.
  Eigen::Matrix<double, 3, 2> flux(int t, Eigen::Index& row) const {
    Eigen::Matrix<double, 3, 2> at_corners;
    for (int i = 0; i < 3; ++i)
      at_corners.row(i) = solution.u(space.cell_dofs().row(t)).transpose() *
                          hybrid_bdm1().derivative(Eigen::Vector3d::Unit(i)) *
                          barycentric_gradients(space.mesh(), t);
    if (space.mesh().region[t] == Region::layer) {
      const Eigen::Vector3d p = solution.p.segment<3>(row);
      row += 3;
      at_corners.col(1) = Eigen::Vector3d::Constant(p.sum()) - 2 * p;
    }
    return at_corners;
  }
};

/// The outward normal of the edge opposite vertex i, of length 1.
Eigen::Vector2d normal(const TriangleMesh& mesh, int t, int i) {
  return -barycentric_gradients(mesh, t).row(i).normalized().transpose();
}

/// sigma = A grad u of the exact solution: (u_x, p) in the layer.
Eigen::Vector2d exact_flux(const Reference& exact, const Eigen::Vector2d& x, bool in_layer) {
  ExactPoint known = exact.known(x, in_layer);
  if (in_layer) known.gradient(1) = known.layer_stress;
  return known.gradient;
}

/// Both sides of the theorem: |grad u - G u_h|^2 <= |grad u - Pi_1 grad u|^2 + |sigma - tau|^2 + 2
/// int_{Gamma_C} (tau.n) u
struct Sides {
  double left = 0, gradient = 0, flux = 0, contact = 0;
  double right() const { return gradient + flux + contact; }
};

/// tau is the interpolant of sigma in BDM1. On an edge of Gamma_C where its normal part would be
/// negative at an end, it is the mean instead.
Sides sides(const Solved& run, double epsilon, const Reference& exact, bool contact) {
  const TriangleMesh& mesh = run.space.mesh();
  const Quadrature& rule = triangle_rule(10);
  const auto [s, weights] = gauss_rule(10);
  Sides sides;
  Eigen::Index row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const bool in_layer = mesh.region[t] == Region::layer;
    Eigen::Matrix<double, 6, 6> conditions;  // on the values of tau at the corners, x then y
    Eigen::Matrix<double, 6, 1> right;
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      const Eigen::Vector2d n = normal(mesh, t, i);
      Eigen::Vector2d hat_means = Eigen::Vector2d::Zero();
      double work =
          0;  // hat means of u: of tau.n = a (1 - s) + b s the work is (a u_0 + b u_1) |E| / 2
      Eigen::Vector2d u_means = Eigen::Vector2d::Zero();
      for (Eigen::Index q = 0; q < s.size(); ++q) {
        const Eigen::Vector2d x = point_in(mesh, t, on_edge(i, s(q)));
        const Eigen::Vector2d hats(1 - s(q), s(q));
        hat_means += 2 * weights(q) * exact_flux(exact, x, in_layer).dot(n) * hats;
        u_means += 2 * weights(q) * exact.value(x(0), x(1)) * hats;
      }
      // an affine function with these hat means has these values at the ends
      Eigen::Vector2d ends(2 * hat_means(0) - hat_means(1), 2 * hat_means(1) - hat_means(0));
      if (contact && mesh.edge_tag[e] == EdgeTag::contact) {
        if (ends.minCoeff() < 0) ends.setConstant(hat_means.mean());
        work = mesh.edge_length(e) / 2 * ends.dot(u_means);
      }
      sides.contact += 2 * work;
      for (int end = 0; end < 2; ++end) {
        const int corner = (i + 1 + end) % 3;
        conditions.row(2 * i + end).setZero();
        conditions(2 * i + end, corner) = n(0);
        conditions(2 * i + end, 3 + corner) = n(1);
        right(2 * i + end) = ends(end);
      }
    }
    const Eigen::Matrix<double, 6, 1> solved = conditions.partialPivLu().solve(right);
    const Eigen::Matrix<double, 3, 2> tau = solved.reshaped(3, 2), discrete = run.flux(t, row);
    Eigen::Matrix<double, 3, 2> moments = Eigen::Matrix<double, 3, 2>::Zero();
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
      moments += rule.weights(q) * rule.points.row(q).transpose() *
                 exact_flux(exact, point_in(mesh, t, rule.points.row(q)), in_layer).transpose();
    const Eigen::Matrix<double, 3, 2> projected =
        (12 * Eigen::Matrix3d::Identity() - 3 * Eigen::Matrix3d::Ones()) * moments;
    const double y = in_layer ? epsilon * epsilon : 1;  // A^-1
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::RowVector2d sigma =
          exact_flux(exact, point_in(mesh, t, rule.points.row(q)), in_layer).transpose();
      const auto squared = [&](const Eigen::Matrix<double, 3, 2>& affine) {
        const Eigen::RowVector2d off = sigma - rule.points.row(q) * affine;
        return mesh.area(t) * rule.weights(q) * (off(0) * off(0) + y * off(1) * off(1));
      };
      sides.left += squared(discrete);
      sides.gradient += squared(projected);
      sides.flux += squared(tau);
    }
  }
  return sides;
}

// Both sides are of size h^4, and each is integrated with an error far below the distance between
// them.
TEST(HybridBdm1Bound, HoldsWithConstantOneWithoutContact) {
  for (const double epsilon : {1.0, 1e-2, 0.0}) {
    const Manufactured exact = Manufactured::stiff_layer(epsilon);
    for (const char* family : {"columns", "rows", "delaunay"})
      for (const int cells : {8, 16}) {
        const Solved run(mesh_family(family).mesh(cells), epsilon, exact.load(), false);
        const Sides found = sides(run, epsilon, exact.reference(), false);
        EXPECT_LE(found.left, found.right()) << family << epsilon;
        EXPECT_GT(found.left, 0.4 * found.right()) << family << epsilon;
        EXPECT_LE(found.gradient, found.left * (1 + 1e-9))
            << "Pi_1 grad u is the best affine field";
      }
  }
}

TEST(HybridBdm1Bound, HoldsWithConstantOneInContact) {
  for (const double epsilon : {1.0, 1e-2, 0.0}) {
    const ExactTable table{ExactSolution(paper_sine_load(), epsilon)};
    for (const char* family : {"columns", "rows", "delaunay"})
      for (const int cells : {8, 16}) {
        const Solved run(mesh_family(family).mesh(cells), epsilon, paper_load, true);
        const Sides found = sides(run, epsilon, reference(table), true);
        EXPECT_LE(found.left, found.right()) << family << epsilon;
        EXPECT_GT(found.left, 0.02 * found.right()) << family << epsilon;
        EXPECT_GE(found.contact, 0) << family << epsilon;
      }
  }
}

// With the load on the means the flux is a candidate of the dual problem: its normal parts are
// continuous, its divergence is minus the mean of f, and the pressure, affine on each edge of
// Gamma_C, is at least 0 at both ends.
TEST(HybridBdm1Bound, TheFluxIsInEquilibrium) {
  for (const double epsilon : {1.0, 1e-2, 0.0})
    for (const char* family : {"rows", "delaunay"}) {
      const Solved run(mesh_family(family).mesh(12), epsilon, paper_load, true);
      const TriangleMesh& mesh = run.space.mesh();
      Eigen::MatrixX2d jump = Eigen::MatrixX2d::Zero(mesh.edge_count(), 2);
      Eigen::Index row = 0;
      double largest = 0, imbalance = 0, lowest = 0;
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        const Eigen::Matrix<double, 3, 2> flux = run.flux(t, row);
        double outflow = 0, force = 0;
        for (int i = 0; i < 3; ++i) {
          const int e = mesh.triangle_edges(t, i);
          for (const int corner : {(i + 1) % 3, (i + 2) % 3}) {
            const double through = flux.row(corner).dot(normal(mesh, t, i));
            outflow += mesh.edge_length(e) * through / 2;
            largest = std::max(largest, std::abs(through));
            jump(e, mesh.edges(e, 0) == mesh.triangles(t, corner) ? 0 : 1) += through;
          }
        }
        const Quadrature& rule = triangle_rule(8);
        for (Eigen::Index q = 0; q < rule.weights.size() && mesh.region[t] == Region::body; ++q)
          force += mesh.area(t) * rule.weights(q) *
                   paper_load(point_in(mesh, t, rule.points.row(q))(0), 0);
        imbalance = std::max(imbalance, std::abs(outflow + force));
      }
      double jumps = 0;
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_triangles(e, 1) >= 0)
          jumps = std::max(jumps, jump.row(e).cwiseAbs().maxCoeff());
        if (mesh.edge_tag[e] == EdgeTag::contact) lowest = std::min(lowest, jump.row(e).minCoeff());
      }
      // the solver's tolerance of 1e-10, over the areas of the triangles
      EXPECT_LT(jumps, 1e-7 * largest) << family << epsilon;
      EXPECT_LT(imbalance, 1e-9 * largest) << family << epsilon;
      EXPECT_GT(lowest, -1e-7 * largest) << family << epsilon;
    }
}

// The largest error over epsilon has order 2 in energy and 3 in L2 on each family. The intervals
// are wide enough for the coarsest of three meshes.
TEST(HybridBdm1Bound, HasOrderTwoUniformlyWithoutContact) {
  for (const std::string& family : families) {
    std::vector<double> h, energy, l2;
    for (const int cells : {8, 16, 32}) {
      const Space space(mesh_family(family).mesh(cells), hybrid_bdm1());
      h.push_back(1.0 / cells);
      energy.push_back(0);
      l2.push_back(0);
      for (const double epsilon : {1.0, 0.1, 1e-2, 1e-4, 0.0}) {
        const Manufactured exact = Manufactured::stiff_layer(epsilon);
        const Solution solution =
            active_set(assemble(Scene({exact.load()}, StiffLayer{epsilon}), space));
        const Errors errors = measure_errors(space, solution, epsilon, exact.reference());
        const double size = exact.b + exact.c;
        energy.back() = std::max(energy.back(), errors.energy / size);
        l2.back() = std::max(l2.back(), errors.l2 / size);
      }
    }
    EXPECT_NEAR(slope(h, energy), 2, 0.1) << family;
    EXPECT_NEAR(slope(h, l2), 3, 0.2) << family;
  }
}

// |u - w| <= |u - v| + |v - w|: the certificate of Crouzeix-Raviart bounds this element by its
// distance.
TEST(HybridBdm1Bound, IsCertifiedByItsDistanceToTheCompanion) {
  for (const double epsilon : {1.0, 1e-2, 0.0}) {
    const ExactTable table{ExactSolution(paper_sine_load(), epsilon, true, 14)};
    const Scene scene = stiff_scene(epsilon);
    Result cr{.space = Space(mesh_family("columns").mesh(12), crouzeix_raviart())};
    cr.problem = assemble(scene, cr.space);
    cr.solution = active_set(cr.problem);
    const Space conforming(cr.space, p1()), space(cr.space, hybrid_bdm1());
    const ConformingCompanion v = p1_companion(active_set(assemble(scene, conforming)));
    const Certificate found = certify(scene, cr, {.companion = &v});
    const VariationalInequality problem = assemble(scene, space);
    const Solution w = active_set(problem);
    const double bound = certified_distance(found, v, {space, problem, w});
    EXPECT_GE(bound, measure_errors(space, w, epsilon, reference(table)).energy) << epsilon;
    EXPECT_LT(bound, 3 * found.displacement) << epsilon;
  }
}

}  // namespace antilock::test::measure_test::hybrid_bdm1_bound_test

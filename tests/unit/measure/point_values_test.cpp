// Values of discrete functions at points, on triangles and on tetrahedra.
#include "antilock/measure/point_values.hpp"

#include <random>
#include <vector>

#include "support/scenes.hpp"

namespace antilock::test::measure_test::point_values_test {

double affine(double x, double y, double z) { return 1 + 2 * x - y + 3 * z; }

/// Meshes of the body and the layer of Figure 2, in the plane and in space.
std::vector<Mesh> body_and_layer() {
  const Domain in_space{1, CellKind::tetrahedron};
  return {jittered_mesh(4, 0.2), unstructured_mesh(4), jittered_mesh(3, 0.15, in_space),
          unstructured_mesh(3, in_space)};
}

/// A point of (0,1) x (-1,1) or of (0,1)^2 x (-1,1).
Eigen::Vector3d random_point(std::mt19937& random, int dimension) {
  const auto share = [&] { return static_cast<double>(random()) / std::mt19937::max(); };
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int k = 0; k < dimension; ++k) x(k) = share();
  x(dimension - 1) = 2 * x(dimension - 1) - 1;
  return x;
}

// The affine function is in every space. Values and gradients are exact but for round-off.
TEST(PointValues, ReproduceAnAffineFunction) {
  std::mt19937 random(56);
  for (const Mesh& mesh : body_and_layer())
    for (const char* const name : {"P1", "P2", "CR"}) {
      const Space space(mesh, element(name, mesh.kind));
      const Eigen::VectorXd u = dof_values(space, affine);
      const PointValues values(space);
      Eigen::Vector3d slope = Eigen::Vector3d::Zero();
      slope.head(mesh.dimension()) = Eigen::Vector3d(2, -1, 3).head(mesh.dimension());
      for (int i = 0; i < 200; ++i) {
        const Eigen::Vector3d x = random_point(random, mesh.dimension());
        const auto place = values.locate(x);
        ASSERT_TRUE(place) << x.transpose();
        EXPECT_NEAR(values.value(u, *place), affine(x(0), x(1), x(2)), 1e-12);
        EXPECT_LT((values.gradient(u, *place) - slope).norm(), 1e-11);
      }
    }
}

TEST(PointValues, FindTheCellWithTheSmallestNumberThatHoldsAPoint) {
  std::mt19937 random(57);
  for (const Mesh& mesh : body_and_layer()) {
    const PointValues values(Space(mesh, p1(mesh.kind)));
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      EXPECT_EQ(values.locate(centroid(mesh, t))->triangle, t);
      // a vertex belongs to many cells
      const int v = mesh.triangles(t, static_cast<int>(random() % 3));
      Eigen::Vector3d corner = Eigen::Vector3d::Zero();
      corner.head(mesh.dimension()) = mesh.vertices.row(v).transpose();
      int first = 0;
      while ((mesh.triangles.row(first).array() != v).all()) ++first;
      EXPECT_EQ(values.locate(corner)->triangle, first);
    }
  }
}

TEST(PointValues, FindNothingOutsideTheMesh) {
  for (const Mesh& mesh : body_and_layer()) {
    const PointValues values(Space(mesh, p1(mesh.kind)));
    Eigen::Vector3d outside = Eigen::Vector3d::Constant(0.5);
    if (mesh.dimension() == 2) outside(2) = 0;
    outside(0) = 1.001;
    EXPECT_FALSE(values.locate(outside));
    EXPECT_TRUE(values.locate(outside, 0.1));  // less than a tenth of a cell outside
    outside(0) = 0.5;
    outside(mesh.vertical()) = -1.001;
    EXPECT_FALSE(values.locate(outside));
    // the sum of such coordinates is infinite
    outside.head(mesh.dimension()).setConstant(1.7e308);
    EXPECT_FALSE(values.locate(outside));
  }
}

}  // namespace antilock::test::measure_test::point_values_test

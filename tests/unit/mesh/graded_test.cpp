// Graded lines and tensor meshes, and what they are for: degrees on them.
#include "antilock/mesh/graded.hpp"
#include "antilock/analysis/kernel.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::graded_test {

/// The x of all vertices, ascending.
std::vector<double> lines_in_x(const TriangleMesh& mesh) {
  const std::set<double> x(mesh.vertices.col(0).begin(), mesh.vertices.col(0).end());
  return {x.begin(), x.end()};
}

TEST(GradedMesh, KeepsTheEndsAndThePointBetweenCellsOfTheWidth) {
  for (const double at : {0.3, 0.7})
    for (const int layers : {0, 1, 7}) {
      const std::vector<double> x = lines_in_x(graded_mesh(at, 0.25, layers, 0.25, 1));
      EXPECT_EQ(x.front(), 0);
      EXPECT_EQ(x.back(), 1);
      EXPECT_EQ(std::count(x.begin(), x.end(), at), 1);
      for (std::size_t i = 1; i < x.size(); ++i) EXPECT_LE(x[i] - x[i - 1], 0.25 * (1 + 1e-14));
      EXPECT_EQ(x.size(), 1 + 5 + 2 * static_cast<std::size_t>(layers));
    }
}

TEST(GradedMesh, EachLayerLeavesItsShareNextToThePoint) {
  const std::vector<double> x =
      lines_in_x(graded_mesh(0.5, 0.5, 4, 0.2, 1));  // one cell on each side, cut 4 times
  ASSERT_EQ(x.size(), 11u);
  for (int k = 0; k <= 4; ++k) {
    EXPECT_NEAR(x[10 - k] - 0.5, 0.5 * std::pow(0.2, k), 1e-15);
    EXPECT_NEAR(0.5 - x[k], 0.5 * std::pow(0.2, k), 1e-15);
  }
}

TEST(TensorMesh, OfEqualLinesIsTheStructuredMesh) {
  for (const Diagonal diagonal : {Diagonal::right, Diagonal::left, Diagonal::crossed})
    expect_same(tensor_mesh({0, 0.25, 0.5, 0.75, 1},
                            {-1, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 1}, diagonal),
                structured_mesh(4, {}, diagonal));
}

TEST(GradedMesh, FillsTheTwoSquaresWithTaggedSides) {
  for (const double epsilon : {1.0, 0.1, 1e-20, 0.0}) {
    const TriangleMesh mesh = graded_mesh(0.7, 1.0 / 3, 6, 0.25, epsilon);
    for (int t = 0; t < mesh.triangle_count(); ++t) ASSERT_GT(mesh.area(t), 0);
    expect_two_squares(mesh, 1, 1e-12, std::to_string(epsilon));
  }
}

// Layers wider than epsilon have rows above Sigma, the others above Gamma_C: at epsilon = 1 all of
// them there, at 0 none.
TEST(GradedMesh, PutsARowWhereALayerIsFelt) {
  const auto lowest = [](const TriangleMesh& mesh,
                         double above) {  // the height of the first row above a line
    double least = 1;
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 1) > above) least = std::min(least, mesh.vertices(v, 1) - above);
    return least;
  };
  for (const auto& [epsilon, in_body] :
       {std::pair{1.0, 0}, {0.1, 2}, {1e-2, 4}, {1e-6, 6}, {0.0, 6}}) {
    const TriangleMesh mesh = graded_mesh(0.5, 0.5, 6, 0.25, epsilon);
    EXPECT_NEAR(lowest(mesh, 0), 0.5 * std::pow(0.25, in_body), 1e-15) << epsilon;
    EXPECT_NEAR(lowest(mesh, -1), 0.5 * std::pow(0.25, 6 - in_body), 1e-15) << epsilon;
  }
}

// Columns, however narrow: G_h on the layer is every function of x, n p - 1 of them, for every
// degree.
TEST(GradedMesh, LeavesNoDegreeLocked) {
  const TriangleMesh mesh = graded_mesh(0.5, 0.5, 2, 0.25, 0.1);  // 6 columns
  for (int degree = 1; degree <= 6; ++degree) {
    const Space space(mesh, lagrange(degree));
    const VariationalInequality problem = test::stiff_problem(space, 0);
    EXPECT_EQ(layer_kernel_dimension(problem), 6 * degree - 1) << degree;
  }
}

TEST(GradedMesh, RefusesWhatHasNoMesh) {
  EXPECT_THROW(tensor_mesh({0}, {0, 1}), Error);
  EXPECT_THROW(tensor_mesh({0, 1, 1}, {0, 1}), Error);
  EXPECT_THROW(tensor_mesh({0, 1}, {-1, 1}), Error);  // no line y = 0
  EXPECT_THROW(tensor_mesh({0, 1}, {-1, 0}), Error);  // no body
  EXPECT_THROW(tensor_mesh({0, 1}, {0, NAN}), Error);
  EXPECT_THROW(graded_mesh(0, 0.1, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 0.5, -1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 0.5, 2), Error);
  EXPECT_THROW(graded_mesh(0.5, 0, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, NAN, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, -1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 61, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 1, 1), Error);
}

}  // namespace antilock::test::mesh_test::graded_test

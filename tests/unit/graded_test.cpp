// Graded lines and tensor meshes, and what they are for: degrees on them.
#include "antilock/mesh/graded.hpp"
#include "antilock/analysis/kernel.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::graded_test {

TEST(GradedLines, KeepTheEndsAndThePointAndAscend) {
  for (const double at : {0.0, 0.3, 0.7, 1.0})
    for (const int layers : {0, 1, 7}) {
      const std::vector<double> x = graded_lines(0, at, 1, 0.25, layers, 0.25);
      EXPECT_EQ(x.front(), 0);
      EXPECT_EQ(x.back(), 1);
      EXPECT_EQ(std::count(x.begin(), x.end(), at), 1);
      EXPECT_EQ(std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()), x.end());
      for (std::size_t i = 1; i < x.size(); ++i) EXPECT_LE(x[i] - x[i - 1], 0.25 * (1 + 1e-14));
      const std::size_t sides = (at > 0 ? 1 : 0) + (at < 1 ? 1 : 0), cells = at == 0 || at == 1 ? 4 : 5;
      EXPECT_EQ(x.size(), 1 + cells + sides * layers);
    }
}

TEST(GradedLines, EachLayerLeavesItsShareNextToThePoint) {
  const std::vector<double> x = graded_lines(0, 0.5, 1, 0.5, 4, 0.2);  // one cell of 1/2 on each side, cut 4 times
  ASSERT_EQ(x.size(), 11u);
  for (int k = 0; k <= 4; ++k) {
    EXPECT_NEAR(x[10 - k] - 0.5, 0.5 * std::pow(0.2, k), 1e-15);
    EXPECT_NEAR(0.5 - x[k], 0.5 * std::pow(0.2, k), 1e-15);
  }
}

TEST(TensorMesh, OfEqualLinesIsTheStructuredMesh) {
  const std::vector<double> x = graded_lines(0, 0, 1, 0.25, 0, 0.5);
  std::vector<double> y = graded_lines(-1, -1, 0, 0.25, 0, 0.5);
  y.insert(y.end(), x.begin() + 1, x.end());
  for (const Diagonal diagonal : {Diagonal::right, Diagonal::left, Diagonal::crossed}) {
    const TriangleMesh ours = tensor_mesh(x, y, diagonal), figure = structured_mesh(4, {}, diagonal);
    EXPECT_EQ(ours.vertices, figure.vertices);
    EXPECT_EQ(ours.triangles, figure.triangles);
    EXPECT_EQ(ours.region, figure.region);
    EXPECT_EQ(ours.edge_tag, figure.edge_tag);
  }
}

TEST(GradedMesh, FillsTheTwoSquaresWithTaggedSides) {
  for (const double epsilon : {1.0, 0.1, 1e-20, 0.0}) {
    const TriangleMesh mesh = graded_mesh(0.7, 1.0 / 3, 6, 0.25, epsilon);
    for (int t = 0; t < mesh.triangle_count(); ++t) ASSERT_GT(mesh.area(t), 0);
    EXPECT_NEAR(test::area(mesh, Region::body), 1, 1e-13);
    EXPECT_NEAR(test::area(mesh, Region::layer), 1, 1e-13);
    EXPECT_NEAR(test::length(mesh, EdgeTag::contact), 1, 1e-14);
    EXPECT_NEAR(test::length(mesh, EdgeTag::sigma), 1, 1e-14);
    EXPECT_NEAR(test::length(mesh, EdgeTag::clamped), 5, 1e-13);
  }
}

// Layers wider than epsilon have rows above Sigma, the others above Gamma_C: at epsilon = 1 all of them there, at 0 none.
TEST(GradedMesh, PutsARowWhereALayerIsFelt) {
  const auto lowest = [](const TriangleMesh& mesh, double above) {  // the height of the first row above a line
    double least = 1;
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 1) > above) least = std::min(least, mesh.vertices(v, 1) - above);
    return least;
  };
  for (const auto& [epsilon, in_body] : {std::pair{1.0, 0}, {0.1, 2}, {1e-2, 4}, {1e-6, 6}, {0.0, 6}}) {
    const TriangleMesh mesh = graded_mesh(0.5, 0.5, 6, 0.25, epsilon);
    EXPECT_NEAR(lowest(mesh, 0), 0.5 * std::pow(0.25, in_body), 1e-15) << epsilon;
    EXPECT_NEAR(lowest(mesh, -1), 0.5 * std::pow(0.25, 6 - in_body), 1e-15) << epsilon;
  }
}

// Columns, however narrow: G_h on the layer is every function of x, n p - 1 of them, for every degree.
TEST(GradedMesh, LeavesNoDegreeLocked) {
  const TriangleMesh mesh = graded_mesh(0.5, 0.5, 2, 0.25, 0.1);  // 6 columns
  for (int degree = 1; degree <= 6; ++degree) {
    const Space space(mesh, lagrange(degree));
    const VariationalInequality problem = test::stiff_problem(space, 0);
    EXPECT_EQ(layer_kernel_dimension(problem), 6 * degree - 1) << degree;
  }
}

TEST(GradedMesh, RefusesWhatHasNoMesh) {
  EXPECT_THROW(graded_lines(0, 1.5, 1, 0.1, 1, 0.5), Error);
  EXPECT_THROW(graded_lines(1, 1, 1, 0.1, 1, 0.5), Error);
  EXPECT_THROW(graded_lines(0, 0.5, 1, 0, 1, 0.5), Error);
  EXPECT_THROW(graded_lines(0, 0.5, 1, NAN, 1, 0.5), Error);
  EXPECT_THROW(graded_lines(0, 0.5, 1, 0.1, -1, 0.5), Error);
  EXPECT_THROW(graded_lines(0, 0.5, 1, 0.1, 61, 0.5), Error);
  EXPECT_THROW(graded_lines(0, 0.5, 1, 0.1, 1, 1), Error);
  EXPECT_THROW(tensor_mesh({0}, {0, 1}), Error);
  EXPECT_THROW(tensor_mesh({0, 1, 1}, {0, 1}), Error);
  EXPECT_THROW(tensor_mesh({0, 1}, {-1, 1}), Error);  // no line y = 0
  EXPECT_THROW(tensor_mesh({0, 1}, {-1, 0}), Error);  // no body
  EXPECT_THROW(tensor_mesh({0, 1}, {0, NAN}), Error);
  EXPECT_THROW(graded_mesh(0, 0.1, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 0.5, -1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 0.5, 2), Error);
}

}  // namespace antilock::test::graded_test

// The disc of the plate.
#include "antilock/mesh/families.hpp"
#include "support/measures.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::disc_test {

TEST(DiscMesh, IsADiscOfGoodTriangles) {
  for (const int n : {1, 2, 7, 20}) {
    const TriangleMesh mesh = disc_mesh(n);
    EXPECT_EQ(mesh.triangle_count(), 6 * n * n);
    EXPECT_EQ(mesh.vertex_count(), 3 * n * n + 3 * n + 1);
    // the polygon of 6 n corners
    EXPECT_NEAR(area(mesh, Region::body), 3 * n * std::sin(std::numbers::pi / (3 * n)), 1e-12);
    EXPECT_LT(angles(mesh).second, 95) << n;
    for (int e = 0; e < mesh.edge_count(); ++e)
      EXPECT_EQ(mesh.edge_tag[e] == EdgeTag::clamped, mesh.edge_triangles(e, 1) < 0);
  }
  EXPECT_THROW(disc_mesh(0), Error);
}

}  // namespace antilock::test::mesh_test::disc_test

// VTU.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "support/vtu_array.hpp"

namespace antilock::test::io_test::write_vtu_test {

/// Every tag closed, in order.
bool well_formed(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = text.find('<', 1); at != text.npos; at = text.find('<', at + 1)) {
    const std::string tag = text.substr(at + 1, text.find_first_of(" >", at) - at - 1);
    if (text[text.find('>', at) - 1] == '/' || tag[0] == '?') continue;  // closed in itself
    if (tag[0] != '/') {
      open.push_back(tag);
    } else {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(WriteVtu, P1SharesItsVerticesAndCrouzeixRaviartKeepsItsJumps) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = structured_mesh(3);
  const int triangles = mesh.triangle_count();
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const bool shared = element == &p1();
    const Space space(mesh, *element);
    const Eigen::VectorXd u = Eigen::VectorXd::Random(space.size());
    write_vtu(folder / "u.vtu", space, u);
    const std::string text = contents(folder / "u.vtu");
    EXPECT_TRUE(well_formed(text));
    EXPECT_EQ(text.rfind("<?xml version=\"1.0\"?>\n<VTKFile", 0), 0U);

    const auto value = vtu_array(text, "u"), region = vtu_array(text, "region"),
               point = vtu_array(text, "points"), corner = vtu_array(text, "connectivity"),
               offset = vtu_array(text, "offsets"), type = vtu_array(text, "types");
    EXPECT_EQ(value.size(), shared ? mesh.vertex_count() : 3U * triangles);
    ASSERT_EQ(point.size(), 3 * value.size());
    ASSERT_EQ(corner.size(), 3U * triangles);
    EXPECT_EQ(region.size(), triangles);
    EXPECT_EQ(type, std::vector<double>(triangles, 5));  // VTK_TRIANGLE
    for (int t = 0; t < triangles; ++t) {
      EXPECT_EQ(offset[t], 3 * (t + 1));
      EXPECT_EQ(region[t], static_cast<int>(mesh.region[t]));
      Eigen::Vector3d corners;
      for (int i = 0; i < 3; ++i) {
        const auto p = static_cast<std::size_t>(corner[3 * t + i]);
        corners(i) = value.at(p);
        EXPECT_EQ(point[3 * p], mesh.vertices(mesh.triangles(t, i), 0));
        EXPECT_EQ(point[3 * p + 1], mesh.vertices(mesh.triangles(t, i), 1));
      }
      // the affine function of the file takes u's values at the unknowns; 1e-14: three terms of
      // order 1
      const Eigen::Vector3d at_unknowns = element->support_points() * corners;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(at_unknowns(i), u(space.cell_dofs()(t, i)), 1e-14);
    }
  }
}

TEST(WriteVtu, WritesTetrahedraAndQuadrilaterals) {
  const TemporaryFolder folder;
  constexpr int vtk_quad = 9, vtk_tetra = 10;
  for (const CellKind kind : {CellKind::quadrilateral, CellKind::tetrahedron}) {
    const bool in_space = kind == CellKind::tetrahedron;
    const Mesh mesh = structured_mesh(2, {1, kind});
    std::vector<const Element*> elements{&q1()};
    if (in_space) elements = {&p1(kind), &p2(kind), &crouzeix_raviart(kind)};
    for (const Element* element : elements) {
      const Space space(mesh, *element);
      // u = x - 2 y (+ 3 z): its values at the points of the file are those of the formula
      const auto formula = [](double x, double y, double z) { return x - 2 * y + 3 * z; };
      write_vtu(folder / "u.vtu", space, dof_values(space, formula));
      const std::string text = contents(folder / "u.vtu");
      EXPECT_TRUE(well_formed(text));
      const auto value = vtu_array(text, "u"), point = vtu_array(text, "points"),
                 corner = vtu_array(text, "connectivity"), type = vtu_array(text, "types");
      const auto cells = static_cast<std::size_t>(mesh.triangle_count());
      EXPECT_EQ(type, std::vector<double>(cells, in_space ? vtk_tetra : vtk_quad));
      ASSERT_EQ(point.size(), 3 * value.size());
      ASSERT_EQ(corner.size(), 4 * cells);
      for (std::size_t k = 0; k < value.size(); ++k)
        EXPECT_NEAR(value[k], formula(point[3 * k], point[3 * k + 1], point[3 * k + 2]), 1e-14);
      for (std::size_t t = 0; t < cells; ++t)
        for (int i = 0; i < 4; ++i) {
          const auto p = static_cast<std::size_t>(corner[4 * t + static_cast<std::size_t>(i)]);
          const Eigen::RowVectorXd vertex =
              mesh.vertices.row(mesh.triangles(static_cast<Eigen::Index>(t), i));
          for (int k = 0; k < mesh.dimension(); ++k)
            EXPECT_EQ(point[3 * p + static_cast<std::size_t>(k)], vertex(k));
        }
    }
  }
}

TEST(WriteDeformedVtu, MovesEveryTriangleWithItsUnknowns) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = structured_mesh(3, Domain{0});
  const int triangles = mesh.triangle_count();
  const Space x(mesh, p1()), y(mesh, crouzeix_raviart());
  // u = (2x + y, -x/2), affine: in both spaces
  Eigen::VectorXd u(x.size() + y.size());
  u << 2 * x.dof_coordinates().col(0) + x.dof_coordinates().col(1),
      -0.5 * y.dof_coordinates().col(0);
  const Eigen::VectorXd pressure = Eigen::VectorXd::LinSpaced(triangles, 0, 1);
  write_deformed_vtu(folder / "u.vtu", {x, y}, u, pressure);
  const std::string text = contents(folder / "u.vtu");
  EXPECT_TRUE(well_formed(text));
  const auto point = vtu_array(text, "points"), moved = vtu_array(text, "displacement"),
             found = vtu_array(text, "pressure");
  ASSERT_EQ(point.size(), 9U * triangles);
  ASSERT_EQ(moved.size(), point.size());
  EXPECT_EQ(found, std::vector<double>(pressure.begin(), pressure.end()));
  for (int t = 0; t < triangles; ++t)
    for (int i = 0; i < 3; ++i) {
      const std::size_t at = 9U * t + 3U * i;
      const double vx = mesh.vertices(mesh.triangles(t, i), 0),
                   vy = mesh.vertices(mesh.triangles(t, i), 1);
      // 1e-14: a few terms of order 1
      EXPECT_NEAR(moved[at], 2 * vx + vy, 1e-14);
      EXPECT_NEAR(moved[at + 1], -0.5 * vx, 1e-14);
      EXPECT_NEAR(point[at], vx + moved[at], 1e-14);
      EXPECT_NEAR(point[at + 1], vy + moved[at + 1], 1e-14);
    }
  EXPECT_NE(refusal([&] {
              write_deformed_vtu(folder / "u.vtu", {x, y}, u, pressure.head(2));
            }),
            "");
}

}  // namespace antilock::test::io_test::write_vtu_test

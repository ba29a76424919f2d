// The three kinds of cells: their reference cells, their maps, their elements, and integrals on
// them.
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/cell_map.hpp"
#include "support/scenes.hpp"

namespace antilock::test::space_test::cells_test {

/// Exact in double precision but for a few round-offs of numbers of size 1.
constexpr double round_off = 1e-13;

std::vector<const Element*> elements() {
  constexpr CellKind in_space = CellKind::tetrahedron;
  return {&p1(),         &crouzeix_raviart(), &q1(),
          &p1(in_space), &p2(in_space),       &crouzeix_raviart(in_space)};
}

/// Meshes of body and layer, structured and with moved vertices.
std::vector<NamedMesh> meshes(CellKind kind, int cells) {
  const Domain domain{1, kind};
  return {{"structured", structured_mesh(cells, domain)},
          {"moved", jittered_mesh(cells, 0.15, domain)}};
}

/// The volume of body and layer is 2 in the plane and in space; the surface is 6 and 10.
double surface(const Mesh& mesh) { return mesh.dimension() == 2 ? 6 : 10; }

Eigen::VectorXd values(const Space& space, const std::function<double(const Eigen::VectorXd&)>& f) {
  Eigen::VectorXd u(space.size());
  for (int i = 0; i < space.size(); ++i) u(i) = f(space.dof_coordinates().row(i).transpose());
  return u;
}

TEST(Cells, FillTheDomainAndShareTheirFacets) {
  for (const CellKind kind : {CellKind::triangle, CellKind::quadrilateral, CellKind::tetrahedron}) {
    std::vector<NamedMesh> all = meshes(kind, 3);
    all.push_back({"gmsh", unstructured_mesh(3, {1, kind})});
    for (const auto& [name, mesh] : all) {
      double volume = 0, boundary = 0, contact = 0, sigma = 0;
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        ASSERT_GT(mesh.measure(t), 0) << name;
        volume += mesh.measure(t);
      }
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_triangles(e, 1) < 0) boundary += mesh.facet_measure(e);
        if (mesh.edge_tag[e] == EdgeTag::contact) contact += mesh.facet_measure(e);
        if (mesh.edge_tag[e] == EdgeTag::sigma) sigma += mesh.facet_measure(e);
      }
      EXPECT_NEAR(volume, 2, round_off) << name << mesh.reference().name;
      EXPECT_NEAR(boundary, surface(mesh), round_off) << name << mesh.reference().name;
      EXPECT_NEAR(contact, 1, round_off) << name << mesh.reference().name;
      EXPECT_NEAR(sigma, 1, round_off) << name << mesh.reference().name;
    }
  }
}

// The Jacobian of a quadrilateral is affine in s and t, and positive if it is so at the corners.
TEST(Cells, QuadrilateralsAreConvex) {
  constexpr CellKind kind = CellKind::quadrilateral;
  for (const Mesh& mesh : {jittered_mesh(8, 0.2, {1, kind}), unstructured_mesh(8, {1, kind})})
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; i < 4; ++i)
        EXPECT_GT(CellMap<kind>(mesh, t).at(reference_vertex(kind, i)).factor, 0);
}

TEST(Cells, RecombinedMeshesAreTheSameInEveryCall) {
  const Domain squares{1, CellKind::quadrilateral};
  const Mesh one = unstructured_mesh(4, squares), two = unstructured_mesh(4, squares);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.triangles, two.triangles);
}

// The order of the vertices of a facet gives the outward normal: the divergence theorem for the
// field x.
TEST(Cells, HaveFacetsWithOutwardNormals) {
  const Mesh mesh = structured_mesh(2, {1, CellKind::tetrahedron});
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    double flux = 0;
    for (const auto& [a, b, c] : mesh.reference().facet) {
      const Eigen::Vector3d x = mesh.vertices.row(mesh.triangles(t, a)),
                            y = mesh.vertices.row(mesh.triangles(t, b)),
                            z = mesh.vertices.row(mesh.triangles(t, c));
      flux += (y - x).cross(z - x).dot(x + y + z) / 6;  // normal times area, and the mean of x
    }
    EXPECT_NEAR(flux, 3 * mesh.measure(t), round_off);
  }
}

TEST(Cells, HaveNodalBasesThatSumToOne) {
  for (const Element* element : elements()) {
    const ReferencePoints nodes = element->support_points();
    ASSERT_EQ(nodes.rows(), element->dofs()) << element->name();
    for (Eigen::Index j = 0; j < nodes.rows(); ++j) {
      const Eigen::VectorXd phi = element->basis(nodes.row(j));
      EXPECT_LT((phi - Eigen::VectorXd::Unit(nodes.rows(), j)).cwiseAbs().maxCoeff(), round_off)
          << element->name();
      EXPECT_NEAR(phi.sum(), 1, round_off) << element->name();
    }
  }
}

TEST(Cells, HaveRulesOfTheDegreeThatIsAskedFor) {
  // int over the reference cell, divided by its measure: a! b! c! d! 3! / (a+b+c+d+3)! in space, 1
  // / ((a+1) (b+1)) on the square
  const auto factorial = [](int n) { return std::tgamma(n + 1); };
  for (int degree = 0; degree <= 12; ++degree) {
    const Quadrature& in_space = cell_rule(CellKind::tetrahedron, degree);
    const Quadrature& square = cell_rule(CellKind::quadrilateral, degree);
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b) {
        const int c = degree - a - b;
        double sum = 0, product = 0;
        for (Eigen::Index q = 0; q < in_space.weights.size(); ++q)
          sum += in_space.weights(q) * std::pow(in_space.points(q, 0), a) *
                 std::pow(in_space.points(q, 1), b) * std::pow(in_space.points(q, 3), c);
        for (Eigen::Index q = 0; q < square.weights.size(); ++q)
          product += square.weights(q) * std::pow(square.points(q, 0), a) *
                     std::pow(square.points(q, 1), b);
        EXPECT_NEAR(sum, 6 * factorial(a) * factorial(b) * factorial(c) / factorial(degree + 3),
                    round_off);
        EXPECT_NEAR(product, 1.0 / ((a + 1) * (b + 1)), round_off);
      }
  }
}

// The energy of w = x - 2 y (+ 3 z) is its constant |grad w|^2 times the volume, in A1 and, across
// the layer, in B.
TEST(Cells, GiveAffineFunctionsTheirEnergy) {
  for (const Element* element : elements())
    for (const auto& [name, mesh] : meshes(element->kind(), 3)) {
      const Space space(mesh, *element);
      const Eigen::VectorXd slope = Eigen::Vector3d(1, -2, 3).head(mesh.dimension());
      const Eigen::VectorXd w =
          values(space, [&](const Eigen::VectorXd& x) { return 0.5 + slope.dot(x); });
      const Eigen::SparseMatrix<double> form = gradient_form(space, {1, 1}, {1, 0});
      const double across = std::pow(slope(mesh.vertical()), 2), all = slope.squaredNorm();
      EXPECT_NEAR(w.dot(form * w), 2 * all - across, 100 * round_off) << name << element->name();
      const FactoredForm strain = layer_strain(space);
      EXPECT_NEAR((strain.b * w).cwiseAbs2().dot(strain.m), across, 100 * round_off)
          << name << element->name();
      EXPECT_NEAR(strain.m.sum(), 1, round_off) << name << element->name();
      const std::vector<Stiffness> unit(mesh.triangle_count(), {1, 1});
      const Eigen::SparseMatrix<double> whole = gradient_form(space, {1, 1}, {1, 1});
      EXPECT_LT((gram_matrix(gradient_rows(space, unit)) - whole).norm(), 1e-12 * whole.norm())
          << element->name();
    }
}

// |w|^2 + ||w||^2 of w = x - 2 y over (0, 1) x (-1, 1): 5 * 2 + int x^2 + 4 y^2 - 4 x y = 10 + 2/3 +
// 8/3.
TEST(Cells, GiveAffineFunctionsTheirNormOnQuadrilaterals) {
  for (const auto& [name, mesh] : meshes(CellKind::quadrilateral, 3))
    for (const Element* element : {&q1(), &rotated_q1_plus()}) {
      const Space space(mesh, *element);
      const Eigen::VectorXd w = dof_values(space, [](double x, double y) { return x - 2 * y; });
      EXPECT_NEAR(w.dot(h1_gram_matrix(space) * w), 40.0 / 3, 1000 * round_off)
          << name << element->name();
    }
}

TEST(Cells, IntegrateLoadsOnTheBodyAndOnFacets) {
  // int of f over the body, and of g over Gamma_C: the sums of the loads, since the bases sum to 1
  const Field f = [](double x, double y, double z) { return x * x + y * y * y + 2 * z; };
  const Field g = [](double x, double y) { return x * x + y; };
  for (const Element* element : elements())
    for (const auto& [name, mesh] : meshes(element->kind(), 2)) {
      const Space space(mesh, *element);
      const bool plane = mesh.dimension() == 2;
      EXPECT_NEAR(load_vector(space, f).sum(), 1.0 / 3 + 1.0 / 4 + (plane ? 0 : 1), round_off)
          << element->name();
      EXPECT_NEAR(edge_load(space, EdgeTag::contact, g).sum(), 1.0 / 3 + (plane ? -1 : 0.5),
                  round_off)
          << element->name();
    }
}

// Each side of a prism is cut alike by both neighbours: no face is left alone inside.
TEST(Cells, LayersOfPrismsAreConforming) {
  const Mesh mesh = layered_mesh(3, 1, CellKind::tetrahedron);
  double volume = 0, boundary = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    ASSERT_GT(mesh.measure(t), 0);
    volume += mesh.measure(t);
  }
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0) boundary += mesh.facet_measure(e);
  EXPECT_NEAR(volume, 2, round_off);
  EXPECT_NEAR(boundary, surface(mesh), round_off);
}

/// Euler's formula for a solid ball, V - E + F - T = 1, gives the number of edges.
int edges_by_euler(const Mesh& mesh) {
  return mesh.vertex_count() + mesh.edge_count() - mesh.triangle_count() - 1;
}

TEST(Cells, ShareEdgesInSpace) {
  expect_refused([] { cell_edges(structured_mesh(2)); }, "accepted: tetrahedra");
  for (const auto& [name, mesh] : meshes(CellKind::tetrahedron, 3)) {
    const CellEdges edges = cell_edges(mesh);
    EXPECT_EQ(edges.count, edges_by_euler(mesh)) << name;
    const Space space(mesh, p2(CellKind::tetrahedron));
    EXPECT_EQ(space.size(), mesh.vertex_count() + edges.count) << name;
  }
}

// u = x^2 - x y + 2 z is in P2. int |grad u|^2 over (0,1)^2 x (-1,1), grad u = (2 x - y, -x, 2):
// 2 (int (2 x - y)^2 + int x^2 + 4) = 2 (4/3 - 1 + 1/3 + 1/3 + 4) = 10.
TEST(Cells, GiveQuadraticsTheirEnergyInP2) {
  for (const auto& [name, mesh] : meshes(CellKind::tetrahedron, 3)) {
    const Space space(mesh, p2(CellKind::tetrahedron));
    const Eigen::VectorXd u = values(
        space, [](const Eigen::VectorXd& x) { return x(0) * x(0) - x(0) * x(1) + 2 * x(2); });
    EXPECT_NEAR(u.dot(gradient_form(space, {1, 1}, {1, 1}) * u), 10, 100 * round_off) << name;
  }
}

// On the bottom of the layer 3 x 3 squares, each cut by a diagonal: what is not on its rim.
TEST(Cells, HaveContactUnknownsOnFaces) {
  const Mesh mesh = structured_mesh(3, {1, CellKind::tetrahedron});
  EXPECT_EQ(Space(mesh, p1(mesh.kind)).contact_dofs().size(), 4U);
  EXPECT_EQ(Space(mesh, crouzeix_raviart(mesh.kind)).contact_dofs().size(), 18U);
  // the midpoints of 33 edges of the squares, 12 of them on the rim, and the 4 vertices
  EXPECT_EQ(Space(mesh, p2(mesh.kind)).contact_dofs().size(), 25U);
}

TEST(Cells, AreRefusedWhereTheElementIsOfAnotherKind) {
  expect_refused([] { Space(structured_mesh(2), q1()); }, "accepted: both of one kind");
  expect_refused(
      [] {
        Space(structured_mesh(2, {1, CellKind::tetrahedron}), p1());
      },
      "accepted: both of one kind");
  expect_refused([] { p1(CellKind::quadrilateral); }, "accepted: Q1");
  expect_refused([] { lagrange(2, CellKind::quadrilateral); }, "accepted: Q1");
  expect_refused([] { lagrange(3, CellKind::tetrahedron); }, "1 to 2");
  expect_refused([] { element("P3", CellKind::tetrahedron); },
                 "accepted \"P1\", \"P2\" and \"CR\"");
  expect_refused([] { element("P1", CellKind::quadrilateral); }, "accepted \"Q1\"");
  expect_refused([] { structured_mesh(129, {1, CellKind::tetrahedron}); }, "accepted 1 to 128");
  expect_refused([] { unstructured_mesh(129, {1, CellKind::quadrilateral}); }, "accepted 1 to 128");
}

}  // namespace antilock::test::space_test::cells_test

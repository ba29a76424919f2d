// What makes an element an element, and the numbering that joins them.
#include "antilock/space/space.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "support/scenes.hpp"

namespace antilock::test::space_test::space_test {

std::vector<const Element*> elements() {
  return {
      &p1(),        &p2(),         &p3(), &p4(), &lagrange(5), &lagrange(6), &crouzeix_raviart(),
      &p1_bubble(), &hybrid_bdm1()};
}

/// The value of each unknown for a function of the barycentric coordinates.
Eigen::VectorXd dofs_of(const Element& element,
                        const std::function<Eigen::VectorXd(const Eigen::Vector3d&)>& v,
                        Eigen::Index component = 0) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(element.dofs());
  for (int i = 0; i < element.dofs(); ++i) {
    const DofFunctional functional = element.functional(i);
    for (Eigen::Index q = 0; q < functional.weights.size(); ++q)
      values(i) += functional.weights(q) * v(functional.points.row(q))(component);
  }
  return values;
}

/// Points in and on the triangle, irregular.
std::vector<Eigen::Vector3d> sample_points() {
  return {{1, 0, 0},       {0.5, 0.5, 0},     {1.0 / 3, 1.0 / 3, 1.0 / 3},
          {0.2, 0.7, 0.1}, {0.05, 0.15, 0.8}, {0, 0.3, 0.7}};
}

/// Exact in double precision but for a few round-offs of numbers of size 1.
constexpr double round_off = 1e-14;

TEST(Element, BasisIsDualToItsFunctionals) {
  for (const Element* element : elements()) {
    const Eigen::MatrixX3d nodes = element->support_points();
    ASSERT_EQ(nodes.rows(), element->dofs()) << element->name();
    for (Eigen::Index j = 0; j < nodes.rows(); ++j) {
      EXPECT_NEAR(nodes.row(j).sum(), 1, round_off) << element->name();
      const Eigen::VectorXd of_phi = dofs_of(
          *element, [&](const Eigen::Vector3d& at) { return element->basis(at); }, j);
      const Eigen::VectorXd delta = Eigen::VectorXd::Unit(nodes.rows(), j);
      EXPECT_LT((of_phi - delta).cwiseAbs().maxCoeff(), round_off)
          << element->name() << " of function " << j;
      const Eigen::VectorXd of_affine = dofs_of(
          *element, [&](const Eigen::Vector3d& at) { return Eigen::VectorXd(at); }, j % 3);
      EXPECT_LT((of_affine - nodes.col(j % 3)).cwiseAbs().maxCoeff(), round_off) << element->name();
    }
  }
}

TEST(Element, ReproducesPolynomialsOfItsDegree) {
  const auto polynomial = [](const Eigen::RowVector3d& l, int degree) {
    const double linear = 0.3 + 1.7 * l(0) - 2.1 * l(1);
    return degree == 2 ? linear + 0.9 * l(0) * l(0) - 1.3 * l(0) * l(1) + 0.4 * l(1) * l(1)
                       : linear;
  };
  for (const Element* element : elements()) {
    const Eigen::MatrixX3d nodes = element->support_points();
    Eigen::VectorXd values(nodes.rows());
    // degree() is that of the quadrature; unknowns at vertices, or one per edge, hold affine
    // functions alone
    const int degree =
        (element->conforming() && element->dofs_per_edge() > 0) || element == &hybrid_bdm1() ? 2
                                                                                             : 1;
    const auto of_point = [&](const Eigen::Vector3d& at) {
      return Eigen::VectorXd::Constant(1, polynomial(at.transpose(), degree));
    };
    values = dofs_of(*element, of_point);
    for (const Eigen::Vector3d& at : sample_points()) {
      EXPECT_NEAR(element->basis(at).sum(), 1, round_off) << element->name();
      EXPECT_NEAR(values.dot(element->basis(at)), polynomial(at.transpose(), degree), round_off)
          << element->name();
    }
  }
}

TEST(Element, DerivativeIsTheDerivativeOfTheBasis) {
  // central differences: round-off / step to degree 2; then step^2 / 6 times the third derivative,
  // below 5,000 to degree 6
  constexpr double step = 1e-5;
  for (const Element* element : elements()) {
    if (!element->nodal()) continue;  // its derivative is projected: hybrid_bdm1_test.cpp
    for (const Eigen::Vector3d& at : sample_points()) {
      const Eigen::MatrixX3d d = element->derivative(at);
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector3d e = Eigen::Vector3d::Unit(j) * step;
        const Eigen::VectorXd difference =
            (element->basis(at + e) - element->basis(at - e)) / (2 * step);
        EXPECT_LT((difference - d.col(j)).cwiseAbs().maxCoeff(),
                  element->degree() <= 2 ? 1e-9 : 1e-7)
            << element->name();
      }
    }
  }
}

TEST(Element, ABubbleIsNothingOnTheEdgesAndHasItsMean) {
  // 27 lambda_0 lambda_1 lambda_2: 1 at the centroid, mean 27 * 2 / 5! = 9/20. Without it the
  // element is P1.
  const Quadrature& rule = triangle_rule(3);
  double mean = 0;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    mean += rule.weights(q) * p1_bubble().basis(rule.points.row(q))(3);
  EXPECT_NEAR(mean, 9.0 / 20, round_off);
  for (const Eigen::Vector3d& at : sample_points()) {
    const Eigen::Vector3d on_edge(0, at(1) / (at(1) + at(2) + 1e-300),
                                  at(2) / (at(1) + at(2) + 1e-300));
    EXPECT_EQ(p1_bubble().basis(on_edge)(3), 0);
    EXPECT_LT((p1_bubble().basis(on_edge).head<3>() - on_edge).norm(), round_off);
    const Eigen::VectorXd phi = p1_bubble().basis(at);
    EXPECT_LT((phi.head<3>().array() + phi(3) / 3 - at.array()).matrix().norm(), round_off);
  }
}

TEST(Element, IsFoundByNameAndUnknownNamesAreRefused) {
  for (const Element* one : elements()) EXPECT_EQ(&element(one->name()), one);
  EXPECT_EQ(&element("M2"), &hybrid_bdm1());
  for (const char* name : {"", "p1", "Q1"})
    test::expect_refused([&] { element(name); }, "accepted \"P1\"");
  for (int k = 1; k <= 6; ++k) EXPECT_EQ(lagrange(k).degree(), k);
  for (const int k : {0, 7}) test::expect_refused([&] { lagrange(k); }, "accepted; 1 to 6");
}

TEST(Space, BarycentricGradientsDifferentiateTheCoordinates) {
  for (const auto& [name, mesh] : test::two_square_meshes(4))
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      Eigen::Matrix<double, 3, 2> corners;
      for (int i = 0; i < 3; ++i) corners.row(i) = mesh.vertices.row(mesh.triangles(t, i));
      // x = sum_i lambda_i x_i, so sum_i x_i grad lambda_i is the identity
      const Eigen::Matrix2d identity = corners.transpose() * barycentric_gradients(mesh, t);
      ASSERT_LT((identity - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), 1e-12) << name;
    }
}

TEST(Space, PointInMapsCornersAndCentroid) {
  const TriangleMesh mesh = unstructured_mesh(3);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    Eigen::RowVector2d mean = Eigen::RowVector2d::Zero();
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector2d corner = mesh.vertices.row(mesh.triangles(t, i));
      ASSERT_EQ(point_in(mesh, t, Eigen::Vector3d::Unit(i)).transpose(), corner);
      mean += corner / 3;
    }
    ASSERT_LT((point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3)).transpose() - mean).norm(),
              round_off);
  }
}

TEST(Space, UnknownsSitWhereTheirElementSays) {
  for (const NamedSpace& space : two_square_spaces(5, elements())) {
    EXPECT_EQ(space.size(), space.element().dofs_per_vertex() * space.mesh().vertex_count() +
                                space.element().dofs_per_edge() * space.mesh().edge_count() +
                                space.element().dofs_per_cell() * space.mesh().triangle_count());
    std::set<int> met;
    for (int t = 0; t < space.mesh().triangle_count(); ++t)
      for (int i = 0; i < space.element().dofs(); ++i) {
        const int unknown = space.cell_dofs()(t, i);
        met.insert(unknown);
        // neighbours agree on the place, whichever of them looks
        const Eigen::Vector2d here =
            point_in(space.mesh(), t, space.element().support_points().row(i));
        ASSERT_LT((space.dof_coordinates().row(unknown).transpose() - here).norm(), round_off)
            << space.name;
      }
    EXPECT_EQ(static_cast<int>(met.size()), space.size()) << space.name;
  }
}

// A mesh lives as long as a space on it, wherever the space goes, and is not copied on the way.
TEST(Space, SharesItsMesh) {
  TriangleMesh mesh = structured_mesh(4);
  const double* const vertices = mesh.vertices.data();
  std::vector<Space> kept;
  {
    const Space space(std::move(mesh), p1());
    kept = {space, Space(space, crouzeix_raviart()), Space(space.shared_mesh(), p2())};
    EXPECT_EQ(&kept.front().dof_coordinates(),
              &space.dof_coordinates());  // a copy shares its numbering
  }
  EXPECT_EQ(kept.front().mesh().vertices.data(), vertices);
  for (const Space& space : kept) {
    EXPECT_EQ(&space.mesh(), &kept.front().mesh());
    EXPECT_TRUE(have_one_mesh(space, kept.front()));
  }
  EXPECT_EQ(kept[0].size(), kept[0].mesh().vertex_count());
  EXPECT_EQ(kept[1].size(), kept[0].mesh().edge_count());
}

TEST(Space, MeshesAreOneWhereTheyAreEqual) {
  const TriangleMesh mesh = structured_mesh(4);
  TriangleMesh moved = mesh, tagged = mesh;
  moved.vertices(0, 0) += 1e-9;
  tagged.edge_tag.front() = dirichlet_group(0);
  const Space space(mesh, p1());
  EXPECT_TRUE(have_one_mesh(space, Space(mesh, crouzeix_raviart())));  // copied twice
  for (const TriangleMesh& other :
       {moved, tagged, structured_mesh(5), structured_mesh(4, {}, Diagonal::left)})
    EXPECT_FALSE(have_one_mesh(space, Space(other, p1())));
}

TEST(Space, CrouzeixRaviartUnknownsAreEdgeMidpoints) {
  const TriangleMesh mesh = unstructured_mesh(5);
  const Space space(mesh, crouzeix_raviart());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const Eigen::RowVector2d middle =
        0.5 * (mesh.vertices.row(mesh.edges(e, 0)) + mesh.vertices.row(mesh.edges(e, 1)));
    ASSERT_LT((space.dof_coordinates().row(e) - middle).norm(), round_off);
  }
}

// Its basis is that of Crouzeix-Raviart, which the tests above check; the numbering is its own.
TEST(Space, DiscontinuousP1SharesNoUnknown) {
  const TriangleMesh mesh = unstructured_mesh(5);
  const Space space(mesh, discontinuous_p1());
  ASSERT_EQ(space.size(), 3 * mesh.triangle_count());
  std::set<int> met(space.cell_dofs().data(), space.cell_dofs().data() + space.cell_dofs().size());
  EXPECT_EQ(static_cast<int>(met.size()), space.size());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto edge = mesh.edges.row(mesh.triangle_edges(t, i));
      const Eigen::RowVector2d middle =
          0.5 * (mesh.vertices.row(edge(0)) + mesh.vertices.row(edge(1)));
      ASSERT_LT((space.dof_coordinates().row(space.cell_dofs()(t, i)) - middle).norm(), round_off);
    }
  EXPECT_TRUE(space.dirichlet_dofs().empty());  // its form imposes u = 0
  EXPECT_EQ(space.contact_dofs().size(), 5U);
}

TEST(Space, ConformingElementsAreContinuousCrouzeixRaviartOnlyAtMidpoints) {
  const TriangleMesh mesh = unstructured_mesh(4);
  for (const Element* element : elements()) {
    if (element == &hybrid_bdm1())
      continue;  // its weighted means are continuous: hybrid_bdm1_test.cpp
    const Space space(mesh, *element);
    const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(space.size(), 0, 1).array().sin();
    double jump_at_ends = 0, jump_at_middle = 0;
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (mesh.edge_triangles(e, 1) < 0) continue;
      for (const double s : {0.0, 0.5, 0.8}) {
        double value[2];
        for (int side = 0; side < 2; ++side) {
          const int t = mesh.edge_triangles(e, side);
          Eigen::Vector3d at = Eigen::Vector3d::Zero();
          for (int i = 0; i < 3; ++i) {
            if (mesh.triangles(t, i) == mesh.edges(e, 0)) at(i) = 1 - s;
            if (mesh.triangles(t, i) == mesh.edges(e, 1)) at(i) = s;
          }
          value[side] = element->basis(at).dot(u(space.cell_dofs().row(t)));
        }
        double& jump = s == 0.5 ? jump_at_middle : jump_at_ends;
        jump = std::max(jump, std::abs(value[0] - value[1]));
      }
    }
    EXPECT_LT(jump_at_middle, 1e-13) << element->name();
    if (element == &crouzeix_raviart())
      EXPECT_GT(jump_at_ends, 1e-2);
    else
      EXPECT_LT(jump_at_ends, 1e-13) << element->name();
  }
}

TEST(Space, ClampedAndContactUnknownsAreThoseOnTheirEdges) {
  for (const NamedSpace& space : two_square_spaces(6, elements())) {
    std::vector<int> clamped, contact;
    for (int i = 0; i < space.size(); ++i) {
      const double x = space.dof_coordinates()(i, 0), y = space.dof_coordinates()(i, 1);
      if (x == 0 || x == 1 || y == 1)
        clamped.push_back(i);
      else if (y == -1)
        contact.push_back(i);
    }
    std::sort(contact.begin(), contact.end(), [&](int a, int b) {
      return space.dof_coordinates()(a, 0) < space.dof_coordinates()(b, 0);
    });
    EXPECT_EQ(space.dirichlet_dofs(), clamped) << space.name;
    EXPECT_EQ(space.contact_dofs(), contact) << space.name;
    EXPECT_EQ(space.free_count(), space.size() - static_cast<int>(clamped.size()));
    const int vertices = space.element().dofs_per_vertex() * 5,
              midpoints = space.element().dofs_per_edge() * 6;
    EXPECT_EQ(static_cast<int>(contact.size()), vertices + midpoints) << space.name;
  }
}

}  // namespace antilock::test::space_test::space_test

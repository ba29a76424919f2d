// The constraints between two meshes that do not match.
#include "antilock/form/mortar.hpp"

#include "antilock/mesh/quadrature.hpp"
#include "support/scenes.hpp"
#include "support/two_bodies.hpp"

namespace antilock::test::form_test::mortar_test {

constexpr InterfaceMethod mortar = InterfaceMethod::mortar;
constexpr InterfaceMethod node_to_segment = InterfaceMethod::node_to_segment;

/// Calls `act` for both methods and elements, with either side as the slave, on random meshes.
template <class Act>
void for_all_constraints(bool free_sides, const Act& act) {
  std::mt19937 random(7);
  for (const auto& [upper, lower] : {std::pair(3, 7), {7, 3}, {8, 8}, {1, 5}, {16, 11}}) {
    const TriangleMesh mesh = random_bodies(upper, lower, random, free_sides);
    for (const Element* element : {&p1(), &crouzeix_raviart()})
      for (const InterfaceMethod method : {mortar, node_to_segment})
        for (const bool upper_slave : {true, false}) {
          const Space space(mesh, *element);
          const EdgeTag slave = upper_slave ? upper_side : lower_side;
          const EdgeTag master = upper_slave ? lower_side : upper_side;
          // P1 has no free unknown on one clamped edge
          const bool none = element == &p1() && !free_sides && (upper_slave ? upper : lower) == 1;
          if (none) continue;
          SCOPED_TRACE(fmt::format("{} and {} cells, {}, {}, slave {}", upper, lower,
                                   element->name(), method == mortar ? "mortar" : "node to segment",
                                   upper_slave ? "above" : "below"));
          act(space, interface_constraints(space, slave, master, method), upper_slave);
        }
  }
}

TEST(Mortar, HasNoJumpForAffineFunctions) {
  for (const bool free_sides : {true, false})
    for_all_constraints(
        free_sides, [](const Space& space, const InterfaceConstraints& found, bool) {
          for (const Eigen::Vector3d& c : {Eigen::Vector3d(1, 0, 0), {0, 1, 0}, {3, -2, 5}}) {
            const Eigen::VectorXd u =
                dof_values(space, [&](double x, double y) { return c(0) + c(1) * x + c(2) * y; });
            EXPECT_LT((found.jump * u).lpNorm<Eigen::Infinity>(), 1e-13 * c.lpNorm<1>());
          }
        });
}

TEST(Mortar, ItsRowsAreMeansOfEachSide) {
  for (const bool free_sides : {true, false})
    for_all_constraints(
        free_sides, [](const Space& space, const InterfaceConstraints& found, bool upper_slave) {
          const Eigen::VectorXd sums = found.jump * in_upper_body(space);
          const double wanted = upper_slave ? 1 : -1;
          EXPECT_LT((sums.array() - wanted).abs().maxCoeff(), 1e-13);
          const Eigen::VectorXd of_means = found.means * Eigen::VectorXd::Ones(found.means.cols());
          EXPECT_LT((of_means.array() - 1).abs().maxCoeff(), 1e-13);
          EXPECT_GT(found.lengths.minCoeff(), 0);
          EXPECT_EQ(found.normal(1), upper_slave ? -1 : 1);
          for (Eigen::Index i = 1; i < found.places.rows(); ++i)
            EXPECT_LT(found.places(i - 1, 0), found.places(i, 0));
        });
}

TEST(Mortar, AConstantPressureGivesConsistentForces) {
  // sum_i lengths_i row_i v = int [v] for every v, since the psi_i sum to 1
  for (const bool free_sides : {true, false})
    for_all_constraints(free_sides, [](const Space& space, const InterfaceConstraints& found,
                                       bool upper_slave) {
      if (found.points.rows() == found.places.rows()) return;  // node to segment
      Eigen::VectorXd integral = Eigen::VectorXd::Zero(space.size());
      const TriangleMesh& mesh = space.mesh();
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_tag[e].group < 0) continue;
        const int t = mesh.edge_triangles(e, 0);
        const double sign = (mesh.edge_tag[e] == upper_side) == upper_slave ? 1 : -1;
        integral(space.cell_dofs().row(t)) +=
            sign * mesh.edge_length(e) * means_on_facet(space.element(), local_edge(mesh, t, e));
      }
      EXPECT_LT((found.jump.transpose() * found.lengths - integral).lpNorm<Eigen::Infinity>(),
                1e-14);
      EXPECT_NEAR(found.lengths.sum(), 1, 1e-14);
    });
}

TEST(Mortar, TheDualBasisIsDiagonalOnTheSlaveSide) {
  std::mt19937 random(3);
  const Space space(random_bodies(6, 9, random, true), p1());
  const InterfaceConstraints found = interface_constraints(space, upper_side, lower_side, mortar);
  const int of_upper = 6 * 6 + 7 * 7;  // vertices, those at the centres of cells too
  for (Eigen::Index row = 0; row < found.jump.rows(); ++row) {
    int entries = 0;
    for (RowMatrix::InnerIterator entry(found.jump, row); entry; ++entry)
      if (entry.col() < of_upper) ++entries;
    EXPECT_EQ(entries, 1);
  }
}

TEST(Mortar, OnMatchingSidesItIsTheDifferenceOfTheUnknowns) {
  const TriangleMesh square = with_free_sides(unstructured_mesh(5, {0}));
  for (const Element* element : {&p1(), &crouzeix_raviart()})
    for (const InterfaceMethod method : {mortar, node_to_segment}) {
      const Space space(two_body_mesh(square, square), *element), one(square, *element);
      const InterfaceConstraints found =
          interface_constraints(space, upper_side, lower_side, method);
      ASSERT_EQ(found.jump.rows(), static_cast<Eigen::Index>(one.contact_dofs().size()));
      for (Eigen::Index row = 0; row < found.jump.rows(); ++row) {
        EXPECT_EQ(found.jump.row(row).nonZeros(), 2);
        EXPECT_NEAR(found.jump.row(row).norm(), std::sqrt(2.0), 1e-13);
        EXPECT_NEAR(found.jump.coeff(row, one.contact_dofs()[row]), 1, 1e-13);
      }
    }
}

TEST(Mortar, AMeanOfAQuadraticIsExact) {
  // for Crouzeix-Raviart the mean of x^2 over (a, b) is (a^2 + a b + b^2) / 3
  std::mt19937 random(11);
  const Space space(random_bodies(5, 8, random, true), crouzeix_raviart());
  const InterfaceConstraints found = interface_constraints(space, lower_side, upper_side, mortar);
  const Eigen::VectorXd squares = found.points.col(0).cwiseAbs2();
  const Eigen::VectorXd means = found.means * squares;
  for (Eigen::Index i = 0; i < means.size(); ++i) {
    const double middle = found.places(i, 0), half = found.lengths(i) / 2;
    EXPECT_NEAR(means(i), middle * middle + half * half / 3, 1e-14);
  }
}

TEST(Mortar, RefusesSidesThatAreNoInterface) {
  const TriangleMesh square = structured_mesh(4, {0});
  const TriangleMesh good = two_body_mesh(square, square);
  const auto refused = [](const TriangleMesh& mesh, EdgeTag slave, EdgeTag master,
                          const std::string& words, const Element& element = p1()) {
    expect_refused([&] { interface_constraints(Space(mesh, element), slave, master, mortar); },
                   words);
  };
  refused(good, upper_side, lower_side, "P2 is not accepted", p2());
  refused(good, upper_side, upper_side, "one group");
  refused(good, upper_side, natural_group(7), "no edge is on the master side");
  refused(good, natural_group(7), upper_side, "no edge is on the slave side");
  TriangleMesh spoilt = good;
  for (int v = 0; v < good.vertex_count(); ++v)
    if (good.vertices(v, 0) == 0.5 && good.vertices(v, 1) == 0) {
      spoilt = good;
      spoilt.vertices(v, 1) = 1e-3;
      refused(spoilt, upper_side, lower_side, "off the line");
    }
  spoilt = good;
  for (int e = 0; e < good.edge_count(); ++e)
    if (good.edge_tag[e] == lower_side && good.vertices(good.edges(e, 0), 0) >= 0.5)
      spoilt.edge_tag[e] = EdgeTag::free;
  refused(spoilt, upper_side, lower_side, "the master edges cover 0 of the slave edge");
  EXPECT_NO_THROW(interface_constraints(Space(spoilt, p1()), lower_side, upper_side, mortar));
  spoilt = good;
  for (int v = 0; v < square.vertex_count(); ++v) {
    double& x = spoilt.vertices(v, 0);
    if (x == 0)
      x = -1e-7;  // beside the master
    else if (x == 0.25)
      x = 0;
  }
  refused(spoilt, upper_side, lower_side, "the master edges cover 0 of the slave edge");
  const TriangleMesh free_square = with_free_sides(square);
  spoilt = two_body_mesh(free_square, free_square);
  const auto corner = [&](int begin) {
    int v = begin;
    while (spoilt.vertices.row(v).norm() > 0) ++v;
    return v;
  };
  const int upper = corner(0), lower = corner(square.vertex_count());
  for (int& v : spoilt.triangles.reshaped())
    if (v == lower) v = upper;
  for (int& v : spoilt.edges.reshaped())
    if (v == lower) v = upper;
  refused(spoilt, upper_side, lower_side, "the vertex at (0, 0) is on both sides");
  // the same body on both sides
  spoilt = good;
  for (int e = 0; e < good.edge_count(); ++e)
    if (good.edge_tag[e] == upper_side && good.vertices(good.edges(e, 0), 0) >= 0.5)
      spoilt.edge_tag[e] = natural_group(5);
  refused(spoilt, upper_side, natural_group(5), "on one side of their line");
  refused(two_body_mesh(structured_mesh(1, {0}), square), upper_side, lower_side,
          "every slave unknown is prescribed");
}

}  // namespace antilock::test::form_test::mortar_test

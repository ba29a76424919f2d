// One question, several models: the change of variable between (22) and (23), the limit (24)
// against (25), and the body alone against a reference of its own. Loads and obstacles are those of
// the figures.
#include "antilock/exact/exact_solution.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::agreement_test {

struct Result {
  Eigen::MatrixX3d table;  ///< x, gap, pressure
  Eigen::VectorXd u;
  std::vector<bool> active;
  double energy, from;
};

Result answer(const Layer& layer, const TriangleMesh& mesh, const Element& element) {
  const Space space(mesh, element);
  const VariationalInequality problem =
      assemble(Scene({paper_load}, layer, UnilateralContact{}), space);
  const Solution s = active_set(problem);
  return {contact_table({space, problem, s}), s.u, s.active, energy(problem, s),
          contact_zone({space, problem, s}).from.value_or(2)};
}

TriangleMesh mesh_of(bool regular, int cells, double depth) {
  return regular ? structured_mesh(cells, {depth}) : unstructured_mesh(cells, {depth});
}

/// The layer of a mesh for (23) pressed to its true depth: y -> epsilon y below Sigma.
TriangleMesh squashed(TriangleMesh mesh, double epsilon) {
  for (auto vertex : mesh.vertices.rowwise())
    if (vertex(1) < 0) vertex(1) *= epsilon;
  return mesh;
}

using Discretisation = std::tuple<bool, const Element*>;  // structured or not, element
class Models : public testing::TestWithParam<Discretisation> {
 protected:
  bool regular() const { return std::get<0>(GetParam()); }
  const Element& element() const { return *std::get<1>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(All, Models,
                         testing::Combine(testing::Bool(),
                                          testing::Values(&p1(), &crouzeix_raviart())),
                         [](const auto& info) {
                           return std::get<1>(info.param)->name() +
                                  (std::get<0>(info.param) ? "Structured" : "Unstructured");
                         });

TEST_P(Models, TheChangeOfVariableIsExactOnCorrespondingMeshes) {
  // An affine map of the layer takes (22) to (23) term by term, P1 to P1 and CR to CR: not an
  // approximation.
  const TriangleMesh mesh = mesh_of(regular(), 16, 1);
  for (const double epsilon : {1e-1, 1e-2, 1e-3}) {
    const Result scaled = answer(StiffLayer{epsilon}, mesh, element());
    const Result thin = answer(ThinLayer{epsilon}, squashed(mesh, epsilon), element());
    // measured 6e-10 at most: (22) is one Cholesky solve of a matrix of condition epsilon^-2 h^-2 =
    // 3e8, (23) stops at 1e-10
    EXPECT_LE((thin.u - scaled.u).cwiseAbs().maxCoeff(), 1e-8 * scaled.u.cwiseAbs().maxCoeff())
        << epsilon;
    EXPECT_EQ(thin.active, scaled.active) << epsilon;
    EXPECT_NEAR(thin.energy, scaled.energy, 1e-8) << epsilon;
  }
}

// Both elements in one test: gmsh takes seconds for a mesh that follows a thin layer.
class OwnMeshes : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(All, OwnMeshes, testing::Bool(), [](const auto& info) {
  return info.param ? "Structured" : "Unstructured";
});

TEST_P(OwnMeshes, ThinAndScaledAgreeOnTheirOwnMeshesUpToDiscretisation) {
  const bool regular = GetParam();
  constexpr int cells = 32;
  constexpr double h = 1.0 / cells;
  const TriangleMesh scaled_mesh = mesh_of(regular, cells, 1);
  for (const double epsilon : {1e-1, 1e-2, 1e-3}) {
    const ExactSolution exact(paper_sine_load(), epsilon, true, 12);
    const double exact_from = exact.contact_zones().front().first;
    const TriangleMesh thin_mesh = mesh_of(regular, cells, epsilon);
    for (const Element* element : {&p1(), &crouzeix_raviart()}) {
      SCOPED_TRACE(fmt::format("{} at epsilon = {:g}", element->name(), epsilon));
      const Result thin = answer(ThinLayer{epsilon}, thin_mesh, *element);
      // energies miss the exact one by 2.6 h^2 (P1), 0.75 h^2 (CR) on structured meshes, less on
      // the others
      EXPECT_NEAR(thin.energy, exact.energy(), 3 * h * h);
      EXPECT_NEAR(thin.from, exact_from, 1.5 * h);
      if (!regular && element == &p1())
        continue;  // scaled P1 locks on such meshes, thin P1 need not
      const Result scaled = answer(StiffLayer{epsilon}, scaled_mesh, *element);
      EXPECT_NEAR(thin.energy, scaled.energy,
                  0.5 * h * h);  // the layer holds a small part of the error
      EXPECT_NEAR(thin.from, scaled.from, 1.5 * h);
    }
  }
}

TEST_P(Models, VentcelConvergesWithOrderTwo) {
  const ExactSolution exact(paper_sine_load(), 0, true, 12);
  std::vector<double> h, error, energy_error;
  for (const int cells : {8, 16, 32, 64}) {
    const Result a = answer(VentcelLayer{}, mesh_of(regular(), cells, 0), element());
    double worst = 0;
    for (Eigen::Index i = 0; i < a.table.rows(); ++i)
      worst = std::max(worst, std::abs(a.table(i, 1) - exact.value(a.table(i, 0), 0)));
    h.push_back(1.0 / cells);
    error.push_back(worst);
    energy_error.push_back(std::abs(a.energy - exact.energy()));
  }
  EXPECT_NEAR(slope(h, energy_error), 2, 0.1);
  // pointwise on Sigma; the end of the contact zone falls differently into its cell on every mesh,
  // hence the margin
  EXPECT_NEAR(slope(h, error), 2, 0.4);
  EXPECT_LE(error.back(), 8e-5);
  EXPECT_LE(energy_error.back(), 1e-3);
}

TEST(RigidLimit, OfCrouzeixRaviartAgreesWithVentcelOnAnyMesh) {
  // without columns the two differ by their discretisation errors: energies 1.1 h^2 each
  constexpr int cells = 32;
  const Result ventcel = answer(VentcelLayer{}, unstructured_mesh(cells, {0}), crouzeix_raviart());
  const Result limit = answer(StiffLayer{0}, unstructured_mesh(cells), crouzeix_raviart());
  EXPECT_NEAR(ventcel.energy, limit.energy, 0.1 / (cells * cells));
  EXPECT_NEAR(ventcel.from, limit.from, 2.0 / cells);
}

/// The body alone on an obstacle at Sigma, by collocation: with the sine transform everything is a
/// problem for c = u(., 0) on n points,  c >= 0, D c - q >= 0, complementary,  D_k = a coth a,  q =
/// 10 tanh(a / 2) / a sin(2 pi x), solved by projected Gauss-Seidel, which shares nothing with the
/// library.
Eigen::VectorXd obstacle_reference(int n) {
  constexpr double pi = std::numbers::pi;
  Eigen::MatrixXd sines(n, n);
  Eigen::VectorXd symbol(n), q(n);
  for (int k = 1; k <= n; ++k) {
    symbol(k - 1) = k * pi / std::tanh(k * pi);
    q(k - 1) = 10 * std::tanh(pi) / (2 * pi) * std::sin(2 * pi * k / (n + 1));
    for (int j = 1; j <= n; ++j)
      sines(j - 1, k - 1) = std::sqrt(2.0 / (n + 1)) * std::sin(pi * j * k / (n + 1));
  }
  const Eigen::MatrixXd d = test::gram(sines, symbol);  // sines is symmetric
  Eigen::VectorXd c = Eigen::VectorXd::Zero(n);
  for (double change = 1; change > 1e-13;) {
    change = 0;
    for (int i = 0; i < n; ++i) {
      const double next = std::max(0.0, c(i) - (d.row(i).dot(c) - q(i)) / d(i, i));
      change = std::max(change, std::abs(next - c(i)));
      c(i) = next;
    }
  }
  return c;
}

TEST(BodyAlone, OnAnObstacleConvergesToItsReference) {
  const Eigen::VectorXd fine = obstacle_reference(255);
  for (const Element* element : {&p1(), &crouzeix_raviart()})
    for (const bool regular : {true, false}) {
      const Result a = answer(NoLayer{}, mesh_of(regular, 64, 0), *element);
      double worst = 0;
      for (Eigen::Index i = 0; i < a.table.rows(); ++i) {
        const double at = a.table(i, 0) * 256 -
                          1;  // unknowns at multiples of 1/128, points of the reference of 1/256
        const auto j = static_cast<Eigen::Index>(std::lround(at));
        ASSERT_NEAR(at, static_cast<double>(j), 1e-6);
        worst = std::max(worst, std::abs(a.table(i, 1) - fine(j)));
      }
      // u is 0.15 on Sigma; P1 and CR err by O(h^2) away from the end of contact, where u behaves
      // like r^(3/2)
      EXPECT_LE(worst, 1.5e-3) << element->name() << (regular ? " structured" : " unstructured");
    }
}

}  // namespace antilock::test::agreement_test

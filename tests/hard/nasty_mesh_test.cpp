// Nasty meshes: needles, slivers, strong grading, thin layers, any numbering and orientation. An
// answer that quadruple precision proves right, or a refusal of one line.
#include "antilock/mesh/graded.hpp"
#include "antilock/mesh/layered.hpp"
#include "hard/quad_reference.hpp"
#include "support/scenes.hpp"

namespace antilock::hard::nasty_mesh_test {

using namespace test;

std::vector<TaggedEdge> boundary(const TriangleMesh& mesh) {
  std::vector<TaggedEdge> tagged;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] != EdgeTag::interior)
      tagged.push_back({mesh.edges(e, 0), mesh.edges(e, 1), mesh.edge_tag[e]});
  return tagged;
}

/// The tensor mesh of x = at_x(column), y = at_y(row), rows counted from -n to n.
TriangleMesh on_lines(int n, const std::function<double(int)>& at_x,
                      const std::function<double(int)>& at_y) {
  std::vector<double> x, y;
  for (int i = 0; i <= n; ++i) x.push_back(at_x(i));
  for (int j = -n; j <= n; ++j) y.push_back(at_y(j));
  return tensor_mesh(x, y);
}

/// 0, 2^-(n-1), ..., 1/4, 1/2, 1: each cell twice as long as the one before; exact in binary.
double doubling(int i, int n) { return i == 0 ? 0 : std::ldexp(1.0, i - n); }

/// Every inner vertex moved at random, by the share `reach` of the way to where a triangle would
/// turn over.
TriangleMesh jittered(const TriangleMesh& mesh, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, 6.283185307179586);
  std::vector<std::vector<int>> around(mesh.vertex_count());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) around[mesh.triangles(t, i)].push_back(t);
  std::vector<char> fixed(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] != EdgeTag::interior)
      fixed[mesh.edges(e, 0)] = fixed[mesh.edges(e, 1)] = 1;
  TriangleMesh moved = mesh;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (fixed[v]) continue;
    const Eigen::RowVector2d home = moved.vertices.row(v),
                             way(std::cos(angle(random)), std::sin(angle(random)));
    double room = 1;  // the area falls linearly along the way
    for (const int t : around[v]) {
      const double before = moved.twice_area(t);
      moved.vertices.row(v) = home + 1e-3 * way;
      const double slope = (before - moved.twice_area(t)) / 1e-3;
      moved.vertices.row(v) = home;
      if (slope > 0) room = std::min(room, before / slope);
    }
    moved.vertices.row(v) = home + reach * room * way;
  }
  return make_mesh(moved.vertices, moved.triangles, moved.region, boundary(mesh), "jittered");
}

double worst_aspect(const TriangleMesh& mesh) {
  double worst = 1;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      worst = std::max(
          worst, std::pow(mesh.edge_length(mesh.triangle_edges(t, i)), 2) / mesh.twice_area(t));
  return worst;
}

/// Solves at every epsilon and has quadruple precision prove the answers.
void prove(const std::string& what, const TriangleMesh& mesh, const Element& element,
           const std::vector<double>& epsilons) {
  const Space space(mesh, element);
  for (const double epsilon : epsilons) {
    SCOPED_TRACE(what + ", " + element.name() + ", epsilon = " + std::to_string(epsilon));
    const VariationalInequality problem = stiff_problem(space, epsilon);
    const Solution solution = active_set(problem);
    const QuadSolution exact = settle(problem, solution.active, quad_reference);
    ASSERT_LT(exact.residual, 1e-18);
    EXPECT_GE(std::min(exact.min_gap, exact.min_pressure), -1e-18);
    EXPECT_LT(distance(solution.u, exact.u), 1e-9);
    EXPECT_TRUE(solution.warning.empty()) << solution.warning;
  }
}

const std::vector<double> all{1, 1e-2, 1e-4, 1e-8, 0};

class Nasty : public testing::TestWithParam<const char*> {
 protected:
  const Element& chosen() const { return element(GetParam()); }
};

TEST_P(Nasty, NeedlesAlongX) {
  const auto y = [](int j) {
    return std::copysign(j == 0 ? 0 : std::abs(j) < 9 ? doubling(std::abs(j), 8) / 64 / 64 : 1, j);
  };
  // rows: eight needles each side of Sigma within 2.4e-4, then one row of the rest
  const TriangleMesh mesh = on_lines(
      9, [](int i) { return i / 9.0; }, y);
  EXPECT_GT(worst_aspect(mesh), 1e4);
  prove("needles along x", mesh, chosen(), all);
}

TEST_P(Nasty, NeedlesAlongY) {
  const auto x = [](int i) {
    return i <= 8 ? doubling(i, 8) / 4096 / 2 : 1 - doubling(16 - i, 8) / 4096 / 2;
  };
  const TriangleMesh mesh = on_lines(16, x, [](int j) { return j / 16.0; });
  EXPECT_GT(worst_aspect(mesh), 1e4);
  prove("needles along y", mesh, chosen(), all);
}

TEST_P(Nasty, GradedFrom1em1To1em5) {
  const auto graded = [](int j) { return std::copysign(doubling(std::abs(j), 17), j); };
  prove("graded towards Sigma",
        on_lines(
            17, [](int i) { return i / 17.0; }, graded),
        chosen(), all);
  prove("graded towards the corner",
        on_lines(
            17, [](int i) { return doubling(i, 17); }, graded),
        chosen(), all);
  const auto to_gamma_c = [](int j) { return j >= 0 ? j / 17.0 : -1 + doubling(17 + j, 17); };
  prove("graded towards Gamma_C",
        on_lines(
            17, [](int i) { return i / 17.0; }, to_gamma_c),
        chosen(), all);
}

TEST_P(Nasty, VerticesMovedUntilTrianglesAlmostTurnOver) {
  for (const double reach : {0.9, 0.99}) {  // aspect 3e3 and 3e6
    prove("structured, moved " + std::to_string(reach), jittered(structured_mesh(16), reach, 1),
          chosen(), all);
    prove("unstructured, moved " + std::to_string(reach), jittered(unstructured_mesh(16), reach, 2),
          chosen(), all);
  }
}

/// Whether the problem of a mesh and a scene has an answer, which must be right to 1e-6, the level
/// above which the library refuses; a refusal has one line.
bool survives(const std::function<TriangleMesh()>& make, const Element& element,
              const Scene& scene) {
  try {
    const TriangleMesh mesh = make();
    const VariationalInequality problem = assemble(scene, Space(mesh, element));
    const Solution solution = active_set(problem);
    const QuadSolution exact = settle(problem, solution.active, quad_reference);
    if (!(exact.residual < 1e-18))
      return false;  // what u is worth quadruple precision cannot tell either
    EXPECT_LT(distance(solution.u, exact.u), 1e-6)
        << "layer " << scene.layer().index() << ", aspect " << worst_aspect(mesh);
    return true;
  } catch (const Error& refusal) {
    EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << "one line";
    return false;
  }
}

// Far beyond what a mesh should be (aspect 1e9 and more) double precision may give up, but not in
// silence.
TEST_P(Nasty, FlatTrianglesAreSurvivedOrRefused) {
  int survived = 0, without_layer = 0;
  const auto flat = [](bool structured, Domain domain, double reach) {
    return [=] {
      return jittered(structured ? structured_mesh(8, domain) : unstructured_mesh(8, domain), reach,
                      5);
    };
  };
  for (const bool structured : {true, false}) {
    for (const double reach : {0.999, 0.9999, 0.99999})
      for (const double epsilon : {1.0, 1e-4, 0.0})
        survived += survives(flat(structured, {}, reach), chosen(), stiff_scene(epsilon));
    // without a stiff form as with one: there a plain solve would be taken for the answer. The
    // cells of the unstructured mesh are as small as its layer is thin: 1e-3 would be 26,000
    // unknowns
    const double thin = structured ? 1e-3 : 1e-2;
    for (const double reach : {0.99, 0.9999})
      for (const Layer& layer : {Layer{NoLayer{}}, Layer{VentcelLayer{}}, Layer{ThinLayer{thin}}}) {
        const Domain domain{std::holds_alternative<ThinLayer>(layer) ? thin : 0};
        without_layer += survives(flat(structured, domain, reach), chosen(),
                                  Scene({paper_load}, layer, UnilateralContact{}));
      }
  }
  EXPECT_GE(survived, 5) << "an aspect of 1e9 is survived";
  EXPECT_GE(without_layer, 6) << "the less flat are survived";
}

// A structured mesh moved by t h has no kernel, only functions whose d/dy is nearly zero: the modes
// that the corrections serve last. Nothing tells them from a kernel but the compliance equation.
TEST(NearlyAKernel, IsNotTakenForOneInSilence) {
  int survived = 0;
  for (const int n : {8, 16})
    for (const double t : {1e-4, 1e-6, 1e-7, 1e-9})
      for (const double epsilon : {1e-6, 1e-7, 1e-10, 0.0})
        survived += survives([=] { return jittered_mesh(n, t); }, p1(), stiff_scene(epsilon));
  EXPECT_GE(survived, 8) << "of 32: not all are refused";
}

TEST_P(Nasty, ALayerOneTriangleThickWithoutAnInnerVertex) {
  prove("one triangle thick", extruded(structured_mesh(16, {0}), 0), chosen(), all);
}

TEST_P(Nasty, TheCoarsestMeshes) {
  for (const int n : {1, 2, 3}) {
    const TriangleMesh mesh = structured_mesh(n);
    if (Space(mesh, chosen()).free_count() == 0) continue;  // P1, n = 1: every vertex is clamped
    prove("coarsest, n = " + std::to_string(n), mesh, chosen(), {1, 1e-2});
    // below, u itself tends to 0 on the meshes that hold no function of the kernel: right on the
    // scale of the forces
    for (const double epsilon : {1e-4, 1e-8, 0.0}) {
      const Space space(mesh, chosen());
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Solution solution = active_set(problem);
      const QuadSolution exact = settle(problem, solution.active, quad_reference);
      const double scale =
          problem.load.cwiseAbs().cwiseQuotient(Eigen::VectorXd(problem.a1.diagonal())).maxCoeff();
      EXPECT_LT(static_cast<double>(largest(solution.u.cast<Quad>() - exact.u)), 1e-9 * scale)
          << n << ", " << epsilon;
    }
  }
}

// The answer belongs to the places, not to the numbers: vertices, triangles and their corners
// shuffled.
TEST_P(Nasty, AnyNumberingGivesTheSameAnswer) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const Space space(mesh, chosen());
  std::map<std::pair<double, double>, double> at;
  std::mt19937 random(7);
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    const Solution straight = active_set(stiff_problem(space, epsilon));
    const double scale = straight.u.lpNorm<Eigen::Infinity>();
    at.clear();
    for (int i = 0; i < space.size(); ++i)
      at[{space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1)}] = straight.u(i);
    for (int trial = 0; trial < 3; ++trial) {
      std::vector<int> vertex(mesh.vertex_count()), triangle(mesh.triangle_count());
      std::iota(vertex.begin(), vertex.end(), 0);
      std::iota(triangle.begin(), triangle.end(), 0);
      std::shuffle(vertex.begin(), vertex.end(), random);
      std::shuffle(triangle.begin(), triangle.end(), random);
      Points vertices(mesh.vertices.rows(), 2);
      for (int v = 0; v < mesh.vertex_count(); ++v) vertices.row(vertex[v]) = mesh.vertices.row(v);
      Triples triangles(mesh.triangles.rows(), 3);
      std::vector<Region> region;
      for (const int t : triangle) {
        const auto k = static_cast<Eigen::Index>(region.size());
        const int turn = static_cast<int>(random() % 3);
        for (int i = 0; i < 3; ++i) triangles(k, i) = vertex[mesh.triangles(t, (i + turn) % 3)];
        region.push_back(mesh.region[t]);
      }
      std::vector<TaggedEdge> tagged = boundary(mesh);
      for (TaggedEdge& e : tagged) e = {vertex[e.vertices[1]], vertex[e.vertices[0]], e.tag};
      const Space other(make_mesh(vertices, triangles, region, tagged, "shuffled"), chosen());
      VariationalInequality problem = stiff_problem(other, epsilon);
      // out of order they only cost steps
      std::shuffle(problem.bounds.unknowns.begin(), problem.bounds.unknowns.end(), random);
      const Solution s = active_set(problem);
      ASSERT_EQ(other.size(), space.size());
      double worst = 0;
      for (int i = 0; i < other.size(); ++i) {
        const auto place = at.find({other.dof_coordinates()(i, 0), other.dof_coordinates()(i, 1)});
        ASSERT_NE(place, at.end());
        worst = std::max(worst, std::abs(s.u(i) - place->second));
      }
      EXPECT_LT(worst, 2e-9 * scale) << "each within 1e-9 of the exact one";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Element, Nasty, testing::Values("P1", "CR"),
                         [](const auto& info) { return info.param; });

}  // namespace antilock::hard::nasty_mesh_test

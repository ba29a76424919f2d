// The diagnosis of locking held against what is kept: members of the class, elements and meshes,
// locked and not.
#include <Eigen/LU>
#include <string>

#include "antilock/analysis/locking.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/space/space.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "unit/analysis/helpers.hpp"

namespace antilock::test::analysis_test::locking_test {

using Problem = std::function<VariationalInequality(int cells)>;

/// What a force on the bounds does at compliance 1e-8, without bounds.
double flexibility(VariationalInequality problem) {
  problem.load.setZero();
  for (const int i : problem.bounds.unknowns)
    problem.load(i) = 1.0 / static_cast<double>(problem.bounds.unknowns.size());
  problem.dirichlet_values.setZero();
  problem.compliance = 1e-8;
  const std::vector<bool> none(problem.bounds.unknowns.size());
  return active_set(equality_constrained(problem, none)).u.dot(problem.load);
}

/// `kept` is measured: the flexibility at compliance 1e-8 over that of the method that is known to
/// be right.
LockingDiagnosis expect_right(const std::string& name, const Problem& method, const Problem& right,
                              int cells, bool locks, std::pair<double, double> kept) {
  VariationalInequality coarse = method(cells / 2), fine = method(cells);
  const LockingDiagnosis found = diagnose_locking(coarse, fine);
  EXPECT_EQ(found.locks(), locks) << name << ": " << found.text();
  EXPECT_EQ(found.text().find("locks") != std::string::npos, locks) << found.text();
  const double measured = flexibility(fine) / flexibility(right(cells));
  fmt::print("| {} | {} | {:.3g} |\n", name, found.text(),
             measured);  // the table of what is told and what is kept
  EXPECT_GE(measured, kept.first) << name;
  EXPECT_LE(measured, kept.second) << name;
  for (const double unit : {1e6, 1e-9}) {  // no unit of A1 is better than another
    coarse.a1 *= unit, fine.a1 *= unit;
    EXPECT_EQ(diagnose_locking(coarse, fine).locks(), locks) << name << unit;
  }
  return found;
}

TEST(LockingDiagnosis, IsRightForTheScaledLayerOnNineFamiliesOfMeshes) {
  const auto method = [](const std::string& family, const Element& element) -> Problem {
    return [family, &element](int cells) {
      const TriangleMesh mesh = mesh_family(family).mesh(cells);
      return test::stiff_problem(Space(mesh, element), 0);
    };
  };
  const Problem right = method("structured", p2());
  for (const MeshFamily& family : mesh_families()) {
    const bool columns =
        family.name == "structured" || family.name == "layered" || family.name == "columns";
    const LockingDiagnosis found = expect_right(family.name + " P1", method(family.name, p1()),
                                                right, 16, !columns, columns ? all : nearly_none);
    EXPECT_EQ(found.verdict() == Verdict::locks_completely, found.fine == 0);
    EXPECT_EQ(found.fine, family.name == "structured" ? 15 : found.fine) << "all move";
    expect_right(family.name + " CR", method(family.name, crouzeix_raviart()), right, 16, false,
                 all);
    // the one parabola that P2 keeps is what this force asks for: other loads find nothing
    const int kept =
        expect_right(family.name + " P2", method(family.name, p2()), right, 16, !columns, all).fine;
    EXPECT_EQ(kept, family.name == "unstructured" ? 1 : kept);
  }
}

TEST(LockingDiagnosis, FindsThatAHalfIsHeld) {
  const auto method = [](int cells) {  // columns on the left, tied triangles on the right
    TriangleMesh mesh = structured_mesh(cells);
    const TriangleMesh moved = jittered_mesh(cells, 0.2);
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 0) > 0.5 && mesh.vertices(v, 1) < 0)
        mesh.vertices.row(v) = moved.vertices.row(v);
    return test::stiff_problem(Space(mesh, p1()), 0);
  };
  const LockingDiagnosis found = diagnose_locking(method(8), method(16));
  EXPECT_EQ(found.verdict(), Verdict::locks_in_part) << found.text();
  EXPECT_GT(found.fine, found.coarse) << "it grows, and yet";
}

TEST(LockingDiagnosis, IsRightForRubberWhereTheBoundsMoveInsideOneTriangleAlone) {
  const auto method = [](Diagonal diagonal, bool any, const Element& x,
                         const Element& y) -> Problem {
    return [=, &x, &y](int cells) {
      const TriangleMesh mesh = with_free_sides(any ? unstructured_mesh(cells, {0})
                                                    : structured_mesh(cells, {0}, diagonal));
      const Space of_x(mesh, x), of_y(mesh, y);
      PlaneStrain rubber;
      rubber.epsilon = 0;
      return assemble(rubber, VectorSpace{of_x, of_y});
    };
  };
  const Element& cr = crouzeix_raviart();
  const Problem right = method(Diagonal::crossed, false, p2(), p2());
  expect_right("rubber P1 right", method(Diagonal::right, false, p1(), p1()), right, 32, true,
               {0.3, 0.7});
  expect_right("rubber P1 unstructured", method(Diagonal::right, true, p1(), p1()), right, 32, true,
               {0.3, 0.85});
  expect_right("rubber P1 crossed", method(Diagonal::crossed, false, p1(), p1()), right, 32, false,
               all);
  expect_right("rubber CR", method(Diagonal::right, true, cr, cr), right, 32, false, all);
  expect_right("rubber P1 / CR", method(Diagonal::right, true, p1(), cr), right, 32, false, all);
}

TEST(LockingDiagnosis, IsRightForBeamAndPlate) {
  const auto beam = [](ShearIntegration shear) -> Problem {
    return
        [shear](int cells) { return assemble(Beam{.cells = cells, .epsilon = 0, .shear = shear}); };
  };
  expect_right("beam, full", beam(ShearIntegration::full), beam(ShearIntegration::reduced), 32,
               true, nearly_none);
  expect_right("beam, reduced", beam(ShearIntegration::reduced), beam(ShearIntegration::reduced),
               32, false, all);
  // prescribed values do not matter; without bounds all unknowns of the stiff part are counted, and
  // those that B ties are no sign of locking
  VariationalInequality coarse = beam(ShearIntegration::reduced)(16),
                        fine = beam(ShearIntegration::reduced)(32);
  const double softening = diagnose_locking(coarse, fine).refinement_softening;
  for (VariationalInequality* problem : {&coarse, &fine}) problem->dirichlet_values.setOnes();
  EXPECT_EQ(diagnose_locking(coarse, fine).refinement_softening, softening);
  for (VariationalInequality* problem : {&coarse, &fine}) problem->bounds = {};
  EXPECT_FALSE(diagnose_locking(coarse, fine).locks());
  const auto plate = [](const Element& deflection, const Element& rotation,
                        ShearRule shear) -> Problem {
    return [=, &deflection, &rotation](int cells) {
      TriangleMesh mesh = unstructured_mesh(cells, {0});
      for (int e = 0; e < mesh.edge_count(); ++e)
        if (mesh.edge_triangles(e, 1) < 0) mesh.edge_tag[e] = EdgeTag::clamped;
      const Space w(mesh, deflection), theta(mesh, rotation);
      return assemble(Plate{.thickness = 0}, PlateSpace{w, {theta, theta}, shear});
    };
  };
  const Problem right = plate(p1(), p1(), ShearRule::edges);
  expect_right("plate P1", plate(p1(), p1(), ShearRule::exact), right, 16, true, nearly_none);
  expect_right("plate P1, one point", plate(p1(), p1(), ShearRule::mean), right, 16, true,
               nearly_none);
  expect_right("plate Duran-Liberman", right, right, 16, false, all);
  expect_right("plate Arnold-Falk", plate(crouzeix_raviart(), p1_bubble(), ShearRule::mean), right,
               16, false, {0.8, 1.15});
}

/// A block with a coating, nu = 0.3, whose top is pushed down on a round punch.
VariationalInequality coating(const TriangleMesh& mesh, const Element& of_x, const Element& of_y,
                              double t) {
  const Space x(mesh, of_x), y(mesh, of_y);
  Coating scene;
  scene.thickness = t;
  scene.gap = [](double at) { return (at - 0.5) * (at - 0.5); };
  return assemble(scene, VectorSpace{x, y});
}

// The contact force at t = 1e-6 is the measure; t = 0 in the rows is what the diagnosis is asked
// for. With u_x Crouzeix-Raviart and u_y P1 the kernel grows fast, and none of it moves a bound.
TEST(LockingDiagnosis, IsRightForACoatingInPlaneStrain) {
  const Element &cr = crouzeix_raviart(), &one = p1();
  struct Case {
    std::string name;
    bool columns;
    const Element &x, &y;
    bool locks;
  };
  const auto mesh = [](bool columns, int cells) {
    return with_free_sides(columns ? structured_mesh(cells) : unstructured_mesh(cells));
  };
  constexpr int cells = 16;
  const auto force = [&](const Case& c) {
    return active_set(coating(mesh(c.columns, cells), c.x, c.y, 1e-6)).lambda.sum();
  };
  const Case right{"P2 columns", true, p2(), p2(), false};
  const double reference = force(right);
  for (const Case& c :
       {right, Case{"P1 columns", true, one, one, false}, Case{"P1 / P1", false, one, one, true},
        Case{"P2 / P2", false, p2(), p2(), true}, Case{"CR / CR", false, cr, cr, false},
        Case{"P1 / CR", false, one, cr, false}, Case{"CR / P1", false, cr, one, true}}) {
    const LockingDiagnosis found =
        diagnose_locking(coating(mesh(c.columns, cells / 2), c.x, c.y, 0),
                         coating(mesh(c.columns, cells), c.x, c.y, 0));
    EXPECT_EQ(found.locks(), c.locks) << c.name << ": " << found.text();
    const double off = force(c) / reference - 1;
    fmt::print("| coating {} | {} | force {:+.1f} % |\n", c.name, found.text(), 100 * off);
    EXPECT_EQ(off > 0.1, c.locks) << c.name << ": the contact force is off by " << off;
  }
}

/// (23) in three dimensions: cubes cut in six tetrahedra (Kuhn), inner vertices moved by up to
/// `moved` h; P1 or Crouzeix-Raviart (an unknown per face).
VariationalInequality tetrahedra(int n, double moved, bool nonconforming, double compliance) {
  const auto vertex = [n](int i, int j, int k) {
    return (k * (n + 1) + j) * (n + 1) + i;
  };  // k from z = -1 up
  std::vector<Eigen::Vector3d> at;
  std::mt19937 random(7);
  const auto step = [&] { return moved / n * (2.0 * random() / std::mt19937::max() - 1); };
  for (int k = 0; k <= 2 * n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        Eigen::Vector3d x(i, j, k - n);
        x /= n;
        if (i > 0 && i < n && j > 0 && j < n && k > 0 && k < 2 * n && k != n)
          x += Eigen::Vector3d(step(), step(), step());
        at.push_back(x);
      }
  std::map<std::array<int, 3>, int> faces;
  std::vector<Eigen::Vector3d> places = nonconforming ? std::vector<Eigen::Vector3d>{} : at;
  std::vector<Eigen::Triplet<double>> a1, b;
  std::vector<double> m, loads;
  std::vector<std::pair<int, double>> load;
  const std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (int k = 0; k < 2 * n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& order : orders) {
          std::array<int, 4> corner{};
          std::array<int, 3> c{i, j, k};
          corner[0] = vertex(c[0], c[1], c[2]);
          for (int s = 0; s < 3; ++s) ++c[order[s]], corner[s + 1] = vertex(c[0], c[1], c[2]);
          Eigen::Matrix4d affine;
          for (int s = 0; s < 4; ++s) affine.row(s) << 1, at[corner[s]].transpose();
          const Eigen::Matrix<double, 3, 4> lambda = pseudo_inverse(affine).bottomRows<3>();
          const double volume = std::abs(affine.determinant()) / 6;
          std::array<int, 4> unknown = corner;
          if (nonconforming)
            for (int s = 0; s < 4; ++s) {
              std::array<int, 3> face{corner[(s + 1) % 4], corner[(s + 2) % 4],
                                      corner[(s + 3) % 4]};
              std::sort(face.begin(), face.end());
              const auto [place, fresh] = faces.emplace(face, static_cast<int>(places.size()));
              if (fresh) places.emplace_back((at[face[0]] + at[face[1]] + at[face[2]]) / 3);
              unknown[s] = place->second;
            }
          const Eigen::Matrix<double, 3, 4> gradient = nonconforming ? -3 * lambda : lambda;
          const bool body = k >= n;
          for (int r = 0; r < 4; ++r) {
            for (int s = 0; s < 4; ++s)
              a1.emplace_back(
                  unknown[r], unknown[s],
                  volume *
                      gradient.col(r).head(body ? 3 : 2).dot(gradient.col(s).head(body ? 3 : 2)));
            if (!body) b.emplace_back(static_cast<int>(m.size()), unknown[r], gradient(2, r));
          }
          if (!body) m.push_back(volume);
        }
  VariationalInequality problem;
  const auto size = static_cast<Eigen::Index>(places.size());
  problem.a1.resize(size, size);
  problem.a1.setFromTriplets(a1.begin(), a1.end());
  problem.b.resize(static_cast<Eigen::Index>(m.size()), size);
  problem.b.setFromTriplets(b.begin(), b.end());
  problem.m = Eigen::Map<Eigen::VectorXd>(m.data(), static_cast<Eigen::Index>(m.size()));
  problem.compliance = compliance;
  problem.load = Eigen::VectorXd::Zero(size);
  std::vector<int> bottom;
  for (int i = 0; i < size; ++i) {
    const Eigen::Vector3d& x = places[i];
    const bool side = std::min({x(0), x(1), 1 - x(0), 1 - x(1), 1 - x(2)}) < 1e-12;
    if (side) problem.dirichlet_dofs.push_back(i);
    if (!side && x(2) < -1 + 1e-12) bottom.push_back(i);
  }
  problem.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.dirichlet_dofs.size()));
  problem.bounds =
      Bounds::lower_on(bottom, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(bottom.size())));
  return problem;
}

TEST(LockingDiagnosis, IsRightForTetrahedra) {
  const auto method = [](double moved, bool nonconforming) -> Problem {
    return [=](int cells) { return tetrahedra(cells, moved, nonconforming, 0); };
  };
  const Problem right = method(0, false);
  expect_right("tetrahedra P1, cubes", right, right, 8, false, all);
  expect_right("tetrahedra P1, moved", method(0.2, false), right, 8, true, nearly_none);
  // the bounds of Crouzeix-Raviart lie nearer to the clamped sides: the same force moves them less,
  // cubes or not
  expect_right("tetrahedra CR, cubes", method(0, true), right, 8, false, {0.6, 1});
  expect_right("tetrahedra CR, moved", method(0.2, true), right, 8, false, {0.6, 1});
}

using std::numbers::pi;

}  // namespace antilock::test::analysis_test::locking_test

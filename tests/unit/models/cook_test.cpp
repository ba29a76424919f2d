// Cook's membrane (R. D. Cook, J. Struct. Div. 100, 1974) in plane strain: a tapered panel with the
// corners (0, 0), (48, 44), (48, 60) and (0, 44), clamped on the left, under a shear force of 1,
// uniform on the right side. mu = 0.375 and lambda = 7500 (nu = 0.499975), as in P. Krysl's
// examples.
#include "antilock/form/edge_forms.hpp"
#include "antilock/models/plane_strain.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::cook_test {

constexpr double mu = 0.375, lambda = 7500;

TriangleMesh panel(int cells) {
  TriangleMesh mesh = structured_mesh(cells, Domain{0});
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) >= 0) continue;
    const double x0 = mesh.vertices(mesh.edges(e, 0), 0), x1 = mesh.vertices(mesh.edges(e, 1), 0);
    mesh.edge_tag[e] = EdgeTag::free;
    if (x0 == 0 && x1 == 0) mesh.edge_tag[e] = EdgeTag::clamped;
    if (x0 == 1 && x1 == 1) mesh.edge_tag[e] = natural_group(0);
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const double s = mesh.vertices(v, 0), t = mesh.vertices(v, 1);
    mesh.vertices(v, 0) = 48 * s;
    mesh.vertices(v, 1) = 44 * s + t * (44 - 28 * s);
  }
  return mesh;
}

/// The mean of u_y over the right side, which is the work of the unit force.
double mean_deflection(const Element& element, int cells, double epsilon) {
  const Space space(panel(cells), element);
  const BlockLoading held{.prescribed_displacement = 0,
                          .jump_weight = element.conforming() ? 0.0 : 1.0};
  VariationalInequality problem = assemble(PlaneStrain{held, epsilon}, {space, space});
  // the model has mu = 1: the same u for the traction divided by mu
  problem.load.tail(space.size()) +=
      edge_load(space, natural_group(0), [](double, double) { return 1.0 / 16 / mu; });
  return mu * problem.load.dot(active_set(problem).u);
}

TEST(Cook, HasTheDeflectionsOfAnotherProgram) {
  // a first program in numpy, which shares no line with this library, on the same meshes; it sums
  // lambda and mu into one matrix, which costs it 1e4 eps
  constexpr double epsilon = mu / lambda;
  const struct {
    const Element& element;
    int cells;
    double deflection;
  } known[] = {{p1(), 8, 4.630581740480},
               {p1(), 16, 4.662290796348},
               {p2(), 8, 15.237828768180},
               {p2(), 16, 16.059639198545},
               {crouzeix_raviart(), 8, 16.622471558981},
               {crouzeix_raviart(), 16, 16.644870979853}};
  for (const auto& [element, cells, deflection] : known)
    EXPECT_NEAR(mean_deflection(element, cells, epsilon), deflection, 1e-7 * deflection)
        << element.name() << " " << cells;
}

/// The mean deflection at Poisson's ratio nu for mu = 0.375. It is that of Taylor and Hood's
/// element in another program, on 32 x 32 squares that are graded towards the corners. Between 24
/// and 32 squares it grows by 1e-4 (nu = 0.3) and 3e-4 (nu = 0.5).
struct PoissonsRatio {
  double nu, reference;
  double p1, p2, cr;  ///< of that program on 16 x 16 squares
};
const PoissonsRatio ratios[] = {
    {0.3, 22.5752, 20.09740541880, 22.51471862230, 22.48661802988},
    {0.4999, 16.5001, 4.75773286499, 16.08732039681, 16.64713115183},
    {0.5, 16.4970, 4.62808, 16.04571, 16.64412},  // of 1/epsilon = 1e6 and 1e7
};

TEST(Cook, LocksForP1AloneWhereNuIsNearOneHalf) {
  for (const PoissonsRatio& at : ratios) {
    const double epsilon = (1 - 2 * at.nu) / (2 * at.nu);  // mu / lambda
    const double p1_alone = mean_deflection(p1(), 16, epsilon);
    const double p2_too = mean_deflection(p2(), 16, epsilon);
    const double cr = mean_deflection(crouzeix_raviart(), 16, epsilon);
    const double digits = at.nu == 0.5 ? 3e-6 : 1e-7;
    EXPECT_NEAR(p1_alone, at.p1, digits * at.p1) << at.nu;
    EXPECT_NEAR(p2_too, at.p2, digits * at.p2) << at.nu;
    EXPECT_NEAR(cr, at.cr, digits * at.cr) << at.nu;
    // below: conforming elements are too stiff
    EXPECT_LT(p2_too, at.reference) << at.nu;
    EXPECT_NEAR(p2_too, at.reference, 0.03 * at.reference) << at.nu;
    EXPECT_NEAR(cr, at.reference, 0.01 * at.reference) << at.nu;
    // an eighth is lost where nothing locks, and seven tenths where P1 does
    if (at.nu == 0.3)
      EXPECT_NEAR(p1_alone, at.reference, 0.12 * at.reference) << at.nu;
    else
      EXPECT_LT(p1_alone, 0.3 * at.reference) << at.nu;
  }
}

}  // namespace antilock::test::models_test::cook_test

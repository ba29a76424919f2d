// Functions that know triangles only. Each of them refuses tetrahedra in one line, so that no
// number of such a mesh is wrong.
#include "antilock/adapt/bisection.hpp"
#include "antilock/adapt/marking.hpp"
#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/best_approximation.hpp"
#include "antilock/analysis/layer_components.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/analysis/locking_loss.hpp"
#include "antilock/analysis/locking_report.hpp"
#include "antilock/analysis/negative_part.hpp"
#include "antilock/analysis/worst_load.hpp"
#include "antilock/certificate/balanced_tolerance.hpp"
#include "antilock/certificate/certificate.hpp"
#include "antilock/certificate/companion.hpp"
#include "antilock/certificate/contact_force_bounds.hpp"
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/form/interior_penalty.hpp"
#include "antilock/form/mortar.hpp"
#include "antilock/form/plate_forms.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/measure/point_values.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/mesh/two_bodies.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/models/plate.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::models_test::plane_only_test {

constexpr CellKind kind = CellKind::tetrahedron;
const std::string triangles = "a mesh of tetrahedra; accepted: triangles";

double no_load(double, double) { return 0; }

Mesh body_and_layer() { return structured_mesh(2, {1, kind}); }
Mesh body_alone() { return structured_mesh(2, {0, kind}); }
Scene stiff() { return Scene({no_load}, StiffLayer{0.1}, UnilateralContact{}); }

Result solved(const Element& element) {
  const Space space(body_and_layer(), element);
  Result result{.space = space, .problem = assemble(stiff(), space)};
  result.solution = active_set(result.problem);
  return result;
}

Reference zero() {
  return {[](double, double, double) { return 0.0; },
          [](double, double, double) { return Eigen::Vector3d(0, 0, 0); },
          [](double, double, double) { return 0.0; }};
}

TEST(PlaneOnly, GeometryOfATriangle) {
  const Mesh mesh = body_and_layer();
  const Eigen::Vector3d centroid = Eigen::Vector3d::Constant(1.0 / 3);
  expect_refused([&] { mesh.area(0); }, triangles);
  expect_refused([&] { mesh.edge_length(0); }, triangles);
  expect_refused([&] { barycentric_gradients(mesh, 0); }, triangles);
  expect_refused([&] { point_in(mesh, 0, centroid); }, triangles);
}

TEST(PlaneOnly, ChangesOfAMesh) {
  const Mesh mesh = body_and_layer();
  Mesh copy = mesh;
  expect_refused([&] { refined(mesh); }, triangles);
  expect_refused([&] { bisected(mesh, std::vector<bool>(mesh.triangle_count())); }, triangles);
  expect_refused([&] { longest_edge_first(mesh); }, triangles);
  expect_refused([&] { resolve_load(copy, no_load, 1000); }, triangles);
  expect_refused([&] { with_free_sides(mesh); }, triangles);
  expect_refused([&] { extruded(body_alone(), 0.1, true); }, triangles);
  expect_refused([&] { two_body_mesh(mesh, mesh); }, triangles);
}

TEST(PlaneOnly, ElementsOfOtherKinds) {
  expect_refused([] { element("P3", kind); }, "accepted \"P1\", \"P2\" and \"CR\"");
  expect_refused([] { lagrange(3, kind); }, "degree 3 is not accepted; 1 to 2");
  for (const Element* planar :
       {&p1(), &p1_bubble(), &hybrid_bdm1(), &fortin_soulie(), &discontinuous_p1()})
    expect_refused([&] { Space(body_and_layer(), *planar); }, "on a mesh of tetrahedra");
}

TEST(PlaneOnly, Forms) {
  const Space space(body_alone(), p1(kind)), cr(space, crouzeix_raviart(kind));
  const VectorSpace vectors{space, space}, jumping{cr, cr};
  const PlateSpace plate{space, vectors};
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(space.size());
  expect_refused([&] { ventcel_form(space, zeros); }, triangles);
  expect_refused(
      [&] { interface_constraints(space, upper_side, lower_side, InterfaceMethod::mortar); },
      triangles);
  expect_refused([&] { interior_penalty_form(space, Region::body, 0, {}); }, triangles);
  expect_refused([&] { divergence(vectors); }, triangles);
  expect_refused([&] { strain_form(vectors); }, triangles);
  expect_refused([&] { jump_form(jumping, 1); }, triangles);
  expect_refused([&] { jump_rows(jumping, 1); }, triangles);
  expect_refused([&] { bending_form(plate, 0.3); }, triangles);
  expect_refused([&] { shear_form(plate); }, triangles);
  const Space stiff_space(body_and_layer(), p1(kind));
  const FactoredForm strain = layer_strain(stiff_space);
  const Mesh& mesh = stiff_space.mesh();
  expect_refused([&] { box_projection(mesh, strain, 1, 1); }, triangles);
  expect_refused([&] { vertex_projection(mesh, strain, strain_quadrature(p1(kind))); }, triangles);
}

TEST(PlaneOnly, Models) {
  const Space space(body_alone(), p1(kind));
  const VectorSpace vectors{space, space};
  const Scene ventcel({no_load}, VentcelLayer{}, UnilateralContact{});
  expect_refused([&] { assemble(ventcel, space); }, triangles);
  expect_refused([&] { assemble(Scene({no_load}, NoLayer{}), space, InteriorPenalty{}); },
                 triangles);
  expect_refused([&] { assemble(PlaneStrain{}, vectors); }, triangles);
  expect_refused([&] { assemble(Coating{}, vectors); }, triangles);
  expect_refused([&] { pressure(Coating{}, vectors, {}, {}); }, triangles);
  expect_refused([&] { assemble(Plate{}, PlateSpace{space, vectors}); }, triangles);
}

TEST(PlaneOnly, Measurements) {
  const Result result = solved(crouzeix_raviart(kind));
  const Space& space = result.space;
  const Eigen::VectorXd& u = result.solution.u;
  expect_refused([&] { contact_edges(space.mesh()); }, triangles);
  expect_refused([&] { contact_trace(space, u); }, triangles);
  expect_refused([&] { contact_work(space, [](double) { return 1.0; }); }, triangles);
  expect_refused([&] { consistency_residual(space, result.problem.load, zero(), {}); }, triangles);
  expect_refused([&] { h1_products(space, zero()); }, triangles);
  expect_refused([&] { interpolant(space, no_load); }, triangles);
}

TEST(PlaneOnly, Analysis) {
  const Result result = solved(p1(kind)), cr = solved(crouzeix_raviart(kind));
  const Mesh& mesh = result.space.mesh();
  expect_refused([&] { bending_length(mesh, 0); }, triangles);
  expect_refused([&] { bending_length(mesh); }, triangles);
  expect_refused([&] { locking_loss(stiff(), result); }, triangles);
  expect_refused([&] { ErrorForm(result.space, LoadModes(2)); }, triangles);
  expect_refused([&] { negative_part(cr.space, cr.problem, h1_gram_matrix(cr.space)); }, triangles);
  expect_refused(
      [&] { best_approximation(result.space, result.problem, zero(), AdmissibleSet::k_h); },
      triangles);
}

TEST(PlaneOnly, CertificatesAndAccuracies) {
  const Result result = solved(crouzeix_raviart(kind));
  const Space p(result.space, p1(kind));
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(p.size());
  expect_refused([&] { equilibrated_flux(stiff(), result); }, triangles);
  expect_refused([&] { local_companion(stiff(), result); }, triangles);
  expect_refused([&] { certify(stiff(), result); }, triangles);
  expect_refused([&] { contact_force_bounds(stiff(), result, Certificate{}); }, triangles);
  expect_refused([&] { assemble_in_k(stiff(), p); }, triangles);
  expect_refused([&] { admissible_bounds(UnilateralContact{}, p, zeros); }, triangles);
  expect_refused([&] { energy_bounds(stiff(), p.mesh()); }, triangles);
  expect_refused([&] { solve_to(stiff(), p.mesh(), {.relative = 0.1}); }, triangles);
}

TEST(PlaneOnly, Files) {
  const TemporaryFolder folder;
  const Mesh mesh = body_alone();
  const Eigen::MatrixX3d corners = Eigen::MatrixX3d::Zero(mesh.triangle_count(), 3);
  expect_refused([&] { write_vtu(folder / "u.vtu", mesh, corners); }, triangles);
  const Mesh squares = structured_mesh(2, {1, CellKind::quadrilateral});
  expect_refused([&] { write_freefem_mesh(folder / "mesh.msh", squares); },
                 "a mesh of quadrilaterals; accepted: triangles or tetrahedra");
}

TEST(PlaneOnly, Quadrilaterals) {
  const Space space(structured_mesh(2, {1, CellKind::quadrilateral}), q1());
  expect_refused([&] { layer_components(space.mesh()); }, "accepted: triangles");
  PlaneStrain rough;
  rough.friction = [](double) { return 1.0; };
  const Space block(structured_mesh(2, {0, CellKind::quadrilateral}), q1());
  expect_refused([&] { assemble(rough, VectorSpace{block, block}); }, "accepted: triangles");
  expect_refused([&] { assemble(Coating{}, VectorSpace{block, block}); }, "accepted: triangles");
  expect_refused([&] { space.mesh().area(0); }, "accepted: triangles");
  expect_refused([&] { PointValues{space}; }, "accepted: triangles and tetrahedra");
}

}  // namespace antilock::test::models_test::plane_only_test

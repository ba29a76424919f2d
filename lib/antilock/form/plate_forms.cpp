#include "antilock/form/plate_forms.hpp"

#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/form/detail/strains.hpp"
#include "antilock/form/elasticity_forms.hpp"

namespace antilock {
namespace {

/// The unit tangent of an edge, from its smaller vertex to its larger.
Eigen::RowVector2d tangent(const TriangleMesh& mesh, int e) {
  return (mesh.vertices.row(mesh.edges(e, 1)) - mesh.vertices.row(mesh.edges(e, 0))) /
         mesh.edge_length(e);
}

/// Both components of grad w - theta, theta averaged with a rule.
void add_strain(FactoredFormBuilder& rows, const PlateSpace& space, int t, const Quadrature& rule,
                double weight) {
  const Eigen::MatrixX3d derivative =
      space.deflection.element().derivative(Eigen::Vector3d::Constant(1.0 / 3));
  const Eigen::MatrixX2d slope = derivative * barycentric_gradients(space.mesh(), t);
  const Space& rotation = space.rotation.x;
  Eigen::VectorXd mean =
      Eigen::VectorXd::Zero(rotation.element().dofs());  // of the basis of the rotation
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    mean += rule.weights(q) * rotation.element().basis(rule.points.row(q));
  for (const int c : {0, 1}) {
    rows.add(t, weight);
    for (int i = 0; i < 3; ++i) rows.put(space.deflection.cell_dofs()(t, i), slope(i, c));
    for (Eigen::Index i = 0; i < mean.size(); ++i)
      if (mean(i) != 0)
        rows.put((c == 0 ? space.theta_x() : space.theta_y()) + rotation.cell_dofs()(t, i),
                 -mean(i));
  }
}

/// The Nedelec field of the edge integrals g_i of the strain: at the centroid sum g_i (grad
/// lambda_k - grad lambda_j)/3, b = circulation / (2 area).
void add_edge_field(FactoredFormBuilder& rows, const PlateSpace& space, int t) {
  const TriangleMesh& mesh = space.mesh();
  const Eigen::Matrix<double, 3, 2> gradient = barycentric_gradients(mesh, t);
  const double area = mesh.area(t);
  double polar = 0;  // mean of |x - centroid|^2
  for (int i = 0; i < 3; ++i)
    polar += std::pow(mesh.edge_length(mesh.triangle_edges(t, i)), 2) / 36;
  for (int row = 0; row < 3; ++row) {
    rows.add(t, row < 2 ? area : area * polar);
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i), j = (i + 1) % 3, k = (i + 2) % 3;
      const int from = mesh.triangles(t, j), to = mesh.triangles(t, k);
      const double weight = row < 2 ? (gradient(k, row) - gradient(j, row)) / 3 : 1 / (2 * area);
      const Eigen::RowVector2d along = mesh.vertices.row(to) - mesh.vertices.row(from);
      if (row < 2) {  // the circulation of a gradient is 0
        rows.put(to, weight);
        rows.put(from, -weight);
      }
      for (const int vertex : {from, to}) {
        rows.put(space.theta_x() + vertex, -weight * along(0) / 2);
        rows.put(space.theta_y() + vertex, -weight * along(1) / 2);
      }
      rows.put(space.on_edges() + e, -weight * along.dot(tangent(mesh, e)));
    }
  }
}

void check_elements(const PlateSpace& space) {
  if (!have_one_mesh(space.rotation.x, space.deflection) ||
      !have_one_mesh(space.rotation.y, space.deflection))
    throw Error(
        "plate: deflection and rotation live on different meshes; accepted: spaces of one mesh");
  if (&space.rotation.x.element() != &space.rotation.y.element())
    throw Error("plate: the rotation is of " + space.rotation.x.element().name() + " in x and of " +
                space.rotation.y.element().name() + " in y; accepted: one element twice");
  const std::string w = space.deflection.element().name(),
                    theta = space.rotation.x.element().name();
  const bool affine = w == "P1" && theta == "P1" && space.rotation.y.element().name() == "P1";
  if (!affine && (space.shear != ShearRule::mean || space.deflection.element().degree() != 1))
    throw Error(
        "plate: deflection " + w + " and rotation " + theta +
        " are not accepted with this shear rule; accepted P1 and P1, or the mean over a triangle");
}

}  // namespace

SparseMatrix bending_form(const PlateSpace& space, double poisson) {
  require_triangles(space.mesh(), "bending form");
  check_elements(space);
  const TriangleMesh& mesh = space.mesh();
  // the bubbles 6 lambda_j lambda_k of the edges are rotations, too
  const int bubbles = space.shear == ShearRule::edges ? 3 : 0;
  const int degree = std::max(space.rotation.x.element().degree(), bubbles > 0 ? 2 : 1);
  const Quadrature& rule = triangle_rule(2 * (degree - 1));
  const Gradients rotation(space.rotation, rule);
  const Eigen::Matrix4d stiffness = Lame{poisson, (1 - poisson) / 2}.matrix();
  return assemble_strains(space.size(), mesh.triangle_count(), [&](int t) {
    const Eigen::Matrix<double, 3, 2> to_xy = barycentric_gradients(mesh, t);
    const Eigen::VectorXi own = rotation.unknowns(t);
    const Eigen::Index all = own.size() + bubbles;
    Eigen::VectorXi unknown(all);
    unknown.head(own.size()) = own.array() + space.theta_x();
    unknown.tail(bubbles) =
        mesh.triangle_edges.row(t).head(bubbles).transpose().array() + space.on_edges();
    Eigen::MatrixXd local = Eigen::MatrixXd::Zero(all, all);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      Eigen::Matrix4Xd d(4, all);
      d.leftCols(own.size()) = rotation.at(q, to_xy);
      for (int i = 0; i < bubbles; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Eigen::RowVector2d slope = 6 * (rule.points(q, j) * to_xy.row(k) +
                                              rule.points(q, k) * to_xy.row(j)),
                                 along = tangent(mesh, mesh.triangle_edges(t, i));
        d.col(own.size() + i) << along(0) * slope.transpose(), along(1) * slope.transpose();
      }
      local += rule.weights(q) * mesh.area(t) * d.transpose() * stiffness * d;
    }
    return std::pair(unknown, local);
  });
}

FactoredForm shear_form(const PlateSpace& space) {
  require_triangles(space.mesh(), "shear form");
  check_elements(space);
  const TriangleMesh& mesh = space.mesh();
  FactoredFormBuilder rows;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (space.shear == ShearRule::edges) add_edge_field(rows, space, t);
    if (space.shear == ShearRule::mean)
      add_strain(rows, space, t, triangle_rule(space.rotation.x.element().degree()), mesh.area(t));
    if (space.shear == ShearRule::exact)
      for (int q = 0; q < 3; ++q)
        add_strain(rows, space, t, {midpoint_rule().points.row(q), Eigen::VectorXd::Ones(1)},
                   mesh.area(t) / 3);
  }
  return rows.form(space.size());
}

}  // namespace antilock

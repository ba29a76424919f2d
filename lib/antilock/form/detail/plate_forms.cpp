#include "antilock/form/detail/plate_forms.hpp"

#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {
namespace {

using PlateEntries = std::vector<Eigen::Triplet<double>>;

/// The basis of the rotation on a triangle at one point: its unknowns, their values (0 for the bubbles 6 lambda_j lambda_k
/// of the edges, whose shear has rows of its own), and strains xx, yy, 2 xy.
struct Rotations {
  Eigen::VectorXi unknown;
  Eigen::MatrixX2d value;
  Eigen::MatrixX3d strain;
};

/// The unit tangent of an edge, from its smaller vertex to its larger.
Eigen::RowVector2d tangent(const TriangleMesh& mesh, int e) {
  return (mesh.vertices.row(mesh.edges(e, 1)) - mesh.vertices.row(mesh.edges(e, 0))) / mesh.edge_length(e);
}

Rotations rotations(const PlateSpace& space, int t, const Eigen::Vector3d& lambda) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.rotation.x.element();
  const Eigen::Matrix<double, 3, 2> to_xy = barycentric_gradients(mesh, t);
  const Eigen::VectorXd phi = element.basis(lambda);
  const Eigen::MatrixX2d gradient = element.derivative(lambda) * to_xy;
  const Eigen::Index m = phi.size(), edges = space.shear == ShearRule::edges ? 3 : 0;
  Rotations r{Eigen::VectorXi(2 * m + edges), Eigen::MatrixX2d::Zero(2 * m + edges, 2),
              Eigen::MatrixX3d::Zero(2 * m + edges, 3)};
  r.unknown.head(m) = space.rotation.x.unknowns().row(t).transpose().array() + space.theta_x();
  r.unknown.segment(m, m) = space.rotation.y.unknowns().row(t).transpose().array() + space.theta_y();
  r.value.col(0).head(m) = r.value.col(1).segment(m, m) = phi;
  r.strain.col(0).head(m) = r.strain.col(2).segment(m, m) = gradient.col(0);
  r.strain.col(1).segment(m, m) = r.strain.col(2).head(m) = gradient.col(1);
  for (int i = 0; i < edges; ++i) {
    const int e = mesh.triangle_edges(t, i), j = (i + 1) % 3, k = (i + 2) % 3;
    const Eigen::RowVector2d along = tangent(mesh, e);
    const Eigen::RowVector2d slope = 6 * (lambda(j) * to_xy.row(k) + lambda(k) * to_xy.row(j));
    r.unknown(2 * m + i) = space.on_edges() + e;
    r.strain.row(2 * m + i) << slope(0) * along(0), slope(1) * along(1), slope(0) * along(1) + slope(1) * along(0);
  }
  return r;
}

const Quadrature& bending_rule(const PlateSpace& space) {
  return triangle_rule(2 *
                       (std::max(space.rotation.x.element().degree(), space.shear == ShearRule::edges ? 2 : 1) - 1));
}

/// The rows of B and the entries of M while they are collected.
struct ShearRows {
  PlateEntries b;
  std::vector<double> m;
  std::vector<int> cell;

  void add(int t, double weight) {
    m.push_back(weight);
    cell.push_back(t);
  }
  void put(int unknown, double value) { b.emplace_back(static_cast<int>(m.size()) - 1, unknown, value); }
};

/// Both components of grad w - theta, theta averaged with a rule.
void add_strain(ShearRows& rows, const PlateSpace& space, int t, const Quadrature& rule, double weight) {
  const Eigen::MatrixX2d slope = space.deflection.element().derivative(Eigen::Vector3d::Constant(1.0 / 3)) *
                                 barycentric_gradients(space.mesh(), t);
  for (int c = 0; c < 2; ++c) {
    rows.add(t, weight);
    for (int i = 0; i < 3; ++i) rows.put(space.deflection.unknowns()(t, i), slope(i, c));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Rotations r = rotations(space, t, rule.points.row(q));
      for (Eigen::Index i = 0; i < r.unknown.size(); ++i)
        if (r.value(i, c) != 0) rows.put(r.unknown(i), -rule.weights(q) * r.value(i, c));
    }
  }
}

/// The Nedelec field of the edge integrals g_i of the strain: at the centroid sum g_i (grad lambda_k - grad lambda_j)/3,
/// b = circulation / (2 area).
void add_edge_field(ShearRows& rows, const PlateSpace& space, int t) {
  const TriangleMesh& mesh = space.mesh();
  const Eigen::Matrix<double, 3, 2> gradient = barycentric_gradients(mesh, t);
  const double area = mesh.area(t);
  double polar = 0;  // mean of |x - centroid|^2
  for (int i = 0; i < 3; ++i) polar += std::pow(mesh.edge_length(mesh.triangle_edges(t, i)), 2) / 36;
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
  if (&space.rotation.x.mesh() != &space.mesh() || &space.rotation.y.mesh() != &space.mesh())
    throw Error("plate: deflection and rotation live on different meshes; accepted: spaces of one mesh");
  if (&space.rotation.x.element() != &space.rotation.y.element())
    throw Error("plate: the rotation is of " + space.rotation.x.element().name() + " in x and of " +
                space.rotation.y.element().name() + " in y; accepted: one element twice");
  const std::string w = space.deflection.element().name(), theta = space.rotation.x.element().name();
  const bool affine = w == "P1" && theta == "P1" && space.rotation.y.element().name() == "P1";
  if (!affine && (space.shear != ShearRule::mean || space.deflection.element().degree() != 1))
    throw Error("plate: deflection " + w + " and rotation " + theta +
                " are not accepted with this shear rule; accepted P1 and P1, or the mean over a triangle");
}

}  // namespace

SparseMatrix bending_form(const PlateSpace& space, double poisson) {
  check_elements(space);
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = bending_rule(space);
  Eigen::Matrix3d stiffness;
  stiffness << 1, poisson, 0, poisson, 1, 0, 0, 0, (1 - poisson) / 2;
  PlateEntries entries;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    Eigen::MatrixXd local;
    Eigen::VectorXi unknown;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Rotations r = rotations(space, t, rule.points.row(q));
      if (q == 0) local.setZero(r.unknown.size(), r.unknown.size());
      local += rule.weights(q) * mesh.area(t) * r.strain * stiffness * r.strain.transpose();
      unknown = r.unknown;
    }
    for (Eigen::Index i = 0; i < unknown.size(); ++i)
      for (Eigen::Index j = 0; j < unknown.size(); ++j) entries.emplace_back(unknown(i), unknown(j), local(i, j));
  }
  SparseMatrix matrix(space.size(), space.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

FactoredForm shear_form(const PlateSpace& space) {
  check_elements(space);
  const TriangleMesh& mesh = space.mesh();
  ShearRows rows;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (space.shear == ShearRule::edges) add_edge_field(rows, space, t);
    if (space.shear == ShearRule::mean)
      add_strain(rows, space, t, triangle_rule(space.rotation.x.element().degree()), mesh.area(t));
    if (space.shear == ShearRule::exact)
      for (int q = 0; q < 3; ++q)
        add_strain(rows, space, t, {midpoint_rule().points.row(q), Eigen::VectorXd::Ones(1)}, mesh.area(t) / 3);
  }
  FactoredForm form;
  form.m = Eigen::Map<const Eigen::VectorXd>(rows.m.data(), static_cast<Eigen::Index>(rows.m.size()));
  form.cell = std::move(rows.cell);
  form.b.resize(form.m.size(), space.size());
  form.b.setFromTriplets(rows.b.begin(), rows.b.end());
  return form;
}

}  // namespace antilock
